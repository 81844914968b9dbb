//! A graph in clauses, as far as it is asked for: Tseitin's encoding (*On the Complexity of Derivation in Propositional
//! Calculus*, 1968), where exclusive ors and if-then-elses, which are three conjunctions in the graph, are one gate.

use super::Solver;
use crate::logic::aig::{Aig, Gate, Lit};

/// Which variable of a solver stands for which node. Use one for each copy of the graph, that is for each cycle.
#[derive(Clone, Debug, Default)]
pub struct Encoder {
    variables: Vec<i32>,
}

/// A node as a gate of clauses.
enum Shape {
    /// Both.
    And(Lit, Lit),
    /// Exclusive or.
    Xor(Lit, Lit),
    /// If-then-else.
    Ite(Lit, Lit, Lit),
}

impl Encoder {
    /// Lets `var` stand for the leaf `lit`.
    pub fn bind(&mut self, leaf: Lit, var: i32) {
        let node = leaf.node() as usize;
        self.reserve(node);
        self.variables[node] = if leaf.inverted() { -var } else { var };
    }

    /// The literal that stands for `lit`, if there is one already.
    #[must_use]
    pub fn known(&self, lit: Lit) -> Option<i32> {
        let var = self.variables.get(lit.node() as usize).copied().filter(|var| *var != 0)?;
        Some(if lit.inverted() { -var } else { var })
    }

    /// The value of `lit` in the model that the solver found. A node that no literal stands for is false, and its complement
    /// true.
    #[must_use]
    pub fn value(&self, lit: Lit, solver: &dyn Solver) -> bool {
        self.known(lit).map_or(lit.inverted(), |lit| solver.value(lit))
    }

    /// The literal that stands for `lit`, with the clauses for what is below it. A leaf that is not bound gets a variable.
    pub fn encode(&mut self, aig: &Aig, lit: Lit, solver: &mut dyn Solver) -> i32 {
        self.reserve(aig.len() - 1);
        let mut pending = vec![lit.node()];
        while let Some(node) = pending.last().copied() {
            if self.variables[node as usize] != 0 {
                pending.pop();
                continue;
            }
            let shape = match aig.gate(node) {
                Gate::False | Gate::Leaf => None,
                Gate::And(a, b) => Some(shape(aig, a, b)),
            };
            let operands = shape.as_ref().map_or([Lit::FALSE; 3], Shape::operands);
            let missing = operands.iter().map(|lit| lit.node()).filter(|node| self.variables[*node as usize] == 0);
            let before = pending.len();
            if shape.is_some() {
                pending.extend(missing);
            }
            if pending.len() == before {
                pending.pop();
                self.define(aig, node, shape, solver);
            }
        }
        self.known(lit).expect("just encoded")
    }

    fn define(&mut self, aig: &Aig, node: u32, shape: Option<Shape>, solver: &mut dyn Solver) {
        let own = solver.new_var();
        self.variables[node as usize] = own;
        let var = |lit: Lit| self.known(lit).expect("operands come first");
        match shape {
            None if aig.gate(node) == Gate::False => solver.add_clause(&[-own]),
            None => {}
            Some(Shape::And(a, b)) => {
                let (a, b) = (var(a), var(b));
                solver.add_clause(&[-own, a]);
                solver.add_clause(&[-own, b]);
                solver.add_clause(&[own, -a, -b]);
            }
            Some(Shape::Xor(a, b)) => {
                let (a, b) = (var(a), var(b));
                solver.add_clause(&[-own, a, b]);
                solver.add_clause(&[-own, -a, -b]);
                solver.add_clause(&[own, -a, b]);
                solver.add_clause(&[own, a, -b]);
            }
            Some(Shape::Ite(c, t, e)) => {
                let (c, t, e) = (var(c), var(t), var(e));
                solver.add_clause(&[-own, -c, t]);
                solver.add_clause(&[own, -c, -t]);
                solver.add_clause(&[-own, c, e]);
                solver.add_clause(&[own, c, -e]);
                // Redundant, but they let a value through where the condition is not known.
                solver.add_clause(&[-own, t, e]);
                solver.add_clause(&[own, -t, -e]);
            }
        }
    }

    fn reserve(&mut self, node: usize) {
        if self.variables.len() <= node {
            self.variables.resize(node + 1, 0);
        }
    }
}

impl Shape {
    fn operands(&self) -> [Lit; 3] {
        match *self {
            Self::And(a, b) | Self::Xor(a, b) => [a, b, a],
            Self::Ite(c, t, e) => [c, t, e],
        }
    }
}

/// `!(c & t) & !(!c & e)` is the complement of an if-then-else, that is `c ? !t : !e`; with `e = !t` an exclusive or.
fn shape(aig: &Aig, a: Lit, b: Lit) -> Shape {
    if let (true, true, Gate::And(p, q), Gate::And(r, s)) =
        (a.inverted(), b.inverted(), aig.gate(a.node()), aig.gate(b.node()))
    {
        for (condition, then, other, otherwise) in [(p, q, r, s), (p, q, s, r), (q, p, r, s), (q, p, s, r)] {
            if condition == !other {
                return if then == !otherwise {
                    Shape::Xor(condition, then)
                } else {
                    Shape::Ite(condition, !then, !otherwise)
                };
            }
        }
    }
    Shape::And(a, b)
}
