//! What a proof covered: asks the prover, plays every run that it names on the interpreter and on the game, checks every proof
//! that something is never reached again, and puts names to it.

use std::collections::{BTreeMap, BTreeSet};
use std::time::Duration;

use super::Project;
use super::ready::Ready;
use crate::evidence::coverage::{Coverage, Fate, FreeCells, Item, Kind, Stretch, Witness};
use crate::library::{ItemId, Section, TypeUse};
use crate::logic::certificate::Certificate;
use crate::machine::program::SlotId;
use crate::machine::{interpret, translate};
use crate::prove::cover::probe::{Probed, Way, probed};
use crate::prove::cover::{Effort, Fate as Found, Question, Reached, never, reach};
use crate::prove::decide::Choice;
use crate::prove::engine::Cancel;
use crate::prove::product::{Parts, product};
use crate::recheck::invariant;
use crate::recheck::replay::{Environment, Replay, Subject, replay};
use crate::semantics::show::{Kind as Shown, literal};
use crate::table::Table;
use crate::table::decide::free::free;
use crate::text::Place;

/// What the search for the verdict brought to light.
pub(super) struct Known<'a> {
    /// Runs that lead somewhere.
    pub(super) runs: Vec<Choice>,
    /// The proof, if it is about the obligation's own system.
    pub(super) invariant: Option<&'a Certificate>,
    /// How long the check of a proof may take.
    pub(super) patience: Duration,
}

/// What the proof of a table covered, and the runs that show it.
///
/// # Errors
/// That the prover's answer was not confirmed, which is an error of this tool, or that the block with its probes is too large.
pub(super) fn cover(
    project: &Project,
    table: &Table,
    ready: &Ready,
    known: Known<'_>,
    cancel: &Cancel,
) -> Result<(Coverage, Vec<Choice>), String> {
    let counted = counted(project, ready.program.unit);
    let probed = probed(&ready.program, &|item| counted.contains(&item));
    let mut work = Work { project, table, ready, probed, inputs: Vec::new() };
    let found = if ready.automaton.may_be_empty { None } else { Some(work.search(known, cancel)?) };
    let items = work.items(found.as_ref());
    let witnesses = found.iter().flat_map(|found| &found.runs).map(|run| work.witness(run)).collect();
    let mut coverage = Coverage {
        rows: Coverage::ratio(&items, Kind::Row),
        statements: Coverage::ratio(&items, Kind::Statement),
        branches: Coverage::ratio(&items, Kind::Branch),
        items,
        witnesses,
        ..Coverage::default()
    };
    work.outputs(&mut coverage);
    Ok((coverage, found.map_or_else(Vec::new, |found| found.runs)))
}

/// The block, its members, and what they inherit.
pub(super) fn counted(project: &Project, unit: ItemId) -> BTreeSet<ItemId> {
    let catalogue = &project.catalogue;
    let mut found = BTreeSet::new();
    let mut open = vec![catalogue.top(unit)];
    while let Some(id) = open.pop() {
        if found.insert(id) {
            let item = catalogue.item(id);
            open.extend(&item.children);
            open.extend(item.extends.iter().filter_map(TypeUse::item).map(|base| catalogue.top(base)));
        }
    }
    found
}

/// What was not confirmed.
struct Rejected {
    text: String,
    /// It is the invariant of the verdict, as one of the system with probes.
    is_of_invariant: bool,
}

struct Work<'a> {
    project: &'a Project,
    table: &'a Table,
    ready: &'a Ready,
    probed: Probed,
    inputs: Vec<SlotId>,
}

