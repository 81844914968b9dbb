//! The part of a model that matters for one property, and the way back: latches, inputs and gates that the bad literal or a
//! constraint depends on, with latches that never leave their first value replaced by it (a fixed point of three-valued
//! simulation).

use std::collections::BTreeMap;

use super::engine::{Answer, Fact, Proof};
use crate::logic::aig::{Gate, Latch, Lit, Model, Trace};

/// A smaller model.
pub(crate) struct Reduced {
    /// With one property.
    pub(crate) model: Model,
    latches: Vec<usize>,
    inputs: Vec<usize>,
    constants: Vec<Fact>,
    /// What each node of the old model became.
    map: BTreeMap<u32, Lit>,
}

/// Three-valued conjunction.
fn and3(a: Option<bool>, b: Option<bool>) -> Option<bool> {
    match (a, b) {
        (Some(false), _) | (_, Some(false)) => Some(false),
        (Some(true), Some(true)) => Some(true),
        _ => None,
    }
}

/// For each latch the value that it never leaves, if three-valued simulation finds one.
fn constants(model: &Model) -> Vec<Option<bool>> {
    let mut known: Vec<Option<bool>> = model.latches.iter().map(|l| l.initial).collect();
    let mut values = vec![None; model.aig.len()];
    loop {
        values[0] = Some(false);
        for (latch, &value) in model.latches.iter().zip(&known) {
            values[latch.lit.node() as usize] = value;
        }
        let of = |values: &[Option<bool>], l: Lit| values[l.node() as usize].map(|v| v != l.inverted());
        for node in 0..model.aig.len() {
            if let Gate::And(a, b) = model.aig.gate(node as u32) {
                values[node] = and3(of(&values, a), of(&values, b));
            }
        }
        let mut changed = false;
        for (latch, value) in model.latches.iter().zip(&mut known) {
            if value.is_some() && of(&values, latch.next) != *value {
                *value = None;
                changed = true;
            }
        }
        if !changed {
            return known;
        }
    }
}

/// The nodes that matter, through next values; constant latches end the search.
fn needed(model: &Model, property: usize, constants: &[Option<bool>]) -> Vec<bool> {
    let latch_of: BTreeMap<u32, usize> = model.latches.iter().enumerate().map(|(i, l)| (l.lit.node(), i)).collect();
    let mut seen = vec![false; model.aig.len()];
    let mut open: Vec<u32> = model.constraints.iter().chain([&model.bad[property]]).map(|l| l.node()).collect();
    while let Some(node) = open.pop() {
        if std::mem::replace(&mut seen[node as usize], true) {
            continue;
        }
        match model.aig.gate(node) {
            Gate::And(a, b) => open.extend([a.node(), b.node()]),
            Gate::False => {}
            Gate::Leaf => open.extend(
                latch_of.get(&node).filter(|&&i| constants[i].is_none()).map(|&i| model.latches[i].next.node()),
            ),
        }
    }
    seen
}

impl Reduced {
    pub(crate) fn new(model: &Model, property: usize) -> Self {
        let constants = constants(model);
        let needed = needed(model, property, &constants);
        let keeps = |lit: Lit| needed[lit.node() as usize];
        let mut small = Model::default();
        let mut map = BTreeMap::from([(0, Lit::FALSE)]);
        let latches: Vec<usize> =
            (0..model.latches.len()).filter(|&i| keeps(model.latches[i].lit) && constants[i].is_none()).collect();
        let inputs: Vec<usize> = (0..model.inputs.len()).filter(|&i| keeps(model.inputs[i])).collect();
        for (latch, value) in model.latches.iter().zip(&constants) {
            if let Some(value) = value {
                map.insert(latch.lit.node(), Lit::FALSE.invert_if(*value));
            }
        }
        for &i in &latches {
            map.insert(model.latches[i].lit.node(), small.aig.leaf());
        }
        for &i in &inputs {
            let leaf = small.aig.leaf();
            small.inputs.push(leaf);
            map.insert(model.inputs[i].node(), leaf);
        }
        for node in (0..model.aig.len() as u32).filter(|&n| needed[n as usize]) {
            if let Gate::And(a, b) = model.aig.gate(node) {
                let gate = small.aig.and(through(&map, a), through(&map, b));
                map.insert(node, gate);
            }
        }
        for &i in &latches {
            let Latch { lit, next, initial } = model.latches[i];
            small.latches.push(Latch { lit: through(&map, lit), next: through(&map, next), initial });
        }
        small.constraints = model.constraints.iter().map(|&c| through(&map, c)).filter(|&c| c != Lit::TRUE).collect();
        small.bad = vec![through(&map, model.bad[property])];
        let constants = constants.iter().enumerate().filter_map(|(i, v)| v.map(|v| (i, v))).collect();
        Self { model: small, latches, inputs, constants, map }
    }

    /// What became of words of the old model; bits that are gone are constant.
    pub(crate) fn words(&self, words: &[Vec<Lit>]) -> Vec<Vec<Lit>> {
        let bit = |l: &Lit| self.map.get(&l.node()).map_or(Lit::FALSE, |m| m.invert_if(l.inverted()));
        let all = words.iter().map(|w| w.iter().map(bit).collect::<Vec<Lit>>());
        all.filter(|w| w.iter().any(|l| l.node() != 0)).collect()
    }

    /// The answer for the old model.
    pub(crate) fn lift(&self, model: &Model, answer: Answer) -> Answer {
        match answer {
            Answer::Proved(proof) => Answer::Proved(self.proof(model, proof)),
            Answer::Violated(trace) => Answer::Violated(self.trace(model, &trace)),
            other => other,
        }
    }

    fn proof(&self, model: &Model, proof: Proof) -> Proof {
        let (old, new) = (self.latches.len(), model.latches.len());
        let fact = |(f, v): Fact| (if f < old { self.latches[f] } else { f - old + new }, v);
        let mut clauses: Vec<Vec<Fact>> = proof.clauses.iter().map(|c| c.iter().map(|&f| fact(f)).collect()).collect();
        clauses.extend(self.constants.iter().map(|&c| vec![c]));
        clauses.iter_mut().for_each(|c| c.sort_unstable());
        clauses.sort();
        let gates = proof.gates.iter().map(|&(a, b)| (fact(a), fact(b))).collect();
        Proof { gates, clauses, ..proof }
    }

    fn trace(&self, model: &Model, trace: &Trace) -> Trace {
        let mut latches: Vec<bool> = model.latches.iter().map(|l| l.initial.unwrap_or_default()).collect();
        for (&old, &value) in self.latches.iter().zip(&trace.latches) {
            latches[old] = value;
        }
        let widen = |small: &Vec<bool>| {
            let mut inputs = vec![false; model.inputs.len()];
            for (&old, &value) in self.inputs.iter().zip(small) {
                inputs[old] = value;
            }
            inputs
        };
        Trace { latches, inputs: trace.inputs.iter().map(widen).collect() }
    }
}

fn through(map: &BTreeMap<u32, Lit>, lit: Lit) -> Lit {
    map.get(&lit.node()).copied().unwrap_or(Lit::FALSE).invert_if(lit.inverted())
}
