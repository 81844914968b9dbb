//! Test tables as pages see them: laid out as the papers draw them.

use serde::Serialize;

use super::prose::Inline;

/// A generalized test table, ready to be drawn.
#[derive(Clone, Debug, Serialize)]
pub struct TableView {
    /// Its name.
    pub name: String,
    /// Anchor on the page.
    pub anchor: String,
    /// The label in the PDF.
    pub label: String,
    /// The file it stands in, below the tree's root.
    pub file: String,
    /// The line, from 1.
    pub line: u32,
    /// What is known of it.
    pub verdict: VerdictView,
    /// Cycle time, time constants, global variables with their constraints, options: name and value.
    pub facts: Vec<(String, String)>,
    /// Prose before the table.
    pub remark: Vec<Inline>,
    /// The columns, in the order inputs, states, outputs.
    pub columns: Vec<ColumnView>,
    /// The rows, in order.
    pub rows: Vec<RowView>,
    /// The repeated blocks as brackets beside the rows.
    pub brackets: Vec<BracketView>,
    /// Messages of the findings in it.
    pub errors: Vec<String>,
    /// The run that violates it.
    pub run: Option<super::run::RunView>,
    /// The signs that it uses, and what they mean.
    pub legend: Vec<SignView>,
    /// Its automaton.
    pub automaton: AidView,
    /// A run that conforms to it, as a timing diagram.
    pub example: AidView,
}

/// A sign of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct SignView {
    /// The sign.
    pub text: &'static str,
    /// Whether it stands in the column of durations.
    pub duration: bool,
    /// What it means.
    pub meaning: &'static str,
}

/// A drawing that helps to read a table.
#[derive(Clone, Debug, Default, Serialize)]
pub struct AidView {
    /// The drawing; none where it would not help or cannot be had.
    pub diagram: Option<super::entity::Diagram>,
    /// What is seen, or why there is nothing; empty where there is nothing to say.
    pub note: String,
}

/// A verdict as pages show it.
#[derive(Clone, Debug, Serialize)]
pub struct VerdictView {
    /// `verified`, `violated`, `bounded`, `unsupported`, `unusable`, `stale` or `unverified`.
    pub key: &'static str,
    /// The word.
    pub label: String,
    /// What it means here, in a sentence.
    pub note: String,
    /// What it rests on and how it was found: name and value.
    pub facts: Vec<(String, String)>,
    /// What the proof covered, if it was found out.
    pub coverage: Option<CoverageView>,
}

/// What a proof covered.
#[derive(Clone, Debug, Serialize)]
pub struct CoverageView {
    /// All in a line.
    pub line: String,
    /// Why the verdict proves nothing; empty where it proves something.
    pub vacuous: Vec<String>,
    /// What is not covered.
    pub missed: Vec<MissedView>,
}

/// A row, a statement or a way of a branch that no run reaches, or a change to the block that the table does not notice.
#[derive(Clone, Debug, Serialize)]
pub struct MissedView {
    /// `row`, `statement`, `branch`, `mutant`.
    pub kind: &'static str,
    /// What it is.
    pub text: String,
    /// The file, below the tree's root.
    pub file: String,
    /// The line, from 1.
    pub line: u32,
    /// What is known of it.
    pub fate: String,
}

/// A column.
#[derive(Clone, Debug, Serialize)]
pub struct ColumnView {
    /// `input` (an assumption) or `output` (an assertion).
    pub group: &'static str,
    /// The header cell: a variable or an expression.
    pub name: String,
    /// Its type, if known; empty otherwise.
    pub type_: String,
    /// Whether it is bound to an internal variable.
    pub state: bool,
}

/// A row.
#[derive(Clone, Debug, Serialize)]
pub struct RowView {
    /// Number or name.
    pub seq: String,
    /// One cell for a column.
    pub cells: Vec<CellView>,
    /// The duration as the papers write it.
    pub duration: String,
    /// What the duration means, for a hover.
    pub duration_meaning: String,
    /// What the signs of the duration mean.
    #[serde(skip)]
    pub duration_signs: Vec<SignView>,
    /// The remark.
    pub remark: Vec<Inline>,
    /// The row as a sentence; empty if there is none.
    pub sentence: String,
}

/// A cell.
#[derive(Clone, Debug, Serialize)]
pub struct CellView {
    /// Its text as the papers write it; empty where it repeats the one above.
    pub text: String,
    /// The text that holds here, also where it repeats the one above.
    pub effective: String,
    /// Whether it repeats the one above.
    pub same: bool,
    /// Whether anything goes.
    pub any: bool,
    /// What it means, for a hover.
    pub meaning: String,
    /// What the signs in it mean.
    #[serde(skip)]
    pub signs: Vec<SignView>,
    /// What is wrong with it.
    pub error: Option<String>,
    /// What was expected and seen, where the run that violates the table ends here.
    pub failing: Option<String>,
}

/// A bracket beside rows that form a repeated block.
#[derive(Clone, Debug, Serialize)]
pub struct BracketView {
    /// 0 for the outermost.
    pub depth: u32,
    /// Index of the first row.
    pub first: usize,
    /// Index of the last row.
    pub last: usize,
    /// The repetition as the papers write it: `ω`, `[1,3]`.
    pub label: String,
}
