//! Random runs, and what nodes and words were in them.

use super::super::engine::{Budget, Reason};
use super::super::simulate::{Random, Simulator};
use super::inputs::Inputs;
use crate::logic::aig::{Lit, Model, Trace};

/// Values in the cycles that were looked at.
pub(super) struct Samples {
    /// For each node, a word for each cycle: a bit for each of 64 runs; false outside of `valid`.
    nodes: Vec<Vec<u64>>,
    valid: Vec<u64>,
    /// Bytes that may still be recorded.
    room: usize,
    /// For each word, values of some runs in some cycles.
    pub(super) words: Vec<Vec<u64>>,
    /// For each guard, whether it was true there.
    pub(super) guards: Vec<Vec<bool>>,
}

/// What to look at.
#[derive(Clone, Copy, Default)]
pub(super) struct Wanted<'a> {
    pub(super) nodes: &'a [Lit],
    pub(super) words: &'a [Vec<Lit>],
    pub(super) guards: &'a [Lit],
}

/// Episodes: how many cycles, and how long inputs stay as they are, as the exponent of two of the mean; in an episode of
/// short length they change at every cycle.
const EPISODES: [(usize, u32); 10] =
    [(12, 1), (12, 3), (40, 1), (60, 4), (120, 5), (300, 6), (300, 4), (600, 7), (1200, 8), (1200, 10)];

/// Cycles behind the end of a run that is followed: its last inputs stay, so that what counts goes up to its bound. After
/// the first of them they stay exactly, until nothing changes any more.
const BEYOND: usize = 1_100;
const VARIED: usize = 64;

/// How many cycles at the beginning of a run, and around its end, are looked at each.
const FAR: usize = 48;
const NEAR: usize = 12;

/// What is known of runs: how to draw their inputs, and some that led somewhere.
pub(super) type Runs<'a> = (&'a Inputs, &'a [Trace]);

/// Bytes for what is recorded, so that it seldom depends on the memory that others leave.
const ROOM: usize = 256 << 20;

/// Runs whose words are kept.
const LANES: u32 = 8;

impl Samples {
    /// Of random runs, and of runs like `traces`, as many as fit into the room, and into a quarter of the budget's memory.
    ///
    /// # Errors
    /// If the budget ends before.
    pub(super) fn take(
        model: &Model,
        wanted: Wanted<'_>,
        (inputs, traces): Runs<'_>,
        budget: &Budget,
    ) -> Result<Self, Reason> {
        let mut samples = Self {
            nodes: vec![Vec::new(); wanted.nodes.len()],
            valid: Vec::new(),
            room: ROOM.min(budget.memory / 4),
            words: vec![Vec::new(); wanted.words.len()],
            guards: vec![Vec::new(); wanted.guards.len()],
        };
        let mut random = Random::new(1);
        for (cycles, calm) in EPISODES {
            samples.episode(model, wanted, (inputs, &mut random), (cycles, calm), budget);
        }
        for trace in traces {
            samples.follow(model, wanted, (inputs, &mut random), trace, budget);
        }
        budget.check().map(|()| samples)
    }

    fn episode(
        &mut self,
        model: &Model,
        wanted: Wanted<'_>,
        (choice, random): (&Inputs, &mut Random),
        (cycles, calm): (usize, u32),
        budget: &Budget,
    ) {
        let mut run = Simulator::new(model);
        let first: Vec<u64> = model
            .latches
            .iter()
            .map(|l| l.initial.map_or_else(|| random.next(), |v| if v { u64::MAX } else { 0 }))
            .collect();
        run.start(|index| first[index]);
        let mut inputs: Vec<u64> = model.inputs.iter().map(|_| random.next()).collect();
        choice.vary(&mut inputs, 0, u64::MAX, random);
        let mut alive = u64::MAX;
        for cycle in 0..cycles {
            if cycle > 0 {
                run.step();
            }
            let before = inputs.clone();
            choice.vary(&mut inputs, calm, u64::MAX, random);
            alive = constrained(model, &mut run, &mut inputs, &before, alive, random);
            if cycle < 64 || cycle % if wanted.nodes.is_empty() { 8 } else { 32 } == 0 {
                self.record(&run, wanted, alive);
            }
            if alive == 0 || budget.exhausted().is_some() {
                break;
            }
        }
    }

