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
}
