//! Bit-blasting: a system over bit-vectors becomes a model over an and-inverter graph, with the way back.
//!
//! *Initial values.* A constant gives its bits to the latches. One that depends on earlier state variables is evaluated with
//! their initial values put in. What then still depends on a free first value is not a constant: its latch gets no initial
//! value, and a latch of the blaster's own, [`LatchBit::First`], true in the first cycle alone, conditions a constraint that
//! says what it is. A certificate speaks only of state variables; [`Blasted::project`] brings clauses back to them.

mod float;
mod project;
mod term;
#[cfg(test)]
mod tests;
mod word;

use super::aig::{Latch, Lit, Model, Trace};
use super::certificate::StateBit;
use super::simulate::Stimulus;
use super::system::{Labelled, System};
use super::term::Term;
pub use term::Blaster;

/// What a latch stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum LatchBit {
    /// A bit of a state variable.
    State {
        /// The index of the state variable in the system.
        state: u32,
        /// The number of the bit, from the least significant one.
        bit: u32,
    },
    /// True in the first cycle alone.
    First,
}

/// A blasted system.
#[derive(Clone, Debug, Default)]
pub struct Blasted {
    /// The model; its bad literals are the complements of the obligations, in their order, its constraints begin with the
    /// system's.
    pub model: Model,
    /// For each state variable its latches' literals, from the least significant bit on.
    pub states: Vec<Vec<Lit>>,
    /// For each input its literals.
    pub inputs: Vec<Vec<Lit>>,
    /// For each output its literals.
    pub outputs: Vec<Vec<Lit>>,
    /// For each latch of the model, what it stands for.
    pub latches: Vec<LatchBit>,
}

impl Blasted {
    /// The latch that is true in the first cycle alone, if there is one: always the last.
    #[must_use]
    pub fn first(&self) -> Option<usize> {
        self.latches.iter().position(|bit| *bit == LatchBit::First)
    }

    /// A run of the model as one of the system.
    #[must_use]
    pub fn stimulus(&self, trace: &Trace) -> Stimulus {
        let mut latches = trace.latches.iter().copied();
        let free = self.states.iter().map(|bits| packed(bits.len(), &mut latches)).collect();
        let inputs = trace.inputs.iter().map(|cycle| {
            let mut bits = cycle.iter().copied();
            self.inputs.iter().map(|own| packed(own.len(), &mut bits)).collect()
        });
        Stimulus { free, inputs: inputs.collect() }
    }

    /// A run of the system as one of the model.
    #[must_use]
    pub fn trace(&self, system: &System, stimulus: &Stimulus) -> Trace {
        let bits = |value: u64, width: usize| (0..width).map(move |bit| value >> bit & 1 == 1);
        let first = system.first_values(&stimulus.free);
        let latches = self.states.iter().zip(first).flat_map(|(own, value)| bits(value, own.len())).collect();
        let inputs = stimulus.inputs.iter().map(|cycle| {
            let values = cycle.iter().copied().chain(std::iter::repeat(0));
            self.inputs.iter().zip(values).flat_map(|(own, value)| bits(value, own.len())).collect()
        });
        Trace { latches, inputs: inputs.collect() }
    }

    /// The state bits of a literal of the model's latches, by the latch's index; `None` for [`LatchBit::First`].
    #[must_use]
    pub fn state_bit(&self, latch: usize, value: bool) -> Option<StateBit> {
        match self.latches[latch] {
            LatchBit::State { state, bit } => Some(StateBit { state, bit, value }),
            LatchBit::First => None,
        }
    }
}

fn packed(width: usize, bits: &mut impl Iterator<Item = bool>) -> u64 {
    (0..width).fold(0, |value, bit| value | u64::from(bits.next().unwrap_or_default()) << bit)
}

/// Blasts a system.
#[must_use]
pub fn blast(system: &System) -> Blasted {
    let mut out = Blasted::default();
    let mut blaster = Blaster::new(&system.pool);
    for input in &system.inputs {
        let word = blaster.fresh(input.variable);
        out.model.inputs.extend(&word);
        out.inputs.push(word);
    }
    for (index, state) in (0..).zip(&system.states) {
        let word = blaster.fresh(state.variable);
        let bits = (0..u32::try_from(word.len()).unwrap_or(64)).map(|bit| LatchBit::State { state: index, bit });
        out.latches.extend(bits);
        out.states.push(word);
    }
    let roots = [&system.constraints, &system.obligations, &system.outputs].into_iter().flatten();
    let nexts = system.states.iter().map(|state| state.next);
    blaster.blast(roots.map(|labelled| labelled.term).chain(nexts));
    let bits = |list: &[Labelled]| list.iter().map(|own| blaster.word(own.term)[0]).collect::<Vec<Lit>>();
    out.model.constraints = bits(&system.constraints);
    out.model.bad = bits(&system.obligations).into_iter().map(|lit| !lit).collect();
    out.outputs = system.outputs.iter().map(|own| blaster.word(own.term).to_vec()).collect();
    for (state, word) in system.states.iter().zip(&out.states) {
        let latches = word.iter().zip(blaster.word(state.next));
        out.model.latches.extend(latches.map(|(lit, next)| Latch { lit: *lit, next: *next, initial: None }));
    }
    out.model.aig = blaster.finish();
    initialize(system, &mut out);
    out
}

/// Gives the latches their first values; see the head of the file.
fn initialize(system: &System, out: &mut Blasted) {
    let initials: Vec<Option<Term>> = system.states.iter().map(|state| state.initial).collect();
    let mut blaster = Blaster::with(&system.pool, std::mem::take(&mut out.model.aig));
    let (mut latch, mut conditions) = (0, Vec::new());
    for ((state, initial), word) in system.states.iter().zip(initials).zip(&out.states) {
        let first = match initial {
            Some(term) => {
                blaster.blast([term]);
                blaster.word(term).to_vec()
            }
            None => word.clone(),
        };
        for (own, value) in word.iter().zip(&first) {
            match *value {
                Lit::FALSE | Lit::TRUE => out.model.latches[latch].initial = Some(*value == Lit::TRUE),
                value if value == *own => {}
                value => conditions.push((*own, value)),
            }
            latch += 1;
        }
        blaster.bind(state.variable, first);
    }
    out.model.aig = blaster.finish();
    if conditions.is_empty() {
        return;
    }
    let first = out.model.aig.leaf();
    out.latches.push(LatchBit::First);
    out.model.latches.push(Latch { lit: first, next: Lit::FALSE, initial: Some(true) });
    for (own, value) in conditions {
        let differ = out.model.aig.xor(own, value);
        let wrong = out.model.aig.and(first, differ);
        out.model.constraints.push(!wrong);
    }
}
