//! The site as a list of jobs, one a page, and what all of them share.

use std::collections::BTreeMap;

use tera::{Context, Tera, Value};

use super::context::Place;
use super::entity::Writer;
use super::error::Error;
use super::highlight::Highlighter;
use super::prose::{Prose, message};
use super::value::{list, markup, record};
use super::{Options, Page, lists, script};
use crate::book::view::entity::EntityView;
use crate::book::view::finding::FindingView;
use crate::book::view::{Book, FolderView, Totals};
use crate::render::theme::Theme;

const TEMPLATES: &str = "templates/html/";
const STYLES: &str = "themes/";

/// A page to be rendered.
pub(super) enum Job {
    Front,
    Library(usize),
    Folder(usize, usize),
    Kind(usize),
    Entity(usize),
    Chapter(usize),
    Explanation(usize),
    Names(Option<String>),
    Findings(Option<String>),
    Coverage,
    Files,
    Search,
}

impl Job {
    /// Every page of the book's site.
    pub(super) fn all(book: &Book) -> Vec<Self> {
        let mut jobs = vec![Self::Front, Self::Names(None), Self::Coverage, Self::Findings(None)];
        jobs.extend([Self::Files, Self::Search]);
        if lists::names_are_split(book) {
            jobs.extend(lists::initials(book).into_keys().map(|initial| Self::Names(Some(initial))));
        }
        if lists::findings_are_split(book) {
            jobs.extend(book.codes.iter().map(|code| Self::Findings(Some(code.code.clone()))));
        }
        jobs.extend((0..book.chapters.len()).map(Self::Chapter));
        jobs.extend((0..book.explanations.len()).map(Self::Explanation));
        jobs.extend((0..book.kinds.len()).map(Self::Kind));
        for (l, library) in book.libraries.iter().enumerate() {
            jobs.push(Self::Library(l));
            jobs.extend((0..library.folders.len()).map(|f| Self::Folder(l, f)));
        }
        jobs.extend((0..book.entities.len()).map(Self::Entity));
        jobs
    }

    /// Path, template, title.
    fn page(&self, book: &Book) -> (String, &'static str, String) {
        let fixed = |path: &str, template, title: &str| (path.to_owned(), template, title.to_owned());
        match self {
            Self::Front => (String::from("index.html"), "front.html", String::new()),
            Self::Library(l) => (book.libraries[*l].url.clone(), "library.html", book.libraries[*l].name.clone()),
            Self::Folder(l, f) => {
                let (library, folder) = (&book.libraries[*l], &book.libraries[*l].folders[*f]);
                let name = if folder.path.is_empty() { library.name.clone() } else { folder.path.join("/") };
                (folder.url.clone(), "folder.html", name)
            }
            Self::Kind(k) => fixed(&book.kinds[*k].url, "kind.html", book.kinds[*k].title),
            Self::Entity(e) => {
                let core = &book.entities[*e].core;
                (core.url.clone(), "entity.html", core.name.clone())
            }
            Self::Chapter(c) => fixed(&book.chapters[*c].url, "chapter.html", &book.chapters[*c].title),
            Self::Explanation(c) => fixed(&book.explanations[*c].url, "chapter.html", &book.explanations[*c].title),
            Self::Names(None) => fixed("names.html", "names.html", "Index"),
            Self::Names(Some(i)) => (lists::names_path(book, i), "names.html", format!("Index: {i}")),
            Self::Findings(None) => fixed("findings.html", "findings.html", "Findings"),
            Self::Findings(Some(code)) => {
                (lists::findings_path(book, code), "findings.html", format!("Findings: {code}"))
            }
            Self::Coverage => fixed("coverage.html", "coverage.html", "Coverage"),
            Self::Files => fixed("files.html", "files.html", "Files and externals"),
            Self::Search => fixed("search.html", "search.html", "Search"),
        }
    }

    /// The part of the navigation that the page belongs to.
    const fn section(&self) -> &'static str {
        match self {
            Self::Front => "front",
            Self::Library(_) | Self::Folder(..) | Self::Entity(_) => "library",
            Self::Kind(_) => "kind",
            Self::Chapter(_) => "chapter",
            Self::Names(_) => "names",
            Self::Findings(_) | Self::Explanation(_) => "findings",
            Self::Coverage => "coverage",
            Self::Files => "files",
            Self::Search => "search",
        }
    }
}

