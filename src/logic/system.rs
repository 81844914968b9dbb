//! A transition system over bit-vector terms, as a value.

use super::term::{Pool, Term};
use crate::text::Place;

/// A system: variables, how they begin, what they become, what is assumed and what must hold.
#[derive(Clone, Debug, Default)]
pub struct System {
    /// The terms.
    pub pool: Pool,
    /// What the environment chooses anew in each cycle.
    pub inputs: Vec<Input>,
    /// What lasts from cycle to cycle.
    pub states: Vec<State>,
    /// Holds in every cycle of the runs that are looked at.
    pub constraints: Vec<Labelled>,
    /// Must hold in every cycle; a run that reaches a cycle in which one does not is a violation of it.
    pub obligations: Vec<Labelled>,
    /// Other terms that somebody wants to see in a run.
    pub outputs: Vec<Labelled>,
}

/// An input.
#[derive(Clone, Debug)]
pub struct Input {
    /// Its variable.
    pub variable: Term,
    /// Its name.
    pub name: String,
    /// Where it is declared.
    pub origin: Option<Place>,
}

/// A state variable.
#[derive(Clone, Debug)]
pub struct State {
    /// Its variable.
    pub variable: Term,
    /// Its name.
    pub name: String,
    /// Its value before the first cycle, over constants and state variables that come before; `None` is any.
    pub initial: Option<Term>,
    /// Its value in the next cycle.
    pub next: Term,
    /// Where it is declared.
    pub origin: Option<Place>,
}

/// A term with a name; width 1 where it is a constraint or an obligation.
#[derive(Clone, Debug)]
pub struct Labelled {
    /// The term.
    pub term: Term,
    /// What it says.
    pub name: String,
    /// Where it comes from.
    pub origin: Option<Place>,
}
