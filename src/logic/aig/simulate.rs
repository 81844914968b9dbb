//! Graphs on values: 64 at once, a bit of a word each; and models, run cycle by cycle.

use super::{Aig, Gate, Lit, Model};

/// A run of a model: what it is free to choose.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    /// The first value of each latch; those of latches with an initial value are ignored.
    pub latches: Vec<bool>,
    /// The inputs in each cycle.
    pub inputs: Vec<Vec<bool>>,
}

/// What a model does in a cycle.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct BitSnapshot {
    /// The latches, as the cycle finds them.
    pub latches: Vec<bool>,
    /// Whether all constraints hold in this cycle.
    pub constrained: bool,
    /// What is bad.
    pub bad: Vec<bool>,
}

impl Aig {
    /// Sets the words of all conjunctions from those of the leaves; `words` has one for each node.
    pub fn propagate(&self, words: &mut [u64]) {
        words[0] = 0;
        for (node, gate) in self.gates.iter().enumerate() {
            if let Gate::And(a, b) = gate {
                words[node] = word(words, *a) & word(words, *b);
            }
        }
    }
}

/// The word of a literal, by those of the nodes.
#[must_use]
pub fn word(words: &[u64], lit: Lit) -> u64 {
    words[lit.node() as usize] ^ 0_u64.wrapping_sub(u64::from(lit.inverted()))
}

impl Model {
    /// Runs for as many cycles as `trace` has inputs. What the trace does not say is false.
    #[must_use]
    pub fn simulate(&self, trace: &Trace) -> Vec<BitSnapshot> {
        let at = |values: &[bool], index: usize| values.get(index).copied().unwrap_or_default();
        let first = self.latches.iter().enumerate();
        let mut latches: Vec<bool> =
            first.map(|(index, latch)| latch.initial.unwrap_or_else(|| at(&trace.latches, index))).collect();
        let mut words = vec![0; self.aig.len()];
        let mut run = Vec::with_capacity(trace.inputs.len());
        for inputs in &trace.inputs {
            for (index, lit) in self.inputs.iter().enumerate() {
                words[lit.node() as usize] = u64::from(at(inputs, index));
            }
            for (latch, value) in self.latches.iter().zip(&latches) {
                words[latch.lit.node() as usize] = u64::from(*value);
            }
            self.aig.propagate(&mut words);
            let value = |lit: &Lit| word(&words, *lit) & 1 == 1;
            let next = self.latches.iter().map(|latch| value(&latch.next)).collect();
            let constrained = self.constraints.iter().all(value);
            let bad = self.bad.iter().map(value).collect();
            run.push(BitSnapshot { latches: std::mem::replace(&mut latches, next), constrained, bad });
        }
        run
    }
}

/// Random words, the same ones each time: xorshift64* (Vigna, *An Experimental Exploration of Marsaglia's xorshift
/// Generators, Scrambled*, 2016).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Default for Random {
    fn default() -> Self {
        Self(0x9e37_79b9_7f4a_7c15)
    }
}

impl Random {
    /// The next word.
    pub fn word(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }
}
