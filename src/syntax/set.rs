//! Sets of token kinds, as bits.

use super::kind::TokenKind;

/// A set of token kinds.
#[derive(Clone, Copy, Debug)]
pub(super) struct TokenSet([u64; 4]);

impl TokenSet {
    /// The set of `kinds`.
    pub(super) const fn new(kinds: &[TokenKind]) -> Self {
        let mut bits = [0; 4];
        let mut i = 0;
        while i < kinds.len() {
            let kind = kinds[i] as usize;
            bits[kind / 64] |= 1 << (kind % 64);
            i += 1;
        }
        Self(bits)
    }

    /// What is in either set.
    pub(super) const fn union(self, other: Self) -> Self {
        Self([self.0[0] | other.0[0], self.0[1] | other.0[1], self.0[2] | other.0[2], self.0[3] | other.0[3]])
    }

    /// Whether `kind` is in the set.
    pub(super) const fn contains(self, kind: TokenKind) -> bool {
        let kind = kind as usize;
        self.0[kind / 64] & (1 << (kind % 64)) != 0
    }
}
