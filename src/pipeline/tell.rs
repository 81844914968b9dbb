//! A run that loses, told as the papers tell it: cycle by cycle the values, the rows that were possible, the failing cell
//! with what was expected and seen, and the lines that were executed.
//!
//! As JSON: `{"format": "rungbook-run-1", "cycle_ns", "globals": [{"name", "bits", "value"}], "inputs": [{"name", "bits": […]}],
//! "variables": [{"name", "input"}], "cycles": [{"values": […], "tried": […], "live": […], "lines": […]}], "end": {…}}`. A failing cell in `end` names
//! the assignment that gave the wrong value: `"set": {"cycle", "file", "line"}`. Everything that
//! is needed to play the run again is in `globals` and `inputs`; the rest is for reading.

use serde_json::{Value, json};

use super::Project;
use super::verify::Verified;
use crate::machine::program::Program;
use crate::prove::verdict::{Loss, Run, Verdict};
use crate::recheck::replay::{Cycle, Replay};
use crate::semantics::expr::Fault;
use crate::semantics::show::{Kind, literal};
use crate::table::bind::BoundTable;
use crate::text::Place;

/// The format of runs.
pub const RUN: &str = "rungbook-run-1";

/// The run of a violation; `None` for other verdicts.
#[must_use]
pub fn run(project: &Project, verified: &Verified) -> Option<Value> {
    let Verdict::Violated(run) = &verified.verdict else { return None };
    let (replay, bound) = (verified.replay.as_ref()?, verified.bound.as_deref()?);
    let teller = Teller { project, verified, bound, program: verified.program.as_deref()?, run };
    Some(teller.tell(replay))
}

struct Teller<'a> {
    project: &'a Project,
    verified: &'a Verified,
    bound: &'a BoundTable,
    program: &'a Program,
    run: &'a Run,
}

/// What a fault is called.
#[must_use]
pub const fn fault_name(fault: Fault) -> &'static str {
    match fault {
        Fault::DivisionByZero => "division by zero",
        Fault::IndexOutOfBounds => "index out of bounds",
        Fault::SubrangeViolation => "value outside of its subrange",
        Fault::LoopLimit => "loop beyond the limit",
        Fault::NullReference => "null reference followed",
    }
}

