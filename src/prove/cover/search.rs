//! The search: known and random runs, the known invariant, bounded model checking for the targets that are left, proofs that no
//! run reaches them.
//!
//! Each question to the solver asks for any of the targets that are left, at the depth that is looked at; a run that it
//! gives is followed for everything that it reaches, and random runs go on from its end.

use super::super::bmc::{Reply, Unrolled};
use super::super::decide::certificate;
use super::super::engine::{Answer, Budget, Cancel, Search};
use super::super::ic3::Ic3Search;
use super::super::reduce::Reduced;
use super::super::witness;
use super::frontier::{Frontier, Place};
use super::walk::Walker;
use super::{Effort, Fate, Question, Reached, given};
use crate::logic::aig::{Lit, Model};
use crate::logic::blast::{Blasted, blast};
use crate::logic::system::{Labelled, System};

/// Answers a question, within an effort.
#[must_use]
pub fn reach(question: &Question, effort: &Effort, cancel: &Cancel) -> Reached {
    let blasted = blast(&asked(question));
    let budget = Budget { cancel: cancel.clone(), ..Budget::default() };
    let mut frontier = Frontier::new(question.targets.len());
    let mut walker = Walker::new(question, &blasted, effort.simulation);
    question.known.iter().for_each(|run| walker.repeat(run, &mut frontier));
    walker.explore(&mut frontier);
    if let Some(invariant) = &question.invariant {
        given::exclude(&blasted, invariant, (effort.search, &budget), &mut frontier);
    }
    let depth = unrolled(&blasted.model, effort, &budget, &mut walker, &mut frontier);
    proofs(&blasted, effort, &budget, &mut walker, &mut frontier);
    // Where runs are known, they were found in the same way.
    if question.known.is_empty() {
        witnessed(&blasted, &budget, &mut walker, &mut frontier);
    }
    let (places, runs) = frontier.finish();
    let fate = |place| match place {
        Place::Open => Fate::NotWithin(depth),
        Place::Reached { run, cycle } => Fate::Reached { run, cycle },
        Place::Never(proof) => Fate::Never(proof),
    };
    Reached { fates: places.into_iter().map(fate).collect(), runs }
}

/// Follows runs that lead, step by step, through the states of the table's automaton and the block's flags.
fn witnessed(blasted: &Blasted, budget: &Budget, walker: &mut Walker<'_>, frontier: &mut Frontier) {
    if frontier.is_done() {
        return;
    }
    let model = &blasted.model;
    let mut targets = witness::guards(model, &blasted.states);
    targets.extend(frontier.open().into_iter().map(|target| model.bad[target]).filter(|lit| *lit != Lit::FALSE));
    for run in witness::witnesses(model, &targets, budget) {
        if frontier.is_done() {
            return;
        }
        walker.follow(&run, frontier);
    }
}

/// The system whose obligations are that the targets are not reached.
fn asked(question: &Question) -> System {
    let mut system = question.system.clone();
    let label = |term| Labelled { term, name: String::new(), origin: None };
    system.obligations = question.targets.iter().map(|target| label(system.pool.not(*target))).collect();
    system.outputs = vec![label(question.covered)];
    system
}

/// Looks at runs of one cycle more each time; how many cycles it has looked at in full.
fn unrolled(
    model: &Model,
    effort: &Effort,
    budget: &Budget,
    walker: &mut Walker<'_>,
    frontier: &mut Frontier,
) -> usize {
    let mut unrolled = Unrolled::new(model, true);
    let mut left = effort.search;
    for depth in 0..effort.depth {
        unrolled.constrain(model, depth);
        loop {
            let open = frontier.open();
            if open.is_empty() || left == 0 || budget.exhausted_with(unrolled.bytes()).is_some() {
                return depth;
            }
            let mut any = Lit::FALSE;
            for target in open {
                let there = unrolled.graph.at(model.bad[target], depth);
                any = unrolled.graph.aig.or(any, there);
            }
            if any == Lit::FALSE {
                break;
            }
            match unrolled.ask(any, &mut left, budget) {
                Reply::Yes => {
                    let trace = unrolled.trace(model, depth);
                    let before = frontier.open().len();
                    walker.follow(&trace, frontier);
                    if frontier.open().len() == before {
                        return depth;
                    }
                }
                Reply::No => break,
                Reply::Stopped(_) | Reply::Pause => return depth,
            }
        }
    }
    effort.depth
}

/// Tries to prove of each target that is left that no run reaches it.
fn proofs(blasted: &Blasted, effort: &Effort, budget: &Budget, walker: &mut Walker<'_>, frontier: &mut Frontier) {
    let open = frontier.open();
    let share = effort.proof / (open.len().max(1) as u64);
    for target in open {
        if !frontier.is_open(target) || budget.exhausted().is_some() {
            continue;
        }
        let reduced = Reduced::cone(&blasted.model, target);
        let answer = Ic3Search::new(reduced.problem()).advance(share, budget, &|_| {});
        match answer.map(|answer| reduced.lift(&blasted.model, answer)) {
            Some(Answer::Proved(proof)) => frontier.close(target, certificate(blasted, proof)),
            Some(Answer::Violated(trace)) => walker.follow(&trace, frontier),
            _ => {}
        }
    }
}

/// The obligation that the certificate of these targets is about.
#[must_use]
pub fn never(question: &Question, targets: &[usize]) -> System {
    let mut system = question.system.clone();
    let obligation = |target: &usize| {
        let term = system.pool.not(question.targets[*target]);
        Labelled { term, name: "not reached".to_owned(), origin: None }
    };
    system.obligations = targets.iter().map(obligation).collect();
    system
}
