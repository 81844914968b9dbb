//! The certificate of a safety property of a [`System`](super::system::System): data that a checker needs no engine to
//! believe.
//!
//! It speaks of single bits of the system's state variables, and of conjunctions of such that it defines as gates. Let `Inv` be the conjunction of its clauses. What a
//! checker has to show, all of it by propositional queries over the constraints `C` of the system, its first
//! states `I` and its transitions `T`:
//!
//! * `I ∧ C → Inv` and `Inv ∧ C ∧ T ∧ C' → Inv'`: the invariant holds in every cycle;
//! * with `k = 1`: `Inv ∧ C → P`, where `P` says that no obligation fails;
//! * with `k > 1`: `P` holds in the first `k` cycles, and `k` successive cycles in which `Inv`, `C` and `P` hold, pairwise
//!   different in their states where `simple_path` is set, are followed by one in which `P` holds (Sheeran, Singh and
//!   Stålmarck, *Checking Safety Properties Using Induction and a SAT-Solver*, FMCAD 2000).

use std::collections::{BTreeMap, BTreeSet};

use super::system::System;

/// A bit of a state variable with a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct StateBit {
    /// The index of the state variable in its system.
    pub state: u32,
    /// The number of the bit, from the least significant one.
    pub bit: u32,
    /// The value that satisfies the literal.
    pub value: bool,
}

/// A literal of a clause, or an operand of a gate.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Fact {
    /// A bit of a state variable has the value.
    Bit(StateBit),
    /// The gate of the certificate with this number has the value.
    Gate(u32, bool),
}

/// A certificate.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Certificate {
    /// Conjunctions that clauses may speak of; the operands of each are bits, or gates with smaller numbers.
    pub gates: Vec<[Fact; 2]>,
    /// The invariant, in conjunctive form; each clause ascending, the clauses ascending.
    pub clauses: Vec<Vec<Fact>>,
    /// 1 where the invariant alone is enough, else the bound of the induction.
    pub k: u32,
    /// Whether the steps of the induction are pairwise different states.
    pub simple_path: bool,
}

impl Certificate {
    /// Brings clauses and literals in their canonical order, without repetition.
    #[must_use]
    pub fn sorted(mut self) -> Self {
        for clause in &mut self.clauses {
            clause.sort_unstable();
            clause.dedup();
        }
        self.clauses.sort_unstable();
        self.clauses.dedup();
        self
    }

    /// The invariant, which speaks of a system's states by their index, about another system that has these states among its
    /// own. `None` where a name does not tell which state is which.
    #[must_use]
    pub fn moved(&self, from: &System, to: &System) -> Option<Self> {
        let mut places = BTreeMap::new();
        for (index, state) in to.states.iter().enumerate() {
            let twice = places.insert(state.name.as_str(), u32::try_from(index).ok()?);
            if twice.is_some() {
                return None;
            }
        }
        let names: BTreeSet<&str> = from.states.iter().map(|state| state.name.as_str()).collect();
        if names.len() < from.states.len() {
            return None;
        }
        let fact = |fact: &Fact| match fact {
            Fact::Bit(bit) => {
                let name = from.states.get(bit.state as usize)?.name.as_str();
                Some(Fact::Bit(StateBit { state: *places.get(name)?, ..*bit }))
            }
            Fact::Gate(..) => Some(*fact),
        };
        let gates = self.gates.iter().map(|[one, other]| Some([fact(one)?, fact(other)?])).collect::<Option<_>>()?;
        let clauses = self.clauses.iter().map(|clause| clause.iter().map(fact).collect()).collect::<Option<_>>()?;
        Some(Self { gates, clauses, k: 1, simple_path: false }.sorted())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::logic::system::State;
    use crate::logic::term::Pool;

    fn system(names: &[&str]) -> System {
        let mut pool = Pool::default();
        let state = |name: &&str| {
            let variable = pool.variable(4, *name);
            State { variable, name: (*name).to_owned(), initial: None, next: variable, origin: None }
        };
        let states = names.iter().map(state).collect();
        System { pool, states, ..System::default() }
    }

    #[test]
    fn an_invariant_follows_its_states_to_another_system() {
        let bit = |state, bit| Fact::Bit(StateBit { state, bit, value: true });
        let own = Certificate {
            gates: vec![[bit(0, 3), bit(1, 2)]],
            clauses: vec![vec![bit(1, 0), Fact::Gate(0, false)]],
            k: 3,
            simple_path: true,
        };
        let there = own.moved(&system(&["a", "b"]), &system(&["b", "probe", "a"])).expect("all names are there, once");
        assert_eq!((there.k, there.simple_path), (1, false));
        assert_eq!(there.gates, [[bit(2, 3), bit(0, 2)]]);
        assert_eq!(there.clauses, [vec![bit(0, 0), Fact::Gate(0, false)]]);
        assert_eq!(own.moved(&system(&["a", "b"]), &system(&["b", "probe"])), None, "a is missing");
        assert_eq!(own.moved(&system(&["a", "b"]), &system(&["a", "b", "b"])), None, "which b?");
        assert_eq!(own.moved(&system(&["a", "a"]), &system(&["a", "b"])), None, "which a?");
    }
}
