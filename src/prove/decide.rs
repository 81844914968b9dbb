//! From the obligation to an answer with evidence that speaks of the obligation's own states and inputs.

use std::time::Instant;

use super::engine::{Answer, Budget, Cancel, Fact as LatchFact, Hints, Progress, Proof, Reason};
use super::options::Options;
use super::portfolio;
use super::product::Product;
use crate::logic::aig::Trace;
use crate::logic::blast::{Blasted, LatchBit, blast};
use crate::logic::certificate::{Certificate, Fact, StateBit};
use crate::logic::system::{Labelled, System};

/// What the engines found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Decision {
    /// Every obligation holds in runs of every length.
    Proved(Certificate),
    /// An obligation fails in the last cycle of this run.
    Violated(Choice),
    /// No obligation fails in the first so many cycles.
    Bounded(u64),
}

/// What a run chooses.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Choice {
    /// The values of the table's global variables.
    pub globals: Vec<u64>,
    /// The values of the inputs in each cycle, in the order of the system's.
    pub inputs: Vec<Vec<u64>>,
}

impl Choice {
    /// What a run of the blasted product chooses.
    pub(super) fn of(product: &Product, blasted: &Blasted, trace: &Trace) -> Self {
        let stimulus = blasted.stimulus(trace);
        let globals = product.globals.iter().map(|state| stimulus.free[*state]).collect();
        Self { globals, inputs: stimulus.inputs }
    }
}

/// A decision and who made it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decided {
    /// The decision.
    pub decision: Decision,
    /// The engine.
    pub engine: &'static str,
    /// Why nothing is decided, where nothing is.
    pub ended: Option<Reason>,
    /// Runs that came up, to states that are seldom reached.
    pub runs: Vec<Choice>,
}

/// Decides the obligations of `product`, within the options' memory and their time, counted from `start`.
#[must_use]
pub fn decide(
    product: &Product,
    options: &Options,
    (start, cancel): (Instant, &Cancel),
    listener: &(dyn Fn(Progress) + Sync),
) -> Decided {
    let budget = Budget {
        deadline: start.checked_add(options.timeout),
        memory: usize::try_from(options.memory.saturating_mul(1 << 20)).unwrap_or(usize::MAX),
        cancel: cancel.clone(),
    };
    let blasted = blast(&together(&product.system));
    let words = blasted.states.clone();
    let options = portfolio::Options { threads: options.threads, hints: Hints { words } };
    let outcome = portfolio::decide(&blasted.model, 0, &options, &budget, listener);
    let ended = match outcome.answer {
        Answer::Bounded { reason, .. } | Answer::GaveUp(reason) => Some(reason),
        Answer::Proved(_) | Answer::Violated(_) => None,
    };
    let chosen = |trace: &Trace| Choice::of(product, &blasted, trace);
    let decision = match outcome.answer {
        Answer::Proved(proof) => Decision::Proved(certificate(&blasted, proof)),
        Answer::Violated(trace) => Decision::Violated(chosen(&trace)),
        Answer::Bounded { depth, .. } => Decision::Bounded(depth as u64),
        Answer::GaveUp(_) => Decision::Bounded(0),
    };
    let runs = outcome.runs.iter().map(chosen).collect();
    Decided { decision, engine: outcome.engine, ended, runs }
}

/// The system with one obligation: that all hold.
#[must_use]
pub fn together(system: &System) -> System {
    let mut system = system.clone();
    let terms: Vec<_> = system.obligations.iter().map(|obligation| obligation.term).collect();
    let term = system.pool.all(terms);
    system.obligations = vec![Labelled { term, name: "all obligations".to_owned(), origin: None }];
    system
}

/// The proof in terms of state bits. No first value of a product depends on another state, so the blaster has no latch of
/// its own here; a proof that spoke of it would become a malformed certificate, which the second check rejects.
pub(super) fn certificate(blasted: &Blasted, proof: Proof) -> Certificate {
    let latches = blasted.latches.len();
    let fact = |(index, value): LatchFact| match blasted.latches.get(index) {
        Some(LatchBit::State { state, bit }) => Fact::Bit(StateBit { state: *state, bit: *bit, value }),
        Some(LatchBit::First) => Fact::Gate(u32::MAX, value),
        None => Fact::Gate(u32::try_from(index - latches).unwrap_or(u32::MAX), value),
    };
    let gates = proof.gates.into_iter().map(|(one, other)| [fact(one), fact(other)]).collect();
    let clauses = proof.clauses.into_iter().map(|clause| clause.into_iter().map(fact).collect()).collect();
    let k = u32::try_from(proof.k).unwrap_or(u32::MAX);
    Certificate { gates, clauses, k, simple_path: proof.simple_path }.sorted()
}
