//! A table bound to the block that it specifies: columns to variables, cells to typed expressions over them.
//!
//! What a cell says is decided here once, for the game on values and for the prover alike: a constraint is an expression
//! of type `BOOL`; one that faults (a division by zero, no guard that holds) is not satisfied. A wrong cell spoils its row
//! and those that repeat it, not its table; a table with an error never gets a verdict.

mod cells;
mod columns;
mod fixed;
mod functions;
mod globals;
mod names;
mod paths;
mod shapes;
mod standard;

use std::collections::BTreeMap;
use std::sync::Arc;

use super::model::Table;
use crate::diagnostic::{Finding, Severity};
use crate::library::names::Names;
use crate::library::{Catalogue, ItemId};
use crate::semantics::expr::Expr;
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::{Operand, Type};
use crate::text::Place;

/// What a cell reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Leaf {
    /// A variable of the unit at the end of a cycle.
    Variable {
        /// Its index in [`BoundTable::variables`].
        index: usize,
        /// How many cycles ago; before the run is so old, it is the declared initial value.
        ago: u32,
    },
    /// A global variable of the table, by its index in [`BoundTable::globals`].
    Global(usize),
}

/// An expression over the variables of the unit and the global variables of the table.
pub type Term = Expr<Leaf>;

/// What a variable is to its unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// Set by the environment.
    Input,
    /// Set by the unit.
    Output,
    /// Both.
    InOut,
    /// A variable of the unit's own.
    Internal,
    /// A global variable of the program.
    Global,
}

/// A variable that the table names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BoundVariable {
    /// Its path as it is declared: `Ext`, `Timer.Q`, `Points[3].X`, `GVL.Speed`.
    pub path: String,
    /// Its type.
    pub scalar: Scalar,
    /// The enumeration that the type is, if it is one.
    pub enumeration: Option<ItemId>,
    /// The values of the enumeration with their names.
    pub labels: Vec<(u64, String)>,
    /// The numbers that it may hold, where its type is a subrange.
    pub range: Option<(i128, i128)>,
    /// Its declared initial value, where that is a constant.
    pub initial: u64,
    /// What it is to the unit.
    pub role: Role,
    /// Where the first variable of the path is declared: the item, and the index among its variables.
    pub root: (ItemId, usize),
    /// Where the table names it first.
    pub place: Place,
}

/// A global variable of the table: one value for the whole run.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundGlobal {
    /// Its name.
    pub name: String,
    /// Its type.
    pub scalar: Scalar,
    /// The enumeration that the type is, if it is one.
    pub enumeration: Option<ItemId>,
    /// The values of the enumeration with their names.
    pub labels: Vec<(u64, String)>,
    /// What its value satisfies.
    pub constraint: Option<Term>,
    /// Where it is declared.
    pub place: Place,
}

/// A cell, of type `BOOL`.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundCell {
    first: Term,
    /// What holds in the later cycles, where that is something else.
    later: Option<Term>,
    /// Where it stands.
    pub place: Place,
}

impl BoundCell {
    /// What holds in the row's first cycle, or in a later one: the same without the triggers.
    #[must_use]
    pub fn constraint(&self, first: bool) -> &Term {
        self.later.as_ref().filter(|_| !first).unwrap_or(&self.first)
    }

    /// The constraints that it has, each once.
    pub fn distinct(&self) -> impl Iterator<Item = &Term> {
        std::iter::once(&self.first).chain(&self.later)
    }
}

/// A row.
#[derive(Clone, Debug, Default)]
pub struct BoundRow {
    /// For each column, its cell or the one that it repeats; `None` admits anything.
    pub cells: Vec<Option<Arc<BoundCell>>>,
    /// Whether a cell of it is wrong.
    pub spoiled: bool,
}

/// What a table uses and cannot be decided.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unsupported {
    /// What it is.
    pub what: String,
    /// Where.
    pub place: Place,
}

/// A table bound to its unit.
#[derive(Clone, Debug)]
pub struct BoundTable {
    /// The unit.
    pub unit: ItemId,
    /// The variables that it names, in the order in which it does.
    pub variables: Vec<BoundVariable>,
    /// Its global variables.
    pub globals: Vec<BoundGlobal>,
    /// For each column, whether its cells are assumptions.
    pub assumptions: Vec<bool>,
    /// For each column, the values that its cells speak of; empty where it could not be bound.
    pub subjects: Vec<Vec<Term>>,
    /// Its rows, as [`Table::rows`] lists them.
    pub rows: Vec<BoundRow>,
    /// What it uses and cannot be decided.
    pub unsupported: Vec<Unsupported>,
    /// How many errors it has, those of its reading included.
    pub errors: usize,
}

