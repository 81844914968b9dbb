//! What stands beside the tree and belongs to its evidence: requirements, results of other tools; and the report of it all.

use std::collections::BTreeMap;

use super::{Project, Stamp, records};
use crate::book::Narrative;
use crate::book::view::Book;
use crate::book::view::entity::Fact;
use crate::book::view::prose::{Block, Inline};
use crate::config::Settings;
use crate::diagnostic::Finding;
use crate::evidence::codes::{UNKNOWN_REQUIREMENT, UNMET_REQUIREMENT, UNREADABLE_RESULTS};
use crate::evidence::diff::Comparison;
use crate::evidence::record::{Answer, Record};
use crate::evidence::requirements::{self, Requirement};
use crate::evidence::results::{self, Outside};
use crate::evidence::{changelog, report, trace};
use crate::library::ItemKind;
use crate::library::names::fold;
use crate::source::{EntryKind, FileSystem};
use crate::text::{Place, decode};

/// No list and no report is larger.
const LIMIT: u64 = 64 << 20;

/// What stands beside the tree.
#[derive(Clone, Debug, Default)]
pub struct Beside {
    /// The requirements, in the order of their lists.
    pub requirements: Vec<Requirement>,
    /// Identifiers behind `@req`, with the block that they stand at.
    pub tags: Vec<(String, String)>,
    /// Results of other tools, with the block that they belong to.
    pub outside: Vec<(Outside, Option<String>)>,
}

/// Reads it; what is wrong with it is added to the project's findings.
pub(super) fn read(fs: &dyn FileSystem, settings: &Settings, project: &mut Project) -> Beside {
    let mut beside = Beside { tags: Vec::new(), ..Beside::default() };
    let places = tags(project, &mut beside);
    for path in expand(fs, &settings.evidence.requirements) {
        let found = fs.read(&path, LIMIT).map_err(|error| error.to_string()).and_then(|bytes| {
            let file = requirements::read(&path, &bytes)?;
            Ok((file, bytes))
        });
        match found {
            Ok((list, bytes)) => {
                unmet(project, &beside, &path, &bytes, &list);
                beside.requirements.extend(list);
            }
            Err(message) => unreadable(project, &path, &message),
        }
    }
    if !settings.evidence.requirements.is_empty() {
        for (place, id) in places {
            if !beside.requirements.iter().any(|requirement| requirement.id == id) {
                let message = format!("there is no requirement `{id}`");
                project.findings.push(Finding::new(&UNKNOWN_REQUIREMENT, place, message));
            }
        }
    }
    for path in expand(fs, &settings.evidence.results) {
        let found = fs.read(&path, LIMIT).map_err(|error| error.to_string());
        match found.and_then(|bytes| results::read(&path, &bytes)) {
            Ok(list) => beside
                .outside
                .extend(list.into_iter().map(|result| (block(project, &result), result)).map(|(b, r)| (r, b))),
            Err(message) => unreadable(project, &path, &message),
        }
    }
    beside
}

/// Collects the tags, and gives their places.
fn tags(project: &Project, beside: &mut Beside) -> Vec<(Place, String)> {
    let mut places = Vec::new();
    for (id, _) in project.catalogue.iter() {
        let entry = project.docs.item(id);
        let Some(doc) = entry.doc.as_ref().filter(|_| entry.inherited_from.is_none()) else { continue };
        for (requirement, place) in &doc.tags.requirements {
            beside.tags.push((requirement.clone(), project.catalogue.qualified_name(id)));
            places.push((*place, requirement.clone()));
        }
    }
    places
}

/// The paths that patterns mean; a `*` stands for any part of a file's name.
fn expand(fs: &dyn FileSystem, patterns: &[String]) -> Vec<String> {
    let mut out = Vec::new();
    for pattern in patterns {
        let Some((before, after)) = pattern.split_once('*') else {
            out.push(pattern.clone());
            continue;
        };
        let (folder, prefix) = before.rsplit_once('/').unwrap_or(("", before));
        let mut found: Vec<String> = fs
            .entries(folder)
            .unwrap_or_default()
            .into_iter()
            .filter(|entry| matches!(entry.kind, EntryKind::File(_)))
            .filter(|entry| entry.name.len() >= prefix.len() + after.len())
            .filter(|entry| entry.name.starts_with(prefix) && entry.name.ends_with(after))
            .map(|entry| if folder.is_empty() { entry.name } else { format!("{folder}/{}", entry.name) })
            .collect();
        found.sort();
        out.append(&mut found);
    }
    out
}

fn unreadable(project: &mut Project, path: &str, message: &str) {
    let file = project.files.add(path, "", crate::text::Encoding::Utf8);
    project.findings.push(Finding::of_file(&UNREADABLE_RESULTS, file, format!("cannot be read: {message}")));
}

