//! Operators that a language lacks, as terms of bits: the operator's circuit, gate by gate.

use std::collections::HashMap;

use crate::logic::aig::{Gate, Lit};
use crate::logic::blast::Blaster;
use crate::logic::eval::below;
use crate::logic::system::{Labelled, System};
use crate::logic::term::{Node, Op, Pool, Term};

/// Rebuilds terms in a new pool.
struct Lowering<'s> {
    old: &'s Pool,
    new: Pool,
    map: HashMap<Term, Term>,
}

/// The system with every operator that is not `kept` made of conjunctions and complements of bits. Its variables, names and
/// runs are the same.
#[must_use]
pub fn lower(system: &System, kept: impl Fn(Op) -> bool) -> System {
    let mut lowering = Lowering { old: &system.pool, new: Pool::default(), map: HashMap::new() };
    let variables = system.inputs.iter().map(|input| input.variable);
    let variables: Vec<Term> = variables.chain(system.states.iter().map(|state| state.variable)).collect();
    let labelled = [&system.constraints, &system.obligations, &system.outputs].into_iter().flatten();
    let values = system.states.iter().flat_map(|state| [Some(state.next), state.initial]).flatten();
    let roots = labelled.map(|own| own.term).chain(values);
    for term in variables.iter().copied().chain(below(&system.pool, roots)) {
        lowering.rebuild(term, &kept);
    }
    let labels = |list: &[Labelled], map: &HashMap<Term, Term>| {
        list.iter().map(|own| Labelled { term: map[&own.term], ..own.clone() }).collect()
    };
    let mut out = System {
        pool: Pool::default(),
        inputs: system.inputs.clone(),
        states: system.states.clone(),
        constraints: labels(&system.constraints, &lowering.map),
        obligations: labels(&system.obligations, &lowering.map),
        outputs: labels(&system.outputs, &lowering.map),
    };
    for input in &mut out.inputs {
        input.variable = lowering.map[&input.variable];
    }
    for state in &mut out.states {
        state.variable = lowering.map[&state.variable];
        state.next = lowering.map[&state.next];
        state.initial = state.initial.map(|term| lowering.map[&term]);
    }
    out.pool = lowering.new;
    out
}

impl Lowering<'_> {
    fn rebuild(&mut self, term: Term, kept: &impl Fn(Op) -> bool) {
        if self.map.contains_key(&term) {
            return;
        }
        let width = self.old.width(term);
        let new = match self.old.node(term) {
            Node::Const(value) => self.new.constant(width, value),
            Node::Var(var) => self.new.variable(width, self.old.name(var)),
            Node::Apply(op, operands) => {
                let own = operands.map(|operand| self.map[&operand]);
                if kept(op) {
                    self.new.apply(op, &own[..op.arity()])
                } else {
                    self.circuit(op, &operands[..op.arity()], &own[..op.arity()])
                }
            }
        };
        self.map.insert(term, new);
    }

    /// The operator on the old operands as a circuit over bits of the new ones.
    fn circuit(&mut self, op: Op, old: &[Term], new: &[Term]) -> Term {
        let mut scratch = Pool::default();
        let variables: Vec<Term> = old.iter().map(|operand| scratch.variable(self.old.width(*operand), "")).collect();
        let term = scratch.plain(op, &variables);
        let mut blaster = Blaster::new(&scratch);
        let mut gates = vec![self.new.truth(false)];
        for (variable, new) in variables.iter().zip(new) {
            let leaves = blaster.fresh(*variable);
            gates.extend((0..).zip(leaves).map(|(bit, _)| self.new.extract(*new, bit, bit)));
        }
        blaster.blast([term]);
        let result = blaster.word(term).to_vec();
        let graph = blaster.finish();
        for node in u32::try_from(gates.len()).unwrap_or(u32::MAX)..u32::try_from(graph.len()).unwrap_or(u32::MAX) {
            let Gate::And(a, b) = graph.gate(node) else { continue };
            let (a, b) = (self.literal(&gates, a), self.literal(&gates, b));
            gates.push(self.new.and(a, b));
        }
        let bits: Vec<Term> = result.into_iter().map(|lit| self.literal(&gates, lit)).collect();
        let joined = bits.into_iter().reduce(|low, high| self.new.concat(high, low));
        joined.expect("a word has a bit")
    }

    fn literal(&mut self, gates: &[Term], lit: Lit) -> Term {
        let term = gates[lit.node() as usize];
        if lit.inverted() { self.new.not(term) } else { term }
    }
}
