//! A recorded trace held against a table: the game is played with the recorded values.
//!
//! A global variable stands for every value that it may have, so the trace has to keep the table for all of them. Tried are
//! those that can make a difference: what the trace and the table's constants hold, and their neighbours.

use std::collections::{BTreeMap, BTreeSet};

use super::show::{self, Outcome};
use super::{NotPlayed, Ready, passes};
use crate::machine::program::Program;
use crate::machine::trace::Trace;
use crate::pipeline::Project;
use crate::recheck::replay::{End, Failed};
use crate::semantics::eval::{FaultAt, Leaves, evaluate, mask};
use crate::semantics::expr::ExprKind;
use crate::semantics::show::Kind;
use crate::table::automaton::Site;
use crate::table::automaton::game::{Game, Judge, Standing};
use crate::table::bind::{BoundTable, Leaf, Term};

/// The most choices of global variables that are tried.
const CHOICES: usize = 10_000;

/// How values of a variable of the table are written, by its path; `None` for one that it does not name.
#[must_use]
pub fn kind(project: &Project, index: usize, path: &str) -> Option<Kind> {
    let ready = Ready::new(project, index).ok()?;
    let variable = ready.bound.variables.iter().find(|variable| variable.path.eq_ignore_ascii_case(path))?;
    let program = if variable.enumeration.is_some() { ready.program().ok() } else { None };
    Some(show::kind(project, program.as_ref(), variable.scalar, variable.enumeration))
}

/// Holds `trace` against a table.
///
/// # Errors
/// Why it cannot be done.
pub fn monitor(project: &Project, index: usize, trace: &Trace) -> Result<Outcome, NotPlayed> {
    let ready = Ready::new(project, index)?;
    // Only initial values are needed of the block, and only where cells look back beyond the first cycle.
    let program = ready.program();
    let initial = initial(&ready, program.as_ref().ok());
    if initial.is_none() && ready.bound.depths().iter().any(|depth| *depth > 0) {
        let mut reasons = program.err().map(|error| error.reasons).unwrap_or_default();
        reasons
            .insert(0, "cells name values of earlier cycles, and the block's initial values are not known".to_owned());
        return Err(NotPlayed::beyond(reasons));
    }
    let initial = initial.unwrap_or_else(|| vec![0; ready.bound.variables.len()]);
    let values = values(&ready, trace)?;
    let choices = choices(&ready.bound, &values)?;
    let mut shown: Option<(Vec<u64>, Played)> = None;
    for globals in choices {
        let played = played(&ready, &values, &initial, &globals);
        if played.end == End::WrongGlobals {
            continue;
        }
        let lost = !passes(&played.end);
        // Of the values that pass, the ones that the trace covers longest tell most.
        if lost || shown.as_ref().is_none_or(|(_, best)| played.rows.len() > best.rows.len()) {
            shown = Some((globals, played));
        }
        if lost {
            break;
        }
    }
    let Some((globals, played)) = shown else {
        return Err(NotPlayed::because("no values of the global variables were found"));
    };
    let mut cut = Trace::new(trace.name.clone(), ready.cycle_time);
    for variable in &ready.bound.variables {
        if let Some(signal) = trace.signal(&variable.path) {
            let values = signal.values.iter().take(played.rows.len()).copied().collect();
            cut.signals.push(crate::machine::trace::Signal { values, name: variable.path.clone(), ..signal.clone() });
        }
    }
    Ok(show::made(&ready, program.as_ref().ok(), &globals, played.rows, cut, &played.end))
}

fn initial(ready: &Ready<'_>, program: Option<&Program>) -> Option<Vec<u64>> {
    let program = program?;
    let slot = |path: &str| program.variables.iter().find(|variable| variable.path.eq_ignore_ascii_case(path));
    let initial = |path: &str| slot(path).map(|variable| program.slots[variable.slot.0 as usize].initial);
    ready.bound.variables.iter().map(|variable| initial(&variable.path)).collect()
}

/// The values of each cycle, in the order of the table's variables.
fn values(ready: &Ready<'_>, trace: &Trace) -> Result<Vec<Vec<u64>>, NotPlayed> {
    let mut signals = Vec::new();
    let mut missing = Vec::new();
    for variable in &ready.bound.variables {
        match trace.signal(&variable.path) {
            Some(signal) if signal.kind.scalar == variable.scalar => signals.push(signal),
            Some(_) => missing.push(format!("`{}` is of another type in the trace", variable.path)),
            None => missing.push(format!("the trace has no signal `{}`", variable.path)),
        }
    }
    if !missing.is_empty() {
        return Err(NotPlayed::wrong(missing));
    }
    Ok((0..trace.cycles()).map(|cycle| signals.iter().map(|signal| signal.values[cycle]).collect()).collect())
}

