//! Terms on values. What a set of terms needs is listed once, operands first, so that evaluating it again costs one pass
//! without recursion.

use super::term::{Node, Pool, Term, Var};
use super::value::operate;

/// The terms that some roots are made of, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Evaluator {
    order: Vec<Term>,
}

/// Values of terms, by the last evaluation of an [`Evaluator`].
#[derive(Clone, Debug, Default)]
pub struct Values {
    values: Vec<u64>,
}

impl Values {
    /// The value of a term that was a root, or below one.
    #[must_use]
    pub fn get(&self, term: Term) -> u64 {
        self.values[term.0 as usize]
    }

    /// Whether a truth value holds.
    #[must_use]
    pub fn holds(&self, term: Term) -> bool {
        self.get(term) == 1
    }
}

/// The terms below `roots`, themselves included, operands before what they are operands of.
#[must_use]
pub fn below(pool: &Pool, roots: impl IntoIterator<Item = Term>) -> Vec<Term> {
    let mut seen = vec![false; pool.len()];
    let mut pending: Vec<Term> = roots.into_iter().collect();
    while let Some(term) = pending.pop() {
        if std::mem::replace(&mut seen[term.0 as usize], true) {
            continue;
        }
        if let Node::Apply(op, operands) = pool.node(term) {
            pending.extend(&operands[..op.arity()]);
        }
    }
    (0..).zip(seen).filter(|(_, seen)| *seen).map(|(number, _)| Term(number)).collect()
}

impl Evaluator {
    /// For the terms `roots` of `pool`.
    #[must_use]
    pub fn new(pool: &Pool, roots: impl IntoIterator<Item = Term>) -> Self {
        Self { order: below(pool, roots) }
    }

    /// Sets `values` to those of the roots and of all below, where a variable is what `variable` says, cut to its width.
    pub fn run(&self, pool: &Pool, variable: impl Fn(Var) -> u64, values: &mut Values) {
        values.values.resize(pool.len(), 0);
        for term in &self.order {
            let value = match pool.node(*term) {
                Node::Const(value) => value,
                Node::Var(var) => variable(var) & super::term::mask(pool.width(*term)),
                Node::Apply(op, operands) => {
                    let own = operands.map(|operand| values.values[operand.0 as usize]);
                    operate(op, own, operands.map(|operand| pool.width(operand)))
                }
            };
            values.values[term.0 as usize] = value;
        }
    }
}

/// The value of one term.
#[must_use]
pub fn evaluate(pool: &Pool, term: Term, variable: impl Fn(Var) -> u64) -> u64 {
    let mut values = Values::default();
    Evaluator::new(pool, [term]).run(pool, variable, &mut values);
    values.get(term)
}
