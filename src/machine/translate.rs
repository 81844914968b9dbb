//! A program as a transition system: the second of its two meanings, the first being the interpreter's.
//!
//! One cycle is executed symbolically. Memory is a vector of terms, one a slot; a branch is executed on the memory that
//! it finds, and where branches join, the slots that differ become if-then-elses over the branch's condition. A jump
//! (`EXIT`, `CONTINUE`, `RETURN`) leaves its memory with the loop or routine that it ends, which merges it when it is
//! done; what follows a jump on another path carries no trace of it. So terms stay linear in the program where
//! paths would be exponential (Allen et al., *Conversion of control dependence to data dependence*, POPL 1983; Babić and Hu,
//! *Structural abstraction of software verification conditions*, CAV 2007).
//!
//! *Faults.* Each site of a fault gives one obligation: no cycle runs into it before another fault. After a fault the run
//! stops: a constraint says that no earlier cycle had one, and what the slots hold at the end of a cycle with a fault
//! means nothing ([`Translated::fault`] says so).
//!
//! *States.* Every slot that is not an input lasts from cycle to cycle, as it does for the interpreter. A slot is assumed to
//! keep its initial value until a cycle is found that changes it, and the cycle is executed again with what was
//! found, until nothing new is: what never changes is a constant then (van Eijk, *Sequential equivalence checking*, 2000, for
//! constants). The same loop finds which addresses a reference may hold. A slot that is set before it is read is no state.
//!
//! *Inputs* are any value of their type; one whose type is a subrange is constrained to it.

mod access;
mod address;
mod call;
mod execute;
mod flow;
mod loops;
mod memory;
mod rounds;
mod text;

use super::program::Program;
use crate::logic::system::System;
use crate::logic::term::Term;
pub use crate::semantics::encode::Unsupported;
use crate::semantics::expr::Fault;
use crate::text::Place;

/// What bounds a translation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// How often a loop's body may be done in one execution of the loop, a `FOR` with constant bounds as often as they say:
    /// as for the interpreter.
    pub loop_limit: u64,
    /// How many statements are executed for one cycle, unrolled loops and calls included, before the program is too large.
    pub step_limit: u64,
    /// How many terms there may be before the program is too large.
    pub term_limit: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { loop_limit: 1_000, step_limit: 2_000_000, term_limit: 5_000_000 }
    }
}

/// A program as a system, with the way from slots to terms.
#[derive(Clone, Debug)]
pub struct Translated {
    /// The system: an obligation for each site of a fault, in the order of [`Translated::faults`], and no other.
    pub system: System,
    /// The value of each slot at the beginning of the cycle, inputs and clocks set.
    pub begin: Vec<Term>,
    /// The value of each slot at the end of the cycle.
    pub end: Vec<Term>,
    /// The variable of each slot that is an input.
    pub inputs: Vec<Option<Term>>,
    /// The index in [`System::states`] of each slot that is a state.
    pub states: Vec<Option<usize>>,
    /// The sites of faults: that of each obligation.
    pub faults: Vec<(Fault, Option<Place>)>,
    /// Whether the cycle runs into a fault, width 1.
    pub fault: Term,
    /// How often the cycle was executed until nothing new was found.
    pub rounds: u32,
}

/// The program as a transition system.
///
/// # Errors
/// A part that is not modelled, or a program that is too large.
pub fn translate(program: &Program, options: &Options) -> Result<Translated, Unsupported> {
    rounds::translate(program, options)
}