/// The choices of global variables that are tried.
fn choices(table: &BoundTable, values: &[Vec<u64>]) -> Result<Vec<Vec<u64>>, NotPlayed> {
    let mut choices: Vec<Vec<u64>> = vec![Vec::new()];
    for global in &table.globals {
        let width = global.scalar.width();
        let mut own: BTreeSet<u64> = [0, 1].into();
        let mut near = |value: u64| {
            let around = [value, value.wrapping_add(1), value.wrapping_sub(1)];
            own.extend(around.map(|value| mask(global.scalar, value)));
        };
        for (index, variable) in table.variables.iter().enumerate() {
            if variable.scalar == global.scalar {
                let distinct: BTreeSet<u64> = values.iter().map(|cycle| cycle[index]).collect();
                distinct.into_iter().for_each(&mut near);
            }
        }
        if let Some(constraint) = &global.constraint {
            constants(constraint, width, &mut near);
        }
        let longer = choices.iter().flat_map(|choice| {
            own.iter().map(move |value| choice.iter().copied().chain([*value]).collect::<Vec<u64>>())
        });
        choices = longer.take(CHOICES + 1).collect();
        if choices.len() > CHOICES {
            let message = format!("there are more than {CHOICES} choices of the global variables to try");
            return Err(NotPlayed::because(message));
        }
    }
    Ok(choices)
}

fn constants(term: &Term, width: u32, found: &mut dyn FnMut(u64)) {
    match &term.kind {
        ExprKind::Const(value) if term.scalar.width() == width => found(*value),
        ExprKind::Apply(_, operands) => operands.iter().for_each(|operand| constants(operand, width, found)),
        ExprKind::AndThen(a, b) | ExprKind::OrElse(a, b) => {
            [a, b].into_iter().for_each(|part| constants(part, width, found));
        }
        ExprKind::If(a, b, c) => [a, b, c].into_iter().for_each(|part| constants(part, width, found)),
        _ => {}
    }
}

/// A game that was played.
struct Played {
    /// The rows that are possible after each cycle.
    rows: Vec<Vec<usize>>,
    end: End,
}

fn played(ready: &Ready<'_>, values: &[Vec<u64>], initial: &[u64], globals: &[u64]) -> Played {
    let mut game = Game::new(&ready.automaton);
    let mut cells = Cells { ready, values, initial, globals, cycle: 0 };
    let mut constraints = ready.bound.globals.iter().filter_map(|global| global.constraint.as_ref());
    if !constraints.all(|constraint| cells.holds(constraint)) {
        return Played { rows: Vec::new(), end: End::WrongGlobals };
    }
    let mut rows = Vec::new();
    for cycle in 0..values.len() {
        if *game.standing() != Standing::Open {
            break;
        }
        cells.cycle = cycle;
        game.play(&mut cells);
        let live: BTreeSet<usize> = game.live().into_iter().map(|leaf| ready.automaton.leaves[leaf].row).collect();
        rows.push(if *game.standing() == Standing::Open { live.into_iter().collect() } else { Vec::new() });
    }
    let end = match game.standing() {
        Standing::Open => End::Open,
        Standing::Uncovered => End::Uncovered,
        Standing::Ended => End::Ended,
        Standing::Lost { rows } => End::Lost(cells.failed(rows)),
    };
    Played { rows, end }
}

/// Judges cells on recorded values.
struct Cells<'a> {
    ready: &'a Ready<'a>,
    values: &'a [Vec<u64>],
    initial: &'a [u64],
    globals: &'a [u64],
    cycle: usize,
}

impl Leaves<Leaf> for &Cells<'_> {
    fn read(&mut self, leaf: &Leaf) -> Result<u64, FaultAt> {
        Ok(match *leaf {
            Leaf::Global(index) => self.globals.get(index).copied().unwrap_or(0),
            Leaf::Variable { index, ago } => match self.cycle.checked_sub(ago as usize) {
                Some(cycle) => self.values.get(cycle).map_or(0, |cycle| cycle[index]),
                None => self.initial[index],
            },
        })
    }

    fn address(&mut self, _: &Leaf) -> Result<u64, FaultAt> {
        // A cell has no addresses: its expressions are over values.
        Ok(0)
    }
}

impl Cells<'_> {
    fn holds(&self, term: &Term) -> bool {
        let mut leaves = self;
        evaluate(term, &mut leaves) == Ok(1)
    }

    fn fit(&self, site: Site, assumptions: bool) -> bool {
        let row = self.ready.automaton.leaves[site.leaf].row;
        let mut constraints = self.ready.bound.constraints(row, assumptions, site.first);
        constraints.all(|term| self.holds(term))
    }

    fn failed(&self, sites: &[Site]) -> Vec<Failed> {
        let bound = &self.ready.bound;
        let mut by_row: BTreeMap<(usize, bool), Vec<usize>> = BTreeMap::new();
        for site in sites {
            let row = self.ready.automaton.leaves[site.leaf].row;
            let cells = bound.rows[row].cells.iter().zip(&bound.assumptions).enumerate();
            let columns = cells.filter_map(|(column, (cell, assumption))| {
                let cell = cell.as_ref().filter(|_| !assumption)?;
                (!self.holds(cell.constraint(site.first))).then_some(column)
            });
            by_row.entry((row, site.first)).or_insert_with(|| columns.collect());
        }
        by_row.into_iter().map(|((row, first), columns)| Failed { row, first, columns }).collect()
    }
}

impl Judge for Cells<'_> {
    fn inputs_fit(&mut self, site: Site) -> bool {
        self.fit(site, true)
    }

    fn outputs_fit(&mut self, site: Site) -> bool {
        self.fit(site, false)
    }
}
