//! What conclusions rest on: each learnt clause with the clauses that it was resolved from, in order, down to the empty
//! one; and the interpolant of a refutation.
//!
//! McMillan, "Interpolation and SAT-based model checking" (CAV 2003). Where clauses of two parts contradict each other, the
//! interpolant speaks only of what both speak of, follows from the first part, and contradicts the second. A solver that
//! keeps its proof never forgets a clause, and takes no assumptions.

use std::collections::BTreeSet;

use super::{NONE, Solver};
use crate::logic::aig::{Aig, Lit};
use crate::logic::hash::FastMap;

/// Which of the two parts of a contradiction a clause belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    First,
    Second,
}

/// A clause of the proof; its entries are the literals of an original, or of a derived one the number of a clause, then
/// pairs of a variable and the number of the clause that is resolved on it.
#[derive(Clone, Copy, Debug)]
struct Step {
    original: Option<Part>,
    start: usize,
}

/// The proof so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Log {
    steps: Vec<Step>,
    entries: Vec<u32>,
    /// The number of a clause in the arena, and of the clause that gives a variable its value for good.
    numbers: FastMap<u32, u32>,
    units: Vec<u32>,
    /// How much of the trail has its units.
    synced: usize,
    empty: Option<u32>,
    /// The conflict that is looked at: the clause that fails, then variables with the clauses resolved on them.
    pub(super) chain: Vec<(u32, u32)>,
    /// The number of the clause that was learnt from it.
    learnt: u32,
}

impl Log {
    fn push(&mut self, original: Option<Part>, entries: impl IntoIterator<Item = u32>) -> u32 {
        self.steps.push(Step { original, start: self.entries.len() });
        self.entries.extend(entries);
        self.steps.len() as u32 - 1
    }

    fn entries(&self, number: u32) -> &[u32] {
        let at = number as usize;
        let end = self.steps.get(at + 1).map_or(self.entries.len(), |next| next.start);
        &self.entries[self.steps[at].start..end]
    }

    pub(super) fn bytes(&self) -> usize {
        self.entries.capacity() * 4 + self.steps.capacity() * 16 + self.numbers.len() * 12
    }

    /// For each clause, up to the empty one, whether that rests on it.
    fn needed(&self) -> Vec<bool> {
        let Some(empty) = self.empty else { return Vec::new() };
        let mut needed = vec![false; empty as usize + 1];
        needed[empty as usize] = true;
        for number in (0..=empty).rev().filter(|&number| self.steps[number as usize].original.is_none()) {
            if needed[number as usize] {
                self.entries(number).iter().step_by(2).for_each(|&below| needed[below as usize] = true);
            }
        }
        needed
    }

    fn set_unit(&mut self, variable: u32, number: u32) {
        let at = variable as usize;
        if self.units.len() <= at {
            self.units.resize(at + 1, NONE);
        }
        self.units[at] = number;
    }
}

impl Solver {
    /// An empty solver that keeps its proof.
    pub(crate) fn with_proof() -> Self {
        Self { log: Some(Box::default()), most_learnts: usize::MAX, ..Self::new() }
    }

    /// Adds a clause of one of two parts.
    pub(crate) fn add_to(&mut self, part: Part, clause: &[Lit]) {
        self.back_to(0);
        let mut lits = clause.to_vec();
        lits.sort_unstable();
        lits.dedup();
        let holds = |l: &Lit| self.value_of(*l) > 0;
        if self.broken || lits.iter().any(holds) || lits.windows(2).any(|w| w[0] == !w[1]) {
            return;
        }
        self.sync();
        let falsified: Vec<Lit> = lits.iter().copied().filter(|&l| self.value_of(l) < 0).collect();
        let Some(log) = &mut self.log else { return };
        let mut number = log.push(Some(part), lits.iter().map(|l| l.0));
        if !falsified.is_empty() {
            let units = falsified.iter().flat_map(|l| [l.node(), log.units[l.node() as usize]]);
            let entries: Vec<u32> = std::iter::once(number).chain(units).collect();
            number = log.push(None, entries);
            lits.retain(|l| !falsified.contains(l));
        }
        match lits[..] {
            [] => {
                log.empty = Some(number);
                self.broken = true;
            }
            [unit] => {
                log.set_unit(unit.node(), number);
                self.assign(unit, NONE);
                self.settle();
            }
            _ => {
                let clause = self.store(&lits, false, 0);
                self.originals.push(clause);
                self.log.as_mut().map(|log| log.numbers.insert(clause, number));
            }
        }
    }

