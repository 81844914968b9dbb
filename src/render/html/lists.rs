//! The pages that list things: libraries, folders, kinds, names, coverage, findings, files.

use std::collections::BTreeMap;

use tera::{Context, Value};

use super::context::Place;
use super::prose::{Prose, message};
use super::site::Site;
use super::value::{list, markup, record, strings};
use crate::book::view::coverage::{CoverageRow, Hole};
use crate::book::view::finding::{CodeCount, ReadingView};
use crate::book::view::prose::{Block, Href, Inline};
use crate::book::view::{Book, Chapter, Entry, FolderView, IndexEntry, KindList, LibraryView};

/// Above this, a long list is cut into pages.
const LONG: usize = 1500;

/// A library's overview names every entity up to this many; above, it names folders.
const OVERVIEW: usize = 250;

/// The letters that a list shows for a kind.
pub(super) fn kind_short(kind: &str) -> &'static str {
    match kind {
        "function-block" => "FB",
        "function" => "FC",
        "program" => "PRG",
        "interface" => "ITF",
        "class" => "CLS",
        "method" => "MTH",
        "property" => "PRP",
        "action" => "ACT",
        "transition" => "TRN",
        "struct" => "STR",
        "enum" => "ENM",
        "union" => "UNI",
        "alias" => "ALS",
        "subrange" => "SUB",
        "gvl" => "GVL",
        "task" => "TSK",
        _ => "",
    }
}

/// Below this root, the page that a link leads to.
pub(super) fn link_url(to: Option<&Href>) -> Option<&str> {
    match to {
        Some(Href::Page { url, .. }) => Some(url),
        _ => None,
    }
}

/// A folder's entities for the navigation, the one at `current` marked.
pub(super) fn siblings(entries: &[Entry], place: &Place, current: &str) -> Value {
    list(entries, |entry| {
        record! {
            link: place.link(&entry.link),
            short: kind_short(entry.kind),
            current: link_url(entry.link.to.as_ref()) == Some(current),
        }
    })
}

fn entry(entry: &Entry, place: &Place, prose: &Prose<'_>) -> Value {
    record! {
        link: place.link(&entry.link),
        kind: entry.kind,
        short: kind_short(entry.kind),
        library: entry.library.as_str(),
        brief: markup(&prose.inlines(&entry.brief)),
        documented: entry.documented,
        tables: entry.tables,
        badges: strings(&entry.badges),
    }
}

fn entries(entries: &[Entry], place: &Place, prose: &Prose<'_>) -> Value {
    list(entries, |e| entry(e, place, prose))
}

fn folder_name(folder: &FolderView) -> String {
    folder.path.join("/")
}

/// The front page.
pub(super) fn front(book: &Book, place: &Place, context: &mut Context) {
    context.insert_value("cards", list(&book.libraries, |library| library_card(library, place)));
}

fn library_card(library: &LibraryView, place: &Place) -> Value {
    record! {
        name: library.name.as_str(),
        href: place.href(&library.url),
        version: library.version.as_str(),
        author: library.author.as_str(),
        format: library.format.as_str(),
        path: library.path.as_str(),
        references: strings(&library.references),
        entities: library.entities,
        documented: library.documented,
        documented_percent: library.documented_percent,
        tables: library.tables,
    }
}

/// A library's overview.
pub(super) fn library(library: &LibraryView, place: &Place, prose: &Prose<'_>, context: &mut Context) {
    let shown: usize = library.folders.iter().map(|folder| folder.entities.len()).sum();
    let folder = |folder: &FolderView| {
        let listed = if shown <= OVERVIEW { &folder.entities[..] } else { &[] };
        record! {
            name: folder_name(folder),
            href: place.href(&folder.url),
            count: folder.entities.len(),
            documented: folder.entities.iter().filter(|entry| entry.documented).count(),
            tables: folder.entities.iter().map(|entry| entry.tables).sum::<usize>(),
            entries: entries(listed, place, prose),
        }
    };
    context.insert_value("library", library_card(library, place));
    context.insert_value("description", markup(&prose.blocks(&library.description, 2)));
    context.insert_value("folders", list(&library.folders, folder));
    context.insert_value("brief_list", Value::from(shown > OVERVIEW));
}

