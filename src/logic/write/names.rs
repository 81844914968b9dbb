//! Names of the parts of a model, for the symbol table of an AIGER file.

use crate::logic::blast::{Blasted, LatchBit};
use crate::logic::system::{Labelled, System};

/// Names, by the order of the model's lists; what is missing has none.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Names {
    /// Of the inputs.
    pub inputs: Vec<String>,
    /// Of the latches.
    pub latches: Vec<String>,
    /// Of what is bad.
    pub bad: Vec<String>,
    /// Of the constraints.
    pub constraints: Vec<String>,
}

impl Names {
    /// The names of a system in a model that was blasted from it: that of a word with the bit behind it.
    #[must_use]
    pub fn of(system: &System, blasted: &Blasted) -> Self {
        let bits = |name: &str, width: usize| -> Vec<String> {
            if width == 1 { vec![name.to_owned()] } else { (0..width).map(|bit| format!("{name}[{bit}]")).collect() }
        };
        let labels = |list: &[Labelled]| list.iter().map(|own| own.name.clone()).collect();
        let inputs = system.inputs.iter().zip(&blasted.inputs).flat_map(|(input, word)| bits(&input.name, word.len()));
        let latches = blasted.latches.iter().map(|latch| match latch {
            LatchBit::State { state, bit } => {
                let state = *state as usize;
                bits(&system.states[state].name, blasted.states[state].len()).swap_remove(*bit as usize)
            }
            LatchBit::First => "first cycle".to_owned(),
        });
        Self {
            inputs: inputs.collect(),
            latches: latches.collect(),
            bad: labels(&system.obligations),
            constraints: labels(&system.constraints),
        }
    }
}

/// A name without whitespace, which ends a symbol in BTOR2, and for some readers of AIGER too.
pub(super) fn symbol(name: &str) -> String {
    name.split_whitespace().collect::<Vec<_>>().join("_")
}
