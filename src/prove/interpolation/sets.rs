//! Sets of states, in a graph over latches of their own.

use super::super::cdcl::Solver;
use super::super::encode::Encoding;
use super::super::engine::Budget;
use crate::logic::aig::{self, Aig, Lit, Model};

/// Work for the question whether a set is new.
const PATIENCE: u64 = 100_000_000;

/// The first states, and images of them.
pub(super) struct Sets {
    pub(super) aig: Aig,
    /// A leaf for each latch of the model, in its order.
    pub(super) latches: Vec<Lit>,
    /// The set that is looked at.
    pub(super) image: Lit,
    /// It, and all before it.
    all: Vec<Lit>,
    /// Knows that a state is in none of them.
    outside: Solver,
}

impl Sets {
    /// The first states of the model.
    pub(super) fn new(model: &Model) -> Self {
        let mut aig = Aig::default();
        let latches: Vec<Lit> = model.latches.iter().map(|_| aig.leaf()).collect();
        let known = model.latches.iter().zip(&latches);
        let known = known.filter_map(|(latch, lit)| latch.initial.map(|value| lit.invert_if(!value)));
        let image = known.fold(Lit::TRUE, |all, lit| aig.and(all, lit));
        let mut sets = Self { aig, latches, image, all: Vec::new(), outside: Solver::new() };
        sets.define(image);
        sets.take(image);
        sets
    }

    /// Lets the solver know what the set is.
    fn define(&mut self, set: Lit) {
        self.outside.reserve(self.aig.len());
        let encoding = Encoding::new(&self.aig, &[set]);
        encoding.clauses().for_each(|clause| self.outside.add(clause));
    }

    fn take(&mut self, set: Lit) {
        self.outside.add(&[!set]);
        self.all.push(set);
        self.image = set;
    }

    /// Goes on with the set that `raw`, a model whose inputs are the latches, has as its bad literal; whether there is a state
    /// in it that was not reached before, and `None` where that is too hard to say.
    pub(super) fn follow(&mut self, raw: &Model, budget: &Budget) -> Option<bool> {
        let small = aig::cone(raw).then(|model| aig::sweep(model, &budget.stop()));
        let leaves: Vec<Lit> = small.inputs.iter().map(|&old| self.latches[old]).collect();
        let set = self.aig.import(&small.model, &leaves, small.model.bad[0]);
        self.define(set);
        self.outside.stop = budget.stop();
        let is_new = self.outside.solve(&[set], None, None, PATIENCE)?;
        if is_new {
            self.take(set);
        }
        Some(is_new)
    }

    /// All of them together, as a literal of the model's graph.
    pub(super) fn reached_in(&self, model: &mut Model) -> Lit {
        let mut union = Aig::clone(&self.aig);
        let reached = self.all.iter().fold(Lit::FALSE, |any, &set| union.or(any, set));
        let own = Model { aig: union, inputs: self.latches.clone(), ..Model::default() };
        let leaves: Vec<Lit> = model.latches.iter().map(|latch| latch.lit).collect();
        model.aig.import(&own, &leaves, reached)
    }

    /// Work done so far.
    pub(super) fn work(&self) -> u64 {
        self.outside.ticks
    }

    pub(super) fn bytes(&self) -> usize {
        self.outside.bytes() + self.aig.len() * 40
    }
}
