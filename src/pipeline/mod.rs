//! The only place where stages meet: tree → catalogue → docs and tables → findings → book → bytes.
//!
//! Progress goes out as [`Event`]s; date, commit and tool come in as one [`Stamp`].

pub mod answer;
pub mod artefact;
mod cover;
pub mod evidence;
pub mod export;
mod libraries;
mod mutants;
mod overrides;
mod read;
pub mod ready;
pub mod recheck;
pub mod records;
pub mod run;
pub mod snapshot;
mod tables;
pub mod tell;
pub mod verify;

use std::collections::BTreeMap;

use crate::book::view::{Book, Front};
use crate::book::{self, Narrative};
use crate::config::Settings;
use crate::diagnostic::Finding;
use crate::docs::Docs;
use crate::evidence::policy::allow::{self, Allowed};
use crate::library::names::Names;
use crate::library::relations::Relations;
use crate::library::{Catalogue, Library};
use crate::render::html;
use crate::source::FileSystem;
use crate::table::AttachedTable;
use crate::text::Files;

pub use read::{know, read};

/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// A stage begins.
    Stage {
        /// Its name.
        name: &'static str,
        /// How many steps it has; 0 if that is not known.
        total: usize,
    },
    /// So many more steps of the stage are done.
    Advance(usize),
    /// The run is over.
    Done,
}

/// Takes events.
pub type Events<'a> = dyn Fn(Event) + Sync + 'a;

/// What the world outside of the tree says: nothing else in a manual depends on when and by whom it is made.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Stamp {
    /// `2026-11-22`.
    pub date: String,
    /// The commit, shortened, with `+` if there are changes on top; empty if unknown.
    pub commit: String,
    /// The tool and its version.
    pub tool: String,
    /// Who runs the tool; empty if unknown.
    pub author: String,
}

/// What the configuration and the command line say about proofs, as far as a verdict depends on it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Asked {
    /// The cycle time in nanoseconds, for tables that state none.
    pub cycle: Option<i128>,
    /// Time constants that were set from outside.
    pub constants: BTreeMap<String, String>,
    /// Whether strict conformance is asked of every table.
    pub strict: bool,
    /// How often a loop without constant bounds may be done.
    pub loop_limit: u64,
    /// How reals are read, if not as IEEE 754.
    pub fixed: Option<crate::semantics::fixed::Reading>,
    /// What stands for blocks that have no source, and what the user calls each.
    pub stubs: Vec<(String, crate::machine::elaborate::Stub)>,
}

/// What stands for the block `name`: a text, or outputs that are anything.
fn stub(name: &str, text: &str) -> crate::machine::elaborate::Stub {
    let arbitrary = text == "arbitrary";
    let text = if arbitrary { format!("FUNCTION_BLOCK {name}\nEND_FUNCTION_BLOCK\n") } else { text.to_owned() };
    crate::machine::elaborate::Stub { text, arbitrary }
}

/// A source tree, read and understood.
#[derive(Debug)]
pub struct Project {
    /// The name of the tree's folder.
    pub name: String,
    /// The files.
    pub files: Files,
    /// How many of them were read as source.
    pub source_files: usize,
    /// What they declare.
    pub catalogue: Catalogue,
    /// What names mean.
    pub names: Names,
    /// Who extends, implements and uses whom.
    pub relations: Relations,
    /// What the comments say.
    pub docs: Docs,
    /// The test tables.
    pub tables: Vec<AttachedTable>,
    /// The findings of all rooms, with their configured severities, by file and place.
    pub findings: Vec<Finding>,
    /// The findings that an allowance in the source lets pass.
    pub allowed: Vec<Allowed>,
    /// Requirements and results that stand beside the tree.
    pub beside: evidence::Beside,
    /// How the files were read, each way once.
    pub readings: Vec<book::view::finding::ReadingView>,
    /// Files whose kind is read, and that were not: path and reason.
    pub skipped: Vec<(String, String)>,
    /// How many files are no PLC source.
    pub other_files: usize,
    /// What is known of each table, in their order; empty where nobody asked.
    pub answers: Vec<crate::evidence::record::Answer>,
    /// How its tables are proven.
    pub asked: Asked,
    /// The narrative pages.
    pub narratives: Vec<Narrative>,
    /// The user's templates and theme files, by name.
    pub overrides: BTreeMap<String, String>,
}

/// Reads what stands beside the tree of `fs` and belongs to its evidence.
pub fn read_beside(fs: &dyn FileSystem, settings: &Settings, project: &mut Project) {
    project.beside = evidence::read(fs, settings, project);
}

/// Lets findings pass where the source says so; `today` is the stamp's date, after which an allowance no longer holds.
pub fn allow(project: &mut Project, settings: &Settings, today: &str) {
    let findings = std::mem::take(&mut project.findings);
    let known = |code: &str| crate::audit::code(code).is_some();
    let sorted = allow::apply(findings, &project.catalogue, &project.files, today, &known);
    project.findings = read::in_order(sorted.findings, settings);
    project.allowed = sorted.allowed;
}

