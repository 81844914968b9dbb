//! Runs that lead where random ones do not: to a cycle in which some literal is true.
//!
//! A table's later rows are reached by runs that keep to the earlier ones, and random inputs seldom do. Bounded model
//! checking finds such runs, and where it would have to look too deep, it goes on from where known runs have led: with one
//! state to begin with, most of what a block calculates is a number. What holds along such runs, and along runs like them,
//! is worth a guess.

use super::bmc::{Reply, Unrolled};
use super::engine::Budget;
use super::simulate::{Random, Simulator};
use crate::logic::aig::{Latch, Lit, Model, Trace};

/// Work for all that begin at the beginning, and for all that go on.
const TICKS: u64 = 10_000_000;
const FURTHER: u64 = 15_000_000;
/// Most cycles.
const DEPTH: usize = 32;
/// Most cycles beyond a known run, work for that, and after how many of them that lead nowhere to stop.
const STEP: usize = 14;
const STRIDE: u64 = 4_000_000;
const NOWHERE: usize = 6;
/// Most cycles for which inputs are held.
const RIDE: usize = 2_048;
/// How many more runs are looked for with other values of what is free.
const VARIANTS: usize = 3;
/// For how many cycles a target is to stay true, if it can.
const STAYS: [usize; 2] = [12, 4];

struct Search<'m> {
    model: &'m Model,
    unrolled: Unrolled,
    random: Random,
    left: u64,
    /// In how many cycles the constraints are required.
    constrained: usize,
}

/// A literal and a run in whose last cycle it is true.
type Found = (Lit, Trace);

/// Most guards.
const GUARDS: usize = 50;

/// Latches outside of words: states of an automaton, flags.
pub(crate) fn guards(model: &Model, words: &[Vec<Lit>]) -> Vec<Lit> {
    let words = words.iter().filter(|word| word.len() > 1);
    let inside: std::collections::BTreeSet<u32> = words.flatten().map(|l| l.node()).collect();
    let latches = model.latches.iter().map(|l| l.lit);
    latches.filter(|l| !inside.contains(&l.node())).take(GUARDS).collect()
}

/// Runs that end with one of `targets` true, and runs in which they stay true.
pub(crate) fn witnesses(model: &Model, targets: &[Lit], budget: &Budget) -> Vec<Trace> {
    let (mut open, mut found) = (targets.to_vec(), Vec::new());
    Search::new(model, TICKS).look(&mut open, &mut found, DEPTH, budget);
    let (mut runs, mut left, mut nowhere) = (Vec::new(), FURTHER, 0);
    while !found.is_empty() {
        // Of several runs to one target, from the first.
        let mut firsts: Vec<usize> = (0..found.len()).collect();
        firsts.dedup_by_key(|at| found[*at].0);
        let mut starts = Vec::new();
        for (target, run) in firsts.iter().map(|&at| &found[at]) {
            let longer = stay(model, *target, run, (&mut left, budget));
            starts.push(run.clone());
            starts.extend(longer.as_ref().and_then(|longer| ride(model, *target, longer)));
            runs.extend(longer);
        }
        runs.extend(found.drain(..).map(|(_, run)| run));
        runs.extend(starts.iter().filter(|run| run.inputs.len() > DEPTH + STEP).cloned());
        // The later ones first: they have come the furthest.
        while let Some(run) = starts.pop() {
            if left == 0 || nowhere == NOWHERE || open.is_empty() || !found.is_empty() {
                break;
            }
            nowhere += 1;
            left = left.saturating_sub(go_on(model, &run, &mut open, &mut found, left, budget));
        }
        nowhere = if found.is_empty() { nowhere } else { 0 };
    }
    runs
}

/// From a run on to what is open; how much work it took.
fn go_on(model: &Model, run: &Trace, open: &mut Vec<Lit>, found: &mut Vec<Found>, left: u64, budget: &Budget) -> u64 {
    let from = reached(model, run);
    let share = left.min(STRIDE);
    let mut search = Search::new(&from, share);
    let mut further = Vec::new();
    search.look(open, &mut further, STEP, budget);
    found.extend(further.into_iter().map(|(target, more)| (target, joined(run, more))));
    share.saturating_sub(search.left)
}

/// The run, and then some cycles in which `target`, which is true in its last one, stays true.
fn stay(model: &Model, target: Lit, run: &Trace, (left, budget): (&mut u64, &Budget)) -> Option<Trace> {
    let from = reached(model, run);
    let share = STRIDE.min(*left);
    let mut search = Search::new(&from, share);
    let more = STAYS.iter().find_map(|&stay| {
        search.constrain(stay);
        let mut goal = Lit::TRUE;
        for cycle in 0..=stay {
            let now = search.unrolled.graph.at(target, cycle);
            goal = search.unrolled.graph.aig.and(goal, now);
        }
        let yes = goal != Lit::FALSE && matches!(search.unrolled.ask(goal, &mut search.left, budget), Reply::Yes);
        yes.then(|| search.unrolled.trace(&from, stay))
    });
    *left = left.saturating_sub(share.saturating_sub(search.left));
    more.map(|more| joined(run, more))
}

