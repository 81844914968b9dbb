//! All engines on one property.
//!
//! They take turns by a plan that is counted in work and not in time: induction (which searches for violations on the side),
//! IC3 and interpolation in turns that are short at first and grow; for a large model a longer one of interpolation; mining;
//! then, in turns that grow, induction and IC3 with what was mined, and interpolation and IC3 as they stand. Two threads take
//! the same turns as one, the second one ahead of the plan, and the answer of the earliest turn counts. So the same model gets
//! the same answer with the same evidence, whoever takes part.

mod board;
mod plan;

use super::engine::{Answer, Budget, Engine, Hints, Progress, Reason};
use super::reduce::Reduced;
use super::simulate::is_violation;
use crate::logic::aig::{Model, Trace};
use board::Board;

/// What to do.
#[derive(Clone, Debug)]
pub struct Options {
    /// How many threads, at most two of which are of use.
    pub threads: usize,
    /// What is known of the model.
    pub hints: Hints,
}

impl Default for Options {
    fn default() -> Self {
        Self { threads: 1, hints: Hints::default() }
    }
}

/// An answer, and who gave it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// The answer.
    pub answer: Answer,
    /// The engine.
    pub engine: &'static str,
    /// Runs that mining found where it was done, to states that are seldom reached; they do not bear on the answer.
    pub runs: Vec<Trace>,
}

/// Somebody who is told how it goes, from any thread.
pub type Listener<'a> = &'a (dyn Fn(Progress) + Sync);

/// Work for the search for a shorter run.
const LOOK: u64 = 32_000_000;

/// Decides the property.
#[must_use]
pub fn decide(model: &Model, property: usize, options: &Options, budget: &Budget, listener: Listener<'_>) -> Outcome {
    let reduced = Reduced::new(model, property, &budget.stop());
    let problem = reduced.problem();
    let hints = Hints { words: reduced.words(model, &options.hints.words) };
    let outcome = Board::new(problem, &hints, (budget, listener), options.threads.clamp(1, 2)).settle();
    let outcome = shortened(outcome, &reduced, budget, listener);
    let runs = outcome.runs.iter().map(|run| reduced.trace(run)).collect();
    let answer = match reduced.lift(model, outcome.answer) {
        Answer::Violated(trace) if !is_violation(model, property, &trace) => Answer::GaveUp(Reason::Incomplete),
        answer => answer,
    };
    Outcome { answer, engine: outcome.engine, runs }
}

/// A run that IC3 or interpolation found may be longer than it need be: the shortest one, where it is soon found.
fn shortened(outcome: Outcome, reduced: &Reduced, budget: &Budget, listener: Listener<'_>) -> Outcome {
    if !matches!(outcome.answer, Answer::Violated(_)) || outcome.engine == "induction" {
        return outcome;
    }
    board::shortest(reduced.problem(), LOOK, budget, listener).unwrap_or(outcome)
}

/// The portfolio as an engine, in turns.
#[derive(Clone, Debug, Default)]
pub struct Portfolio {
    /// What is known of the model.
    pub hints: Hints,
}

impl Engine for Portfolio {
    fn name(&self) -> &'static str {
        "portfolio"
    }

    fn run(&self, model: &Model, property: usize, budget: &Budget, progress: &dyn Fn(Progress)) -> Answer {
        progress(Progress { engine: "portfolio", depth: 0, clauses: 0 });
        let options = Options { threads: 1, hints: self.hints.clone() };
        decide(model, property, &options, budget, &|_| ()).answer
    }
}
