//! A finding of one file before the file has a name in the table of files.

use crate::diagnostic::{Code, Finding};
use crate::text::{FileId, Place, Span};

/// A finding that knows its span, and not yet its file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Note {
    /// What kind of finding it is.
    pub code: &'static Code,
    /// Where in the file.
    pub span: Span,
    /// One line, without a full stop.
    pub message: String,
    /// What would help, one sentence each.
    pub help: Vec<String>,
}

impl Note {
    /// A note of `code` at `span`.
    pub fn new(code: &'static Code, span: Span, message: impl Into<String>) -> Self {
        Self { code, span, message: message.into(), help: Vec::new() }
    }

    /// A note about the file as a whole.
    pub fn of_file(code: &'static Code, message: impl Into<String>) -> Self {
        Self::new(code, Span::at(0), message)
    }

    /// With a sentence that helps.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help.push(help.into());
        self
    }

    /// As a finding in `file`.
    #[must_use]
    pub fn in_file(self, file: FileId) -> Finding {
        let mut finding = Finding::new(self.code, Place::new(file, self.span), self.message);
        finding.help = self.help;
        finding
    }
}
