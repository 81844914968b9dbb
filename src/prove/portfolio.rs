//! All engines on one property.
//!
//! With one job the order is fixed and shares are counted in work, not in time, so that the same model gives the same
//! answer with the same evidence: induction (which searches for violations on the side), IC3 and interpolation in turns that
//! are short at first and double, mining, then interpolation and IC3 as they stand, and IC3 and induction with what was
//! mined, in turns that grow. With two jobs induction runs beside mining and IC3, and the first answer counts: its kind is
//! the same, its evidence may differ.

use super::bmc::BmcSearch;
use super::engine::{Answer, Budget, Cancel, Engine, Hints, Progress, Reason, Search, bounded, drive};
use super::ic3::Ic3Search;
use super::induction::InductionSearch;
use super::interpolation::InterpolationSearch;
use super::mine::{Mined, mine};
use super::problem::Problem;
use super::reduce::Reduced;
use super::simulate::is_violation;
use crate::logic::aig::Model;

/// What to do.
#[derive(Clone, Debug)]
pub struct Options {
    /// How many threads, at most two of which are of use.
    pub jobs: usize,
    /// What is known of the model.
    pub hints: Hints,
}

impl Default for Options {
    fn default() -> Self {
        Self { jobs: 1, hints: Hints::default() }
    }
}

/// An answer, and who gave it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outcome {
    /// The answer.
    pub answer: Answer,
    /// The engine.
    pub engine: &'static str,
}

/// Somebody who is told how it goes, from any thread.
pub type Listener<'a> = &'a (dyn Fn(Progress) + Sync);

/// Work for the turns before mining: the first, the last of all, and the one behind it of induction alone; and how much
/// less IC3 and interpolation get in each, whose ticks take longer.
const FIRST: u64 = 1_000_000;
const LAST: u64 = 4_000_000;
const ALONE: u64 = 8_000_000;
const SHARE: u64 = 4;
/// Work for the first turn behind mining.
const TURN: u64 = 32_000_000;

/// Work for the search for a shorter run.
const LOOK: u64 = 32_000_000;

/// Decides the property.
#[must_use]
pub fn decide(model: &Model, property: usize, options: &Options, budget: &Budget, listener: Listener<'_>) -> Outcome {
    let reduced = Reduced::new(model, property, &budget.stop());
    let problem = reduced.problem();
    let hints = Hints { words: reduced.words(model, &options.hints.words) };
    let outcome = if options.jobs > 1 {
        side_by_side(problem, &hints, budget, listener)
    } else {
        in_turns(problem, &hints, budget, listener)
    };
    let outcome = shortened(outcome, &reduced, budget, listener);
    let answer = reduced.lift(model, outcome.answer);
    match &answer {
        Answer::Violated(trace) if !is_violation(model, property, trace) => {
            Outcome { answer: Answer::GaveUp(Reason::Incomplete), engine: outcome.engine }
        }
        _ => Outcome { answer, engine: outcome.engine },
    }
}

/// A run that IC3 or interpolation found may be longer than it need be: the shortest one, where it is soon found.
fn shortened(outcome: Outcome, reduced: &Reduced, budget: &Budget, listener: Listener<'_>) -> Outcome {
    if !matches!(outcome.answer, Answer::Violated(_)) || outcome.engine == "induction" {
        return outcome;
    }
    let mut look = Lane::new("bmc", BmcSearch::new(reduced.problem()));
    look.turn(LOOK, budget, listener).filter(|found| matches!(found.answer, Answer::Violated(_))).unwrap_or(outcome)
}

/// The problem with what mining finds, or its answer.
fn enrich(problem: Problem, hints: &Hints, budget: &Budget, listener: Listener<'_>) -> Result<Problem, Outcome> {
    listener(Progress { engine: "mine", depth: 1, clauses: 0 });
    match mine(problem.clone(), hints, budget) {
        Ok(Mined::Proved(answer)) => Err(Outcome { answer, engine: "mine" }),
        Ok(Mined::Enriched(problem)) => Ok(problem),
        Err(_) => Ok(problem),
    }
}

/// A search that takes turns, until it cannot go on.
struct Lane {
    engine: &'static str,
    /// Its turns are so much shorter.
    share: u64,
    /// `None` where the search ended without an answer that settles the question; then it holds no memory.
    search: Option<Box<dyn Search>>,
    depth: usize,
    bytes: usize,
}

impl Lane {
    fn new(engine: &'static str, search: impl Search + 'static) -> Self {
        Self { engine, share: 1, search: Some(Box::new(search)), depth: 0, bytes: 0 }
    }

    fn with_share(self, share: u64) -> Self {
        Self { share, ..self }
    }

