//! The cone of influence of some obligations: the part of a system that can matter for them.
//!
//! Every constraint stays, with what it depends on. One that shares no variable with the obligations could still end all
//! runs, and then the obligations hold; dropping it would not be exact.

use std::collections::{BTreeMap, BTreeSet};

use super::eval::below;
use super::system::System;
use super::term::{Node, Pool, Term};

/// A part of a system, and what it is part of. The terms are the same, in the same pool.
#[derive(Clone, Debug)]
pub struct Cone {
    /// The part.
    pub system: System,
    /// For each of its state variables, the number in the whole.
    pub states: Vec<usize>,
    /// For each of its inputs, the number in the whole.
    pub inputs: Vec<usize>,
}

impl System {
    /// What matters for the obligations with the numbers `obligations`, which are all that the part has. Outputs stay where
    /// they need nothing more.
    #[must_use]
    pub fn cone(&self, obligations: &[usize]) -> Cone {
        let kept: Vec<_> = obligations.iter().map(|index| self.obligations[*index].clone()).collect();
        let roots = kept.iter().chain(&self.constraints).map(|labelled| labelled.term);
        let needed = self.closure(roots.collect());
        let inside = |term: Term| needed.contains(&term);
        let outputs = self.outputs.iter().filter(|output| variables(&self.pool, output.term).into_iter().all(inside));
        let states: Vec<_> = (0..self.states.len()).filter(|index| inside(self.states[*index].variable)).collect();
        let inputs: Vec<_> = (0..self.inputs.len()).filter(|index| inside(self.inputs[*index].variable)).collect();
        let system = System {
            pool: self.pool.clone(),
            inputs: inputs.iter().map(|index| self.inputs[*index].clone()).collect(),
            states: states.iter().map(|index| self.states[*index].clone()).collect(),
            constraints: self.constraints.clone(),
            obligations: kept,
            outputs: outputs.cloned().collect(),
        };
        Cone { system, states, inputs }
    }

    /// The variables below `roots`, through next and initial values.
    fn closure(&self, mut pending: Vec<Term>) -> BTreeSet<Term> {
        let state_of: BTreeMap<Term, usize> =
            self.states.iter().enumerate().map(|(index, state)| (state.variable, index)).collect();
        let mut seen = vec![false; self.pool.len()];
        let mut needed = BTreeSet::new();
        while let Some(term) = pending.pop() {
            if std::mem::replace(&mut seen[term.0 as usize], true) {
                continue;
            }
            match self.pool.node(term) {
                Node::Const(_) => {}
                Node::Var(_) => {
                    needed.insert(term);
                    if let Some(index) = state_of.get(&term) {
                        pending.push(self.states[*index].next);
                        pending.extend(self.states[*index].initial);
                    }
                }
                Node::Apply(op, operands) => pending.extend(&operands[..op.arity()]),
            }
        }
        needed
    }
}

/// The variables in a term.
#[must_use]
pub fn variables(pool: &Pool, term: Term) -> Vec<Term> {
    let below = below(pool, [term]);
    below.into_iter().filter(|term| matches!(pool.node(*term), Node::Var(_))).collect()
}
