//! The turns of the plan, taken by one worker or more.
//!
//! A worker takes the first turn whose engine is free, and so may be ahead of the plan where another one is busy. Of all
//! answers that of the earliest turn counts, and what comes behind it is stopped; so the answer is that of one worker who
//! takes one turn after the other, as long as no limit of time or memory ends it.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use super::super::bmc::BmcSearch;
use super::super::engine::{Answer, Budget, Cancel, Hints, Progress, Reason, Search, bounded};
use super::super::ic3::Ic3Search;
use super::super::induction::InductionSearch;
use super::super::interpolation::InterpolationSearch;
use super::super::mine::{Found, Mined, mine};
use super::super::problem::Problem;
use super::plan::{NAMES, Name, Plan, Turn};
use super::{Listener, Outcome};
use crate::logic::aig::Trace;

/// How much less work IC3 and interpolation get, whose ticks take longer.
const SHARE: u64 = 4;

/// A search that takes turns, until it cannot go on.
struct Lane {
    engine: &'static str,
    search: Box<dyn Search + Send>,
    /// Its turns are so much shorter.
    share: u64,
}

impl Lane {
    fn induction(problem: &Problem) -> Self {
        Self { engine: "induction", search: Box::new(InductionSearch::new(problem.clone())), share: 1 }
    }

    fn ic3(problem: &Problem) -> Self {
        Self { engine: "ic3", search: Box::new(Ic3Search::new(problem.clone())), share: SHARE }
    }

    fn interpolation(problem: &Problem) -> Self {
        Self { engine: "interpolation", search: Box::new(InterpolationSearch::new(problem.clone())), share: SHARE }
    }
}

/// The shortest run that is bad, where that is found with so much work.
pub(super) fn shortest(problem: Problem, work: u64, budget: &Budget, listener: Listener<'_>) -> Option<Outcome> {
    let answer = BmcSearch::new(problem).advance(work, budget, listener)?;
    matches!(answer, Answer::Violated(_)).then_some(Outcome { answer, engine: "bmc", runs: Vec::new() })
}

/// Where somebody who takes turns is.
enum Place {
    /// Not there before mining is over.
    Absent,
    Free(Box<Lane>),
    Busy,
    /// It ended without an answer that settles the question, and holds no memory.
    Over,
}

/// What workers share.
struct State {
    places: [Place; NAMES],
    /// What each holds in memory, as it was known last.
    bytes: [usize; NAMES],
    /// Turns that nobody has taken, in order, and how many of the plan were looked at.
    waiting: Vec<usize>,
    seen: usize,
    running: Vec<(usize, Cancel)>,
    best: Option<(usize, Outcome)>,
    /// The turn in which was mined, and runs that came up.
    mined: Option<(usize, Vec<Trace>)>,
    /// No run of so many cycles is bad.
    safe: usize,
}

/// The board.
pub(super) struct Board<'b> {
    problem: Problem,
    plan: Plan,
    hints: &'b Hints,
    budget: &'b Budget,
    listener: Listener<'b>,
    workers: usize,
    state: Mutex<State>,
    changed: Condvar,
}

/// What a turn came to.
enum Came {
    /// Somebody goes on, in a later turn.
    Back(Box<Lane>),
    Ended {
        safe: usize,
    },
    /// The problem with what was mined, whether that is anything, and runs that came up.
    Mined {
        problem: Problem,
        is_richer: bool,
        runs: Vec<Trace>,
    },
    Settled(Outcome),
}

/// A turn that is being taken. Where it ends without a word, because something panicked, the others do not wait for it.
struct Taken<'t> {
    board: &'t Board<'t>,
    index: usize,
    name: Name,
    is_over: bool,
}

impl Taken<'_> {
    fn end(mut self, came: Came) {
        let mut state = self.board.lock();
        state.leave(self.index, self.name);
        state.put((self.index, self.name, self.board.plan.comes_again(self.index)), came);
        self.is_over = true;
    }
}

impl Drop for Taken<'_> {
    fn drop(&mut self) {
        if !self.is_over {
            self.board.lock().leave(self.index, self.name);
        }
        self.board.changed.notify_all();
    }
}

impl<'b> Board<'b> {
    pub(super) fn new(
        problem: Problem,
        hints: &'b Hints,
        (budget, listener): (&'b Budget, Listener<'b>),
        workers: usize,
    ) -> Self {
        let state = State {
            places: [
                Place::Free(Box::new(Lane::induction(&problem))),
                Place::Free(Box::new(Lane::ic3(&problem))),
                Place::Free(Box::new(Lane::interpolation(&problem))),
                Place::Absent,
                Place::Absent,
                Place::Absent,
            ],
            bytes: [0; NAMES],
            waiting: Vec::new(),
            seen: 0,
            running: Vec::new(),
            best: None,
            mined: None,
            safe: 0,
        };
        let plan = Plan::new(problem.model.aig.len());
        Self { problem, plan, hints, budget, listener, workers, state: Mutex::new(state), changed: Condvar::new() }
    }