/// A folder's page.
pub(super) fn folder(
    library: &LibraryView,
    folder: &FolderView,
    place: &Place,
    prose: &Prose<'_>,
    context: &mut Context,
) {
    let below = |other: &&FolderView| other.path.len() > folder.path.len() && other.path.starts_with(&folder.path);
    let inner: Vec<&FolderView> = library.folders.iter().filter(below).collect();
    context.insert_value("library", library_card(library, place));
    context.insert_value("name", Value::from(folder_name(folder)));
    context.insert_value("entries", entries(&folder.entities, place, prose));
    context.insert_value("siblings", siblings(&folder.entities, place, ""));
    context.insert_value(
        "inner",
        list(inner, |f| record! { name: folder_name(f), href: place.href(&f.url), count: f.entities.len() }),
    );
}

/// All entities of a kind.
pub(super) fn kind(kind: &KindList, place: &Place, prose: &Prose<'_>, context: &mut Context) {
    let libraries: std::collections::BTreeSet<&str> = kind.entries.iter().map(|e| e.library.as_str()).collect();
    context.insert_value("title", Value::from(kind.title));
    context.insert_value("entries", entries(&kind.entries, place, prose));
    context.insert_value("many_libraries", Value::from(libraries.len() > 1));
}

/// A narrative page: one of `chapters`, with the way to those beside it.
pub(super) fn chapter(chapters: &[Chapter], at: usize, place: &Place, prose: &Prose<'_>, context: &mut Context) {
    let beside = |at: Option<usize>| {
        let chapter = at.and_then(|at| chapters.get(at));
        Value::from(chapter.map(|c| record! { title: c.title.as_str(), href: place.href(&c.url) }))
    };
    explanation(&chapters[at], prose, context);
    context.insert_value("previous", beside(at.checked_sub(1)));
    context.insert_value("next", beside(at.checked_add(1)));
}

/// A page by itself, such as the one that explains a code.
pub(super) fn explanation(chapter: &Chapter, prose: &Prose<'_>, context: &mut Context) {
    context.insert_value("title", Value::from(chapter.title.as_str()));
    context.insert_value("content", markup(&prose.blocks(&chapter.content, 2)));
    context.insert_value("headings", headings(&chapter.content));
    context.insert_value("previous", Value::none());
    context.insert_value("next", Value::none());
}

/// The headings of the two highest levels, for the table of contents beside a page.
fn headings(blocks: &[Block]) -> Value {
    let heading = |block: &Block| match block {
        Block::Heading { level, anchor, content } if *level <= 2 => {
            Some(record! { level: *level as usize, anchor: anchor.as_str(), text: Inline::plain(content) })
        }
        _ => None,
    };
    Value::from(blocks.iter().filter_map(heading).collect::<Vec<_>>())
}

/// The names by initial; `#` gathers what begins with no letter.
pub(super) fn initials(book: &Book) -> BTreeMap<String, Vec<&IndexEntry>> {
    let mut groups: BTreeMap<String, Vec<&IndexEntry>> = BTreeMap::new();
    for entry in &book.index {
        let initial = entry.name.chars().next().filter(|c| c.is_alphabetic());
        let key = initial.map_or_else(|| "#".to_owned(), |c| c.to_uppercase().to_string());
        groups.entry(key).or_default().push(entry);
    }
    groups
}

/// Whether each initial has a page of its own.
pub(super) fn names_are_split(book: &Book) -> bool {
    book.index.len() > LONG
}

/// The path of the page with the names under `initial`.
pub(super) fn names_path(book: &Book, initial: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphabetic() { c.to_string() } else { format!("{:x}", u32::from(c)) };
    if names_are_split(book) {
        format!("names-{}.html", initial.to_lowercase().chars().map(letter).collect::<String>())
    } else {
        "names.html".to_owned()
    }
}

/// The index; of `only` one initial, or of all that fit on its first page.
pub(super) fn names(book: &Book, only: Option<&str>, place: &Place, context: &mut Context) {
    let initials = initials(book);
    let split = names_are_split(book);
    let id = |initial: &str| if initial == "#" { "rb-other".to_owned() } else { format!("rb-{initial}") };
    let letters: Vec<Value> = initials
        .iter()
        .map(|(initial, entries)| {
            let path = names_path(book, initial);
            let href = if split { place.href(&path) } else { format!("#{}", id(initial)) };
            record! { initial: initial.as_str(), href: href, count: entries.len(), current: only == Some(initial) }
        })
        .collect();
    let shown = |initial: &str| !split || only == Some(initial);
    let groups: Vec<Value> = initials
        .iter()
        .filter(|(initial, _)| shown(initial))
        .map(|(initial, entries)| record! { initial: initial.as_str(), id: id(initial), entries: names_of(entries, place) })
        .collect();
    context.insert_value("letters", Value::from(letters));
    context.insert_value("groups", Value::from(groups));
    context.insert_value("total", Value::from(book.index.len()));
}

