//! And-inverter graphs with structural hashing, and transition systems over them: what engines work on.

mod begin;
mod constants;
mod correspond;
mod reduce;
mod simulate;
mod sweep;
#[cfg(test)]
mod tests;

pub use constants::constants;
pub use correspond::correspond;
pub use reduce::{LatchClause, Reduced, cone};
pub(crate) use reduce::{identity, substituted, through};
pub use simulate::{BitSnapshot, Random, Trace, word};
pub use sweep::sweep;

use super::hash::FastMap;

/// An edge to a node, perhaps inverted: twice the node's number, plus one where it is inverted. As in AIGER.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Lit(pub u32);

impl Lit {
    /// The constant false.
    pub const FALSE: Self = Self(0);
    /// The constant true.
    pub const TRUE: Self = Self(1);

    /// The edge to `node`, not inverted.
    #[must_use]
    pub const fn of(node: u32) -> Self {
        Self(node << 1)
    }

    /// The node that it leads to.
    #[must_use]
    pub const fn node(self) -> u32 {
        self.0 >> 1
    }

    /// Whether it is inverted.
    #[must_use]
    pub const fn inverted(self) -> bool {
        self.0 & 1 == 1
    }

    /// The same edge, inverted if `by`.
    #[must_use]
    pub const fn invert_if(self, by: bool) -> Self {
        Self(self.0 ^ by as u32)
    }
}

impl std::ops::Not for Lit {
    type Output = Self;
    fn not(self) -> Self {
        Self(self.0 ^ 1)
    }
}

/// What a node is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Gate {
    /// Node 0.
    False,
    /// An input or a latch: nothing below.
    Leaf,
    /// The conjunction; operands have smaller numbers.
    And(Lit, Lit),
}

/// A graph.
#[derive(Clone, Debug)]
pub struct Aig {
    gates: Vec<Gate>,
    index: FastMap<(Lit, Lit), u32>,
}

impl Default for Aig {
    fn default() -> Self {
        Self { gates: vec![Gate::False], index: FastMap::default() }
    }
}

impl Aig {
    /// A new leaf.
    pub fn leaf(&mut self) -> Lit {
        self.gates.push(Gate::Leaf);
        Lit::of(u32::try_from(self.gates.len() - 1).expect("fewer than 2^31 nodes"))
    }

    /// The conjunction, shared and folded where its operands say so.
    pub fn and(&mut self, left: Lit, right: Lit) -> Lit {
        let (a, b) = if left <= right { (left, right) } else { (right, left) };
        if a == Lit::FALSE || a == !b {
            return Lit::FALSE;
        }
        if a == Lit::TRUE || a == b {
            return b;
        }
        let gates = &mut self.gates;
        let node = *self.index.entry((a, b)).or_insert_with(|| {
            gates.push(Gate::And(a, b));
            u32::try_from(gates.len() - 1).expect("fewer than 2^31 nodes")
        });
        Lit::of(node)
    }

    /// The disjunction.
    pub fn or(&mut self, left: Lit, right: Lit) -> Lit {
        !self.and(!left, !right)
    }

    /// The exclusive disjunction.
    pub fn xor(&mut self, left: Lit, right: Lit) -> Lit {
        let (neither, both) = (self.and(!left, !right), self.and(left, right));
        self.and(!neither, !both)
    }

    /// If-then-else.
    pub fn ite(&mut self, condition: Lit, then: Lit, otherwise: Lit) -> Lit {
        if then == otherwise {
            return then;
        }
        let (yes, no) = (self.and(condition, then), self.and(!condition, otherwise));
        self.or(yes, no)
    }

    /// A copy of a literal of another model's graph and of all below it, `inputs` being here what its inputs are there; of
    /// other leaves there must be none below.
    pub(crate) fn import(&mut self, other: &Model, inputs: &[Lit], lit: Lit) -> Lit {
        let mut needed = vec![false; lit.node() as usize + 1];
        needed[lit.node() as usize] = true;
        for node in (1..=lit.node()).rev() {
            if let (true, Gate::And(a, b)) = (needed[node as usize], other.aig.gate(node)) {
                needed[a.node() as usize] = true;
                needed[b.node() as usize] = true;
            }
        }
        let mut map = vec![Lit::FALSE; needed.len()];
        for (old, &new) in other.inputs.iter().zip(inputs).filter(|(old, _)| old.node() <= lit.node()) {
            map[old.node() as usize] = new;
        }
        for node in (1..=lit.node()).filter(|&node| needed[node as usize]) {
            if let Gate::And(a, b) = other.aig.gate(node) {
                map[node as usize] = self.and(through(&map, a), through(&map, b));
            }
        }
        through(&map, lit)
    }

    /// What the node is.
    #[must_use]
    pub fn gate(&self, node: u32) -> Gate {
        self.gates[node as usize]
    }

    /// How many nodes there are, the constant included.
    #[must_use]
    pub fn len(&self) -> usize {
        self.gates.len()
    }

    /// Never: the constant is always there.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.gates.is_empty()
    }
}

/// A latch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Latch {
    /// Its leaf, not inverted.
    pub lit: Lit,
    /// Its next value.
    pub next: Lit,
    /// Its first value; `None` is any.
    pub initial: Option<bool>,
}

/// A transition system over a graph, bit by bit.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// The graph.
    pub aig: Aig,
    /// The inputs: leaves, not inverted.
    pub inputs: Vec<Lit>,
    /// The latches.
    pub latches: Vec<Latch>,
    /// True in every cycle of the runs that are looked at.
    pub constraints: Vec<Lit>,
    /// A run that reaches a cycle in which one of these is true, while the constraints have been true up to and in that
    /// cycle, violates; the index names the property.
    pub bad: Vec<Lit>,
}

impl Model {
    /// The same model without constraints, for tools that know none: one more latch remembers whether they have held so
    /// far.
    #[must_use]
    pub fn folded(&self) -> Self {
        let mut model = self.clone();
        if model.constraints.is_empty() {
            return model;
        }
        let so_far = model.aig.leaf();
        let constraints = std::mem::take(&mut model.constraints);
        let holds = constraints.into_iter().fold(so_far, |all, constraint| model.aig.and(all, constraint));
        model.latches.push(Latch { lit: so_far, next: holds, initial: Some(true) });
        model.bad = self.bad.iter().map(|bad| model.aig.and(*bad, holds)).collect();
        model
    }
}
