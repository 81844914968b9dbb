//! The outcome of a run as values that reports print.

use super::{Project, Ready, passes, trace_of};
use crate::library::ItemId;
use crate::machine::program::{Program, Role};
use crate::machine::trace::{Signal, Trace};
use crate::recheck::replay::{Cycle, End, Environment, Failed, Replay};
use crate::semantics::expr::Fault;
use crate::semantics::scalar::Scalar;
use crate::semantics::show::{Kind, literal};
use crate::table::bind::{BoundTable, Leaf, Role as TableRole};

/// How a table was played or monitored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// The index of the table in [`Project::tables`].
    pub index: usize,
    /// Its name.
    pub table: String,
    /// The block.
    pub unit: String,
    /// The global variables with their values.
    pub globals: Vec<(String, String)>,
    /// The values of the table's variables.
    pub trace: Trace,
    /// For each cycle, the names of the rows that are possible after it.
    pub rows: Vec<Vec<String>>,
    /// Whether nothing is wrong.
    pub passed: bool,
    /// How it ended, in one line.
    pub end: String,
    /// In one word: `open`, `ended`, `uncovered`, `violated`, `fault`.
    pub word: &'static str,
    /// What differs in the last cycle.
    pub failures: Vec<Failure>,
}

/// A cell that does not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// The row.
    pub row: String,
    /// The column.
    pub column: String,
    /// What the cell says.
    pub expected: String,
    /// What the column's variable holds; empty where the column is no single variable.
    pub seen: String,
}

/// How values of a type are written.
pub(super) fn kind(project: &Project, program: Option<&Program>, scalar: Scalar, enumeration: Option<ItemId>) -> Kind {
    let labels = enumeration.map_or_else(Vec::new, |item| {
        let names = project.catalogue.item(item).variables.iter().map(|value| value.name.clone());
        let values = program.and_then(|program| program.enumerations.get(&item));
        values.into_iter().flatten().copied().zip(names).collect()
    });
    Kind { scalar, labels }
}

/// A trace of the table's variables: inputs at the beginning of each cycle, everything else at its end.
fn trace(ready: &Ready<'_>, program: &Program, replay: &Replay) -> Trace {
    let item = ready.project.catalogue.item(ready.unit());
    let mut trace = trace_of(&item.name, ready.cycle_time);
    for (index, variable) in ready.bound.variables.iter().enumerate() {
        let is_input = variable.role == TableRole::Input;
        let at = usize::from(!is_input);
        trace.signals.push(Signal {
            name: variable.path.clone(),
            kind: kind(ready.project, Some(program), variable.scalar, variable.enumeration),
            role: if is_input { Role::Input } else { Role::Output },
            values: replay.cycles.iter().map(|cycle| cycle.values[index][at]).collect(),
        });
    }
    // Inputs first, as in a table.
    trace.signals.sort_by_key(|signal| signal.role != Role::Input);
    trace
}

pub(super) fn outcome(ready: &Ready<'_>, program: &Program, environment: &Environment, replay: &Replay) -> Outcome {
    // The rows of the cycle in which the table ends are those that were tried.
    let rows = |cycle: &Cycle| match replay.end {
        End::Ended if cycle.live.is_empty() => cycle.tried.iter().map(|(row, _)| *row).collect(),
        _ => cycle.live.clone(),
    };
    let rows = replay.cycles.iter().map(rows).collect();
    let trace = trace(ready, program, replay);
    made(ready, Some(program), &environment.globals, rows, trace, &replay.end)
}

/// An outcome of rows by their indices, for each cycle.
pub(super) fn made(
    ready: &Ready<'_>,
    program: Option<&Program>,
    globals: &[u64],
    rows: Vec<Vec<usize>>,
    trace: Trace,
    end: &End,
) -> Outcome {
    let project = ready.project;
    let table = &project.tables[ready.index].table;
    let name = |row: usize| table.rows().get(row).map_or_else(String::new, |row| row.id.clone());
    let globals = ready.bound.globals.iter().zip(globals).map(|(global, bits)| {
        let kind = kind(project, program, global.scalar, global.enumeration);
        (global.name.clone(), literal(&kind, *bits))
    });
    let (word, line) = told(end, trace.cycles());
    let failures = match end {
        End::Lost(failed) => failed.iter().flat_map(|failed| failures(ready, &trace, failed)).collect(),
        _ => Vec::new(),
    };
    Outcome {
        index: ready.index,
        table: table.name.clone(),
        unit: project.catalogue.qualified_name(ready.unit()),
        globals: globals.collect(),
        rows: rows.into_iter().map(|rows| rows.into_iter().map(name).collect()).collect(),
        trace,
        passed: passes(end),
        end: line,
        word,
        failures,
    }
}

fn told(end: &End, cycle: usize) -> (&'static str, String) {
    match end {
        End::Open => ("open", format!("passed {cycle} cycles; the table goes on")),
        End::Ended => ("ended", format!("passed; the end of the table is reached in cycle {cycle}")),
        End::Uncovered => ("uncovered", format!("passed until cycle {cycle}, whose inputs are not those of the table")),
        End::Lost(_) => ("violated", format!("violated in cycle {cycle}")),
        End::Fault(at) => ("fault", format!("stopped in cycle {cycle}: {}", fault(at.fault))),
        End::WrongGlobals => ("uncovered", "the global variables are not those of the table".to_owned()),
    }
}

const fn fault(fault: Fault) -> &'static str {
    match fault {
        Fault::DivisionByZero => "division by zero",
        Fault::IndexOutOfBounds => "index out of bounds",
        Fault::SubrangeViolation => "value outside of its subrange",
        Fault::LoopLimit => "loop beyond the limit",
        Fault::NullReference => "null reference followed",
    }
}

fn failures(ready: &Ready<'_>, trace: &Trace, failed: &Failed) -> Vec<Failure> {
    let table = &ready.project.tables[ready.index].table;
    let effective = table.effective();
    let one = |column: &usize| {
        let cell = effective.get(failed.row).and_then(|row| row.get(*column).copied().flatten());
        let seen = subject(&ready.bound, *column).and_then(|variable| {
            let signal = trace.signal(&ready.bound.variables[variable].path)?;
            Some(literal(&signal.kind, *signal.values.last()?))
        });
        Failure {
            row: table.rows().get(failed.row).map_or_else(String::new, |row| row.id.clone()),
            column: table.columns.get(*column).map_or_else(String::new, |column| column.name.clone()),
            expected: cell.map_or_else(String::new, |cell| cell.text.clone()),
            seen: seen.unwrap_or_default(),
        }
    };
    failed.columns.iter().map(one).collect()
}

/// The variable that a column is bound to, if it is one.
fn subject(bound: &BoundTable, column: usize) -> Option<usize> {
    let [subject] = bound.subjects.get(column)?.as_slice() else { return None };
    match &subject.kind {
        crate::semantics::expr::ExprKind::Read(Leaf::Variable { index, ago: 0 }) => Some(*index),
        _ => None,
    }
}
