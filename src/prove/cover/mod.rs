//! What a proof covered: which rows some run reaches, which statements and branches some run within the table executes.
//!
//! Each is a question of reachability on the obligation's own system: is there a run, its inputs those of the table, that
//! comes there? Random runs answer most of them, runs from state to state of the table and bounded model checking find the
//! rest, and what no run of so many cycles reaches is handed to IC3, which may prove that none ever does. The answers are
//! runs and certificates, for others to check. Work is counted, not time: the same question has the same answer.

mod frontier;
pub mod mutate;
pub mod probe;
mod search;
pub mod trial;
mod walk;

use super::decide::Choice;
use crate::logic::certificate::Certificate;
use crate::logic::system::System;
use crate::logic::term::Term;
pub use search::{never, reach};

/// What is asked.
#[derive(Clone, Debug)]
pub struct Question {
    /// The system; what it obliges to does not matter.
    pub system: System,
    /// Whether the run is covered by the table in this cycle, width 1.
    pub covered: Term,
    /// What a run may reach, width 1 each.
    pub targets: Vec<Term>,
    /// The states of the table's global variables.
    pub globals: Vec<usize>,
}

/// How much may be done for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Evaluations of a gate in random runs, 64 runs at once.
    pub simulation: u64,
    /// Work of bounded model checking.
    pub search: u64,
    /// Work of all proofs that something is never reached.
    pub proof: u64,
    /// The longest run that bounded model checking looks at.
    pub depth: usize,
}

impl Default for Effort {
    fn default() -> Self {
        Self { simulation: 60_000_000, search: 5_000_000, proof: 10_000_000, depth: 100 }
    }
}

/// What is known of a target.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fate {
    /// The run with this index is there in this cycle, from 0.
    Reached {
        /// Which run.
        run: usize,
        /// Which cycle.
        cycle: usize,
    },
    /// No run comes there, says this proof: that the target is false in every cycle.
    Never(Box<Certificate>),
    /// No run of so many cycles comes there; nothing is known beyond.
    NotWithin(usize),
}

/// The answer.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Reached {
    /// The fate of each target.
    pub fates: Vec<Fate>,
    /// The runs.
    pub runs: Vec<Choice>,
}
