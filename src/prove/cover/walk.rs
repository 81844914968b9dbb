//! Random runs that stay within the table: 64 at once, and where one leaves the table, another one takes its place.
//!
//! In each cycle the inputs mostly stay as they are, since rows last; else single inputs change, to values that the program or
//! the table names or to any. A run that leaves the table, or breaks a constraint, is replaced by a copy of one that does
//! not, so that long tables are not only seen at their beginning (*importance splitting*: Kahn and Harris 1951; for testing,
//! Godefroid and Khurshid, *Exploring very large state spaces using genetic algorithms*, TACAS 2002).

use std::collections::BTreeMap;

use super::super::decide::Choice;
use super::super::simulate::{Random, Simulator};
use super::Question;
use super::frontier::Frontier;
use crate::logic::aig::{Lit, Trace};
use crate::logic::blast::Blasted;
use crate::logic::simulate::Stimulus;

/// How many runs there are at once.
const LANES: usize = 64;
/// How often other inputs are tried where no run stays within the table.
const TRIES: usize = 12;
/// How long random runs go on from the end of a run that is followed.
const BEHIND: usize = 300;
/// So many values of inputs are remembered.
const MEMORY: usize = 6_000_000;
/// No step before this one.
const NOTHING: u32 = u32::MAX;

/// A cycle of a run, and the one before it.
struct Step {
    before: u32,
    inputs: Vec<u64>,
}

/// Where the runs are.
struct Lanes {
    /// The latches, a bit for each run.
    states: Vec<u64>,
    /// The latches before the first cycle.
    first: Vec<u64>,
    /// For each run its last step.
    at: [u32; LANES],
    /// The inputs, word by word, run by run.
    values: Vec<[u64; LANES]>,
}

/// Random runs of a model.
pub(super) struct Walker<'m> {
    question: &'m Question,
    blasted: &'m Blasted,
    simulator: Simulator<'m>,
    random: Random,
    steps: Vec<Step>,
    /// The constants of the terms, by width.
    named: BTreeMap<u32, Vec<u64>>,
    covered: Lit,
    /// How many gates may be evaluated on runs from the beginning, and how many on those from further on; what is left.
    work: u64,
    left: u64,
}

impl<'m> Walker<'m> {
    /// `blasted` has the targets as its bad literals, and as its only output whether the run is covered.
    pub(super) fn new(question: &'m Question, blasted: &'m Blasted, work: u64) -> Self {
        let mut named: BTreeMap<u32, Vec<u64>> = BTreeMap::new();
        for (width, value) in question.system.pool.constants() {
            named.entry(width).or_default().push(value);
        }
        let covered = blasted.outputs.first().and_then(|bits| bits.first()).copied().unwrap_or(Lit::FALSE);
        let simulator = Simulator::new(&blasted.model);
        Self {
            question,
            blasted,
            simulator,
            random: Random::new(7),
            steps: Vec::new(),
            named,
            covered,
            work,
            left: work,
        }
    }

    /// Runs from the beginning, of growing lengths.
    pub(super) fn explore(&mut self, frontier: &mut Frontier) {
        self.wander(frontier);
        self.left = self.work;
    }

    fn wander(&mut self, frontier: &mut Frontier) {
        for (times, cycles) in [(8, 12), (8, 40), (4, 150), (2, 600), (2, 2_500)] {
            for _ in 0..times {
                if frontier.is_done() || self.left == 0 {
                    return;
                }
                self.steps.clear();
                let lanes = self.begin();
                // Runs are remembered whole: with many inputs, fewer cycles.
                let cycles = cycles.min(MEMORY / (LANES * lanes.values.len().max(1)));
                self.go_on(lanes, cycles, frontier);
            }
        }
    }

    /// Follows a run as it is kept, and notes what it reaches.
    pub(super) fn repeat(&mut self, run: &Choice, frontier: &mut Frontier) {
        let system = &self.question.system;
        let mut free = vec![0; system.states.len()];
        for (state, value) in self.question.globals.iter().zip(&run.globals) {
            free[*state] = *value;
        }
        let stimulus = Stimulus { free, inputs: run.inputs.clone() };
        self.go_along(&self.blasted.trace(system, &stimulus), frontier);
    }

    /// Follows a run, notes what it reaches, and goes on from its end.
    pub(super) fn follow(&mut self, trace: &Trace, frontier: &mut Frontier) {
        let lanes = self.go_along(trace, frontier);
        self.go_on(lanes, BEHIND, frontier);
    }