/// Title and version of what is documented: as configured, or as its only library says.
fn title(project: &Project, settings: &Settings) -> (String, String) {
    let title = settings.title.clone().or_else(|| of_library(project, |library| &library.name));
    let version = settings.version.clone().or_else(|| of_library(project, |library| &library.version));
    (title.unwrap_or_else(|| project.name.clone()), version.unwrap_or_default())
}

/// What the only library of `project` says; nothing if there are several, or it says nothing.
fn of_library(project: &Project, what: impl Fn(&Library) -> &String) -> Option<String> {
    let [library] = project.catalogue.libraries.as_slice() else { return None };
    Some(what(library)).filter(|text| !text.is_empty()).cloned()
}

/// The manual of `project`.
#[must_use]
pub fn book(project: &Project, settings: &Settings, stamp: &Stamp) -> Book {
    let (title, version) = title(project, settings);
    let author = settings.author.clone().or_else(|| of_library(project, |library| &library.author));
    let front = Front {
        genre: "Reference manual".to_owned(),
        title,
        subtitle: settings.subtitle.clone(),
        version,
        date: stamp.date.clone(),
        commit: stamp.commit.clone(),
        author: author.unwrap_or_default(),
        tool: stamp.tool.clone(),
        language: settings.language.clone(),
    };
    let mut book = book::build(&book::Input {
        front,
        files: &project.files,
        source_files: project.source_files,
        other_files: project.other_files,
        catalogue: &project.catalogue,
        names: &project.names,
        relations: &project.relations,
        docs: &project.docs,
        tables: &project.tables,
        answers: &project.answers,
        findings: &project.findings,
        readings: &project.readings,
        skipped: &project.skipped,
        narratives: &project.narratives,
    });
    evidence::show(&project.beside, &mut book);
    book
}

/// The site.
///
/// # Errors
/// If a template of the user's cannot be used.
pub fn html(project: &Project, book: &Book, events: &Events<'_>) -> Result<Vec<html::Page>, html::Error> {
    events(Event::Stage { name: "pages", total: html::steps(book) });
    let options = html::Options { overrides: project.overrides.clone() };
    html::render(book, &options, &|n| events(Event::Advance(n)))
}

/// The PDF.
///
/// # Errors
/// If typst refuses the document, or this tool was built without it.
#[cfg(feature = "pdf")]
pub fn pdf(project: &Project, book: &Book, settings: &Settings, events: &Events<'_>) -> Result<Vec<u8>, String> {
    use crate::render::pdf;
    events(Event::Stage { name: "PDF", total: 0 });
    let options = settings.pdf_options(project.overrides.clone(), &book.front.date).map_err(|error| error.message)?;
    pdf::render(book, &options).map(|document| document.bytes).map_err(|error| error.to_string())
}

/// The evidence report as PDF/A-3b, with `attachments` (path and bytes, JSON all) inside.
///
/// # Errors
/// If typst refuses the document, or this tool was built without it.
#[cfg(feature = "pdf")]
pub fn report_pdf(
    project: &Project,
    book: &Book,
    settings: &Settings,
    attachments: Vec<(String, Vec<u8>)>,
) -> Result<Vec<u8>, String> {
    use crate::render::pdf;
    let options = settings.pdf_options(project.overrides.clone(), &book.front.date).map_err(|error| error.message)?;
    let attachment = |(path, bytes)| pdf::Attachment { path, bytes, mime: "application/json".to_owned() };
    let options = pdf::Options {
        standard: pdf::Standard::A3b,
        attachments: attachments.into_iter().map(attachment).collect(),
        parts: pdf::Parts { coverage: false, findings: false, index: false, ..pdf::Parts::default() },
        ..options
    };
    pdf::render(book, &options).map(|document| document.bytes).map_err(|error| error.to_string())
}

/// The PDF.
///
/// # Errors
/// Always: this tool was built without it.
#[cfg(not(feature = "pdf"))]
pub fn pdf(_: &Project, _: &Book, _: &Settings, _: &Events<'_>) -> Result<Vec<u8>, String> {
    Err("this rungbook was built without the feature `pdf`".to_owned())
}

/// The evidence report as PDF.
///
/// # Errors
/// Always: this tool was built without it.
#[cfg(not(feature = "pdf"))]
pub fn report_pdf(_: &Project, _: &Book, _: &Settings, _: Vec<(String, Vec<u8>)>) -> Result<Vec<u8>, String> {
    Err("this rungbook was built without the feature `pdf`".to_owned())
}

/// The model as JSON.
#[must_use]
pub fn model(book: &Book) -> String {
    book::model::render(book)
}