/// The run, and then as many cycles more with the inputs of its last but one as `target` stays true; `None` where that has no
/// end.
fn ride(model: &Model, target: Lit, run: &Trace) -> Option<Trace> {
    let held = run.inputs.iter().nth_back(1)?.clone();
    let mut run = run.clone();
    *run.inputs.last_mut()? = held.clone();
    let from = reached(model, &run);
    let mut ride = Simulator::new(&from);
    let spread = |value: bool| if value { u64::MAX } else { 0 };
    ride.start(|index| spread(from.latches[index].initial == Some(true)));
    for cycles in 0..RIDE {
        ride.evaluate(|index| spread(held[index]));
        let goes_on = model.constraints.iter().all(|&held| ride.value(held) != 0) && ride.value(target) != 0;
        if !goes_on {
            let more = cycles.checked_sub(1)?;
            run.inputs.extend(std::iter::repeat_n(held, more));
            return Some(run);
        }
        ride.step();
    }
    None
}

/// The model, beginning with the state that the last cycle of the run begins with.
fn reached(model: &Model, run: &Trace) -> Model {
    let last = model.simulate(run).pop().map(|cycle| cycle.latches).unwrap_or_default();
    let latches = model.latches.iter().zip(last).map(|(latch, value)| Latch { initial: Some(value), ..*latch });
    Model { latches: latches.collect(), ..model.clone() }
}

/// The run with another one behind it that begins in its last cycle.
fn joined(run: &Trace, more: Trace) -> Trace {
    let before = &run.inputs[..run.inputs.len() - 1];
    Trace { latches: run.latches.clone(), inputs: [before, &more.inputs].concat() }
}

impl<'m> Search<'m> {
    fn new(model: &'m Model, left: u64) -> Self {
        Self { model, unrolled: Unrolled::new(model, true), random: Random::new(3), left, constrained: 0 }
    }

    /// Looks for runs to what is open, and takes what is reached off it.
    fn look(&mut self, open: &mut Vec<Lit>, found: &mut Vec<Found>, depth: usize, budget: &Budget) {
        for depth in 0..depth {
            if budget.exhausted_with(self.unrolled.bytes()).is_some() || open.is_empty() {
                return;
            }
            self.constrain(depth);
            let mut later = Vec::new();
            let mut all = std::mem::take(open).into_iter();
            while let Some(target) = all.next() {
                match self.reach(target, depth, budget) {
                    Some(traces) if traces.is_empty() => later.push(target),
                    Some(traces) => found.extend(traces.into_iter().map(|trace| (target, trace))),
                    None => {
                        later.push(target);
                        later.extend(all);
                        *open = later;
                        return;
                    }
                }
            }
            *open = later;
        }
    }

    fn constrain(&mut self, depth: usize) {
        while self.constrained <= depth {
            self.unrolled.constrain(self.model, self.constrained);
            self.constrained += 1;
        }
    }

    /// Runs in which `target` is true in the cycle; `None` where the work is used up.
    fn reach(&mut self, target: Lit, depth: usize, budget: &Budget) -> Option<Vec<Trace>> {
        let goal = self.unrolled.graph.at(target, depth);
        let mut traces = Vec::new();
        let is_free = self.model.latches.iter().any(|latch| latch.initial.is_none());
        for variant in 0..=if is_free { VARIANTS } else { 0 } {
            let wish = if variant == 0 { goal } else { self.wish(goal) };
            if wish == Lit::FALSE {
                break;
            }
            match self.unrolled.ask(wish, &mut self.left, budget) {
                Reply::Yes => traces.push(self.unrolled.trace(self.model, depth)),
                Reply::No if variant == 0 => break,
                Reply::No => {}
                Reply::Stopped(_) | Reply::Pause if variant == 0 => return None,
                Reply::Stopped(_) | Reply::Pause => break,
            }
        }
        Some(traces)
    }

    /// The goal, with random values for some of what is free in the first state.
    fn wish(&mut self, goal: Lit) -> Lit {
        let free: Vec<Lit> = self.model.latches.iter().filter(|l| l.initial.is_none()).map(|l| l.lit).collect();
        free.into_iter().fold(goal, |wish, lit| {
            let (chosen, value) = (self.random.next().is_multiple_of(8), self.random.next() & 1 == 1);
            let at = self.unrolled.graph.at(lit, 0);
            if chosen { self.unrolled.graph.aig.and(wish, at.invert_if(!value)) } else { wish }
        })
    }
}