/// Finds fault with requirements that no block meets and for which no reason is given.
fn unmet(project: &mut Project, beside: &Beside, path: &str, bytes: &[u8], list: &[Requirement]) {
    let mut holes = list
        .iter()
        .filter(|requirement| requirement.justification.is_empty())
        .filter(|requirement| !beside.tags.iter().any(|(id, _)| *id == requirement.id))
        .peekable();
    if holes.peek().is_none() {
        return;
    }
    let decoded = decode::decode(bytes);
    let text = decoded.text.clone();
    let file = project.files.add(path, decoded.text, decoded.encoding);
    for requirement in holes {
        let at = text.find(&requirement.id).unwrap_or(0);
        let place = Place::new(file, (at..at + requirement.id.len()).into());
        let message = format!("no block meets the requirement `{}`", requirement.id);
        project.findings.push(Finding::new(&UNMET_REQUIREMENT, place, message));
    }
}

/// The block that a result speaks of.
fn block(project: &Project, result: &Outside) -> Option<String> {
    let names = result.names();
    names.iter().find_map(|name| {
        let found = project.names.all(&fold(name)).iter().copied();
        let mut blocks = found.filter(|id| {
            let kind = project.catalogue.item(*id).kind;
            matches!(kind, ItemKind::FunctionBlock | ItemKind::Function | ItemKind::Program | ItemKind::Class)
        });
        blocks.next().map(|id| project.catalogue.qualified_name(id))
    })
}

/// The pages that a manual gets: the evidence report, and the changes where releases are compared.
#[must_use]
pub fn pages(
    project: &Project,
    settings: &Settings,
    stamp: &Stamp,
    records: &[(Record, Answer)],
    changes: Option<&Comparison>,
) -> Vec<Narrative> {
    let origin = records::origin(stamp);
    let records: Vec<&Record> = records.iter().map(|(record, _)| record).collect();
    let (title, version) = super::title(project, settings);
    let (mut entities, mut undocumented) = (0, Vec::new());
    for (id, item) in project.catalogue.iter().filter(|(_, item)| !item.kind.is_accessor()) {
        entities += 1;
        if item.kind != ItemKind::Task && project.docs.item(id).doc.is_none() {
            undocumented.push((item.kind.label().to_lowercase(), project.catalogue.qualified_name(id)));
        }
    }
    let matrix = trace::matrix(&project.beside.requirements, &project.beside.tags, &records);
    let text = report::markdown(&report::Input {
        title: &title,
        version: &version,
        origin: &origin,
        records: &records,
        documented: (entities - undocumented.len(), entities),
        undocumented: &undocumented,
        allowed: &project.allowed,
        matrix: &matrix,
        outside: &project.beside.outside,
        changes,
        sign_off: &settings.evidence.sign_off,
    });
    let page = |path: &str, text: String| Narrative { path: path.to_owned(), text };
    let mut pages = vec![page(report::PATH, text)];
    pages.extend(changes.map(|changes| page(changelog::PATH, changelog::markdown(changes))));
    pages
}

/// Shows results of other tools at the blocks that they belong to, in these tools' own words.
pub(super) fn show(beside: &Beside, book: &mut Book) {
    for entity in &mut book.entities {
        let name = &entity.core.qualified_name;
        let own: Vec<&Outside> =
            beside.outside.iter().filter(|(_, block)| block.as_ref() == Some(name)).map(|(result, _)| result).collect();
        if own.is_empty() {
            continue;
        }
        let cell = |text: &str| vec![Inline::text(text)];
        let row = |result: &&Outside| {
            [&result.suite, &result.case, &result.outcome, &result.tool, &result.message].map(|text| cell(text)).into()
        };
        let table = Block::Table {
            align: vec!["none"; 5],
            head: ["suite", "case", "outcome", "tool", "message"].map(cell).into(),
            rows: own.iter().map(row).collect(),
        };
        let note =
            "As these tools reported them; rungbook has checked none of this, and none of it counts as verified.";
        let content = vec![Block::Paragraph { content: cell(note) }, table];
        entity.core.facts.push(Fact { title: "Results of other tools".to_owned(), content });
    }
}

/// The book of the report alone, for a PDF of its own: `book` without all but its last `pages` chapters.
#[must_use]
pub fn report_book(book: &Book, pages: usize) -> Book {
    let mut front = book.front.clone();
    front.genre = "Evidence report".to_owned();
    let chapters = book.chapters[book.chapters.len().saturating_sub(pages)..].to_vec();
    Book {
        front,
        totals: book.totals.clone(),
        chapters,
        libraries: Vec::new(),
        entities: Vec::new(),
        kinds: Vec::new(),
        index: Vec::new(),
        coverage: crate::book::view::coverage::Coverage::default(),
        findings: Vec::new(),
        codes: Vec::new(),
        readings: Vec::new(),
        skipped: Vec::new(),
        externals: Vec::new(),
        explanations: Vec::new(),
    }
}

/// The files that the records of a release speak of, by path.
pub fn sources(fs: &dyn FileSystem, records: &[(Record, Answer)]) -> Result<BTreeMap<String, Vec<u8>>, String> {
    let mut files = BTreeMap::new();
    for (record, _) in records {
        let claim = &record.claim;
        for part in std::iter::once(&claim.table).chain(&claim.block).chain(&claim.cone) {
            if !files.contains_key(&part.file) {
                let bytes = fs.read(&part.file, u64::MAX).map_err(|error| format!("`{}`: {error}", part.file))?;
                files.insert(part.file.clone(), bytes);
            }
        }
    }
    Ok(files)
}
