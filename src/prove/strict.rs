//! Strict conformance as an obligation of safety: no fair run stays in the table for ever.
//!
//! The states are finitely many, so a run that stays for ever repeats one, and between the two every condition of fairness
//! has held. A run of the extended system may remember a state once, in a copy; it is bad when it comes back to that state
//! with a word still possible and all conditions seen since. After Biere, Artho and Schuppan, *Liveness Checking as Safety
//! Checking* (FMICS 2002). Only states that matter for the game are compared: those that the words still possible, the
//! conditions of fairness and the constraints depend on, and none that never changes.
//!
//! Added to the system, in this order: the input `strict.save`; the states `strict.saved`, a copy `strict.NAME` of each state
//! compared, and `strict.fair.N` for each condition, all zero at first; one obligation. `recheck/` builds the same from this
//! description by code of its own. Left out: copies of words that abstraction could save, and k-liveness.

use std::collections::BTreeSet;

use super::decide::Choice;
use super::product::Product;
use crate::logic::system::{Input, Labelled, State, System};
use crate::logic::term::{Node, Op, Term};

/// The product with the obligation that no fair run stays in the table for ever.
#[must_use]
pub fn strict(product: &Product) -> Product {
    let mut out = product.clone();
    let compared = compared(product);
    let system = &mut out.system;
    let no = system.pool.truth(false);
    let save = system.pool.variable(1, "strict.save");
    let saved = system.pool.variable(1, "strict.saved");
    system.inputs.push(Input { variable: save, name: "strict.save".to_owned(), origin: None });
    let pool = &mut system.pool;
    let after = pool.or(saved, save);
    let fresh = pool.not(saved);
    let now = pool.and(save, fresh);
    let mut added = vec![state("strict.saved".to_owned(), saved, no, after)];
    let mut closed = vec![saved, product.game.alive];
    for index in compared {
        let original = &system.states[index];
        let (variable, name) = (original.variable, format!("strict.{}", original.name));
        let width = pool.width(variable);
        let (copy, zero) = (pool.variable(width, name.clone()), pool.constant(width, 0));
        let next = pool.ite(now, variable, copy);
        closed.push(pool.eq(variable, copy));
        added.push(state(name, copy, zero, next));
    }
    for (index, fair) in product.game.fair.iter().enumerate() {
        let name = format!("strict.fair.{index}");
        let seen = pool.variable(1, name.clone());
        let here = pool.and(after, *fair);
        let next = pool.or(seen, here);
        closed.push(seen);
        added.push(state(name, seen, no, next));
    }
    let bad = pool.all(closed);
    let term = pool.not(bad);
    system.states.extend(added);
    system.obligations.push(Labelled { term, name: "the table is left".to_owned(), origin: None });
    out
}

fn state(name: String, variable: Term, initial: Term, next: Term) -> State {
    State { variable, name, initial: Some(initial), next, origin: None }
}

/// The indices of the states that are compared.
fn compared(product: &Product) -> Vec<usize> {
    let system = &product.system;
    let mut open: Vec<Term> = product.game.fair.clone();
    open.push(product.game.alive);
    open.extend(system.constraints.iter().map(|constraint| constraint.term));
    let needed = closure(system, open);
    let states = system.states.iter().enumerate();
    let compared = states.filter(|(_, state)| needed.contains(&state.variable) && state.next != state.variable);
    compared.map(|(index, _)| index).collect()
}

/// Every term below some, through the next values of states.
fn closure(system: &System, mut open: Vec<Term>) -> BTreeSet<Term> {
    let next: std::collections::BTreeMap<Term, Term> =
        system.states.iter().map(|state| (state.variable, state.next)).collect();
    let mut needed = BTreeSet::new();
    while let Some(term) = open.pop() {
        if !needed.insert(term) {
            continue;
        }
        match system.pool.node(term) {
            Node::Const(_) => {}
            Node::Var(_) => open.extend(next.get(&term)),
            Node::Apply(op, args) => open.extend(&args[..Op::arity(op)]),
        }
    }
    needed
}

/// The cycle, counted from 0, at whose beginning the state was remembered that the run comes back to in its last cycle.
#[must_use]
pub fn repeated_from(product: &Product, choice: &Choice) -> Option<usize> {
    let save = product.inputs.len();
    choice.inputs.iter().position(|inputs| inputs.get(save) == Some(&1))
}
