//! What the proof of the table tells: that no run is in a state that its invariant excludes.

use super::super::bmc::{Reply, Unrolled};
use super::super::engine::Budget;
use super::frontier::Frontier;
use crate::logic::aig::Lit;
use crate::logic::blast::Blasted;
use crate::logic::certificate::{Certificate, Fact};

/// Takes off the targets that need a state that the invariant excludes.
pub(super) fn exclude(
    blasted: &Blasted,
    invariant: &Certificate,
    (mut left, budget): (u64, &Budget),
    frontier: &mut Frontier,
) {
    let model = &blasted.model;
    let mut states = Unrolled::new(model, false);
    states.constrain(model, 0);
    if require(&mut states, blasted, invariant).is_none() {
        return;
    }
    for target in frontier.open() {
        let there = states.graph.at(model.bad[target], 0);
        match states.ask(there, &mut left, budget) {
            Reply::No => frontier.close(target, invariant.clone()),
            Reply::Yes => {}
            Reply::Stopped(_) | Reply::Pause => return,
        }
    }
}

/// `None` if it speaks of something that the system does not have.
fn require(states: &mut Unrolled, blasted: &Blasted, invariant: &Certificate) -> Option<()> {
    let mut gates: Vec<Lit> = Vec::with_capacity(invariant.gates.len());
    for [one, other] in &invariant.gates {
        let one = literal(states, blasted, &gates, one)?;
        let other = literal(states, blasted, &gates, other)?;
        gates.push(states.graph.aig.and(one, other));
    }
    for clause in &invariant.clauses {
        let lits: Option<Vec<Lit>> = clause.iter().map(|fact| literal(states, blasted, &gates, fact)).collect();
        states.require(&lits?);
    }
    Some(())
}

fn literal(states: &mut Unrolled, blasted: &Blasted, gates: &[Lit], fact: &Fact) -> Option<Lit> {
    Some(match fact {
        Fact::Bit(bit) => {
            let word = blasted.states.get(bit.state as usize)?;
            states.graph.at(*word.get(bit.bit as usize)?, 0).invert_if(!bit.value)
        }
        Fact::Gate(gate, value) => gates.get(*gate as usize)?.invert_if(!*value),
    })
}