    /// One turn; the answer, where it settles the question.
    fn turn(&mut self, work: u64, budget: &Budget, listener: Listener<'_>) -> Option<Outcome> {
        let search = self.search.as_mut()?;
        let answer = search.advance(work / self.share, budget, listener);
        (self.depth, self.bytes) = (self.depth.max(search.depth()), search.bytes());
        match answer {
            Some(answer) if answer.is_final() => return Some(Outcome { answer, engine: self.engine }),
            None if self.bytes <= budget.memory => {}
            _ => (self.search, self.bytes) = (None, 0),
        }
        None
    }
}

/// One turn of each, within what memory the others leave; the first answer that settles the question.
fn round(lanes: &mut [Lane], work: u64, budget: &Budget, listener: Listener<'_>) -> Option<Outcome> {
    for index in 0..lanes.len() {
        let others: usize = lanes.iter().map(|lane| lane.bytes).sum::<usize>() - lanes[index].bytes;
        let budget = Budget { memory: budget.memory.saturating_sub(others), ..budget.clone() };
        if let Some(outcome) = lanes[index].turn(work, &budget, listener) {
            return Some(outcome);
        }
    }
    None
}

fn in_turns(problem: Problem, hints: &Hints, budget: &Budget, listener: Listener<'_>) -> Outcome {
    let mut early = [
        Lane::new("induction", InductionSearch::new(problem.clone())),
        Lane::new("ic3", Ic3Search::new(problem.clone())).with_share(SHARE),
        Lane::new("interpolation", InterpolationSearch::new(problem.clone())).with_share(SHARE),
    ];
    let mut turn = FIRST;
    while turn <= LAST {
        if let Some(outcome) = round(&mut early, turn, budget, listener) {
            return outcome;
        }
        turn *= 2;
    }
    if let Some(outcome) = round(&mut early[..1], ALONE, budget, listener) {
        return outcome;
    }
    let [short, plain, interpolation] = early;
    let safe = short.depth;
    drop(short);
    let held = interpolation.bytes + plain.bytes;
    let left = Budget { memory: budget.memory.saturating_sub(held), ..budget.clone() };
    let problem = match enrich(problem, hints, &left, listener) {
        Ok(problem) => problem,
        Err(outcome) => return outcome,
    };
    let (ic3, induction) = (Ic3Search::new(problem.clone()), InductionSearch::new(problem));
    let ic3 = Lane::new("ic3", ic3).with_share(SHARE);
    let mut lanes = [Lane::new("induction", induction), interpolation, ic3, plain];
    to_the_end(&mut lanes, safe, budget, listener)
}

/// Turns that grow, until one settles the question or all have ended.
fn to_the_end(lanes: &mut [Lane], safe: usize, budget: &Budget, listener: Listener<'_>) -> Outcome {
    let mut turn = TURN;
    loop {
        if let Some(outcome) = round(lanes, turn, budget, listener) {
            return outcome;
        }
        let ended = lanes.iter().all(|lane| lane.search.is_none());
        if let Some(reason) = budget.exhausted().or(ended.then_some(Reason::Memory)) {
            let deepest = lanes.iter().fold(safe, |depth, lane| depth.max(lane.depth));
            return Outcome { answer: bounded(deepest, reason), engine: "portfolio" };
        }
        turn = turn.saturating_add(turn / 2);
    }
}

fn side_by_side(problem: Problem, hints: &Hints, budget: &Budget, listener: Listener<'_>) -> Outcome {
    let other = problem.clone();
    let half = Budget { memory: budget.memory / 2, ..budget.clone() };
    let (budget, won) = half.race();
    let (budget, won) = (&budget, &won);
    let (one, two) = std::thread::scope(|scope| {
        let beside = scope.spawn(|| {
            let answer = drive(&mut InductionSearch::new(other), budget, listener);
            finish(Outcome { answer, engine: "induction" }, won)
        });
        let own = match enrich(problem, hints, budget, listener) {
            Ok(problem) => {
                let answer = drive(&mut Ic3Search::new(problem), budget, listener);
                Outcome { answer, engine: "ic3" }
            }
            Err(outcome) => outcome,
        };
        (finish(own, won), beside.join())
    });
    let two = two.unwrap_or(Outcome { answer: Answer::GaveUp(Reason::Incomplete), engine: "induction" });
    better(one, two)
}

/// Stops the others where the question is settled.
fn finish(outcome: Outcome, won: &Cancel) -> Outcome {
    if outcome.answer.is_final() {
        won.cancel();
    }
    outcome
}

fn better(one: Outcome, two: Outcome) -> Outcome {
    let rank = |outcome: &Outcome| match &outcome.answer {
        Answer::Proved(_) | Answer::Violated(_) => usize::MAX,
        Answer::Bounded { depth, .. } => *depth,
        Answer::GaveUp(_) => 0,
    };
    if rank(&one) >= rank(&two) { one } else { two }
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
        let options = Options { jobs: 1, hints: self.hints.clone() };
        decide(model, property, &options, budget, &|_| ()).answer
    }
}
