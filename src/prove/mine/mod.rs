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
mod houdini;
mod inputs;
mod predicates;
mod sample;

use super::engine::{Answer, Budget, Engine, Hints, Progress, Reason};
use super::problem::Problem;
use super::witness;
use crate::logic::aig::{Gate, Lit, Model};
use cases::Question;
use houdini::Houdini;
use inputs::Inputs;
use predicates::Predicates;
use sample::{Runs, Samples, Wanted};

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
            Ok(Mined::Proved(answer)) => answer,
            Ok(Mined::Enriched(_)) => Answer::GaveUp(Reason::Incomplete),
            Err(reason) => Answer::GaveUp(reason),
        }
    }
}

/// What mining leads to.
pub(crate) enum Mined {
    /// The facts imply the property.
    Proved(Answer),
    /// They do not; other engines may use them.
    Enriched(Problem),
}

/// Most nodes that are compared pair by pair for implications.
const PAIRED: usize = 200;

/// Finds facts and adds them to the problem.
pub(crate) fn mine(mut problem: Problem, hints: &Hints, budget: &Budget) -> Result<Mined, Reason> {
    let words: Vec<Vec<Lit>> = hints.words.iter().filter(|w| w.len() > 1).cloned().collect();
    let guards = witness::guards(&problem.model, &words);
    let traces = witness::witnesses(&problem.model, &guards, budget);
    let inputs = Inputs::new(&problem.model, &traces);
    let wanted = Wanted { nodes: &[], words: &words, guards: &guards };
    let sampled = Samples::take(&problem.model, wanted, (&inputs, &traces), budget)?;
    let Predicates { all: predicates, equal, values } = predicates::between(&mut problem, &words, &sampled, budget)?;
    let guesses = guess(&problem, (&guards, &values), &predicates, ((&inputs, &traces), budget))?;
    // The second wave is twice the first or more, and seldom wanted.
    let mut facts = Vec::new();
    for wave in guesses {
        let mut houdini = Houdini::new(&mut problem, [facts, wave].concat(), inputs.clone());
        houdini.settle(budget)?;
        facts = houdini.surviving();
        let question = Question { model: &problem.model, bad: problem.bad, facts: &facts, equal: &equal };
        let proved = match question.implied(&guards, budget) {
            true => Some(facts.clone()),
            false => houdini.imply_property(budget)?,
        };
        if let Some(clauses) = proved {
            return Ok(Mined::Proved(Answer::Proved(problem.proof(&clauses, 1, false))));
        }
    }
    let spoken: std::collections::BTreeSet<u32> = facts.iter().flatten().map(|l| l.node()).collect();
    problem.facts = facts;
    for predicate in predicates {
        if spoken.contains(&predicate.node()) {
            problem.add_signal(predicate);
        }
    }
    Ok(Mined::Enriched(problem))
}

/// Gates whose cones hold latches and no inputs.
fn state_gates(model: &Model) -> Vec<Lit> {
    let mut over_state = vec![false; model.aig.len()];
    over_state[0] = true;
    for latch in &model.latches {
        over_state[latch.lit.node() as usize] = true;
    }
    let mut gates = Vec::new();
    for node in 0..model.aig.len() as u32 {
        if let Gate::And(a, b) = model.aig.gate(node)
            && over_state[a.node() as usize]
            && over_state[b.node() as usize]
        {
            over_state[node as usize] = true;
            gates.push(Lit::of(node));
        }
    }
    gates
}

/// Clauses that no random run contradicts, in two waves: classes, and what holds where a guard is true; then what holds where
/// a word has one of few values, and implications between any two.
fn guess(
    problem: &Problem,
    (guards, values): (&[Lit], &[Lit]),
    predicates: &[Lit],
    (runs, budget): (Runs<'_>, &Budget),
) -> Result<[Vec<Vec<Lit>>; 2], Reason> {
    let model = &problem.model;
    let latches: Vec<Lit> = model.latches.iter().map(|l| l.lit).collect();
    let mut nodes = latches.clone();
    nodes.extend(state_gates(model));
    nodes.sort_unstable();
    nodes.dedup();
    let samples = Samples::take(model, Wanted { nodes: &nodes, ..Wanted::default() }, runs, budget)?;
    let (mut first, leaders) = classes(&samples, &nodes);
    let spoken: Vec<Lit> = predicates.iter().chain(&latches).copied().collect();
    let seen = |guard: &Lit| samples.both(&nodes, *guard, *guard);
    for &guard in guards.iter().filter(|guard| seen(guard)) {
        budget.check()?;
        first.extend(implied(&samples, &nodes, guard, &spoken));
    }
    let mut second = Vec::new();
    for &value in values.iter().filter(|value| seen(value)) {
        budget.check()?;
        second.extend(implied(&samples, &nodes, value, &spoken));
    }
    let mut paired: Vec<Lit> = Vec::new();
    for &lit in spoken.iter().filter(|lit| leaders.contains(lit)) {
        if paired.len() < PAIRED && !paired.contains(&lit) && !guards.contains(&lit) {
            paired.push(lit);
        }
    }
    for (i, &a) in paired.iter().enumerate() {
        budget.check()?;
        for b in [a, !a] {
            second.extend(implied(&samples, &nodes, b, &paired[..i]));
        }
    }
    Ok([first, second])
}

/// What is always true where `guard` is: clauses with each of `lits`, or its inverse.
fn implied(samples: &Samples, nodes: &[Lit], guard: Lit, lits: &[Lit]) -> Vec<Vec<Lit>> {
    let both = lits.iter().filter(|lit| lit.node() != guard.node()).flat_map(|&lit| [lit, !lit]);
    both.filter(|&lit| !samples.both(nodes, guard, !lit)).map(|lit| vec![!guard, lit]).collect()
}

/// Guesses that nodes are constant, or equal to an earlier one up to inversion; and the nodes that are neither.
fn classes(samples: &Samples, nodes: &[Lit]) -> (Vec<Vec<Lit>>, std::collections::BTreeSet<Lit>) {
    let mut guesses = Vec::new();
    let mut leaders = std::collections::BTreeSet::new();
    let mut known: std::collections::BTreeMap<Vec<u64>, Lit> = std::collections::BTreeMap::new();
    for (index, &node) in nodes.iter().enumerate() {
        let (flipped, signature) = samples.normal(index);
        if signature.iter().all(|&s| s == 0) {
            guesses.push(vec![node.invert_if(!flipped)]);
            continue;
        }
        let lit = node.invert_if(flipped);
        if let Some(&leader) = known.get(&signature) {
            guesses.push(vec![!lit, leader]);
            guesses.push(vec![lit, !leader]);
        } else {
            known.insert(signature, lit);
            leaders.insert(node);
        }
    }
    (guesses, leaders)
}
