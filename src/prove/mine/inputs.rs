//! Inputs for random runs that keep to the constraints.
//!
//! Constraints of tables bind few inputs: that one of an enumeration's type has a declared value. Drawn bit by bit, such
//! inputs seldom fit, and the run ends. So the values of inputs that constraints speak of are taken from runs that are
//! known, all together, and only the others are drawn.

use super::super::problem::cone;
use super::super::simulate::Random;
use crate::logic::aig::{Model, Trace};

/// Most combinations that are kept.
const KEPT: usize = 64;

/// Draws inputs for 64 runs at once.
#[derive(Clone)]
pub(super) struct Inputs {
    /// Indices of inputs that no constraint speaks of, and of the others.
    free: Vec<usize>,
    bound: Vec<usize>,
    /// Values of the bound ones.
    known: Vec<Vec<bool>>,
}

impl Inputs {
    pub(super) fn new(model: &Model, traces: &[Trace]) -> Self {
        let spoken: std::collections::BTreeSet<u32> = cone(model, &model.constraints).into_iter().collect();
        let (bound, free) = (0..model.inputs.len()).partition(|&index| spoken.contains(&model.inputs[index].node()));
        let mut inputs = Self { free, bound, known: Vec::new() };
        traces.iter().flat_map(|trace| &trace.inputs).for_each(|values| inputs.learn(|index| values[index]));
        inputs
    }

    /// Keeps the values of what is bound, which are those of a run.
    pub(super) fn learn(&mut self, value: impl Fn(usize) -> bool) {
        let values: Vec<bool> = self.bound.iter().map(|&index| value(index)).collect();
        if self.known.len() < KEPT && !self.known.contains(&values) {
            self.known.push(values);
        }
    }

    /// Changes each free input of each run with a chance of one in `2^calm`, and all that is bound together with the same
    /// chance; only in the runs of `lanes`.
    pub(super) fn vary(&self, inputs: &mut [u64], calm: u32, lanes: u64, random: &mut Random) {
        let mut rare = || (0..calm).fold(lanes, |bits, _| bits & random.next());
        for &index in &self.free {
            inputs[index] ^= rare();
        }
        if self.known.is_empty() {
            self.bound.iter().for_each(|&index| inputs[index] ^= rare());
            return;
        }
        let changing = rare();
        let mut words = vec![0u64; self.bound.len()];
        for lane in (0..64).filter(|lane| changing >> lane & 1 == 1) {
            let chosen = &self.known[(random.next() % self.known.len() as u64) as usize];
            for (word, &value) in words.iter_mut().zip(chosen) {
                *word |= u64::from(value) << lane;
            }
        }
        for (&index, word) in self.bound.iter().zip(words) {
            inputs[index] = (inputs[index] & !changing) | word;
        }
    }
}
