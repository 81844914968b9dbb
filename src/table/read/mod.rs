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
mod workbook;
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
    /// What the columns of a spreadsheet are, where its own header does not say so.
    pub mapping: Option<Mapping>,
}

/// What the columns of a spreadsheet are, said from outside.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Mapping {
    /// The line of the header, from 1; without it, the first line that holds all names of `columns`.
    pub header: Option<usize>,
    /// For a column, by its letter (`B`) or by what its header says, the header cell that a pipe table would have (`in Start`,
    /// `dur ms`). Columns that are not named are left out.
    pub columns: Vec<(String, String)>,
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

/// A length of time in nanoseconds (`10ms`, `T#1s500ms`), above zero.
#[must_use]
pub fn time(text: &str) -> Option<i128> {
    match heading::quantity(text) {
        Some(Quantity::Nanos(nanos)) if nanos > 0 => Some(nanos),
        _ => None,
    }
}

/// The value of a time constant: a number of cycles or a length of time.
#[must_use]
pub fn quantity(text: &str) -> Option<Quantity> {
    heading::quantity(text)
}
