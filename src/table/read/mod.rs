//! Readers: every form of a table into the one model.

mod build;
mod exteta;
pub mod gtt;
mod heading;
pub mod pipe;
mod repeat;
pub mod sheet;
mod stvs;
mod test_manager;
pub mod xml;

use std::collections::BTreeMap;

use super::model::{Quantity, Table, Word};
use super::piece::Piece;
use crate::diagnostic::{Finding, Severity};
use crate::text::Fragment;

/// Reads a text file that holds tables and nothing else, by what it looks like: XML, the language of geteta, pipe tables.
#[must_use]
pub fn text(piece: &Piece<'_>, options: &Options) -> Read {
    let begins = piece.text.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}');
    if begins.starts_with('<') {
        return xml::read(piece, options);
    }
    let piped = piece.lines().any(|line| line.text.trim_start().starts_with('|') || line.text.contains("@gtt"));
    if piped && !begins.starts_with("table") && !begins.starts_with("relational") {
        return pipe::read(piece, &Options { headless: true, ..options.clone() });
    }
    gtt::read(piece, options)
}

/// What a reader is told from outside.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// The cycle time in nanoseconds, where the table itself states none.
    pub cycle: Option<i128>,
    /// Time constants by name; they win over those of the table.
    pub constants: BTreeMap<String, Quantity>,
    /// Whether a pipe table without a `@gtt` line counts, as it does in a file that holds tables and nothing else.
    pub headless: bool,
}

/// What a reader found.
#[derive(Clone, Debug, Default)]
pub struct Read {
    /// The tables, those with errors too.
    pub tables: Vec<Table>,
    /// What is wrong, in the order of the text.
    pub findings: Vec<Finding>,
    /// Files that `@gtt path` names.
    pub references: Vec<Word>,
    /// The program that an STVS session keeps beside its tables.
    pub code: Option<Fragment>,
}

impl Read {
    /// Whether an error was found.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.findings.iter().any(|finding| finding.severity == Severity::Error)
    }

    fn take(&mut self, (table, findings): (Table, Vec<Finding>)) {
        self.tables.push(table);
        self.findings.extend(findings);
    }

    fn sort(&mut self) {
        self.findings.sort_by_key(|finding| finding.place);
    }
}
