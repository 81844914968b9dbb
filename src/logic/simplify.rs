//! A smaller system for a system, word by word, beyond what [`Pool::apply`] does where a term is made:
//!
//! * state variables that keep their first value, and those that are always equal to one another: as for latches, guess
//!   that all with the same first value are, and split classes whose next values, with the guess put in, are not the same
//!   term (van Eijk, *Sequential Equivalence Checking without State Space Traversal*, DATE 1998, with hashing of terms in
//!   the place of SAT);
//! * what a constraint says of a variable or of a truth value is put in everywhere but in the constraint.
//!
//! What is known of single bits is left to the graphs of [`aig`](super::aig).

use std::collections::BTreeMap;

use super::certificate::StateBit;
use super::eval::below;
use super::hash::FastMap;
use super::system::{Labelled, State, System};
use super::term::{Node, Op, Pool, Term};

/// Rounds of splitting; where they are not enough, nothing is made equal.
const ROUNDS: usize = 200;

/// A system with the same inputs, constraints, obligations and outputs in the same order, and fewer states.
#[derive(Clone, Debug)]
pub struct Simplified {
    /// The system.
    pub system: System,
    /// For each of its state variables, the old one's index.
    pub states: Vec<usize>,
    /// Clauses over the old state variables that hold in all first states and are inductive together, under the
    /// constraints.
    pub facts: Vec<Vec<StateBit>>,
}

impl Simplified {
    /// An invariant of the smaller system as one of the old system, with the facts.
    #[must_use]
    pub fn clauses(&self, invariant: &[Vec<StateBit>]) -> Vec<Vec<StateBit>> {
        let old = |bit: &StateBit| StateBit { state: number(self.states[bit.state as usize]), ..*bit };
        let back = invariant.iter().map(|clause| clause.iter().map(old).collect());
        self.facts.iter().cloned().chain(back).collect()
    }

    /// Free first values of the smaller system as those of the old system.
    #[must_use]
    pub fn free(&self, values: &[u64]) -> Vec<u64> {
        let length = self.states.last().map_or(0, |last| last + 1);
        let mut out = vec![0; length];
        for (place, value) in self.states.iter().zip(values) {
            out[*place] = *value;
        }
        out
    }
}

fn number(index: usize) -> u32 {
    u32::try_from(index).expect("fewer than 2^32 state variables")
}

/// What a state variable is taken for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Class {
    /// Its first value.
    Constant,
    /// The state variable with this index, perhaps itself.
    First(usize),
}

/// Simplifies a system.
#[must_use]
pub fn simplify(system: &System) -> Simplified {
    let classes = classes(system);
    let mut copy = Copy::new(system);
    copy.take(&classes);
    let initials: Vec<Option<Term>> =
        system.states.iter().map(|state| state.initial.map(|term| copy.term(term))).collect();
    let constraints = copy.labelled(&system.constraints);
    copy.assume(&system.constraints);
    let kept: Vec<usize> = (0..classes.len()).filter(|index| classes[*index] == Class::First(*index)).collect();
    let state = |copy: &mut Copy<'_>, index: usize| {
        let old = &system.states[index];
        State {
            variable: copy.variables[&old.variable],
            initial: initials[index],
            next: copy.term(old.next),
            ..old.clone()
        }
    };
    let mut out = System {
        pool: Pool::default(),
        inputs: system.inputs.clone(),
        states: kept.iter().map(|index| state(&mut copy, *index)).collect(),
        constraints,
        obligations: copy.labelled(&system.obligations),
        outputs: copy.labelled(&system.outputs),
    };
    for input in &mut out.inputs {
        input.variable = copy.variables[&input.variable];
    }
    out.pool = copy.new;
    Simplified { system: out, states: kept, facts: facts(system, &classes) }
}

/// That each state variable is what it was taken for.
fn facts(system: &System, classes: &[Class]) -> Vec<Vec<StateBit>> {
    let mut out = Vec::new();
    for (index, class) in classes.iter().enumerate() {
        let state = &system.states[index];
        let value = state.initial.and_then(|term| system.pool.value(term)).unwrap_or_default();
        for bit in 0..system.pool.width(state.variable) {
            let own = |value| StateBit { state: number(index), bit, value };
            match *class {
                Class::Constant => out.push(vec![own(value >> bit & 1 == 1)]),
                Class::First(first) if first == index => {}
                Class::First(first) => {
                    let other = |value| StateBit { state: number(first), bit, value };
                    out.push(vec![other(false), own(true)]);
                    out.push(vec![other(true), own(false)]);
                }
            }
        }
    }
    out
}

