//! A model over several cycles as one graph: the nodes that are asked for, folded and shared as the graph does it.

use std::collections::BTreeMap;

use crate::logic::aig::{Aig, Gate, Lit, Model};

/// Not computed yet.
const UNKNOWN: Lit = Lit(u32::MAX);

/// The unrolled graph.
pub(crate) struct Unrolling {
    model: Model,
    from_first: bool,
    /// What each latch's node becomes.
    next: BTreeMap<u32, Lit>,
    /// The graph.
    pub(crate) aig: Aig,
    cycles: Vec<Vec<Lit>>,
}

impl Unrolling {
    /// Runs that begin in a first state, or in any.
    pub(crate) fn new(model: &Model, from_first: bool) -> Self {
        let next = model.latches.iter().map(|l| (l.lit.node(), l.next)).collect();
        Self { model: model.clone(), from_first, next, aig: Aig::default(), cycles: Vec::new() }
    }

    pub(crate) fn bytes(&self) -> usize {
        self.cycles.len() * self.model.aig.len() * 4 + self.aig.len() * 60
    }

    fn open_cycle(&mut self) {
        let mut nodes = vec![UNKNOWN; self.model.aig.len()];
        nodes[0] = Lit::FALSE;
        if self.cycles.is_empty() {
            for latch in &self.model.latches {
                nodes[latch.lit.node() as usize] = match latch.initial {
                    Some(value) if self.from_first => Lit::FALSE.invert_if(value),
                    _ => self.aig.leaf(),
                };
            }
        }
        for input in &self.model.inputs {
            nodes[input.node() as usize] = self.aig.leaf();
        }
        self.cycles.push(nodes);
    }

    /// The literal in the cycle, counted from 0.
    pub(crate) fn at(&mut self, lit: Lit, cycle: usize) -> Lit {
        while self.cycles.len() <= cycle {
            self.open_cycle();
        }
        let mut open = vec![(lit.node(), cycle)];
        while let Some(&(node, cycle)) = open.last() {
            if self.cycles[cycle][node as usize] != UNKNOWN {
                open.pop();
                continue;
            }
            if let Some(value) = self.value(node, cycle, &mut open) {
                self.cycles[cycle][node as usize] = value;
                open.pop();
            }
        }
        self.known(lit, cycle).unwrap_or(Lit::FALSE)
    }

    fn known(&self, lit: Lit, cycle: usize) -> Option<Lit> {
        let value = self.cycles[cycle][lit.node() as usize];
        (value != UNKNOWN).then(|| value.invert_if(lit.inverted()))
    }

    /// The value, or what it takes to know it.
    fn value(&mut self, node: u32, cycle: usize, open: &mut Vec<(u32, usize)>) -> Option<Lit> {
        match self.model.aig.gate(node) {
            Gate::And(a, b) => match (self.known(a, cycle), self.known(b, cycle)) {
                (Some(Lit::FALSE), _) | (_, Some(Lit::FALSE)) => Some(Lit::FALSE),
                (Some(a), Some(b)) => Some(self.aig.and(a, b)),
                (None, _) => {
                    open.push((a.node(), cycle));
                    None
                }
                (_, None) => {
                    open.push((b.node(), cycle));
                    None
                }
            },
            _ => {
                let next = *self.next.get(&node).unwrap_or(&Lit::FALSE);
                let value = self.known(next, cycle - 1);
                if value.is_none() {
                    open.push((next.node(), cycle - 1));
                }
                value
            }
        }
    }
}