    /// Runs like `trace`, and a little further: one is the same, in the others some values differ.
    fn follow(
        &mut self,
        model: &Model,
        wanted: Wanted<'_>,
        (choice, random): (&Inputs, &mut Random),
        trace: &Trace,
        budget: &Budget,
    ) {
        let spread = |value: bool| if value { u64::MAX } else { 0 };
        let first: Vec<u64> = model
            .latches
            .iter()
            .zip(&trace.latches)
            .map(|(latch, &value)| match latch.initial {
                Some(value) => spread(value),
                None => spread(value) ^ (0..4).fold(!1, |bits, _| bits & random.next()),
            })
            .collect();
        let mut run = Simulator::new(model);
        run.start(|index| first[index]);
        let mut alive = u64::MAX;
        let last = trace.inputs.last().into_iter().cycle();
        for (cycle, inputs) in trace.inputs.iter().chain(last).take(trace.inputs.len() + BEYOND).enumerate() {
            let is_still = cycle > trace.inputs.len() + VARIED;
            if cycle > 0 && !run.step() && is_still {
                break;
            }
            let mut inputs: Vec<u64> = inputs.iter().map(|&value| spread(value)).collect();
            if !is_still {
                choice.vary(&mut inputs, 4, !1, random);
            }
            run.evaluate(|index| inputs[index]);
            alive = model.constraints.iter().fold(alive, |all, &c| all & run.value(c));
            let is_near = cycle < FAR || cycle + NEAR > trace.inputs.len() && cycle < trace.inputs.len() + NEAR;
            if is_near || cycle % if wanted.nodes.is_empty() { 4 } else { 32 } == 0 {
                self.record(&run, wanted, alive);
            }
            if alive & 1 == 0 || budget.exhausted().is_some() {
                break;
            }
        }
    }

    fn record(&mut self, run: &Simulator<'_>, wanted: Wanted<'_>, alive: u64) {
        let lanes = LANES as usize;
        let bytes = 8 * (1 + wanted.nodes.len() + lanes * wanted.words.len()) + lanes * wanted.guards.len();
        let Some(room) = self.room.checked_sub(bytes) else { return };
        self.room = room;
        self.valid.push(alive);
        for (values, &node) in self.nodes.iter_mut().zip(wanted.nodes) {
            values.push(run.value(node) & alive);
        }
        for lane in (0..64).step_by(64 / LANES as usize).filter(|lane| alive >> lane & 1 == 1) {
            for (values, word) in self.words.iter_mut().zip(wanted.words) {
                let bits = word.iter().take(64).enumerate();
                values.push(bits.map(|(i, &b)| (run.value(b) >> lane & 1) << i).sum());
            }
            for (values, &guard) in self.guards.iter_mut().zip(wanted.guards) {
                values.push(run.value(guard) >> lane & 1 == 1);
            }
        }
    }

    /// The values of a node, inverted if that makes the first one false; and whether it was.
    pub(super) fn normal(&self, index: usize) -> (bool, Vec<u64>) {
        let values = &self.nodes[index];
        let first = self.valid.iter().zip(values).find(|(valid, _)| **valid != 0);
        let flipped = first.is_some_and(|(valid, value)| value >> valid.trailing_zeros() & 1 == 1);
        let normal = self.valid.iter().zip(values).map(|(&m, &v)| if flipped { !v & m } else { v }).collect();
        (flipped, normal)
    }

    /// Whether two literals over sorted `nodes` were true together.
    pub(super) fn both(&self, nodes: &[Lit], a: Lit, b: Lit) -> bool {
        let find = |l: Lit| nodes.binary_search(&Lit::of(l.node())).ok();
        let (Some(i), Some(j)) = (find(a), find(b)) else { return true };
        self.valid.iter().enumerate().any(|(at, &valid)| {
            let of = |values: &[u64], l: Lit| if l.inverted() { !values[at] } else { values[at] };
            of(&self.nodes[i], a) & of(&self.nodes[j], b) & valid != 0
        })
    }
}

/// Evaluates the cycle; where a constraint fails, tries other inputs a few times. The runs in which all constraints hold.
fn constrained(
    model: &Model,
    run: &mut Simulator<'_>,
    inputs: &mut [u64],
    before: &[u64],
    alive: u64,
    random: &mut Random,
) -> u64 {
    let tries = if model.constraints.is_empty() { 1 } else { 8 };
    let mut holding = 0;
    for attempt in 0..tries {
        run.evaluate(|index| inputs[index]);
        holding = model.constraints.iter().fold(alive, |all, &c| all & run.value(c));
        if holding == alive || attempt + 1 == tries {
            break;
        }
        for (input, &before) in inputs.iter_mut().zip(before) {
            let fresh = match attempt % 3 {
                0 => before,
                1 => random.next(),
                _ => random.next() & random.next(),
            };
            *input = (*input & holding) | (fresh & !holding);
        }
    }
    holding
}
