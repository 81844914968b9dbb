//! Whether facts imply the property, case by case.
//!
//! Where a guard is true, facts make words equal: what a block remembers and what its table remembers, say. With one
//! word in the place of both, what the block calculates and what the table asks for become the same gates, and no solver
//! has to find out that two multipliers agree (structural hashing; Kuehlmann and Krohm, "Equivalence checking using cuts
//! and heaps", DAC 1997).

use std::collections::BTreeSet;

use super::super::bmc::{Reply, Unrolled};
use super::super::engine::Budget;
use crate::logic::aig::{Gate, Latch, Lit, Model, identity, substituted, through};

/// What is asked: whether `bad` can be true where the constraints and the facts hold.
pub(super) struct Question<'q> {
    pub(super) model: &'q Model,
    pub(super) bad: Lit,
    pub(super) facts: &'q [Vec<Lit>],
    /// Predicates that say that two words of latches are equal.
    pub(super) equal: &'q [(Lit, Vec<Lit>, Vec<Lit>)],
}

/// Work for one case.
const TICKS: u64 = 10_000_000;

impl Question<'_> {
    /// Whether the facts imply that `bad` is false, each guard in turn being true, and all false.
    pub(super) fn implied(&self, guards: &[Lit], budget: &Budget) -> bool {
        let mut cases: Vec<(Lit, (Vec<Lit>, usize))> = guards.iter().map(|&g| (g, self.substitution(g))).collect();
        // The ones that say the most first.
        cases.sort_by_key(|(_, (_, count))| std::cmp::Reverse(*count));
        let mut before: Vec<Lit> = Vec::new();
        for (guard, (substitute, _)) in cases {
            let mut case = before.clone();
            case.push(guard);
            if !self.holds(&case, &substitute, budget) {
                return false;
            }
            before.push(!guard);
        }
        self.holds(&before, &identity(self.model), budget)
    }

    /// What each node is where the guard is true, and how many of them are another one.
    fn substitution(&self, guard: Lit) -> (Vec<Lit>, usize) {
        let partner = |fact: &Vec<Lit>| match fact.as_slice() {
            [a, b] if *a == !guard => Some(*b),
            [a, b] if *b == !guard => Some(*a),
            [a] => Some(*a),
            _ => None,
        };
        let true_here: BTreeSet<Lit> = self.facts.iter().filter_map(partner).collect();
        let (mut substitute, mut count) = (identity(self.model), 0);
        let find = |substitute: &[Lit], mut lit: Lit| {
            while through(substitute, lit) != lit {
                lit = through(substitute, lit);
            }
            lit
        };
        for (_, x, y) in self.equal.iter().filter(|(predicate, ..)| true_here.contains(predicate)) {
            for (&a, &b) in x.iter().zip(y) {
                let (a, b) = (find(&substitute, a), find(&substitute, b));
                let (low, high) = if a.node() <= b.node() { (a, b) } else { (b, a) };
                if low.node() != high.node() {
                    substitute[high.node() as usize] = low.invert_if(high.inverted());
                    count += 1;
                }
            }
        }
        (substitute, count)
    }

    fn holds(&self, case: &[Lit], substitute: &[Lit], budget: &Budget) -> bool {
        let (graph, map) = substituted(self.model, substitute);
        let on = |lit: Lit| through(&map, lit);
        let bad = on(self.bad);
        if bad == Lit::FALSE {
            return true;
        }
        // A model without a past: every leaf is an input.
        let inputs = (0..graph.len() as u32).filter(|n| graph.gate(*n) == Gate::Leaf).map(Lit::of).collect();
        let still = Model { aig: graph, inputs, latches: Vec::<Latch>::new(), constraints: Vec::new(), bad: vec![bad] };
        let mut solver = Unrolled::new(&still, false);
        let clauses = self.model.constraints.iter().chain(case).map(|&lit| vec![lit]).chain(self.facts.iter().cloned());
        for clause in clauses {
            let lits: Vec<Lit> = clause.iter().map(|&lit| solver.graph.at(on(lit), 0)).collect();
            if !lits.contains(&Lit::TRUE) {
                solver.require(&lits);
            }
        }
        let (goal, mut ticks) = (solver.graph.at(bad, 0), TICKS);
        matches!(solver.ask(goal, &mut ticks, budget), Reply::No)
    }
}