    /// Takes turns until one settles the question or all have ended.
    pub(super) fn settle(&self) -> Outcome {
        std::thread::scope(|scope| {
            for _ in 1..self.workers {
                scope.spawn(|| self.work());
            }
            self.work();
        });
        let mut state = self.lock();
        let reason = self.budget.exhausted().unwrap_or(Reason::Memory);
        let none = Outcome { answer: bounded(state.safe, reason), engine: "portfolio", runs: Vec::new() };
        let (end, outcome) = state.best.take().unwrap_or((usize::MAX, none));
        // Of a turn behind the answer's it depends on who takes part whether it has ended.
        match state.mined.take() {
            Some((turn, runs)) if turn < end => Outcome { runs, ..outcome },
            _ => outcome,
        }
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn work(&self) {
        let mut state = self.lock();
        while self.budget.exhausted().is_none() {
            match state.take(&self.plan) {
                Some((index, turn, lane)) => {
                    let (budget, cancel) = self.share(&state, turn.name).race();
                    state.running.push((index, cancel));
                    drop(state);
                    let taken = Taken { board: self, index, name: turn.name, is_over: false };
                    taken.end(self.run(turn, lane, &budget));
                    state = self.lock();
                }
                None if state.running.is_empty() => break,
                None => state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner),
            }
        }
    }

    /// What others leave of the memory.
    fn share(&self, state: &State, name: Name) -> Budget {
        let others = state.bytes.iter().sum::<usize>() - state.bytes[name as usize];
        Budget { memory: self.budget.memory.saturating_sub(others) / self.workers, ..self.budget.clone() }
    }

    fn run(&self, turn: Turn, lane: Option<Box<Lane>>, budget: &Budget) -> Came {
        let Some(mut lane) = lane else { return self.mine(budget) };
        let answer = lane.search.advance(turn.work / lane.share, budget, self.listener);
        match answer {
            Some(answer) if answer.is_final() => {
                Came::Settled(Outcome { answer, engine: lane.engine, runs: Vec::new() })
            }
            None if lane.search.bytes() <= budget.memory => Came::Back(lane),
            _ => Came::Ended { safe: lane.search.depth() },
        }
    }

    fn mine(&self, budget: &Budget) -> Came {
        (self.listener)(Progress { engine: "mine", depth: 1, clauses: 0 });
        match mine(self.problem.clone(), self.hints, budget) {
            Ok(Mined { found: Found::Proved(answer), runs }) => Came::Settled(Outcome { answer, engine: "mine", runs }),
            Ok(Mined { found: Found::Enriched(problem), runs }) => Came::Mined { problem, is_richer: true, runs },
            Err(_) => Came::Mined { problem: self.problem.clone(), is_richer: false, runs: Vec::new() },
        }
    }
}

impl State {
    /// The first turn that can be taken, with the search that takes it; mining has none.
    fn take(&mut self, plan: &Plan) -> Option<(usize, Turn, Option<Box<Lane>>)> {
        let end = self.best.as_ref().map_or(usize::MAX, |(index, _)| *index);
        let mut at = 0;
        loop {
            if at == self.waiting.len() {
                // Who is free has another turn, and so has mining until it was done.
                let is_open = matches!(self.places[Name::Mine as usize], Place::Absent);
                let goes_on = is_open || self.places.iter().any(|place| matches!(place, Place::Free(_)));
                if !goes_on || self.seen >= end {
                    return None;
                }
                self.waiting.push(self.seen);
                self.seen += 1;
            }
            let index = self.waiting[at];
            if index >= end {
                return None;
            }
            let next = plan.turn(index);
            let place = &mut self.places[next.name as usize];
            match place {
                Place::Absent if next.name != Name::Mine => at += 1,
                Place::Busy => at += 1,
                Place::Over => drop(self.waiting.remove(at)),
                Place::Absent | Place::Free(_) => {
                    self.waiting.remove(at);
                    return match std::mem::replace(place, Place::Busy) {
                        Place::Free(lane) => Some((index, next, Some(lane))),
                        _ => Some((index, next, None)),
                    };
                }
            }
        }
    }

    /// Ends a turn; whoever had it is over, unless it is put back.
    fn leave(&mut self, index: usize, name: Name) {
        self.running.retain(|(other, _)| *other != index);
        self.places[name as usize] = Place::Over;
        self.bytes[name as usize] = 0;
    }

    fn put(&mut self, (index, name, comes_again): (usize, Name, bool), came: Came) {
        match came {
            Came::Back(lane) => {
                self.safe = self.safe.max(lane.search.depth());
                if comes_again {
                    self.bytes[name as usize] = lane.search.bytes();
                    self.places[name as usize] = Place::Free(lane);
                }
            }
            Came::Ended { safe } => self.safe = self.safe.max(safe),
            Came::Mined { problem, is_richer, runs } => {
                self.mined = Some((index, runs));
                let ic3 = if is_richer { Place::Free(Box::new(Lane::ic3(&problem))) } else { Place::Over };
                self.places[Name::InductionWithFacts as usize] = Place::Free(Box::new(Lane::induction(&problem)));
                self.places[Name::Ic3WithFacts as usize] = ic3;
            }
            Came::Settled(outcome) if self.best.as_ref().is_none_or(|(best, _)| index < *best) => {
                self.best = Some((index, outcome));
                self.running.iter().filter(|(other, _)| *other > index).for_each(|(_, cancel)| cancel.cancel());
            }
            Came::Settled(_) => {}
        }
    }
}
