//! Readers: every form of a table into the one model.

mod build;
pub mod gtt;
mod heading;
pub mod pipe;
mod repeat;

use std::collections::BTreeMap;

use super::model::{Quantity, Table, Word};
use crate::diagnostic::{Finding, Severity};

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