    /// Follows a run as far as the constraints hold, and notes what it reaches; where it ends.
    fn go_along(&mut self, trace: &Trace, frontier: &mut Frontier) -> Lanes {
        let model = &self.blasted.model;
        self.steps.clear();
        let all = |value: bool| if value { u64::MAX } else { 0 };
        let mut states: Vec<u64> = model
            .latches
            .iter()
            .enumerate()
            .map(|(at, latch)| all(latch.initial.unwrap_or_else(|| trace.latches.get(at) == Some(&true))))
            .collect();
        let first = states.clone();
        let run = self.blasted.stimulus(trace);
        let (mut at, mut hits) = (NOTHING, Vec::new());
        for (cycle, bits) in trace.inputs.iter().enumerate() {
            self.simulator.start(|latch| states[latch]);
            self.simulator.evaluate(|input| all(bits.get(input) == Some(&true)));
            if model.constraints.iter().any(|constraint| self.simulator.value(*constraint) & 1 == 0) {
                break;
            }
            let found = (0..model.bad.len()).filter(|target| self.simulator.value(model.bad[*target]) & 1 == 1);
            hits.extend(found.map(|target| (target, cycle)));
            states = model.latches.iter().map(|latch| self.simulator.value(latch.next)).collect();
            at = self.step(at, run.inputs[cycle].clone());
        }
        let globals = self.globals(&first, 0);
        frontier.add(Choice { globals, inputs: run.inputs.clone() }, &hits);
        let values = run.inputs.last().into_iter().flatten().map(|value| [*value; LANES]).collect();
        Lanes { states, first, at: [at; LANES], values }
    }

    fn step(&mut self, before: u32, inputs: Vec<u64>) -> u32 {
        self.steps.push(Step { before, inputs });
        u32::try_from(self.steps.len() - 1).unwrap_or(NOTHING)
    }

    /// A value of a word.
    fn value(&mut self, width: usize) -> u64 {
        let width = u32::try_from(width).unwrap_or(64);
        let random = self.random.next();
        let named = self.named.get(&width).map_or(&[][..], Vec::as_slice);
        let value = match random >> 61 {
            0..=3 if !named.is_empty() => named[(random as usize >> 8) % named.len()],
            4 => 0,
            5 => (random >> 8) & 0xF,
            _ => random.rotate_left(17),
        };
        value & crate::logic::term::mask(width)
    }

    /// Runs before their first cycle.
    fn begin(&mut self) -> Lanes {
        let mut states = Vec::with_capacity(self.blasted.model.latches.len());
        for word in &self.blasted.states {
            let values: Vec<u64> = (0..LANES).map(|_| self.value(word.len())).collect();
            states.extend((0..word.len()).map(|bit| packed(&values, bit)));
        }
        let latches = &self.blasted.model.latches;
        states.resize(latches.len(), 0);
        for (state, latch) in states.iter_mut().zip(latches) {
            if let Some(value) = latch.initial {
                *state = if value { u64::MAX } else { 0 };
            }
        }
        let widths: Vec<usize> = self.blasted.inputs.iter().map(Vec::len).collect();
        let values = widths.into_iter().map(|width| std::array::from_fn(|_| self.value(width))).collect();
        Lanes { first: states.clone(), states, at: [NOTHING; LANES], values }
    }

    /// Changes the inputs of each run: not at all, one of them, or several.
    fn propose(&mut self, values: &mut [[u64; LANES]], hold: bool) {
        for lane in 0..LANES {
            let how = self.random.next();
            if (hold && how & 7 > 2) || values.is_empty() {
                continue;
            }
            if how & 8 == 0 {
                let word = (how as usize >> 8) % values.len();
                values[word][lane] = self.value(self.blasted.inputs[word].len());
                continue;
            }
            for (word, value) in values.iter_mut().enumerate() {
                if self.random.next() & 1 == 0 {
                    value[lane] = self.value(self.blasted.inputs[word].len());
                }
            }
        }
    }

