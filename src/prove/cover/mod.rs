//! What a proof covered: which rows some run reaches, which statements and branches some run within the table executes.
//!
//! Each is a question of reachability on the obligation's own system: is there a run, its inputs those of the table, that
//! comes there? Random runs answer most of them, and runs that the search for the verdict came across. What the invariant of
//! the verdict excludes is never reached. For the rest, bounded model checking and runs from state to state of the table find
//! runs, and IC3 may prove that there is none. The answers are runs and certificates, for others to check. Work is counted, not
//! time: the same question has the same answer.

mod frontier;
mod given;
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
    /// Runs that lead to states that are seldom reached, as far as they are known.
    pub known: Vec<Choice>,
    /// An inductive invariant of the system, if one is known.
    pub invariant: Option<Certificate>,
}

/// How much may be done for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// Evaluations of a gate in random runs, 64 runs at once: from the beginning, and as many from where known runs lead.
    pub simulation: u64,
    /// Work of bounded model checking, and of asking what the invariant excludes.
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