impl BoundTable {
    /// The constraints of a row in its first cycle or in a later one: those on the environment, or those on the unit.
    pub fn constraints(&self, row: usize, assumptions: bool, first: bool) -> impl Iterator<Item = &Term> {
        let cells = self.rows[row].cells.iter().zip(&self.assumptions);
        let cells = cells.filter(move |(_, assumption)| **assumption == assumptions);
        cells.filter_map(move |(cell, _)| cell.as_ref().map(|cell| cell.constraint(first)))
    }

    /// How far back each variable is asked for.
    #[must_use]
    pub fn depths(&self) -> Vec<u32> {
        let mut out = vec![0; self.variables.len()];
        let cells = self.rows.iter().flat_map(|row| row.cells.iter().flatten());
        for cell in cells {
            for term in cell.distinct() {
                term.leaves(&mut |leaf| {
                    if let Leaf::Variable { index, ago } = *leaf {
                        out[index] = out[index].max(ago);
                    }
                });
            }
        }
        out
    }
}

/// Binds `table` to `unit`.
#[must_use]
pub fn bind(table: &Table, catalogue: &Catalogue, names: &Names, unit: ItemId) -> (BoundTable, Vec<Finding>) {
    let mut binder = Binder {
        table,
        catalogue,
        names,
        unit,
        variables: Vec::new(),
        by_path: BTreeMap::new(),
        globals: Vec::new(),
        subjects: Vec::new(),
        enumerators: None,
        calls: Vec::new(),
        frames: Vec::new(),
        findings: Vec::new(),
        unsupported: Vec::new(),
    };
    binder.refuse_what_has_no_game();
    binder.bind_columns();
    binder.type_globals();
    let rows = binder.bind_rows();
    let globals = binder.bind_globals();
    let errors = binder.findings.iter().filter(|finding| finding.severity == Severity::Error).count();
    let subjects = std::mem::take(&mut binder.subjects);
    let settled = |operand: Operand<Leaf>| operand.settled().ok().map(|(expr, _)| expr);
    let bound = BoundTable {
        unit,
        variables: binder.variables,
        globals,
        assumptions: table.columns.iter().map(|column| column.kind.is_assumption()).collect(),
        subjects: subjects
            .into_iter()
            .map(|column| column.into_iter().flatten().filter_map(settled).collect())
            .collect(),
        rows,
        unsupported: binder.unsupported,
        errors: table.errors + errors,
    };
    (bound, binder.findings)
}

/// Why something could not be bound.
pub(super) struct Stop {
    finding: Finding,
    /// It is right, and cannot be decided.
    unsupported: bool,
}

type Result<T> = std::result::Result<T, Box<Stop>>;

struct Binder<'a> {
    table: &'a Table,
    catalogue: &'a Catalogue,
    names: &'a Names,
    unit: ItemId,
    variables: Vec<BoundVariable>,
    /// Variables by their path.
    by_path: BTreeMap<String, usize>,
    /// The types of the table's global variables; `None` where it is not known.
    globals: Vec<Option<Type>>,
    /// For each column, what its cells speak of; `None` where it could not be bound.
    subjects: Vec<Option<Vec<Operand<Leaf>>>>,
    /// The values of all enumerations by their folded names, once somebody asks.
    enumerators: Option<BTreeMap<String, Vec<(ItemId, usize)>>>,
    /// The functions of the table that are being inlined.
    calls: Vec<String>,
    /// Their inputs, innermost last.
    frames: Vec<Vec<(String, Operand<Leaf>)>>,
    findings: Vec<Finding>,
    unsupported: Vec<Unsupported>,
}

impl Binder<'_> {
    /// Keeps why something could not be bound.
    fn report(&mut self, stop: Stop) {
        if stop.unsupported {
            self.unsupported.push(Unsupported { what: stop.finding.message.clone(), place: stop.finding.place });
        }
        if !self.findings.contains(&stop.finding) {
            self.findings.push(stop.finding);
        }
    }

    /// Tables that compare runs or jump into others are read and printed; no game is played on them.
    fn refuse_what_has_no_game(&mut self) {
        let mut refuse = |what: &str, place| self.unsupported.push(Unsupported { what: what.to_owned(), place });
        if self.table.is_relational() {
            refuse("a table that compares runs", self.table.name_place);
        }
        for row in self.table.rows() {
            if !row.gotos.is_empty() {
                refuse("a jump into another table", row.place);
            }
            if row.duration.duration.flag == Some(super::duration::Flag::Hold) {
                refuse("the flag `hold`", row.duration.place);
            }
        }
    }
}
