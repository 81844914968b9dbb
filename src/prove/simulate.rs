//! Running a model on values: 64 runs at once, one in each bit of a word.

use crate::logic::aig::{Lit, Model, Trace, word};

/// The values of every node in one cycle of 64 runs.
pub(crate) struct Simulator<'m> {
    model: &'m Model,
    values: Vec<u64>,
}

impl<'m> Simulator<'m> {
    pub(crate) fn new(model: &'m Model) -> Self {
        Self { model, values: vec![0; model.aig.len()] }
    }

    /// Sets the latches; `false` for those that it has no value for.
    pub(crate) fn start(&mut self, first: impl Fn(usize) -> u64) {
        for (index, latch) in self.model.latches.iter().enumerate() {
            self.values[latch.lit.node() as usize] = first(index);
        }
    }

    /// Sets the inputs and computes every gate.
    pub(crate) fn evaluate(&mut self, input: impl Fn(usize) -> u64) {
        for (index, lit) in self.model.inputs.iter().enumerate() {
            self.values[lit.node() as usize] = input(index);
        }
        self.model.aig.propagate(&mut self.values);
    }

    /// Puts the next values into the latches; whether one changes.
    pub(crate) fn step(&mut self) -> bool {
        let next: Vec<u64> = self.model.latches.iter().map(|l| self.value(l.next)).collect();
        let changes = self.model.latches.iter().zip(&next).any(|(latch, &next)| self.value(latch.lit) != next);
        self.start(|index| next[index]);
        changes
    }

    pub(crate) fn value(&self, lit: Lit) -> u64 {
        word(&self.values, lit)
    }
}

/// Whether the trace is a run of the model, and bad in its last cycle.
#[must_use]
pub fn is_violation(model: &Model, property: usize, trace: &Trace) -> bool {
    let fits = trace.latches.len() == model.latches.len()
        && trace.inputs.iter().all(|i| i.len() == model.inputs.len())
        && model.latches.iter().zip(&trace.latches).all(|(l, &v)| l.initial.is_none_or(|i| i == v));
    let run = model.simulate(trace);
    fits && run.iter().all(|s| s.constrained) && run.last().is_some_and(|s| s.bad[property])
}

/// Pseudo-random numbers (xorshift, Marsaglia 2003): the same ones each time.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub(crate) fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D)
    }
}