    /// Evaluates a cycle; which runs stay within the table.
    fn evaluate(&mut self, lanes: &Lanes, values: &[[u64; LANES]]) -> u64 {
        let mut bits = Vec::with_capacity(self.blasted.model.inputs.len());
        for (word, values) in self.blasted.inputs.iter().zip(values) {
            bits.extend((0..word.len()).map(|bit| packed(values, bit)));
        }
        self.simulator.start(|latch| lanes.states[latch]);
        self.simulator.evaluate(|input| bits[input]);
        self.left = self.left.saturating_sub(self.blasted.model.aig.len() as u64);
        let constraints = self.blasted.model.constraints.iter().fold(u64::MAX, |all, c| all & self.simulator.value(*c));
        constraints & self.simulator.value(self.covered)
    }

    /// Goes on from where the runs are, for so many cycles at most.
    fn go_on(&mut self, mut lanes: Lanes, cycles: usize, frontier: &mut Frontier) {
        for _ in 0..cycles {
            let mut alive = 0;
            let mut values = lanes.values.clone();
            for attempt in 0..TRIES {
                values.clone_from(&lanes.values);
                self.propose(&mut values, attempt < TRIES / 2);
                alive = self.evaluate(&lanes, &values);
                if alive != 0 || self.left == 0 {
                    break;
                }
            }
            if alive == 0 {
                return;
            }
            lanes.values = values;
            for lane in (0..LANES).filter(|lane| alive >> lane & 1 == 1) {
                let inputs = lanes.values.iter().map(|word| word[lane]).collect();
                lanes.at[lane] = self.step(lanes.at[lane], inputs);
            }
            let new = self.note(&lanes, alive, frontier);
            if frontier.is_done() || self.left == 0 {
                return;
            }
            lanes.states = self.blasted.model.latches.iter().map(|latch| self.simulator.value(latch.next)).collect();
            self.replace(&mut lanes, alive, new);
        }
    }

    /// Notes what is reached for the first time; which runs did.
    fn note(&self, lanes: &Lanes, alive: u64, frontier: &mut Frontier) -> u64 {
        let mut found: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for target in frontier.open() {
            let there = self.simulator.value(self.blasted.model.bad[target]) & alive;
            if there != 0 {
                found.entry(there.trailing_zeros()).or_default().push(target);
            }
        }
        let mut new = 0;
        for (lane, targets) in found {
            new |= 1 << lane;
            let run = self.run(lanes, lane as usize);
            let cycle = run.inputs.len() - 1;
            let hits: Vec<(usize, usize)> = targets.into_iter().map(|target| (target, cycle)).collect();
            frontier.add(run, &hits);
        }
        new
    }

    /// Puts copies in the places of runs that are over; rather of those that found something.
    fn replace(&mut self, lanes: &mut Lanes, alive: u64, new: u64) {
        let keep = if new == 0 { alive } else { alive & (new | 0x5555_5555_5555_5555) };
        let models: Vec<usize> =
            (0..LANES).filter(|lane| (if new == 0 { alive } else { new }) >> lane & 1 == 1).collect();
        for lane in (0..LANES).filter(|lane| keep >> lane & 1 == 0) {
            let from = models[(self.random.next() >> 8) as usize % models.len()];
            for word in lanes.states.iter_mut().chain(&mut lanes.first) {
                *word = *word & !(1 << lane) | (*word >> from & 1) << lane;
            }
            for word in &mut lanes.values {
                word[lane] = word[from];
            }
            lanes.at[lane] = lanes.at[from];
        }
    }

    fn run(&self, lanes: &Lanes, lane: usize) -> Choice {
        let mut inputs = Vec::new();
        let mut at = lanes.at[lane];
        while let Some(step) = self.steps.get(at as usize) {
            inputs.push(step.inputs.clone());
            at = step.before;
        }
        inputs.reverse();
        Choice { globals: self.globals(&lanes.first, lane), inputs }
    }

    /// The values of the table's global variables in a run.
    fn globals(&self, first: &[u64], lane: usize) -> Vec<u64> {
        let widths = self.blasted.states.iter().map(Vec::len);
        let starts: Vec<usize> = widths
            .scan(0, |next, width| {
                let start = *next;
                *next += width;
                Some(start)
            })
            .collect();
        let value = |state: &usize| {
            let bits = self.blasted.states[*state].iter().enumerate();
            bits.map(|(bit, _)| (first[starts[*state] + bit] >> lane & 1) << bit).sum()
        };
        self.question.globals.iter().map(value).collect()
    }
}

/// One bit of each of the values, as a word.
fn packed(values: &[u64], bit: usize) -> u64 {
    values.iter().enumerate().fold(0, |word, (lane, value)| word | (value >> bit & 1) << lane)
}