impl Work<'_> {
    /// Asks, and confirms the answer. The targets are the rows, then the probes.
    fn search(&mut self, known: Known<'_>, cancel: &Cancel) -> Result<Reached, String> {
        let ready = self.ready;
        let options = translate::Options { loop_limit: ready.loop_limit, ..translate::Options::default() };
        let translated = translate::translate(&self.probed.program, &options)
            .map_err(|unsupported| format!("with the probes of its coverage: {}", unsupported.what))?;
        let parts = Parts {
            program: &self.probed.program,
            translated: &translated,
            table: &ready.table,
            automaton: &ready.automaton,
        };
        let made = product(&parts).map_err(|_| "the block with its probes does not fit the table".to_owned())?;
        let mut system = made.system;
        let fine = system.pool.not(translated.fault);
        let covered = system.pool.and(made.game.covered, fine);
        let mut rows = vec![system.pool.truth(false); ready.table.rows.len()];
        for (leaf, live) in ready.automaton.leaves.iter().zip(&made.game.live) {
            rows[leaf.row] = system.pool.or(rows[leaf.row], *live);
        }
        let probes = self.probed.slots().map(|slot| translated.end[slot.0 as usize]);
        let invariant = known.invariant.and_then(|proof| proof.moved(ready.system(), &system));
        let targets = rows.into_iter().chain(probes).map(|target| system.pool.and(target, covered)).collect();
        let mut question = Question { system, covered, targets, globals: made.globals, known: known.runs, invariant };
        self.inputs = made.inputs;
        let found = reach(&question, &Effort::default(), cancel);
        match self.confirm(&question, &found, known.patience) {
            Ok(()) => Ok(found),
            // The probes can lead the translation to other states, of which the invariant says too little.
            Err(rejected) if rejected.is_of_invariant => {
                question.invariant = None;
                let found = reach(&question, &Effort::default(), cancel);
                self.confirm(&question, &found, known.patience).map_err(|rejected| rejected.text)?;
                Ok(found)
            }
            Err(rejected) => Err(rejected.text),
        }
    }

    /// Plays the runs and checks the proofs.
    fn confirm(&self, question: &Question, found: &Reached, patience: Duration) -> Result<(), Rejected> {
        let seen = found.runs.iter().map(|run| Ok(self.seen(&self.played(run)?)));
        let other = |text| Rejected { text, is_of_invariant: false };
        let seen: Vec<Vec<BTreeSet<usize>>> = seen.collect::<Result<_, String>>().map_err(other)?;
        let mut proofs: Vec<(&Certificate, Vec<usize>)> = Vec::new();
        for (target, fate) in found.fates.iter().enumerate() {
            match fate {
                Found::Reached { run, cycle } => {
                    let there = seen.get(*run).and_then(|cycles| cycles.get(*cycle));
                    if !there.is_some_and(|there| there.contains(&target)) {
                        return Err(other(format!("a run that is said to cover something does not (target {target})")));
                    }
                }
                Found::Never(proof) => match proofs.iter_mut().find(|(known, _)| **known == **proof) {
                    Some((_, targets)) => targets.push(target),
                    None => proofs.push((proof, vec![target])),
                },
                Found::NotWithin(_) => {}
            }
        }
        for (proof, targets) in proofs {
            invariant::check(&never(question, &targets), proof, &invariant::within(patience)).map_err(|rejection| {
                let text = format!(
                    "the proof that something is never reached was rejected: {rejection:?} (targets {targets:?})"
                );
                Rejected { text, is_of_invariant: question.invariant.as_ref() == Some(proof) }
            })?;
        }
        Ok(())
    }

    fn played(&self, run: &Choice) -> Result<Replay, String> {
        let environment =
            Environment { globals: run.globals.clone(), slots: self.inputs.clone(), inputs: run.inputs.clone() };
        let subject = Subject {
            program: &self.probed.program,
            options: interpret::Options { loop_limit: self.ready.loop_limit },
            table: &self.ready.table,
            automaton: &self.ready.automaton,
        };
        replay(&subject, &environment).map_err(|missing| missing.to_string())
    }

    /// The targets that each cycle of a run reaches; a cycle in which a row is possible afterwards is one of the table.
    fn seen(&self, replay: &Replay) -> Vec<BTreeSet<usize>> {
        let rows = self.ready.table.rows.len();
        let cycle = |cycle: &crate::recheck::replay::Cycle| {
            let mut seen: BTreeSet<usize> = cycle.live.iter().copied().collect();
            if !seen.is_empty() {
                let probes = cycle.assigned.iter().filter(|set| set.slot >= self.probed.first && set.value == 1);
                seen.extend(probes.map(|set| rows + (set.slot.0 - self.probed.first.0) as usize));
            }
            seen
        };
        replay.cycles.iter().map(cycle).collect()
    }

    /// Every row, statement and way of a branch with its fate.
    fn items(&self, found: Option<&Reached>) -> Vec<Item> {
        let rows = self.table.rows();
        let count = self.ready.table.rows.len();
        let fate = |targets: &mut dyn Iterator<Item = usize>| match found {
            Some(found) => best(targets.map(|target| &found.fates[target])),
            None => Fate::Never,
        };
        let mut items = Vec::new();
        let mut add = |kind, name, place: Option<Place>, fate| {
            let (file, line) = place.map(|place| self.at(place)).unwrap_or_default();
            items.push(Item { kind, name, file, line, fate });
        };
        for (row, own) in rows.iter().enumerate().take(count) {
            add(Kind::Row, own.id.clone(), Some(self.table.place), fate(&mut std::iter::once(row)));
        }
        for (place, probes) in &self.probed.statements {
            let fate = fate(&mut probes.iter().map(|probe| count + *probe as usize));
            add(Kind::Statement, self.text(*place), Some(*place), fate);
        }
        for ((place, way), probes) in &self.probed.branches {
            let fate = fate(&mut probes.iter().map(|probe| count + *probe as usize));
            add(Kind::Branch, format!("{}: {}", self.text(*place), way_text(*way)), Some(*place), fate);
        }
        items
    }

    fn at(&self, place: Place) -> (String, u32) {
        let files = &self.project.files;
        (files.get(place.file).path.clone(), files.line_column(place).line)
    }

    /// The first line of what stands there.
    fn text(&self, place: Place) -> String {
        let text = place.span.of(&self.project.files.get(place.file).text);
        let line = text.lines().next().unwrap_or_default().trim();
        line.chars().take(100).collect()
    }

    /// What the table leaves free, and whether it says anything at all.
    fn outputs(&self, coverage: &mut Coverage) {
        let reached = |row: usize| {
            let mut rows = coverage.items.iter().filter(|item| item.kind == Kind::Row);
            rows.nth(row).is_some_and(|item| matches!(item.fate, Fate::Reached { .. }))
        };
        let rows = self.table.rows();
        let free = free(&self.ready.table);
        let reached: Vec<usize> = (0..free.len()).filter(|row| reached(*row)).collect();
        let mut constrained = BTreeMap::<String, bool>::new();
        let (mut nowhere, mut cells) = (Vec::new(), Vec::new());
        for (column, _) in self.ready.table.assumptions.iter().enumerate().filter(|(_, assumption)| !**assumption) {
            let name = self.table.columns[column].name.clone();
            let open: Vec<usize> = reached.iter().copied().filter(|row| free[*row].contains(&column)).collect();
            let says = open.len() < reached.len();
            *constrained.entry(name.to_uppercase()).or_default() |= says;
            for index in self.subjects(column) {
                *constrained.entry(self.ready.table.variables[index].path.to_uppercase()).or_default() |= says;
            }
            if !says {
                nowhere.push(name);
            } else if !open.is_empty() {
                cells.push(FreeCells { output: name, rows: open.iter().map(|row| rows[*row].id.clone()).collect() });
            }
        }
        let outputs = self.project.catalogue.item(self.ready.program.unit).variables.iter();
        for output in outputs.filter(|variable| variable.section == Section::Output) {
            let name = output.name.to_uppercase();
            let part = |path: &String| path.starts_with(&format!("{name}.")) || path.starts_with(&format!("{name}["));
            let says = constrained.iter().any(|(path, says)| *says && (*path == name || part(path)));
            if !says && !nowhere.iter().any(|known| known.eq_ignore_ascii_case(&output.name)) {
                nowhere.push(output.name.clone());
            }
        }
        let says_something = reached.iter().any(|row| {
            let assertions = self.ready.table.assumptions.iter().filter(|assumption| !**assumption).count();
            free[*row].len() < assertions
        });
        coverage.free_outputs = nowhere;
        coverage.free_cells = cells;
        coverage.vacuous = vacuous(self.ready.automaton.may_be_empty, coverage, says_something);
    }

    /// The variables that a column speaks of.
    fn subjects(&self, column: usize) -> Vec<usize> {
        let mut found = Vec::new();
        for subject in &self.ready.table.subjects[column] {
            subject.leaves(&mut |leaf| {
                if let crate::table::bind::Leaf::Variable { index, .. } = leaf {
                    found.push(*index);
                }
            });
        }
        found
    }

    /// A run as it is kept.
    fn witness(&self, run: &Choice) -> Witness {
        let program = &self.probed.program;
        let slots: Vec<_> = self.inputs.iter().map(|slot| &program.slots[slot.0 as usize]).collect();
        let text = |inputs: &Vec<u64>| -> Vec<String> {
            slots.iter().zip(inputs).map(|(slot, bits)| literal(&Shown::from(slot.scalar), *bits)).collect()
        };
        let mut stretches: Vec<Stretch> = Vec::new();
        for inputs in &run.inputs {
            let values = text(inputs);
            match stretches.last_mut() {
                Some(last) if last.values == values => last.cycles += 1,
                _ => stretches.push(Stretch { cycles: 1, values }),
            }
        }
        let globals = self.ready.table.globals.iter().zip(&run.globals).map(|(global, bits)| {
            let kind = Shown { scalar: global.scalar, labels: global.labels.clone() };
            (global.name.clone(), literal(&kind, *bits))
        });
        Witness { globals: globals.collect(), inputs: slots.iter().map(|slot| slot.name.clone()).collect(), stretches }
    }
}

