//! Runs that lead where random ones do not: to a state in which a literal over latches is true.
//!
//! A table's later rows are reached by runs that keep to the earlier ones, and random inputs seldom do. Bounded model
//! checking finds such runs; what holds along them, and along runs like them, is worth a guess.

use super::super::bmc::{Reply, Unrolled};
use super::super::engine::Budget;
use super::super::simulate::Random;
use crate::logic::aig::{Lit, Model, Trace};

/// Work for all of them.
const TICKS: u64 = 60_000_000;
/// Most cycles.
const DEPTH: usize = 32;
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

/// Runs that end with one of `targets` true.
pub(super) fn witnesses(model: &Model, targets: &[Lit], budget: &Budget) -> Vec<Trace> {
    let unrolled = Unrolled::new(model, true);
    let mut search = Search { model, unrolled, random: Random::new(3), left: TICKS, constrained: 0 };
    let (mut open, mut found) = (targets.to_vec(), Vec::new());
    for depth in 0..DEPTH {
        if budget.exhausted_with(search.unrolled.bytes()).is_some() {
            break;
        }
        search.constrain(depth);
        let mut later = Vec::new();
        for target in std::mem::take(&mut open) {
            match search.reach(target, depth, budget) {
                Some(traces) if traces.is_empty() => later.push(target),
                Some(traces) => found.extend(traces),
                None => return found,
            }
        }
        open = later;
        if open.is_empty() {
            break;
        }
    }
    found
}

impl Search<'_> {
    fn constrain(&mut self, depth: usize) {
        while self.constrained <= depth {
            for &constraint in &self.model.constraints {
                let holds = self.unrolled.graph.at(constraint, self.constrained);
                self.unrolled.require(&[holds]);
            }
            self.constrained += 1;
        }
    }

    /// A run in which `target` stays true for some cycles behind this one.
    fn staying(&mut self, target: Lit, depth: usize, budget: &Budget) -> Option<Trace> {
        for stay in STAYS {
            self.constrain(depth + stay);
            let mut goal = Lit::TRUE;
            for cycle in depth..=depth + stay {
                let now = self.unrolled.graph.at(target, cycle);
                goal = self.unrolled.graph.aig.and(goal, now);
            }
            if goal != Lit::FALSE && matches!(self.unrolled.ask(goal, &mut self.left, budget), Reply::Yes) {
                return Some(self.unrolled.trace(self.model, depth + stay));
            }
        }
        None
    }

    /// Runs in which `target` is true in the cycle; `None` where the work is used up.
    fn reach(&mut self, target: Lit, depth: usize, budget: &Budget) -> Option<Vec<Trace>> {
        let goal = self.unrolled.graph.at(target, depth);
        let mut traces = Vec::new();
        for variant in 0..=VARIANTS {
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
        if !traces.is_empty() {
            traces.extend(self.staying(target, depth, budget));
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
