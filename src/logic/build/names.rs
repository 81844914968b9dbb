//! The operators by name.

use crate::logic::term::{Op, Pool, Term};

macro_rules! unary {
    ($($(#[$doc:meta])* $name:ident $op:ident;)*) => {
        impl Pool {
            $($(#[$doc])*
            pub fn $name(&mut self, a: Term) -> Term {
                self.apply(Op::$op, &[a])
            })*
        }
    };
}

macro_rules! binary {
    ($($(#[$doc:meta])* $name:ident $op:ident;)*) => {
        impl Pool {
            $($(#[$doc])*
            pub fn $name(&mut self, a: Term, b: Term) -> Term {
                self.apply(Op::$op, &[a, b])
            })*
        }
    };
}

unary! {
    /// Bitwise complement; of a truth value, its negation.
    not Not;
    /// Two's complement negation.
    neg Neg;
}

binary! {
    /// Bitwise and.
    and And;
    /// Bitwise or.
    or Or;
    /// Bitwise exclusive or.
    xor Xor;
    /// Sum.
    add Add;
    /// Difference.
    sub Sub;
    /// Product.
    mul Mul;
    /// Unsigned quotient.
    udiv Udiv;
    /// Signed quotient.
    sdiv Sdiv;
    /// Unsigned remainder.
    urem Urem;
    /// Signed remainder.
    srem Srem;
    /// Shift left.
    shl Shl;
    /// Shift right with zeros.
    lshr Lshr;
    /// Shift right with the sign.
    ashr Ashr;
    /// Equality.
    eq Eq;
    /// Unsigned less.
    ult Ult;
    /// Unsigned less or equal.
    ule Ule;
    /// Signed less.
    slt Slt;
    /// Signed less or equal.
    sle Sle;
    /// One after the other, the first in front.
    concat Concat;
}

impl Pool {
    /// Whether they differ.
    pub fn ne(&mut self, a: Term, b: Term) -> Term {
        let equal = self.eq(a, b);
        self.not(equal)
    }

    /// Whether the second truth value holds where the first does.
    pub fn implies(&mut self, a: Term, b: Term) -> Term {
        let not = self.not(a);
        self.or(not, b)
    }

    /// If-then-else.
    pub fn ite(&mut self, condition: Term, then: Term, otherwise: Term) -> Term {
        self.apply(Op::Ite, &[condition, then, otherwise])
    }

    /// The bits `low ..= high`.
    pub fn extract(&mut self, a: Term, high: u32, low: u32) -> Term {
        self.apply(Op::Extract { high, low }, &[a])
    }

    /// Zeros in front, up to `width`.
    pub fn zero_extend(&mut self, a: Term, width: u32) -> Term {
        self.apply(Op::ZeroExtend(width), &[a])
    }

    /// The sign in front, up to `width`.
    pub fn sign_extend(&mut self, a: Term, width: u32) -> Term {
        self.apply(Op::SignExtend(width), &[a])
    }

    /// The highest bit.
    pub fn sign(&mut self, a: Term) -> Term {
        let high = self.width(a) - 1;
        self.extract(a, high, high)
    }

    /// The conjunction of truth values; true of none.
    pub fn all(&mut self, terms: impl IntoIterator<Item = Term>) -> Term {
        let start = self.truth(true);
        terms.into_iter().fold(start, |all, term| self.and(all, term))
    }

    /// The disjunction of truth values; false of none.
    pub fn any(&mut self, terms: impl IntoIterator<Item = Term>) -> Term {
        let start = self.truth(false);
        terms.into_iter().fold(start, |any, term| self.or(any, term))
    }
}