/// The fate of what several probes stand for: one that is reached is enough.
fn best<'f>(fates: impl Iterator<Item = &'f Found>) -> Fate {
    let mut best = Fate::Never;
    for fate in fates {
        best = match (best, fate) {
            (Fate::Reached { witness, cycle }, Found::Reached { cycle: other, .. }) if cycle <= *other + 1 => {
                Fate::Reached { witness, cycle }
            }
            (_, Found::Reached { run, cycle }) => Fate::Reached { witness: *run, cycle: *cycle + 1 },
            (Fate::Never, Found::NotWithin(cycles)) => Fate::NotWithin { cycles: *cycles },
            (best, _) => best,
        };
    }
    best
}

fn way_text(way: Way) -> String {
    match way {
        Way::True => "holds".to_owned(),
        Way::False => "does not hold".to_owned(),
        Way::Arm(number) => format!("case {number}"),
        Way::Else => "else".to_owned(),
    }
}

/// Why a verdict proves nothing.
fn vacuous(may_be_empty: bool, coverage: &Coverage, says_something: bool) -> Vec<String> {
    if may_be_empty {
        return vec!["the table may be over before the first cycle, so that every run conforms to it".to_owned()];
    }
    if coverage.rows.hit == 0 {
        let rows: Vec<&Item> = coverage.items.iter().filter(|item| item.kind == Kind::Row).collect();
        let never = rows.iter().all(|item| item.fate == Fate::Never);
        let cycles = rows.iter().find_map(|item| match item.fate {
            Fate::NotWithin { cycles } => Some(cycles),
            _ => None,
        });
        let within = cycles.filter(|_| !never).map_or(String::new(), |cycles| format!(" of {cycles} cycles"));
        return vec![format!("no run{within} reaches a row of the table")];
    }
    if says_something { Vec::new() } else { vec!["no row that a run reaches constrains an output".to_owned()] }
}
