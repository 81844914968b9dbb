//! A smaller model for a model, and the way back: runs and invariants of the one as those of the other.

use super::{Aig, Gate, Latch, Lit, Model, Trace};
use crate::logic::hash::FastMap;

/// A clause over latches: their indices, each with the value that satisfies.
pub type LatchClause = Vec<(usize, bool)>;

/// A model that is as bad as another one, and facts that say why.
#[derive(Clone, Debug)]
pub struct Reduced {
    /// The smaller model, with the same list of what is bad.
    pub model: Model,
    /// For each of its latches, the old one's index.
    pub latches: Vec<usize>,
    /// For each of its inputs, the old one's index.
    pub inputs: Vec<usize>,
    /// Clauses over the old latches that hold in all first states and are inductive together, under the constraints of the
    /// cycle that is left.
    pub facts: Vec<LatchClause>,
    /// For each old latch, the latch of the smaller model or the constant that it became; false too where it matters to
    /// nothing.
    pub states: Vec<Lit>,
    /// The old latches' first values; false where they have none.
    first: Vec<bool>,
    old_inputs: usize,
}

impl Reduced {
    /// The model itself.
    #[must_use]
    pub fn of(model: Model) -> Self {
        let inputs = model.inputs.len();
        Self {
            latches: (0..model.latches.len()).collect(),
            inputs: (0..inputs).collect(),
            facts: Vec::new(),
            states: model.latches.iter().map(|latch| latch.lit).collect(),
            first: first(&model),
            old_inputs: inputs,
            model,
        }
    }

    /// This reduction, and then another one.
    #[must_use]
    pub fn then(self, reduce: impl FnOnce(&Model) -> Self) -> Self {
        let next = reduce(&self.model);
        let facts = self.clauses(&next.facts);
        let index_of: FastMap<u32, usize> =
            self.model.latches.iter().enumerate().map(|(i, l)| (l.lit.node(), i)).collect();
        let on =
            |lit: &Lit| index_of.get(&lit.node()).map_or(*lit, |index| next.states[*index].invert_if(lit.inverted()));
        Self {
            latches: next.latches.iter().map(|latch| self.latches[*latch]).collect(),
            inputs: next.inputs.iter().map(|input| self.inputs[*input]).collect(),
            model: next.model,
            facts,
            states: self.states.iter().map(on).collect(),
            first: self.first,
            old_inputs: self.old_inputs,
        }
    }

    /// An invariant of the smaller model as one of the old model, with the facts.
    #[must_use]
    pub fn clauses(&self, invariant: &[LatchClause]) -> Vec<LatchClause> {
        let back = |clause: &LatchClause| clause.iter().map(|(latch, value)| (self.latches[*latch], *value)).collect();
        self.facts.iter().cloned().chain(invariant.iter().map(back)).collect()
    }

    /// A run of the smaller model as one of the old model.
    #[must_use]
    pub fn trace(&self, trace: &Trace) -> Trace {
        let spread = |values: &[bool], places: &[usize], mut out: Vec<bool>| {
            for (place, value) in places.iter().zip(values) {
                out[*place] = *value;
            }
            out
        };
        let inputs = trace.inputs.iter().map(|cycle| spread(cycle, &self.inputs, vec![false; self.old_inputs]));
        Trace { latches: spread(&trace.latches, &self.latches, self.first.clone()), inputs: inputs.collect() }
    }

    /// Whether the latches that are gone say nothing of their own: each is constant or follows one that is left.
    #[must_use]
    pub fn explains_all(&self) -> bool {
        let mut explained = vec![false; self.first.len()];
        self.latches.iter().for_each(|latch| explained[*latch] = true);
        // What follows a latch that a later step took away stands before what is known of that one.
        for fact in self.facts.iter().rev() {
            match fact.as_slice() {
                [(latch, _)] => explained[*latch] = true,
                [(latch, _), (other, _)] => explained[*latch] |= explained[*other],
                _ => {}
            }
        }
        explained.into_iter().all(|explained| explained)
    }
}

fn first(model: &Model) -> Vec<bool> {
    model.latches.iter().map(|latch| latch.initial.unwrap_or_default()).collect()
}

