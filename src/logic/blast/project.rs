//! Clauses over the model's latches as clauses over the bits of state variables.

use super::{Blasted, LatchBit};
use crate::logic::aig::LatchClause;
use crate::logic::certificate::StateBit;

impl Blasted {
    /// The clauses of an invariant, over the bits of state variables.
    ///
    /// Without [`LatchBit::First`] they are the same. With it, the invariant says `A` in the first cycle and `B` in later
    /// ones; then `A ∨ B` is an invariant too, and its clauses are those of `A` and `B` joined in pairs. It is inductive and
    /// safe as the other was: `A` and `B` each lead to `B`, and each excludes what is bad.
    #[must_use]
    pub fn project(&self, clauses: &[LatchClause]) -> Vec<Vec<StateBit>> {
        let mut out = if self.first().is_some() {
            let (early, late) = (self.within(clauses, true), self.within(clauses, false));
            let pairs = early.iter().flat_map(|a| late.iter().map(move |b| [a.as_slice(), b].concat()));
            pairs.collect()
        } else {
            self.within(clauses, false)
        };
        for clause in &mut out {
            clause.sort_unstable();
            clause.dedup();
        }
        out.retain(|clause: &Vec<StateBit>| {
            !clause.windows(2).any(|pair| pair[0].state == pair[1].state && pair[0].bit == pair[1].bit)
        });
        out.sort_unstable();
        out.dedup();
        out
    }

    /// The clauses that are left where the first cycle is, or is not, the present one.
    fn within(&self, clauses: &[LatchClause], first: bool) -> Vec<Vec<StateBit>> {
        let satisfied = |clause: &LatchClause| {
            clause.iter().any(|(latch, value)| self.latches[*latch] == LatchBit::First && *value == first)
        };
        let left = clauses.iter().filter(|clause| !satisfied(clause));
        left.map(|clause| clause.iter().filter_map(|(latch, value)| self.state_bit(*latch, *value)).collect()).collect()
    }
}
