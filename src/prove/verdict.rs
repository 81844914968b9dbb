//! Verdicts as data.

use crate::logic::certificate::Certificate;
use crate::semantics::expr::Fault;
use crate::text::Place;

/// What is known of a table and its block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The block conforms, in runs of every length.
    Verified(Certificate),
    /// This run does not.
    Violated(Box<Run>),
    /// No violation in the first so many cycles; nothing is claimed beyond.
    Bounded(u64),
    /// The block or the table uses something that is not modelled.
    Unsupported(Vec<Reason>),
    /// The table has errors, or belongs to no block.
    Unusable(Vec<Reason>),
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Reason {
    /// What is not supported, or wrong.
    pub message: String,
    /// What would help; empty if nothing is known to.
    pub help: String,
    /// Where.
    pub place: Option<Place>,
}

/// A run of a block that loses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Run {
    /// The values of the table's global variables, in their order, as bits.
    pub globals: Vec<u64>,
    /// The values of the machine's input slots in each cycle, in the order of the slots, as bits.
    pub inputs: Vec<Vec<u64>>,
    /// What goes wrong in the last cycle.
    pub loss: Loss,
}

/// What goes wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Loss {
    /// No word of the table is left: the rows that were possible, and in each the columns whose cells do not hold.
    Table(Vec<FailedRow>),
    /// The machine cannot go on.
    Fault {
        /// Why.
        fault: Fault,
        /// Where.
        place: Option<Place>,
    },
    /// A fair environment can keep the system in the table for ever, which strict conformance excludes: the cycles from this
    /// one on, counted from 0, can be repeated.
    NeverEnds(usize),
}

/// A row whose assertions do not hold.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FailedRow {
    /// Its index.
    pub row: usize,
    /// Whether the cycle would have been its first one.
    pub first: bool,
    /// The indices of the columns.
    pub columns: Vec<usize>,
}

impl Verdict {
    /// The word for it, as reports and records write it.
    #[must_use]
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Verified(_) => "verified",
            Self::Violated(_) => "violated",
            Self::Bounded(_) => "bounded",
            Self::Unsupported(_) => "unsupported",
            Self::Unusable(_) => "unusable",
        }
    }
}
