//! Random small models.

use rungbook::logic::aig::{Latch, Lit, Model};

/// Pseudo-random numbers (SplitMix64).
pub(crate) struct Dice(pub(crate) u64);

impl Dice {
    pub(crate) fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % bound as u64) as usize
    }
}

/// A model of at most `latches` latches and four inputs.
pub(crate) fn model(seed: u64, latches: usize) -> Model {
    let mut dice = Dice(seed);
    let mut model = Model::default();
    let mut known = vec![Lit::TRUE];
    let latches: Vec<Lit> = (0..1 + dice.below(latches)).map(|_| model.aig.leaf()).collect();
    model.inputs = (0..dice.below(5)).map(|_| model.aig.leaf()).collect();
    known.extend(&latches);
    known.extend(&model.inputs);
    for _ in 0..dice.below(30) + 4 {
        let mut any = || known[dice.below(known.len())].invert_if(dice.below(2) == 0);
        let (a, b, c) = (any(), any(), any());
        let gate = match dice.below(4) {
            0 | 1 => model.aig.and(a, b),
            2 => model.aig.xor(a, b),
            _ => model.aig.ite(a, b, c),
        };
        known.push(gate);
    }
    let late = |dice: &mut Dice| known[known.len() - 1 - dice.below(known.len() * 2 / 3)].invert_if(dice.below(2) == 0);
    for lit in latches {
        let next = late(&mut dice);
        let next = if dice.below(12) == 0 { lit } else { next };
        let initial = [Some(false), Some(false), Some(true), None][dice.below(4)];
        model.latches.push(Latch { lit, next, initial });
    }
    for _ in 0..dice.below(3).saturating_sub(1) {
        let (a, b) = (late(&mut dice), late(&mut dice));
        let either = model.aig.or(a, b);
        model.constraints.push(either);
    }
    let mut bad = late(&mut dice);
    for _ in 0..dice.below(4) {
        let other = late(&mut dice);
        bad = model.aig.and(bad, other);
    }
    model.bad = vec![bad];
    model
}
