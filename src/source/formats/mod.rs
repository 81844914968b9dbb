//! The formats: what takes the container off a file. One file a format, one slice that lists them.
//!
//! A format claims files by extension, then by what their text begins with and by the [`Setting`] they
//! stand in. Of several that claim a file, a sure one wins over a likely one, and then the first.

mod automation_studio;
mod chart;
mod codesys2;
mod codesys_export;
mod codesys_text;
mod four_diac;
mod keyword;
mod logi_cad;
pub(super) mod plain;
mod plcopen;
mod plcopen_declaration;
mod siemens;
mod simatic_ax;
mod twincat;
mod xhtml;
mod xml_tables;

use std::sync::Arc;

use super::codes;
use super::note::Note;
use super::projects::Draft;
use super::xml::{Problem, Xml};
use crate::text::{Object, Vendor};

/// All formats.
pub static ALL: &[&dyn Format] = &[
    &xml_tables::XmlTables,
    &twincat::TwinCat,
    &plcopen::PlcOpen,
    &codesys_export::CodesysExport,
    &codesys2::Codesys2,
    &four_diac::FourDiac,
    &siemens::Siemens,
    &simatic_ax::SimaticAx,
    &automation_studio::AutomationStudio,
    &codesys_text::CodesysText,
    &logi_cad::LogiCad,
    &plain::PlainText,
];

/// Takes the container off the files of one format.
pub trait Format: Sync {
    /// The name, as the manual calls it.
    fn name(&self) -> &'static str;

    /// The extensions of its files, in lower case.
    fn extensions(&self) -> &'static [&'static str];

    /// Whether the file is one of this format; asked only for files with one of its extensions.
    fn claims(&self, input: &Input<'_>) -> Claim;

    /// What the file holds. Never fails: what cannot be read is a note.
    fn unwrap(&self, input: &Input<'_>) -> Unwrapped;
}

/// A file, as a format sees it.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// Its path below the root.
    pub path: &'a str,
    /// Its text.
    pub text: &'a Arc<str>,
    /// What lies around it.
    pub setting: Setting,
}

impl Input<'_> {
    /// The beginning of the text, where signatures stand.
    #[must_use]
    pub fn head(&self) -> &str {
        &self.text[..self.text.floor_char_boundary(4096)]
    }
}

/// The engineering tool whose files lie in the folder of a file or above it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Setting {
    /// None that is known.
    #[default]
    Plain,
    /// SIMATIC AX: there is an `apax.yml`.
    SimaticAx,
    /// B&R Automation Studio: there is a `.apj`, `.pkg` or `.lby`.
    BAndR,
}

/// Whether a format claims a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// It is another format's, or nobody's.
    No,
    /// It is taken for one unless another format is sure.
    Likely,
    /// It is one.
    Sure,
}

/// A file without its container.
#[derive(Clone, Debug, Default)]
pub struct Unwrapped {
    /// What it holds, in its order.
    pub objects: Vec<Object>,
    /// Whose dialect it is written in.
    pub vendor: Vendor,
    /// Whether comments nest, if the container says so.
    pub nested_comments: Option<bool>,
    /// What is wrong with it, or was guessed.
    pub notes: Vec<Note>,
    /// Whether the file holds test tables as well.
    pub tables: bool,
    /// The project that the file is, if it is one by itself.
    pub(in crate::source) project: Option<Draft>,
}

/// The format that claims `input`.
#[must_use]
pub fn claimant(extension: &str, input: &Input<'_>) -> Option<&'static dyn Format> {
    let asked = ALL.iter().filter(|format| format.extensions().contains(&extension));
    let mut likely = None;
    for format in asked {
        match format.claims(input) {
            Claim::Sure => return Some(*format),
            Claim::Likely => likely = likely.or(Some(*format)),
            Claim::No => {}
        }
    }
    likely
}

/// Whether any format reads files with `extension`.
#[must_use]
pub fn reads(extension: &str) -> bool {
    ALL.iter().any(|format| format.extensions().contains(&extension))
}

/// At most so many problems of one file are told.
const TOLD: usize = 10;

/// The problems of `xml` as notes.
pub(crate) fn xml_notes(xml: &Xml<'_>) -> Vec<Note> {
    let problems = xml.problems();
    let note = |problem: &Problem| {
        let code = if problem.doctype { &codes::DOCUMENT_TYPE } else { &codes::MALFORMED_XML };
        Note::new(code, problem.span, problem.message.clone())
    };
    let mut notes: Vec<Note> = problems.iter().take(TOLD).map(note).collect();
    if problems.len() > TOLD
        && let Some(last) = notes.last_mut()
    {
        last.help.push(format!("the file has {} more such problems", problems.len() - TOLD));
    }
    notes
}

/// A note if `objects` is empty: `what` was looked for.
pub(crate) fn note_if_empty(objects: &[Object], what: &str) -> Option<Note> {
    objects.is_empty().then(|| Note::of_file(&codes::EMPTY_CONTAINER, format!("the file holds no {what}")))
}
