//! Clauses that no random run contradicts.

use std::collections::{BTreeMap, BTreeSet};

use super::super::engine::{Budget, Reason};
use super::sample::{Runs, Samples, Wanted};
use crate::logic::aig::{Gate, Lit, Model};

/// Most nodes that are compared pair by pair for implications.
const PAIRED: usize = 200;

/// What runs showed.
pub(super) struct Seen {
    samples: Samples,
    /// Latches and gates over latches, sorted.
    nodes: Vec<Lit>,
    /// Predicates and latches, of which it is said when they hold.
    spoken: Vec<Lit>,
}

impl Seen {
    /// Of runs of the model.
    ///
    /// # Errors
    /// If the budget ends before.
    pub(super) fn take(model: &Model, predicates: &[Lit], runs: Runs<'_>, budget: &Budget) -> Result<Self, Reason> {
        let latches = model.latches.iter().map(|l| l.lit);
        let mut nodes: Vec<Lit> = latches.clone().chain(state_gates(model)).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let samples = Samples::take(model, Wanted { nodes: &nodes, ..Wanted::default() }, runs, budget)?;
        Ok(Self { samples, nodes, spoken: predicates.iter().copied().chain(latches).collect() })
    }

    /// Classes of nodes, and what holds where a guard is true.
    pub(super) fn first(&self, guards: &[Lit], budget: &Budget) -> Result<Vec<Vec<Lit>>, Reason> {
        let (mut guesses, _) = self.classes();
        self.under(guards, &mut guesses, budget)?;
        Ok(guesses)
    }

    /// What holds where a word has one of few values, and implications between any two.
    pub(super) fn second(&self, (guards, values): (&[Lit], &[Lit]), budget: &Budget) -> Result<Vec<Vec<Lit>>, Reason> {
        let (_, leaders) = self.classes();
        let mut guesses = Vec::new();
        self.under(values, &mut guesses, budget)?;
        let mut paired: Vec<Lit> = Vec::new();
        for &lit in self.spoken.iter().filter(|lit| leaders.contains(lit) && !guards.contains(lit)) {
            if paired.len() < PAIRED && !paired.contains(&lit) {
                paired.push(lit);
            }
        }
        for (index, &lit) in paired.iter().enumerate() {
            budget.check()?;
            for guard in [lit, !lit] {
                guesses.extend(self.implied(guard, &paired[..index]));
            }
        }
        Ok(guesses)
    }

    fn under(&self, guards: &[Lit], guesses: &mut Vec<Vec<Lit>>, budget: &Budget) -> Result<(), Reason> {
        for &guard in guards.iter().filter(|guard| self.samples.both(&self.nodes, **guard, **guard)) {
            budget.check()?;
            guesses.extend(self.implied(guard, &self.spoken));
        }
        Ok(())
    }

    /// What is always true where `guard` is: clauses with each of `lits`, or its inverse.
    fn implied(&self, guard: Lit, lits: &[Lit]) -> Vec<Vec<Lit>> {
        let either = lits.iter().filter(|lit| lit.node() != guard.node()).flat_map(|&lit| [lit, !lit]);
        either.filter(|&lit| !self.samples.both(&self.nodes, guard, !lit)).map(|lit| vec![!guard, lit]).collect()
    }

    /// Guesses that nodes are constant, or equal to an earlier one up to inversion; and the nodes that are neither.
    fn classes(&self) -> (Vec<Vec<Lit>>, BTreeSet<Lit>) {
        let (mut guesses, mut leaders) = (Vec::new(), BTreeSet::new());
        let mut known: BTreeMap<Vec<u64>, Lit> = BTreeMap::new();
        for (index, &node) in self.nodes.iter().enumerate() {
            let (flipped, signature) = self.samples.normal(index);
            if signature.iter().all(|&s| s == 0) {
                guesses.push(vec![node.invert_if(!flipped)]);
                continue;
            }
            let lit = node.invert_if(flipped);
            if let Some(&leader) = known.get(&signature) {
                guesses.push(vec![!lit, leader]);
                guesses.push(vec![lit, !leader]);
            } else {
                known.insert(signature, lit);
                leaders.insert(node);
            }
        }
        (guesses, leaders)
    }
}

/// Gates whose cones hold latches and no inputs.
fn state_gates(model: &Model) -> Vec<Lit> {
    let mut over_state = vec![false; model.aig.len()];
    over_state[0] = true;
    for latch in &model.latches {
        over_state[latch.lit.node() as usize] = true;
    }
    let mut gates = Vec::new();
    for node in 0..model.aig.len() as u32 {
        if let Gate::And(a, b) = model.aig.gate(node)
            && over_state[a.node() as usize]
            && over_state[b.node() as usize]
        {
            over_state[node as usize] = true;
            gates.push(Lit::of(node));
        }
    }
    gates
}
