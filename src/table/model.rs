//! The one model into which every form of a generalized test table is read.
//!
//! A table keeps what the user wrote (the text of each cell and its place) beside what it means (the parsed
//! constraint). A blank cell is `None`; [`Table::effective`] says what it repeats.

use super::cell::ast::{Constraint, Expr, Path};
use super::duration::DurationCell;
use crate::text::Place;

/// A table.
#[derive(Clone, Debug)]
pub struct Table {
    /// Its name, as the heading says.
    pub name: String,
    /// Where the name stands.
    pub name_place: Place,
    /// Where the table stands as a whole.
    pub place: Place,
    /// The block or program that it specifies, where the table itself says so.
    pub unit: Option<Word>,
    /// Cycle time, strictness, and other facts.
    pub options: Options,
    /// The runs that a relational table compares; empty for an ordinary one.
    pub runs: Vec<Word>,
    /// The columns, in their order.
    pub columns: Vec<Column>,
    /// The global variables.
    pub globals: Vec<Global>,
    /// The time constants.
    pub constants: Vec<TimeConstant>,
    /// Functions in Structured Text that cells may call.
    pub functions: Vec<Function>,
    /// Rows and blocks, in order.
    pub body: Vec<Node>,
    /// How many errors were found in it; with one, it gets no verdict.
    pub errors: usize,
}

/// A word with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// The text.
    pub text: String,
    /// Its place.
    pub place: Place,
}

/// What a table's heading says about how to read it.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// How long a cycle lasts, in nanoseconds.
    pub cycle: Option<CycleTime>,
    /// Whether strict conformance is asked for.
    pub strict: bool,
    /// Whether every value is one value and every duration one number, by the format's own word.
    pub concrete: bool,
    /// Whether it is a counterexample that another tool recorded.
    pub counterexample: bool,
    /// What other tools keep as options, as key and value.
    pub entries: Vec<(Word, Word)>,
}

/// The cycle time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CycleTime {
    /// In nanoseconds; more than none.
    pub nanos: i128,
    /// Where it is stated; `None` where it came with the call.
    pub place: Option<Place>,
}

/// What a column is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ColumnKind {
    /// An input: an assumption about the environment.
    Input,
    /// An output: an assertion about the system.
    Output,
    /// An internal variable about which something is assumed.
    StateAssumption,
    /// An internal variable about which something is asserted.
    StateAssertion,
}

impl ColumnKind {
    /// Whether its cells constrain the environment.
    #[must_use]
    pub const fn is_assumption(self) -> bool {
        matches!(self, Self::Input | Self::StateAssumption)
    }

    /// The word in the header of a pipe table.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Input => "in",
            Self::Output => "out",
            Self::StateAssumption => "state",
            Self::StateAssertion => "state!",
        }
    }
}

/// A column.
#[derive(Clone, Debug)]
pub struct Column {
    /// The name in the header, unique in the table.
    pub name: String,
    /// What it is for.
    pub kind: ColumnKind,
    /// What it is bound to.
    pub subject: Subject,
    /// The type that the header declares.
    pub ty: Option<Word>,
    /// A remark about the column.
    pub remark: Option<String>,
    /// Where the header stands.
    pub place: Place,
}

/// What a column is bound to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Subject {
    /// A variable of the system: a plain one, a member, an element.
    Variable(Path),
    /// A projection: one expression, or several over which cells name predicates.
    Projection(Vec<Expr>),
}

impl Subject {
    /// How many arguments a cell of the column speaks of.
    #[must_use]
    pub const fn arguments(&self) -> usize {
        match self {
            Self::Variable(_) => 1,
            Self::Projection(exprs) => exprs.len(),
        }
    }
}

/// A global variable: one value for the whole run.
#[derive(Clone, Debug)]
pub struct Global {
    /// Its name.
    pub name: String,
    /// Its declared type.
    pub ty: Option<Word>,
    /// What its value must satisfy; `None` is anything.
    pub constraint: Option<Cell>,
    /// Where it is declared.
    pub place: Place,
}

/// A named duration.
#[derive(Clone, Debug)]
pub struct TimeConstant {
    /// Its name.
    pub name: String,
    /// Its value.
    pub value: Quantity,
    /// Where it is declared.
    pub place: Place,
}

/// A number of cycles or a time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// So many cycles.
    Cycles(i128),
    /// So many nanoseconds.
    Nanos(i128),
}

