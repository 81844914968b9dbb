//! A finding: what is wrong, how bad it is, where, and what would help.
//!
//! Findings are values. Rooms make them, `cli/` prints them; nothing here knows how they look.
//! Every code is a [`Code`] with a page of its own, kept by the room that gives the finding.

use crate::text::{FileId, Place};

/// How bad a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth knowing; nothing is wrong.
    Info,
    /// The manual is poorer for it.
    Warning,
    /// Something is broken, or could not be read.
    Error,
}

impl Severity {
    /// The word that reports print.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Info => "info",
            Self::Warning => "warning",
            Self::Error => "error",
        }
    }

    /// The severity that `name` means.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        [Self::Info, Self::Warning, Self::Error].into_iter().find(|s| s.name() == name)
    }
}

/// A kind of finding: its name, its usual severity, and its page.
#[derive(Debug)]
pub struct Code {
    /// The name in kebab case, as `explain` and `--deny` take it.
    pub name: &'static str,
    /// The severity unless configured otherwise.
    pub severity: Severity,
    /// The page in Markdown: first line a title (`# …`), then what it means, a failing example and its cure.
    pub page: &'static str,
}

impl Code {
    /// The page as Markdown: [`Code::page`], or its `//!` lines where that is the text of a Rust file.
    #[must_use]
    pub fn text(&self) -> String {
        if !self.page.starts_with("//!") {
            return self.page.to_owned();
        }
        let lines = self.page.lines().map_while(|line| line.strip_prefix("//!"));
        lines.flat_map(|line| [line.strip_prefix(' ').unwrap_or(line), "\n"]).collect()
    }

    /// The title of its page.
    #[must_use]
    pub fn title(&self) -> String {
        let text = self.text();
        text.lines().next().unwrap_or("").trim_start_matches('#').trim().to_owned()
    }
}

impl PartialEq for Code {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl Eq for Code {}

/// Another place that belongs to a finding, with a word on it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub place: Place,
    /// What is there.
    pub message: String,
}

/// One finding.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// What kind of finding it is.
    pub code: &'static Code,
    /// How bad it is, here.
    pub severity: Severity,
    /// One line, without a full stop.
    pub message: String,
    /// Where; for a whole file the empty span at its beginning.
    pub place: Place,
    /// Other places.
    pub labels: Vec<Label>,
    /// What would help, one sentence each.
    pub help: Vec<String>,
}

impl Finding {
    /// A finding of `code` at `place`.
    pub fn new(code: &'static Code, place: Place, message: impl Into<String>) -> Self {
        Self { code, severity: code.severity, message: message.into(), place, labels: Vec::new(), help: Vec::new() }
    }

    /// A finding about `file` as a whole.
    pub fn of_file(code: &'static Code, file: FileId, message: impl Into<String>) -> Self {
        Self::new(code, Place::file(file), message)
    }

    /// With a sentence that helps.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help.push(help.into());
        self
    }

    /// With another place.
    #[must_use]
    pub fn label(mut self, place: Place, message: impl Into<String>) -> Self {
        self.labels.push(Label { place, message: message.into() });
        self
    }
}
