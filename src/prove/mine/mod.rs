//! Guessing invariants and keeping those that are inductive together.
//!
//! Flanagan and Leino, "Houdini, an annotation assistant" (FME 2001), with guesses as sequential sweeping makes them (van
//! Eijk, "Sequential equivalence checking without state space traversal", DATE 1998; Mony, Baumgartner, Mishchenko,
//! Brayton, "Speculative reduction-based scalable redundancy identification", DATE 2009): what random runs show to be
//! constant, equal or implied, among latches, gates over latches, and predicates over words of latches: orders,
//! equalities and linear relations. Timers and the counters that tables keep beside them are mostly settled by that.
//!
//! The guesses are clauses over latches' cones, so that what survives is an ordinary invariant. Left out: gates over
//! inputs (their equivalence is no invariant of states), induction over more than one cycle.

mod cases;
mod guess;
mod houdini;
mod inputs;
mod predicates;
mod sample;

use super::engine::{Answer, Budget, Engine, Hints, Progress, Reason};
use super::problem::Problem;
use super::witness;
use crate::logic::aig::{Lit, Model, Trace};
use cases::Question;
use guess::Seen;
use houdini::Houdini;
use inputs::Inputs;
use predicates::Predicates;
use sample::{Samples, Wanted};

/// The engine.
#[derive(Clone, Debug, Default)]
pub struct Mine {
    /// Words to relate.
    pub hints: Hints,
}

impl Engine for Mine {
    fn name(&self) -> &'static str {
        "mine"
    }

    fn run(&self, model: &Model, property: usize, budget: &Budget, progress: &dyn Fn(Progress)) -> Answer {
        progress(Progress { engine: "mine", depth: 1, clauses: 0 });
        match mine(Problem::new(model, property), &self.hints, budget) {
            Ok(Mined { found: Found::Proved(answer), .. }) => answer,
            Ok(Mined { found: Found::Enriched(_), .. }) => Answer::GaveUp(Reason::Incomplete),
            Err(reason) => Answer::GaveUp(reason),
        }
    }
}

/// What mining leads to.
pub(crate) struct Mined {
    pub(crate) found: Found,
    /// Runs into states of the table's automaton and of the block that it guessed from.
    pub(crate) runs: Vec<Trace>,
}

/// What the facts are good for.
pub(crate) enum Found {
    /// The facts imply the property.
    Proved(Answer),
    /// They do not; other engines may use them.
    Enriched(Problem),
}

/// Finds facts and adds them to the problem.
pub(crate) fn mine(mut problem: Problem, hints: &Hints, budget: &Budget) -> Result<Mined, Reason> {
    let words: Vec<Vec<Lit>> = hints.words.iter().filter(|w| w.len() > 1).cloned().collect();
    let guards = witness::guards(&problem.model, &words);
    let traces = witness::witnesses(&problem.model, &guards, budget);
    let inputs = Inputs::new(&problem.model, &traces);
    let wanted = Wanted { nodes: &[], words: &words, guards: &guards };
    let sampled = Samples::take(&problem.model, wanted, (&inputs, &traces), budget)?;
    let Predicates { all: predicates, equal, values } = predicates::between(&mut problem, &words, &sampled, budget)?;
    let seen = Seen::take(&problem.model, &predicates, (&inputs, &traces), budget)?;
    let mut facts = Vec::new();
    for wave in 0..2 {
        // The second is twice the first or more, and seldom wanted.
        let guesses = if wave == 0 { seen.first(&guards, budget)? } else { seen.second((&guards, &values), budget)? };
        let mut houdini = Houdini::new(&mut problem, [facts, guesses].concat(), inputs.clone());
        houdini.settle(budget)?;
        facts = houdini.surviving();
        let question = Question { model: &problem.model, bad: problem.bad, facts: &facts, equal: &equal };
        let proved = match question.implied(&guards, budget) {
            true => Some(facts.clone()),
            false => houdini.imply_property(budget)?,
        };
        if let Some(clauses) = proved {
            let found = Found::Proved(Answer::Proved(problem.proof(&clauses, 1, false)));
            return Ok(Mined { found, runs: traces });
        }
    }
    let spoken: std::collections::BTreeSet<u32> = facts.iter().flatten().map(|l| l.node()).collect();
    problem.facts = facts;
    for predicate in predicates {
        if spoken.contains(&predicate.node()) {
            problem.add_signal(predicate);
        }
    }
    Ok(Mined { found: Found::Enriched(problem), runs: traces })
}