/// A function in Structured Text that belongs to the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// The whole declaration.
    pub text: String,
    /// Where it stands.
    pub place: Place,
}

/// A row, or a block of rows and blocks.
#[derive(Clone, Debug)]
pub enum Node {
    /// A row.
    Row(Box<Row>),
    /// A block.
    Block(Box<Block>),
}

/// A row.
#[derive(Clone, Debug)]
pub struct Row {
    /// Its name or number, unique in the table.
    pub id: String,
    /// One cell for a column; `None` repeats the one above.
    pub cells: Vec<Option<Cell>>,
    /// How long it lasts.
    pub duration: DurationCell,
    /// What the user remarks.
    pub remark: Option<Word>,
    /// What a relational table does with its runs in this row.
    pub controls: Vec<Control>,
    /// Jumps into other tables.
    pub gotos: Vec<Goto>,
    /// Where it stands.
    pub place: Place,
}

/// A block: its children in order, repeated.
#[derive(Clone, Debug)]
pub struct Block {
    /// Its name, where it has one.
    pub id: Option<String>,
    /// Its rows and blocks.
    pub children: Vec<Node>,
    /// How often it is repeated.
    pub duration: DurationCell,
    /// Where it begins.
    pub place: Place,
}

/// A cell as the user wrote it, and what it says.
#[derive(Clone, Debug)]
pub struct Cell {
    /// The text.
    pub text: String,
    /// Where it stands.
    pub place: Place,
    /// What it says; `None` where it could not be read, which spoils its row.
    pub constraint: Option<Constraint>,
}

/// What a relational table does with a run in a row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Control {
    /// The runs stand still.
    Pause(Vec<Word>),
    /// The runs go on.
    Play(Vec<Word>),
    /// The runs go back to where they were in the named row.
    Backward {
        /// The row.
        target: Word,
        /// The runs.
        runs: Vec<Word>,
    },
}

/// A jump to a row of another table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Goto {
    /// When it is taken: `pass`, `miss` or `fail`.
    pub when: String,
    /// The table.
    pub table: Word,
    /// The row.
    pub row: Word,
}

impl Row {
    /// Whether a cell or the duration of this row could not be read.
    #[must_use]
    pub fn is_spoiled(&self) -> bool {
        self.duration.spoiled || self.cells.iter().flatten().any(|cell| cell.constraint.is_none())
    }
}

impl Table {
    /// An empty table.
    #[must_use]
    pub fn new(name: Word, place: Place) -> Self {
        Self {
            name: name.text,
            name_place: name.place,
            place,
            unit: None,
            options: Options::default(),
            runs: Vec::new(),
            columns: Vec::new(),
            globals: Vec::new(),
            constants: Vec::new(),
            functions: Vec::new(),
            body: Vec::new(),
            errors: 0,
        }
    }

    /// Whether anything in it is wrong; such a table gets no verdict.
    #[must_use]
    pub fn has_errors(&self) -> bool {
        self.errors > 0
    }

    /// All rows, from top to bottom.
    #[must_use]
    pub fn rows(&self) -> Vec<&Row> {
        let mut out = Vec::new();
        collect(&self.body, &mut out);
        out
    }

    /// For each row, for each column, the cell that counts: its own, or the one that it repeats; `None` is anything.
    #[must_use]
    pub fn effective(&self) -> Vec<Vec<Option<&Cell>>> {
        let mut above: Vec<Option<&Cell>> = vec![None; self.columns.len()];
        let mut out = Vec::new();
        for row in self.rows() {
            for (above, cell) in above.iter_mut().zip(&row.cells) {
                *above = cell.as_ref().or(*above);
            }
            out.push(above.clone());
        }
        out
    }

    /// The column of that name; names are not case-sensitive.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| column.name.eq_ignore_ascii_case(name))
    }

    /// The global variable of that name.
    #[must_use]
    pub fn global(&self, name: &str) -> Option<&Global> {
        self.globals.iter().find(|global| global.name.eq_ignore_ascii_case(name))
    }

    /// Whether it compares several runs.
    #[must_use]
    pub const fn is_relational(&self) -> bool {
        !self.runs.is_empty()
    }
}

fn collect<'t>(nodes: &'t [Node], out: &mut Vec<&'t Row>) {
    for node in nodes {
        match node {
            Node::Row(row) => out.push(row),
            Node::Block(block) => collect(&block.children, out),
        }
    }
}