    /// Gives every value that holds for good the clause that it follows from.
    fn sync(&mut self) {
        let Some(mut log) = self.log.take() else { return };
        let end = self.levels.first().copied().unwrap_or(self.trail.len());
        while log.synced < end {
            let variable = self.trail[log.synced].node();
            let reason = self.reason[variable as usize];
            if reason != NONE {
                let number = self.resolved_with_units(&mut log, reason, 1);
                log.set_unit(variable, number);
            }
            log.synced += 1;
        }
        self.log = Some(log);
    }

    /// A clause without those of its literals, from the one at `from` on, that are false for good.
    fn resolved_with_units(&self, log: &mut Log, clause: u32, from: usize) -> u32 {
        let others = (from..self.size(clause)).map(|at| self.lit(clause, at).node());
        let units: Vec<u32> = others.flat_map(|variable| [variable, log.units[variable as usize]]).collect();
        let entries: Vec<u32> = std::iter::once(log.numbers[&clause]).chain(units).collect();
        log.push(None, entries)
    }

    /// The clauses contradict each other: this one fails, whatever is decided.
    pub(super) fn note_end(&mut self, conflict: u32) {
        self.sync();
        if let Some(mut log) = self.log.take() {
            let number = self.resolved_with_units(&mut log, conflict, 0);
            log.empty = Some(number);
            self.log = Some(log);
        }
    }

    /// Keeps what literals that are left out of a learnt clause follow from: `gone`, with what they were seen through.
    pub(super) fn note_removed(&mut self, gone: impl Iterator<Item = Lit>) {
        let mut open: BTreeSet<u32> = gone.map(|l| l.node()).collect();
        let mut at = self.trail.len();
        while !open.is_empty() && at > 0 {
            at -= 1;
            let variable = self.trail[at].node();
            if open.remove(&variable) {
                let reason = self.reason[variable as usize];
                self.note_resolved(variable, reason);
            }
        }
    }

    pub(super) fn note_resolved(&mut self, variable: u32, clause: u32) {
        if let Some(log) = &mut self.log {
            log.chain.push((variable, clause));
        }
    }

    /// The conflict has been looked at.
    pub(super) fn note_learnt(&mut self) {
        self.sync();
        let Some(mut log) = self.log.take() else { return };
        let chain = std::mem::take(&mut log.chain);
        let mut settled = BTreeSet::new();
        let mut entries = Vec::with_capacity(2 * chain.len());
        for (index, &(variable, clause)) in chain.iter().enumerate() {
            if index > 0 {
                entries.push(variable);
            }
            entries.push(log.numbers[&clause]);
            let variables = (0..self.size(clause)).map(|at| self.lit(clause, at).node());
            settled.extend(variables.filter(|variable| self.level[*variable as usize] == 0));
        }
        entries.extend(settled.into_iter().flat_map(|variable| [variable, log.units[variable as usize]]));
        log.learnt = log.push(None, entries);
        self.log = Some(log);
    }

    /// The learnt clause is kept, as a value for good or as a clause.
    pub(super) fn note_kept(&mut self, unit: Option<Lit>, clause: u32) {
        let Some(log) = &mut self.log else { return };
        let number = log.learnt;
        match unit {
            Some(unit) => log.set_unit(unit.node(), number),
            None => {
                log.numbers.insert(clause, number);
            }
        }
    }

    /// The interpolant of the refutation that was found, in `graph`: `shared` gives its literals for the variables that
    /// both parts speak of, `is_first` tells the variables that only the first one does. `None` without a refutation, and where
    /// the graph gets more than `most` nodes.
    pub(crate) fn interpolant(
        &self,
        graph: &mut Aig,
        shared: &dyn Fn(u32) -> Option<Lit>,
        is_first: &dyn Fn(u32) -> bool,
        most: usize,
    ) -> Option<Lit> {
        let log = self.log.as_ref()?;
        let empty = log.empty? as usize;
        let needed = log.needed();
        let mut values = vec![Lit::TRUE; empty + 1];
        for number in (0..=empty).filter(|&number| needed[number]) {
            if graph.len() > most {
                return None;
            }
            let entries = log.entries(number as u32);
            values[number] = match log.steps[number].original {
                Some(Part::Second) => Lit::TRUE,
                Some(Part::First) => {
                    let lits = entries.iter().map(|&lit| Lit(lit));
                    let both = lits.filter_map(|lit| shared(lit.node()).map(|at| at.invert_if(lit.inverted())));
                    both.fold(Lit::FALSE, |any, lit| graph.or(any, lit))
                }
                None => {
                    let pairs = entries[1..].chunks(2);
                    pairs.fold(values[entries[0] as usize], |value, pair| {
                        let other = values[pair[1] as usize];
                        if is_first(pair[0]) { graph.or(value, other) } else { graph.and(value, other) }
                    })
                }
            };
        }
        Some(values[empty])
    }
}