/// A literal through a map of nodes.
pub(crate) fn through(map: &[Lit], lit: Lit) -> Lit {
    map[lit.node() as usize].invert_if(lit.inverted())
}

/// Which nodes the roots need, through the next values of latches.
pub(super) fn needed(model: &Model, substitute: &[Lit]) -> Vec<bool> {
    let mut latch_of = vec![None; model.aig.len()];
    for latch in &model.latches {
        latch_of[latch.lit.node() as usize] = Some(latch.next);
    }
    let mut needed = vec![false; model.aig.len()];
    let mut pending: Vec<u32> = model.bad.iter().chain(&model.constraints).map(|lit| lit.node()).collect();
    while let Some(node) = pending.pop() {
        if std::mem::replace(&mut needed[node as usize], true) {
            continue;
        }
        let own = substitute[node as usize];
        if own != Lit::of(node) {
            pending.push(own.node());
        } else if let Gate::And(a, b) = model.aig.gate(node) {
            pending.extend([a.node(), b.node()]);
        } else if let Some(next) = latch_of[node as usize] {
            pending.push(next.node());
        }
    }
    needed
}

/// The graph in which each node is what `substitute` says, a literal of a smaller node or the node itself; and what each
/// old node is there.
pub(crate) fn substituted(model: &Model, substitute: &[Lit]) -> (Aig, Vec<Lit>) {
    let mut aig = Aig::default();
    let mut map = vec![Lit::FALSE; model.aig.len()];
    for node in (1_u32..).take(model.aig.len() - 1) {
        let own = substitute[node as usize];
        map[node as usize] = match model.aig.gate(node) {
            _ if own != Lit::of(node) => through(&map, own),
            Gate::And(a, b) => aig.and(through(&map, a), through(&map, b)),
            _ => aig.leaf(),
        };
    }
    (aig, map)
}

/// Each node for itself.
pub(crate) fn identity(model: &Model) -> Vec<Lit> {
    (0_u32..).map(Lit::of).take(model.aig.len()).collect()
}

/// The model in which each node is what `substitute` says, a literal of a smaller node or the node itself, without what
/// then matters to nothing.
pub(super) fn rebuild(model: &Model, substitute: &[Lit], facts: Vec<LatchClause>) -> Reduced {
    let needed = needed(model, substitute);
    let mut aig = Aig::default();
    let mut map = vec![Lit::FALSE; model.aig.len()];
    for node in (1_u32..).take(model.aig.len() - 1).filter(|node| needed[*node as usize]) {
        let own = substitute[node as usize];
        map[node as usize] = match model.aig.gate(node) {
            _ if own != Lit::of(node) => through(&map, own),
            Gate::False => Lit::FALSE,
            Gate::Leaf => aig.leaf(),
            Gate::And(a, b) => aig.and(through(&map, a), through(&map, b)),
        };
    }
    let kept = |lit: Lit| needed[lit.node() as usize] && substitute[lit.node() as usize] == Lit::of(lit.node());
    let latches: Vec<usize> = (0..model.latches.len()).filter(|index| kept(model.latches[*index].lit)).collect();
    let inputs: Vec<usize> = (0..model.inputs.len()).filter(|index| kept(model.inputs[*index])).collect();
    let new = |lit: Lit| through(&map, lit);
    let latch = |index: &usize| {
        let old = &model.latches[*index];
        Latch { lit: new(old.lit), next: new(old.next), initial: old.initial }
    };
    let out = Model {
        inputs: inputs.iter().map(|index| new(model.inputs[*index])).collect(),
        latches: latches.iter().map(latch).collect(),
        constraints: model.constraints.iter().map(|lit| new(*lit)).filter(|lit| *lit != Lit::TRUE).collect(),
        bad: model.bad.iter().map(|lit| new(*lit)).collect(),
        aig,
    };
    let states = model.latches.iter().map(|latch| new(latch.lit)).collect();
    Reduced { latches, inputs, facts, states, first: first(model), old_inputs: model.inputs.len(), model: out }
}

/// The cone of influence: what bad literals and constraints depend on.
#[must_use]
pub fn cone(model: &Model) -> Reduced {
    rebuild(model, &identity(model), Vec::new())
}
