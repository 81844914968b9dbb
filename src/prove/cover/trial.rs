//! A mutant before its table: a short search for a violation, a short proof.

use super::super::bmc::BmcSearch;
use super::super::decide::{Choice, together};
use super::super::engine::{Answer, Budget, Cancel, Search};
use super::super::ic3::Ic3Search;
use super::super::product::Product;
use super::super::reduce::Reduced;
use crate::logic::aig::Model;
use crate::logic::blast::{Blasted, blast};

/// Work for the search and for the proof.
const SEARCH: u64 = 6_000_000;
const PROOF: u64 = 20_000_000;

/// What became of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trial {
    /// This run violates the table, or the machine faults in it.
    Violated(Choice),
    /// No run does.
    Conforms,
    /// No run of so many cycles does.
    Bounded(usize),
    /// It does the same as the block itself.
    Same,
}

/// What engines see of a block and its table: all of it, and what bears on the table.
#[derive(Clone, Debug)]
pub struct Seen {
    whole: Blasted,
    cone: Model,
}

/// The block that mutants are compared with: one that was verified. The outputs of the system are those of the block.
#[must_use]
pub fn seen(product: &Product) -> Seen {
    let whole = blast(&together(&product.system));
    Seen { cone: Reduced::cone(&whole.model, 0).model().clone(), whole }
}

/// Tries a mutant.
#[must_use]
pub fn trial(product: &Product, original: &Seen, cancel: &Cancel) -> Trial {
    let blasted = blast(&together(&product.system));
    let reduced = Reduced::cone(&blasted.model, 0);
    if same(&blasted.model, &original.whole.model) && blasted.outputs == original.whole.outputs {
        return Trial::Same;
    }
    // Nothing that bears on the table has changed, and the block conforms.
    if same(reduced.model(), &original.cone) {
        return Trial::Conforms;
    }
    let budget = Budget { cancel: cancel.clone(), ..Budget::default() };
    let mut search = BmcSearch::new(reduced.problem());
    let mut answer = search.advance(SEARCH, &budget, &|_| {});
    let mut depth = search.depth();
    if answer.is_none() {
        let mut proof = Ic3Search::new(reduced.problem());
        answer = proof.advance(PROOF, &budget, &|_| {});
        depth = depth.max(proof.depth());
    }
    match answer.map(|answer| reduced.lift(&blasted.model, answer)) {
        Some(Answer::Proved(_)) => Trial::Conforms,
        Some(Answer::Violated(trace)) => Trial::Violated(Choice::of(product, &blasted, &trace)),
        Some(Answer::Bounded { depth: further, .. }) => Trial::Bounded(depth.max(further)),
        Some(Answer::GaveUp(_)) | None => Trial::Bounded(depth),
    }
}

/// Whether two models are one, gate by gate.
fn same(one: &Model, other: &Model) -> bool {
    one.latches == other.latches
        && one.inputs == other.inputs
        && one.constraints == other.constraints
        && one.bad == other.bad
        && one.aig.len() == other.aig.len()
        && (0..one.aig.len()).all(|node| {
            let node = u32::try_from(node).unwrap_or(u32::MAX);
            one.aig.gate(node) == other.aig.gate(node)
        })
}