fn names_of(entries: &[&IndexEntry], place: &Place) -> Value {
    list(entries, |entry| {
        record! {
            name: entry.name.as_str(),
            href: place.href(&entry.url),
            kind: entry.kind_label,
            context: entry.context.as_str(),
            brief: entry.brief.as_str(),
        }
    })
}

/// Documented and verified.
pub(super) fn coverage(book: &Book, place: &Place, context: &mut Context) {
    let coverage = &book.coverage;
    context.insert_value("by_folder", list(&coverage.by_folder, coverage_row));
    context.insert_value("by_kind", list(&coverage.by_kind, coverage_row));
    context.insert_value("total", coverage_row(&coverage.total));
    context.insert_value("undocumented", list(&coverage.undocumented, |h| hole(h, place)));
    context.insert_value("unverified", list(&coverage.unverified, |h| hole(h, place)));
}

fn coverage_row(row: &CoverageRow) -> Value {
    record! {
        name: row.name.as_str(),
        entities: row.entities,
        documented: row.documented,
        documented_percent: row.documented_percent.min(100),
        variables: row.variables,
        variables_documented: row.variables_documented,
        variables_percent: row.variables_percent.min(100),
        tables: row.tables,
        verified: row.verified,
        verified_percent: row.verified_percent.min(100),
    }
}

fn hole(hole: &Hole, place: &Place) -> Value {
    record! { link: place.link(&hole.link), what: markup(&message(&hole.what)), file: hole.file.as_str(), line: hole.line }
}

/// Whether each code has a page of its own.
pub(super) fn findings_are_split(book: &Book) -> bool {
    book.findings.len() > LONG
}

/// The path of the page with the findings of `code`.
pub(super) fn findings_path(book: &Book, code: &str) -> String {
    if findings_are_split(book) { format!("findings-{code}.html") } else { "findings.html".to_owned() }
}

/// What the group of `code` is called on its page: a code may have findings of more than one severity.
fn group_id(book: &Book, code: &CodeCount) -> String {
    let first = book.codes.iter().find(|other| other.code == code.code);
    match first.is_none_or(|first| first.severity == code.severity) {
        true => code.code.clone(),
        false => format!("{}-{}", code.code, code.severity),
    }
}

/// The findings; of `only` one code, or of all that fit on the first page.
pub(super) fn findings(site: &Site<'_>, only: Option<&str>, place: &Place, context: &mut Context) {
    let book = site.book;
    let split = findings_are_split(book);
    let codes = list(&book.codes, |code| {
        let href =
            if split { place.href(&findings_path(book, &code.code)) } else { format!("#rb-{}", group_id(book, code)) };
        record! {
            code: code.code.as_str(),
            title: code.title.as_str(),
            severity: code.severity,
            count: code.count,
            href: href,
            page: site.explanation(&code.code).map(|url| place.href(url)),
            current: only == Some(code.code.as_str()),
        }
    });
    let shown = |code: &str| !split || only == Some(code);
    let groups: Vec<Value> = book
        .codes
        .iter()
        .filter(|code| shown(&code.code))
        .map(|code| {
            let of_code = book.findings.iter();
            let of_code = of_code.filter(|finding| finding.code == code.code && finding.severity == code.severity);
            record! {
                id: group_id(book, code),
                code: code.code.as_str(),
                title: code.title.as_str(),
                severity: code.severity,
                count: code.count,
                page: site.explanation(&code.code).map(|url| place.href(url)),
                findings: list(of_code, |finding| {
                    let entity = site.entity_of(finding);
                    site.finding(finding, place, None, entity)
                }),
            }
        })
        .collect();
    context.insert_value("codes", codes);
    context.insert_value("groups", Value::from(groups));
    context.insert_value("only", Value::from(only));
}

/// Files that are not in the manual, and names from elsewhere.
pub(super) fn files(book: &Book, context: &mut Context) {
    let skipped = list(&book.skipped, |s| record! { file: s.file.as_str(), reason: s.reason.as_str() });
    let reading = |r: &ReadingView| {
        record! { format: r.format.as_str(), encoding: r.encoding.as_str(), nest: r.comments_nest, files: r.files }
    };
    context.insert_value("readings", list(&book.readings, reading));
    let externals = list(&book.externals, |(name, count)| record! { name: name.as_str(), count: *count });
    context.insert_value("skipped", skipped);
    context.insert_value("externals", externals);
}
