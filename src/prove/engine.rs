//! What every engine takes and gives: a model, a budget, an answer with its evidence.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use crate::logic::aig::{Lit, Model, Trace};
use crate::logic::sat::Stop;

/// A literal of a proof: what it is about, and whether it is to be true. Numbers below the count of latches are latches
/// of the model, in its order; the ones above are the proof's gates.
pub type Fact = (usize, bool);

/// An inductive invariant, or the bound of an induction.
///
/// The invariant is the conjunction of the clauses. For `k == 1`: it holds in every first state; where it holds, and the
/// constraints, it holds in the next state; where it holds, and the constraints, the bad literal is false. For `k > 1`
/// the invariant is inductive in the same sense, no run of `k` cycles that begins in a first state is bad, and no run of
/// `k + 1` cycles in which the invariant holds, the first `k` of them not bad, is bad in its last; with `simple_path`
/// only runs whose first `k` states differ are looked at there.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proof {
    /// Conjunctions that clauses may speak of; operands are latches or earlier gates.
    pub gates: Vec<(Fact, Fact)>,
    /// The clauses.
    pub clauses: Vec<Vec<Fact>>,
    /// The bound of the induction.
    pub k: usize,
    /// Whether states are assumed to differ along the runs of the induction's step.
    pub simple_path: bool,
}

/// Why an engine stopped without an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The time was up.
    Time,
    /// The memory was used up.
    Memory,
    /// Somebody else was faster.
    Cancelled,
    /// The engine cannot decide this model.
    Incomplete,
}

/// What an engine found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Answer {
    /// No run is bad, of whatever length.
    Proved(Proof),
    /// This run is; its last cycle is bad.
    Violated(Trace),
    /// No run of at most so many cycles is bad, nothing is known beyond.
    Bounded {
        /// The number of cycles.
        depth: usize,
        /// Why it went no deeper.
        reason: Reason,
    },
    /// Nothing is known.
    GaveUp(Reason),
}

impl Answer {
    /// Whether the question is settled.
    #[must_use]
    pub fn is_final(&self) -> bool {
        matches!(self, Self::Proved(_) | Self::Violated(_))
    }
}

/// How far an engine is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Who speaks.
    pub engine: &'static str,
    /// The depth that is being looked at.
    pub depth: usize,
    /// Clauses learnt so far, where the engine learns any.
    pub clauses: usize,
}

/// A flag that several engines look at; raised, it stops them all.
#[derive(Clone, Debug, Default)]
pub struct Cancel {
    own: Arc<AtomicBool>,
    above: Option<Arc<Self>>,
}

impl Cancel {
    /// Asks everybody to stop.
    pub fn cancel(&self) {
        self.own.store(true, Ordering::Relaxed);
    }

    /// Whether somebody asked.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.own.load(Ordering::Relaxed) || self.above.as_ref().is_some_and(|a| a.is_cancelled())
    }

    /// A flag that is raised with this one, and can be raised alone.
    pub(crate) fn child(&self) -> Self {
        Self { own: Arc::default(), above: Some(Arc::new(self.clone())) }
    }

    fn stop(&self, stop: Stop) -> Stop {
        let stop = stop.or_flag(Arc::clone(&self.own));
        self.above.as_ref().map_or(stop.clone(), |a| a.stop(stop))
    }
}

/// How much may be spent.
#[derive(Clone, Debug)]
pub struct Budget {
    /// When to stop.
    pub deadline: Option<Instant>,
    /// How many bytes an engine may hold, roughly.
    pub memory: usize,
    /// Stops before the deadline.
    pub cancel: Cancel,
}

impl Default for Budget {
    fn default() -> Self {
        Self { deadline: None, memory: 2 << 30, cancel: Cancel::default() }
    }
}

impl Budget {
    /// So much time from now on.
    #[must_use]
    pub fn seconds(seconds: f64) -> Self {
        Self { deadline: Some(Instant::now() + Duration::from_secs_f64(seconds)), ..Self::default() }
    }

    /// The same for a solver.
    pub(crate) fn stop(&self) -> Stop {
        self.cancel.stop(self.deadline.map_or_else(Stop::default, Stop::at))
    }

    /// The same for engines that race each other, with the flag that the first one raises.
    pub(crate) fn race(&self) -> (Self, Cancel) {
        let won = self.cancel.child();
        (Self { cancel: won.clone(), ..self.clone() }, won)
    }

    /// Why to stop now, if so.
    #[must_use]
    pub fn exhausted(&self) -> Option<Reason> {
        if self.cancel.is_cancelled() {
            Some(Reason::Cancelled)
        } else if self.deadline.is_some_and(|d| Instant::now() >= d) {
            Some(Reason::Time)
        } else {
            None
        }
    }

    /// Goes on, or says why not.
    pub(crate) fn check(&self) -> Result<(), Reason> {
        self.exhausted().map_or(Ok(()), Err)
    }

    /// Why to stop when holding so many bytes.
    #[must_use]
    pub fn exhausted_with(&self, bytes: usize) -> Option<Reason> {
        self.exhausted().or_else(|| (bytes > self.memory).then_some(Reason::Memory))
    }
}

/// What is known of a model beyond its bits.
#[derive(Clone, Debug, Default)]
pub struct Hints {
    /// Words of latches, the least significant bit first: between these, relations are looked for.
    pub words: Vec<Vec<Lit>>,
}

/// A way to decide a property.
pub trait Engine {
    /// What it is called.
    fn name(&self) -> &'static str;

    /// Decides whether `model.bad[property]` can be reached, within the budget.
    fn run(&self, model: &Model, property: usize, budget: &Budget, progress: &dyn Fn(Progress)) -> Answer;
}

/// A search that can be interrupted and taken up again: what engines are inside, so that a schedule can share time over
/// them by work done and not by the clock.
pub(crate) trait Search {
    /// Goes on for about `ticks` of work; `None` means that there is more to do.
    fn advance(&mut self, ticks: u64, budget: &Budget, progress: &dyn Fn(Progress)) -> Option<Answer>;

    /// How many cycles have been shown free of violations.
    fn depth(&self) -> usize;

    /// What it holds in memory, roughly, in bytes.
    fn bytes(&self) -> usize;
}

/// Work between two looks at the clock.
const STRETCH: u64 = 3_000_000;

/// Runs a search until it ends or the budget does.
pub(crate) fn drive(search: &mut dyn Search, budget: &Budget, progress: &dyn Fn(Progress)) -> Answer {
    loop {
        if let Some(answer) = search.advance(STRETCH, budget, progress) {
            return answer;
        }
        if let Some(reason) = budget.exhausted_with(search.bytes()) {
            return bounded(search.depth(), reason);
        }
    }
}

/// What is known when a search has to stop.
pub(crate) fn bounded(depth: usize, reason: Reason) -> Answer {
    if depth == 0 { Answer::GaveUp(reason) } else { Answer::Bounded { depth, reason } }
}

impl Reason {
    /// One word for it.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Memory => "memory",
            Self::Cancelled => "cancelled",
            Self::Incomplete => "incomplete",
        }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Time => "the time was up",
            Self::Memory => "the memory was used up",
            Self::Cancelled => "it was cancelled",
            Self::Incomplete => "the engine cannot decide it",
        })
    }
}