impl Teller<'_> {
    fn tell(&self, replay: &Replay) -> Value {
        let slots = &self.verified.input_slots;
        let inputs = slots.iter().enumerate().map(|(index, slot)| {
            let bits: Vec<u64> = self.run.inputs.iter().map(|cycle| cycle[index]).collect();
            json!({"name": self.program.slots[slot.0 as usize].name, "bits": bits})
        });
        let globals = self.bound.globals.iter().zip(&self.run.globals).map(|(global, bits)| {
            let kind = self.kind(global.scalar, global.enumeration);
            json!({"name": global.name, "bits": bits, "value": literal(&kind, *bits)})
        });
        let variables =
            self.bound.variables.iter().map(
                |variable| json!({"name": variable.path, "input": variable.role == crate::table::bind::Role::Input}),
            );
        json!({
            "format": RUN,
            "cycle_ns": self.verified.cycle_time,
            "globals": globals.collect::<Vec<_>>(),
            "inputs": inputs.collect::<Vec<_>>(),
            "variables": variables.collect::<Vec<_>>(),
            "cycles": replay.cycles.iter().map(|cycle| self.cycle(cycle)).collect::<Vec<_>>(),
            "end": self.end(replay),
        })
    }

    fn kind(&self, scalar: crate::semantics::scalar::Scalar, enumeration: Option<crate::library::ItemId>) -> Kind {
        Kind { scalar, labels: self.labels(enumeration) }
    }

    /// The values of an enumeration with their names.
    fn labels(&self, enumeration: Option<crate::library::ItemId>) -> Vec<(u64, String)> {
        let Some(item) = enumeration else { return Vec::new() };
        let names = self.project.catalogue.item(item).variables.iter().map(|value| value.name.clone());
        let values = self.program.enumerations.get(&item).into_iter().flatten().copied();
        values.zip(names).collect()
    }

    fn text(&self, variable: usize, bits: u64) -> String {
        let variable = &self.bound.variables[variable];
        literal(&self.kind(variable.scalar, variable.enumeration), bits)
    }

    fn row(&self, row: usize) -> String {
        self.project.tables[self.verified.table].table.rows().get(row).map_or(String::new(), |row| row.id.clone())
    }

    fn cycle(&self, cycle: &Cycle) -> Value {
        let value = |(index, [begin, end]): (usize, &[u64; 2])| match self.bound.variables[index].role {
            crate::table::bind::Role::Input => self.text(index, *begin),
            crate::table::bind::Role::InOut if begin != end => {
                format!("{} → {}", self.text(index, *begin), self.text(index, *end))
            }
            _ => self.text(index, *end),
        };
        let tried: Vec<String> = cycle.tried.iter().map(|(row, _)| self.row(*row)).collect();
        let live: Vec<String> = cycle.live.iter().map(|row| self.row(*row)).collect();
        json!({
            "values": cycle.values.iter().enumerate().map(value).collect::<Vec<_>>(),
            "tried": tried,
            "live": live,
            "lines": self.lines(cycle),
        })
    }

    /// The executed lines in their order, each with what it set.
    fn lines(&self, cycle: &Cycle) -> Vec<Value> {
        let mut lines: Vec<(Place, Vec<Value>)> = Vec::new();
        for assigned in &cycle.assigned {
            let Some(place) = assigned.place else { continue };
            let slot = &self.program.slots[assigned.slot.0 as usize];
            let value = literal(&Kind::from(slot.scalar), assigned.value);
            let set = json!({"name": slot.name, "value": value});
            match lines.last_mut() {
                Some((last, sets)) if *last == place => sets.push(set),
                _ => lines.push((place, vec![set])),
            }
        }
        lines
            .into_iter()
            .map(|(place, set)| {
                let (file, line) = self.at(place);
                json!({"file": file, "line": line, "set": set})
            })
            .collect()
    }

    fn at(&self, place: Place) -> (String, u32) {
        let files = &self.project.files;
        (files.get(place.file).path.clone(), files.line_column(place).line)
    }

    fn end(&self, replay: &Replay) -> Value {
        let cycle = replay.cycles.len();
        match &self.run.loss {
            Loss::Table(rows) => {
                let last = replay.cycles.last();
                let rows = rows.iter().map(|failed| {
                    let cells = failed.columns.iter().map(|column| self.cell(failed.row, *column, last));
                    json!({"row": self.row(failed.row), "first": failed.first, "cells": cells.collect::<Vec<_>>()})
                });
                json!({"kind": "table", "cycle": cycle, "rows": rows.collect::<Vec<_>>()})
            }
            Loss::Fault { fault, place } => {
                let (file, line) = place.map(|place| self.at(place)).unwrap_or_default();
                json!({"kind": "fault", "cycle": cycle, "fault": fault_name(*fault), "file": file, "line": line})
            }
            Loss::NeverEnds(from) => json!({"kind": "never-ends", "cycle": cycle, "from": from + 1}),
        }
    }

    /// The cell that fails, with what it expects and what the column's variable holds.
    fn cell(&self, row: usize, column: usize, last: Option<&Cycle>) -> Value {
        let table = &self.project.tables[self.verified.table].table;
        let expected = table.effective()[row][column].map_or(String::new(), |cell| cell.text.clone());
        let name = &table.columns[column].name;
        let seen = self.subject(column).and_then(|index| {
            let [_, end] = last?.values.get(index)?;
            Some(self.text(index, *end))
        });
        let set = self.subject(column).and_then(|index| self.set_last(index));
        json!({"column": name, "expected": expected, "seen": seen.unwrap_or_default(), "set": set})
    }

    /// The assignment that gave a variable the value that it has in the last cycle.
    fn set_last(&self, variable: usize) -> Option<Value> {
        let path = &self.bound.variables[variable].path;
        let slot = self.program.variables.iter().find(|named| named.path.eq_ignore_ascii_case(path))?.slot;
        let cycles = self.verified.replay.as_ref()?.cycles.iter().enumerate().rev();
        let mut assigned = cycles.flat_map(|(at, cycle)| cycle.assigned.iter().rev().map(move |set| (at, set)));
        let (at, place) = assigned.find_map(|(at, set)| Some((at, set.place.filter(|_| set.slot == slot)?)))?;
        let (file, line) = self.at(place);
        Some(json!({"cycle": at + 1, "file": file, "line": line}))
    }

    /// The variable that a column is bound to, if it is one.
    fn subject(&self, column: usize) -> Option<usize> {
        let mut found = None;
        for subject in &self.bound.subjects[column] {
            subject.leaves(&mut |leaf| {
                if let crate::table::bind::Leaf::Variable { index, ago: 0 } = leaf {
                    found = Some(*index);
                }
            });
        }
        found.filter(|_| self.bound.subjects[column].len() == 1)
    }
}