/// Where a finding stands.
type FindingKey<'a> = (&'a str, u32, u32, &'a str);

/// What all pages share.
pub(super) struct Site<'a> {
    pub(super) book: &'a Book,
    pub(super) highlighter: Highlighter,
    theme: Theme,
    tera: Tera,
    /// The explanations' addresses by code.
    explanations: BTreeMap<&'a str, &'a str>,
    /// Folders by library and path.
    folders: BTreeMap<(usize, &'a [String]), &'a FolderView>,
    /// The entities on whose pages findings stand.
    findings: BTreeMap<FindingKey<'a>, usize>,
}

impl<'a> Site<'a> {
    /// Reads the templates and the syntax definition.
    pub(super) fn new(book: &'a Book, options: &Options) -> Result<Self, Error> {
        let theme = Theme::new(options.overrides.clone());
        let highlighter = Highlighter::new(theme.text(Highlighter::file()).unwrap_or_default())?;
        let tera = templates(&theme, book)?;
        let folders = (0..)
            .zip(&book.libraries)
            .flat_map(|(l, library)| library.folders.iter().map(move |folder| ((l, folder.path.as_slice()), folder)));
        let findings = (0..)
            .zip(&book.entities)
            .flat_map(|(e, entity)| entity.findings.iter().map(move |finding| (finding_key(finding), e)));
        Ok(Self {
            book,
            highlighter,
            tera,
            explanations: explanations(book),
            folders: folders.collect(),
            findings: findings.collect(),
            theme,
        })
    }

    /// The page of `job`.
    pub(super) fn page(&self, job: &Job) -> Result<Page, Error> {
        let (path, template, title) = job.page(self.book);
        let place = Place::of(&path);
        let prose = Prose::new(&place, &self.highlighter);
        let mut context = Context::new();
        context.insert_value("root", Value::from(place.root()));
        context.insert_value("path", Value::from(path.as_str()));
        context.insert_value("title", Value::from(title));
        context.insert_value("section", Value::from(job.section()));
        self.fill(job, &place, prose, &mut context);
        let html = self.tera.render(template, &context).map_err(|error| Error::from_tera(template, &error))?;
        Ok(Page { path, bytes: html.into_bytes() })
    }

    fn fill(&self, job: &Job, place: &Place, prose: Prose<'_>, context: &mut Context) {
        let book = self.book;
        match job {
            Job::Front => lists::front(book, place, context),
            Job::Library(l) => lists::library(&book.libraries[*l], place, &prose, context),
            Job::Folder(l, f) => {
                let library = &book.libraries[*l];
                lists::folder(library, &library.folders[*f], place, &prose, context);
            }
            Job::Kind(k) => lists::kind(&book.kinds[*k], place, &prose, context),
            Job::Entity(e) => Writer { site: self, entity: &book.entities[*e], place, prose }.fill(context),
            Job::Chapter(c) => lists::chapter(&book.chapters, *c, place, &prose, context),
            Job::Explanation(c) => lists::explanation(&book.explanations[*c], &prose, context),
            Job::Names(initial) => lists::names(book, initial.as_deref(), place, context),
            Job::Findings(code) => lists::findings(self, code.as_deref(), place, context),
            Job::Coverage => lists::coverage(book, place, context),
            Job::Files => lists::files(book, context),
            Job::Search => {}
        }
    }

    /// Style, scripts, and the data that scripts load.
    pub(super) fn assets(&self) -> Vec<Page> {
        let asset = |name: &str, text: &str| Page { path: format!("assets/{name}"), bytes: text.as_bytes().to_vec() };
        let shown = |(name, _): &(&str, &str)| !name.starts_with("themes/syntax/") && !name.starts_with("themes/pdf/");
        let styles = self.theme.files(STYLES).filter(shown);
        let mut assets: Vec<Page> = styles.map(|(name, text)| asset(&name[STYLES.len()..], text)).collect();
        assets.push(asset("search-index.js", &script::search_index(self.book)));
        assets.push(asset("nav.js", &script::navigation(self.book)));
        assets
    }

    /// The folder that `entity` lies in.
    pub(super) fn folder_of(&self, entity: &EntityView) -> Option<&FolderView> {
        self.folders.get(&(entity.library, entity.folder.as_slice())).copied()
    }