/// The classes that are kept by every step.
fn classes(system: &System) -> Vec<Class> {
    let alone: Vec<Class> = (0..system.states.len()).map(Class::First).collect();
    let constant = |state: &State| state.initial.is_some_and(|term| system.pool.value(term).is_some());
    let mut classes = alone.clone();
    for (class, _) in classes.iter_mut().zip(&system.states).filter(|(_, state)| constant(state)) {
        *class = Class::Constant;
    }
    for _ in 0..ROUNDS {
        let finer = split(system, &classes);
        if finer == classes {
            return classes;
        }
        classes = finer;
    }
    alone
}

/// Classes by the next values where each variable is what it is taken for.
fn split(system: &System, classes: &[Class]) -> Vec<Class> {
    let mut copy = Copy::new(system);
    copy.take(classes);
    copy.assume(&system.constraints);
    let mut firsts = BTreeMap::new();
    let mut out = Vec::with_capacity(classes.len());
    for (index, (state, class)) in system.states.iter().zip(classes).enumerate() {
        let next = copy.term(state.next);
        let first = state.initial.and_then(|term| system.pool.value(term));
        out.push(match class {
            Class::Constant if copy.new.value(next) == first => Class::Constant,
            _ if first.is_none() => Class::First(index),
            _ => Class::First(*firsts.entry((*class, first, next)).or_insert(index)),
        });
    }
    out
}

/// Terms made anew in another pool, with some of them replaced.
struct Copy<'s> {
    system: &'s System,
    new: Pool,
    /// What each variable is in the new pool where nothing replaces it.
    variables: FastMap<Term, Term>,
    replaced: FastMap<Term, Term>,
    map: FastMap<Term, Term>,
}

impl<'s> Copy<'s> {
    fn new(system: &'s System) -> Self {
        let (mut new, mut variables) = (Pool::default(), FastMap::default());
        let inputs = system.inputs.iter().map(|input| input.variable);
        for variable in inputs.chain(system.states.iter().map(|state| state.variable)) {
            if let Node::Var(var) = system.pool.node(variable) {
                variables.insert(variable, new.variable(system.pool.width(variable), system.pool.name(var)));
            }
        }
        Self { system, new, variables, replaced: FastMap::default(), map: FastMap::default() }
    }

    /// Replaces state variables by what they are taken for.
    fn take(&mut self, classes: &[Class]) {
        for (index, (class, state)) in classes.iter().zip(&self.system.states).enumerate() {
            let width = self.system.pool.width(state.variable);
            let value = state.initial.and_then(|term| self.system.pool.value(term)).unwrap_or_default();
            let target = match *class {
                Class::Constant => self.new.constant(width, value),
                Class::First(first) if first == index => continue,
                Class::First(first) => self.variables[&self.system.states[first].variable],
            };
            self.replaced.insert(state.variable, target);
        }
    }

    /// Replaces what the constraints say from here on.
    fn assume(&mut self, constraints: &[Labelled]) {
        let pool = &self.system.pool;
        let mut pending: Vec<(Term, bool)> = constraints.iter().map(|own| (own.term, true)).collect();
        self.map.clear();
        while let Some((term, holds)) = pending.pop() {
            match pool.node(term) {
                Node::Const(_) => continue,
                Node::Apply(Op::Not, [inner, ..]) => pending.push((inner, !holds)),
                Node::Apply(Op::And, [a, b, _]) if holds => pending.extend([(a, true), (b, true)]),
                Node::Apply(Op::Or, [a, b, _]) if !holds => pending.extend([(a, false), (b, false)]),
                Node::Apply(Op::Eq, [a, b, _]) if holds && matches!(pool.node(a), Node::Var(_)) => {
                    if let Some(value) = pool.value(b) {
                        let target = self.new.constant(pool.width(a), value);
                        self.replaced.entry(a).or_insert(target);
                    }
                }
                _ => {}
            }
            let truth = self.new.truth(holds);
            self.replaced.entry(term).or_insert(truth);
        }
    }

    fn term(&mut self, term: Term) -> Term {
        if let Some(known) = self.map.get(&term) {
            return *known;
        }
        let pool = &self.system.pool;
        for term in below(pool, [term]) {
            if self.map.contains_key(&term) {
                continue;
            }
            let new = match (self.replaced.get(&term), pool.node(term)) {
                (Some(target), _) => *target,
                (None, Node::Const(value)) => self.new.constant(pool.width(term), value),
                (None, Node::Var(var)) => match self.variables.get(&term) {
                    Some(own) => *own,
                    None => {
                        let own = self.new.variable(pool.width(term), pool.name(var));
                        self.variables.insert(term, own);
                        own
                    }
                },
                (None, Node::Apply(op, operands)) => {
                    let own = operands.map(|operand| self.map[&operand]);
                    self.new.apply(op, &own[..op.arity()])
                }
            };
            self.map.insert(term, new);
        }
        self.map[&term]
    }

    fn labelled(&mut self, list: &[Labelled]) -> Vec<Labelled> {
        list.iter().map(|own| Labelled { term: self.term(own.term), ..own.clone() }).collect()
    }
}
