//! The system whose certificates prove strict conformance, built from its description alone.
//!
//! Let `alive` say that a word is in a row at the beginning of the cycle, and `fair(n)` that in this cycle the environment does
//! not stay in the open end `n` (both are the table's definitions). *Compared* are the states that `alive`, `fair` and the
//! constraints depend on, through next values, without those that never change. To the system of block and table are added:
//!
//! * an input `strict.save`;
//! * states, all zero at first: `strict.saved`, next `saved ∨ save`; for each compared state `x` a copy, next `x` where
//!   `save ∧ ¬saved`, else itself; for each `n` a bit, next `bit ∨ (saved ∨ save) ∧ fair(n)`;
//! * an obligation: not all of `saved`, `alive`, every compared state equals its copy, every bit.
//!
//! If it holds in all runs, no fair run is in the table for ever: such a run would come to some state of the
//! compared ones again and again, with each `fair(n)` between two of these times, and could be repeated from there on.

use crate::logic::system::{Input, Labelled, State, System};
use crate::logic::term::{Node, Op, Pool, Term};

/// The extended system, and the numbers of the states that it compares.
#[derive(Clone, Debug)]
pub struct Strict {
    /// The system.
    pub system: System,
    /// The compared states.
    pub compared: Vec<usize>,
}

/// Extends `base`, where `alive` and `fair` are terms of its pool.
#[must_use]
pub fn extend(base: &System, alive: Term, fair: &[Term]) -> Strict {
    let compared = compared(base, alive, fair);
    let mut system = base.clone();
    let mut builder = Builder { pool: &mut system.pool, states: Vec::new() };
    let save = builder.pool.variable(1, "strict.save");
    let saved = builder.state("strict.saved", 1);
    let looping = builder.both(Op::Or, saved, save);
    builder.next(looping);
    let not_yet = builder.pool.plain(Op::Not, &[saved]);
    let copies = builder.both(Op::And, save, not_yet);
    let mut back = builder.both(Op::And, saved, alive);
    for index in &compared {
        let State { variable, name, .. } = &base.states[*index];
        let copy = builder.state(&format!("strict.{name}"), base.pool.width(*variable));
        let next = builder.pool.plain(Op::Ite, &[copies, *variable, copy]);
        builder.next(next);
        let same = builder.both(Op::Eq, *variable, copy);
        back = builder.both(Op::And, back, same);
    }
    for (index, fair) in fair.iter().enumerate() {
        let bit = builder.state(&format!("strict.fair.{index}"), 1);
        let now = builder.both(Op::And, looping, *fair);
        let next = builder.both(Op::Or, bit, now);
        builder.next(next);
        back = builder.both(Op::And, back, bit);
    }
    let holds = builder.pool.plain(Op::Not, &[back]);
    let states = builder.states;
    system.states.extend(states);
    system.inputs.push(Input { variable: save, name: "strict.save".to_owned(), origin: None });
    system.obligations.push(Labelled { term: holds, name: "the table is left".to_owned(), origin: None });
    Strict { system, compared }
}

struct Builder<'p> {
    pool: &'p mut Pool,
    states: Vec<State>,
}

impl Builder<'_> {
    /// A state that is zero at first; what it becomes is said by the next call of `next`.
    fn state(&mut self, name: &str, width: u32) -> Term {
        let variable = self.pool.variable(width, name);
        let initial = Some(self.pool.constant(width, 0));
        self.states.push(State { variable, name: name.to_owned(), initial, next: variable, origin: None });
        variable
    }

    fn next(&mut self, next: Term) {
        if let Some(state) = self.states.last_mut() {
            state.next = next;
        }
    }

    fn both(&mut self, op: Op, one: Term, other: Term) -> Term {
        self.pool.plain(op, &[one, other])
    }
}

/// By rounds: what matters, and then what that becomes, until nothing is new.
fn compared(base: &System, alive: Term, fair: &[Term]) -> Vec<usize> {
    let mut matters = vec![false; base.pool.len()];
    let mut roots = vec![alive];
    roots.extend(fair);
    roots.extend(base.constraints.iter().map(|constraint| constraint.term));
    mark(&base.pool, &roots, &mut matters);
    loop {
        let is_new = |state: &&State| matters[state.variable.0 as usize] && !matters[state.next.0 as usize];
        let new: Vec<Term> = base.states.iter().filter(is_new).map(|state| state.next).collect();
        if new.is_empty() {
            break;
        }
        mark(&base.pool, &new, &mut matters);
    }
    let lasting = |index: &usize| {
        let state = &base.states[*index];
        matters[state.variable.0 as usize] && state.next != state.variable
    };
    (0..base.states.len()).filter(lasting).collect()
}

/// Marks terms and everything below them.
fn mark(pool: &Pool, terms: &[Term], matters: &mut [bool]) {
    let mut open = terms.to_vec();
    while let Some(term) = open.pop() {
        if !std::mem::replace(&mut matters[term.0 as usize], true)
            && let Node::Apply(op, operands) = pool.node(term)
        {
            open.extend(&operands[..op.arity()]);
        }
    }
}