    /// The page that explains `code`.
    pub(super) fn explanation(&self, code: &str) -> Option<&str> {
        self.explanations.get(code).copied()
    }

    /// The entity on whose page `finding` stands.
    pub(super) fn entity_of(&self, finding: &FindingView) -> Option<&EntityView> {
        self.findings.get(&finding_key(finding)).and_then(|&e| self.book.entities.get(e))
    }

    /// A finding for templates.
    pub(super) fn finding(
        &self,
        finding: &FindingView,
        place: &Place,
        line_href: Option<String>,
        entity: Option<&EntityView>,
    ) -> Value {
        record! {
            code: finding.code.as_str(),
            page: self.explanation(&finding.code).map(|url| place.href(url)),
            severity: finding.severity,
            message: markup(&message(&finding.message)),
            file: finding.file.as_str(),
            line: finding.line,
            column: finding.column,
            help: list(&finding.help, |help| markup(&message(help))),
            line_href: line_href,
            entity: entity.map(|e| record! { name: e.core.name.as_str(), href: place.href(&e.core.url) }),
        }
    }
}

fn finding_key(finding: &FindingView) -> FindingKey<'_> {
    (&finding.file, finding.line, finding.column, &finding.code)
}

/// The address of each code's page: the one named after it, or the one with its title.
fn explanations(book: &Book) -> BTreeMap<&str, &str> {
    let stem = |url: &str| url.rsplit('/').next().and_then(|file| file.split('.').next()).map(str::to_owned);
    let find = |code: &str, title: &str| {
        let named = book.explanations.iter().find(|page| stem(&page.url).as_deref() == Some(code));
        named.or_else(|| book.explanations.iter().find(|page| page.title == title))
    };
    let codes = book.codes.iter().map(|code| (code, find(&code.code, &code.title)));
    codes.filter_map(|(code, page)| page.map(|page| (code.code.as_str(), page.url.as_str()))).collect()
}

/// The templates, and what all pages see.
fn templates(theme: &Theme, book: &Book) -> Result<Tera, Error> {
    let mut tera = Tera::new();
    for (name, value) in shared(book) {
        tera.global_context().insert_value(name, value);
    }
    let files: Vec<(&str, &str)> =
        theme.files(TEMPLATES).map(|(name, text)| (&name[TEMPLATES.len()..], text)).collect();
    tera.add_raw_templates(files).map_err(|error| Error::from_tera("", &error))?;
    Ok(tera)
}

fn shared(book: &Book) -> [(&'static str, Value); 6] {
    let front = &book.front;
    let language = if front.language.is_empty() { "en" } else { &front.language };
    let site = record! {
        title: front.title.as_str(),
        subtitle: front.subtitle.as_str(),
        version: front.version.as_str(),
        date: front.date.as_str(),
        commit: front.commit.as_str(),
        author: front.author.as_str(),
        tool: front.tool.as_str(),
        language: language,
    };
    let kinds = list(&book.kinds, |kind| {
        record! { title: kind.title, url: kind.url.as_str(), count: kind.entries.len() }
    });
    let chapters = list(&book.chapters, |c| record! { title: c.title.as_str(), url: c.url.as_str() });
    let libraries = list(&book.libraries, |l| record! { name: l.name.as_str(), url: l.url.as_str() });
    let finding_count = book.totals.errors + book.totals.warnings + book.totals.infos;
    [
        ("site", site),
        ("kinds", kinds),
        ("chapters", chapters),
        ("libraries", libraries),
        ("totals", totals(&book.totals)),
        ("finding_count", Value::from(finding_count)),
    ]
}

fn totals(totals: &Totals) -> Value {
    record! {
        files: totals.files,
        files_skipped: totals.files_skipped,
        files_other: totals.files_other,
        libraries: totals.libraries,
        entities: totals.entities,
        documented: totals.documented,
        undocumented: totals.undocumented,
        documented_percent: (totals.documented * 100).checked_div(totals.entities).unwrap_or(100),
        tables: totals.tables,
        verdicts: list(&totals.verdicts, |(name, count)| record! { name: name.as_str(), count: *count }),
        errors: totals.errors,
        warnings: totals.warnings,
        infos: totals.infos,
    }
}
