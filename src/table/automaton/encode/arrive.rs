//! Where tokens go: along which edges, under which conditions, with which counts.

use super::{Arrival, Count, Encoder, Moved, bits};
use crate::logic::term::Term;
use crate::table::automaton::{Condition, Counter, Edge, Keeps, Site, Target, Test, Update};

impl Encoder<'_, '_> {
    /// By leaf.
    pub(super) fn arrivals(&mut self, start: Term) -> Vec<Vec<Arrival>> {
        let automaton = self.automaton;
        let mut arrivals: Vec<Vec<Arrival>> = automaton.leaves.iter().map(|_| Vec::new()).collect();
        if !automaton.may_be_empty {
            for edge in &automaton.entries {
                self.take(edge, start, None, &mut arrivals);
            }
        }
        for holder in 0..self.holders.len() {
            let (leaf, active) = (self.holders[holder].leaf, self.holders[holder].active);
            for edge in &automaton.edges[leaf] {
                self.take(edge, active, Some(holder), &mut arrivals);
            }
        }
        arrivals
    }

    /// Sends the token of a holder (at the beginning there is none) along an edge.
    fn take(&mut self, edge: &Edge, active: Term, from: Option<usize>, arrivals: &mut [Vec<Arrival>]) {
        let Some(site) = edge.site() else { return };
        let mut guard = active;
        if let Some(holder) = from {
            let allowed = self.conditions(holder, &edge.conditions);
            guard = self.pool.and(guard, allowed);
        }
        if self.pool.value(guard) == Some(0) {
            return;
        }
        let fits = self.fits(site);
        guard = self.pool.and(guard, fits);
        for rival in &edge.rivals {
            let there = self.fits(Site { leaf: rival.leaf, first: true });
            let allowed = match from {
                Some(holder) => self.conditions(holder, &rival.conditions),
                None => self.pool.truth(true),
            };
            let forced = self.pool.and(there, allowed);
            let free = self.pool.not(forced);
            guard = self.pool.and(guard, free);
        }
        if let Some(holder) = from {
            self.keep(edge, holder, guard);
        }
        let row = match (edge.target, from) {
            (Target::Stay(leaf), Some(holder)) => {
                self.successor(self.holders[holder].row, self.automaton.leaves[leaf].saturation)
            }
            _ => Moved::Fixed(1),
        };
        let loops = self.loops_after(edge, from, site.leaf);
        arrivals[site.leaf].push(Arrival { guard, site, row, loops });
    }

    /// Notes what the edge does to a word in an open end.
    fn keep(&mut self, edge: &Edge, holder: usize, guard: Term) {
        let leaf = self.holders[holder].leaf;
        for (end, known) in self.ends.iter().zip(&mut self.kept) {
            let moved = match self.automaton.keeps(*end, leaf, edge) {
                Some(Keeps::Stays) => &mut known[0],
                Some(Keeps::Leaves) => &mut known[1],
                Some(Keeps::Endless) | None => continue,
            };
            *moved = self.pool.or(*moved, guard);
        }
    }

    /// For each open end, that a word leaves it or none stays.
    pub(super) fn fair(&mut self) -> Vec<Term> {
        let kept = std::mem::take(&mut self.kept);
        let fair = |[stays, leaves]: [Term; 2]| {
            let none = self.pool.not(stays);
            self.pool.or(leaves, none)
        };
        kept.into_iter().map(fair).collect()
    }

    fn loops_after(&mut self, edge: &Edge, from: Option<usize>, target: usize) -> Vec<Moved> {
        let automaton = self.automaton;
        let stack = &automaton.leaves[target].loops;
        let mut out = Vec::with_capacity(stack.len());
        for (at, index) in stack.iter().enumerate() {
            let old = from.and_then(|holder| self.holders[holder].loops.get(at).copied());
            let old = old.unwrap_or(Count::Fixed(1));
            let update = edge.updates.iter().find(|update| update.block() == *index);
            out.push(match update {
                None => match old {
                    Count::Fixed(count) => Moved::Fixed(count),
                    Count::Kept(term, _) => Moved::Term(term),
                    Count::Ignored => Moved::Fixed(1),
                },
                Some(Update::Begin(_)) => Moved::Fixed(1),
                Some(Update::Next(_)) => self.successor(old, automaton.loops[*index].saturation),
            });
        }
        out
    }

    /// One more, up to `saturation`.
    fn successor(&mut self, count: Count, saturation: u64) -> Moved {
        match count {
            Count::Ignored => Moved::Fixed(1),
            Count::Fixed(count) => Moved::Fixed((count + 1).min(saturation)),
            Count::Kept(term, width) => {
                let (one, largest) = (self.pool.constant(width, 1), self.pool.constant(width, saturation));
                let (full, more) = (self.pool.eq(term, largest), self.pool.add(term, one));
                Moved::Term(self.pool.ite(full, largest, more))
            }
        }
    }

    fn conditions(&mut self, holder: usize, conditions: &[Condition]) -> Term {
        let (leaf, row, loops) =
            (self.holders[holder].leaf, self.holders[holder].row, self.holders[holder].loops.clone());
        self.admits(leaf, row, &loops, conditions)
    }

    pub(super) fn admits(&mut self, leaf: usize, row: Count, loops: &[Count], conditions: &[Condition]) -> Term {
        let mut all = self.pool.truth(true);
        for condition in conditions {
            let count = match condition.counter {
                Counter::Row => Some(row),
                Counter::Loop(index) => {
                    let at = self.automaton.leaves[leaf].loops.iter().position(|other| *other == index);
                    at.map(|at| loops[at])
                }
            };
            let holds = match count {
                Some(Count::Fixed(count)) => self.pool.truth(condition.test.admits(count)),
                Some(Count::Kept(term, width)) => self.test(term, width, condition.test),
                // A count that is asked for is kept; a block that is not round the row has none.
                Some(Count::Ignored) | None => self.pool.truth(false),
            };
            all = self.pool.and(all, holds);
        }
        all
    }

    fn test(&mut self, term: Term, width: u32, test: Test) -> Term {
        let (Test::AtLeast(bound) | Test::Below(bound)) = test;
        if bits(bound) > width {
            return self.pool.truth(matches!(test, Test::Below(_)));
        }
        let bound = self.pool.constant(width, bound);
        let below = self.pool.ult(term, bound);
        if matches!(test, Test::Below(_)) { below } else { self.pool.not(below) }
    }
}
