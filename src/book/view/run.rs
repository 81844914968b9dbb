//! A run that violates a table, cycle by cycle, as pages see it.

use serde::Serialize;

use super::entity::Diagram;

/// The run.
#[derive(Clone, Debug, Serialize)]
pub struct RunView {
    /// What goes wrong, in sentences.
    pub summary: Vec<String>,
    /// The values of the global variables.
    pub globals: Vec<(String, String)>,
    /// The variables that are shown, and whether each is an input.
    pub variables: Vec<(String, bool)>,
    /// How many cycles the run has.
    pub length: usize,
    /// The cycles that are shown: the last ones.
    pub cycles: Vec<RunCycle>,
    /// The timing diagram of these cycles.
    pub timing: Diagram,
    /// Variables that the diagram leaves out, since they keep their value: name and value.
    pub unchanged: Vec<(String, String)>,
    /// The cells that fail: row, column, and what was expected and seen.
    pub failing: Vec<(String, String, String)>,
    /// Where each shown cycle begins in the diagram, and where the last one ends, in its units.
    pub edges: Vec<f64>,
}

/// A cycle.
#[derive(Clone, Debug, Serialize)]
pub struct RunCycle {
    /// Its number, from 1.
    pub number: usize,
    /// The values, in the order of the variables.
    pub values: Vec<RunValue>,
    /// The rows whose assumptions the inputs fit.
    pub tried: Vec<String>,
    /// The rows that are possible afterwards.
    pub live: Vec<String>,
    /// The lines that were executed, with what they set.
    pub lines: Vec<RunLine>,
}

/// A value.
#[derive(Clone, Debug, Serialize)]
pub struct RunValue {
    /// Its text.
    pub text: String,
    /// Whether it differs from the cycle before.
    pub changed: bool,
    /// Whether it is what the table does not admit.
    pub failing: bool,
}

/// An executed line.
#[derive(Clone, Debug, Serialize)]
pub struct RunLine {
    /// The file, below the tree's root.
    pub file: String,
    /// The line, from 1.
    pub line: u32,
    /// Its text.
    pub text: String,
    /// What it set: names and values.
    pub set: Vec<(String, String)>,
    /// Whether it gave an output the value that the table does not admit.
    pub wrong: bool,
}
