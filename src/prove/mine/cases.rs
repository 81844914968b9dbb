//! Whether facts imply the property, case by case.
//!
//! Where a guard is true, facts make words equal: what a block remembers and what its table remembers, say. With one
//! word in the place of both, what the block calculates and what the table asks for become the same gates, and no solver
//! has to find out that two multipliers agree (structural hashing; Kuehlmann and Krohm, "Equivalence checking using cuts
//! and heaps", DAC 1997).

use std::collections::BTreeMap;

use super::super::bmc::{Reply, Unrolled};
use super::super::engine::Budget;
use crate::logic::aig::{Aig, Gate, Latch, Lit, Model};

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
        let mut cases: Vec<(Lit, BTreeMap<u32, Lit>)> = guards.iter().map(|&g| (g, self.substitution(g))).collect();
        // The ones that say the most first.
        cases.sort_by_key(|(_, substitute)| std::cmp::Reverse(substitute.len()));
        let mut before: Vec<Lit> = Vec::new();
        for (guard, substitute) in cases {
            let mut case = before.clone();
            case.push(guard);
            if !self.holds(&case, &substitute, budget) {
                return false;
            }
            before.push(!guard);
        }
        self.holds(&before, &BTreeMap::new(), budget)
    }

    /// What latches are where the guard is true.
    fn substitution(&self, guard: Lit) -> BTreeMap<u32, Lit> {
        let partner = |fact: &Vec<Lit>| match fact.as_slice() {
            [a, b] if *a == !guard => Some(*b),
            [a, b] if *b == !guard => Some(*a),
            [a] => Some(*a),
            _ => None,
        };
        let true_here: std::collections::BTreeSet<Lit> = self.facts.iter().filter_map(partner).collect();
        let mut classes: BTreeMap<u32, Lit> = BTreeMap::new();
        let find = |classes: &BTreeMap<u32, Lit>, mut lit: Lit| {
            while let Some(next) = classes.get(&lit.node()) {
                lit = next.invert_if(lit.inverted());
            }
            lit
        };
        for (_, x, y) in self.equal.iter().filter(|(predicate, ..)| true_here.contains(predicate)) {
            for (&a, &b) in x.iter().zip(y) {
                let (a, b) = (find(&classes, a), find(&classes, b));
                let (low, high) = if a.node() <= b.node() { (a, b) } else { (b, a) };
                if low.node() != high.node() {
                    classes.insert(high.node(), low.invert_if(high.inverted()));
                }
            }
        }
        let nodes: Vec<u32> = classes.keys().copied().collect();
        nodes.into_iter().map(|node| (node, find(&classes, Lit::of(node)))).collect()
    }

    fn holds(&self, case: &[Lit], substitute: &BTreeMap<u32, Lit>, budget: &Budget) -> bool {
        let (graph, map) = self.rebuilt(substitute);
        let on = |lit: Lit| map[lit.node() as usize].invert_if(lit.inverted());
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

    /// The graph with some latches in the place of others, and what each node is there.
    fn rebuilt(&self, substitute: &BTreeMap<u32, Lit>) -> (Aig, Vec<Lit>) {
        let mut aig = Aig::default();
        let mut map = vec![Lit::FALSE; self.model.aig.len()];
        for node in 0..self.model.aig.len() as u32 {
            let on = |map: &[Lit], lit: Lit| map[lit.node() as usize].invert_if(lit.inverted());
            map[node as usize] = match (substitute.get(&node), self.model.aig.gate(node)) {
                (Some(&other), _) => on(&map, other),
                (None, Gate::False) => Lit::FALSE,
                (None, Gate::Leaf) => aig.leaf(),
                (None, Gate::And(a, b)) => {
                    let (a, b) = (on(&map, a), on(&map, b));
                    aig.and(a, b)
                }
            };
        }
        (aig, map)
    }
}
