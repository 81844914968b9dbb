//! Rewrites of comparisons: what is decided by equal operands, by the ends of the range, and by the bits that an
//! extension adds.

use crate::logic::term::{Op, Pool, Term, mask};
use crate::logic::value::signed;

impl Pool {
    pub(super) fn rewrite_eq(&mut self, a: Term, b: Term) -> Option<Term> {
        if a == b {
            return Some(self.truth(true));
        }
        if self.opposite(a, b) {
            return Some(self.truth(false));
        }
        if let Some(value) = self.value(b) {
            return self.rewrite_eq_constant(a, b, value);
        }
        if self.value(a).is_some() {
            return Some(self.eq(b, a));
        }
        if let (Some(x), Some(y)) = (self.complement(a), self.complement(b)) {
            return Some(self.eq(x, y));
        }
        for extended in [Self::zero_extended, Self::sign_extended] {
            if let (Some(x), Some(y)) = (extended(self, a), extended(self, b))
                && self.width(x) == self.width(y)
            {
                return Some(self.eq(x, y));
            }
        }
        self.rewrite_eq_of_sums(a, b).or_else(|| self.rewrite_eq_of_sums(b, a)).or_else(|| self.reordered(Op::Eq, a, b))
    }

    fn rewrite_eq_of_sums(&mut self, a: Term, b: Term) -> Option<Term> {
        let [x, y, _] = self.applies(Op::Add, a)?;
        if x != b && y != b {
            return None;
        }
        let (rest, zero) = (if x == b { y } else { x }, self.zero(a));
        Some(self.eq(rest, zero))
    }

    fn rewrite_eq_constant(&mut self, a: Term, b: Term, value: u64) -> Option<Term> {
        let width = self.width(a);
        if width == 1 {
            return Some(if value == 1 { a } else { self.not(a) });
        }
        if let Some(x) = self.complement(a) {
            let opposite = self.constant(width, !value);
            return Some(self.eq(x, opposite));
        }
        if let Some(x) = self.zero_extended(a) {
            return Some(self.eq_narrow(x, value, value & mask(self.width(x))));
        }
        if let Some(x) = self.sign_extended(a) {
            let low = value & mask(self.width(x));
            return Some(self.eq_narrow(x, value, signed(low, self.width(x)).cast_unsigned() & mask(width)));
        }
        if let Some([x, y, _]) = self.applies(Op::Add, a)
            && let Some(other) = self.value(y)
        {
            let difference = self.constant(width, value.wrapping_sub(other));
            return Some(self.eq(x, difference));
        }
        if let Some([x, y, _]) = self.applies(Op::Concat, a) {
            let low_width = self.width(y);
            let (high, low) = (self.constant(self.width(x), value >> low_width), self.constant(low_width, value));
            let (left, right) = (self.eq(x, high), self.eq(y, low));
            return Some(self.and(left, right));
        }
        self.rewrite_eq_of_choice(a, b)
    }

    /// `x` equals the low bits of `value`, where its extension gives `extended` for them.
    fn eq_narrow(&mut self, x: Term, value: u64, extended: u64) -> Term {
        if value != extended {
            return self.truth(false);
        }
        let low = self.constant(self.width(x), value);
        self.eq(x, low)
    }

    /// A choice one of whose branches is a constant, compared with a constant.
    fn rewrite_eq_of_choice(&mut self, a: Term, constant: Term) -> Option<Term> {
        let [condition, then, otherwise] = self.applies(Op::Ite, a)?;
        let (first, second) = (self.value(then).is_some(), self.value(otherwise).is_some());
        match (first, second) {
            (true, true) => {
                let (left, right) = (self.truth(then == constant), self.truth(otherwise == constant));
                Some(self.ite(condition, left, right))
            }
            (true, false) => {
                let (left, right) = (self.truth(then == constant), self.plain_eq(otherwise, constant));
                Some(self.ite(condition, left, right))
            }
            (false, true) => {
                let (left, right) = (self.plain_eq(then, constant), self.truth(otherwise == constant));
                Some(self.ite(condition, left, right))
            }
            (false, false) => None,
        }
    }

    /// Equality without a look into `a` where it is a choice, so that a chain of choices is not walked down.
    fn plain_eq(&mut self, a: Term, constant: Term) -> Term {
        match self.applies(Op::Ite, a) {
            Some(_) => self.plain(Op::Eq, &[a, constant]),
            None => self.eq(a, constant),
        }
    }

    pub(super) fn rewrite_ult(&mut self, a: Term, b: Term) -> Option<Term> {
        if a == b {
            return Some(self.truth(false));
        }
        if self.width(a) == 1 {
            let not = self.not(a);
            return Some(self.and(not, b));
        }
        let highest = mask(self.width(a));
        match (self.value(a), self.value(b)) {
            (Some(value), _) if value == highest => return Some(self.truth(false)),
            (_, Some(0)) => return Some(self.truth(false)),
            (Some(0), _) => {
                let zero = self.eq(b, a);
                return Some(self.not(zero));
            }
            (Some(value), _) if value == highest - 1 => {
                let end = self.constant(self.width(b), highest);
                return Some(self.eq(b, end));
            }
            (_, Some(1)) => {
                let zero = self.zero(a);
                return Some(self.eq(a, zero));
            }
            (_, Some(value)) if value == highest => {
                let end = self.eq(a, b);
                return Some(self.not(end));
            }
            _ => {}
        }
        self.narrowed_less(Op::Ult, a, b)
    }

    pub(super) fn rewrite_slt(&mut self, a: Term, b: Term) -> Option<Term> {
        if a == b {
            return Some(self.truth(false));
        }
        let width = self.width(a);
        if width == 1 {
            let not = self.not(b);
            return Some(self.and(a, not));
        }
        let (lowest, highest) = (1 << (width - 1), mask(width) >> 1);
        match (self.value(a), self.value(b)) {
            (Some(value), _) if value == highest => return Some(self.truth(false)),
            (_, Some(value)) if value == lowest => return Some(self.truth(false)),
            (_, Some(0)) => return Some(self.sign(a)),
            (Some(value), _) if value == mask(width) => {
                let negative = self.sign(b);
                return Some(self.not(negative));
            }
            (Some(value), _) if value == lowest => {
                let end = self.eq(b, a);
                return Some(self.not(end));
            }
            (_, Some(value)) if value == highest => {
                let end = self.eq(a, b);
                return Some(self.not(end));
            }
            _ => {}
        }
        self.narrowed_less(Op::Slt, a, b)
    }

    /// A comparison of extended operands, decided below the bits that the extensions add.
    fn narrowed_less(&mut self, op: Op, a: Term, b: Term) -> Option<Term> {
        if let Some(width) = self.fit(a, b, Self::zero_extended, |value, width| value & mask(width)) {
            let (x, y) = (self.extract(a, width - 1, 0), self.extract(b, width - 1, 0));
            return Some(self.apply(Op::Ult, &[x, y]));
        }
        // A sign extension keeps the signed order and the unsigned one.
        let extend =
            |full: u32| move |value: u64, width: u32| signed(value & mask(width), width).cast_unsigned() & mask(full);
        let full = self.width(a);
        let width = self.fit(a, b, Self::sign_extended, extend(full))?;
        let (x, y) = (self.extract(a, width - 1, 0), self.extract(b, width - 1, 0));
        Some(self.apply(op, &[x, y]))
    }

    /// The width into which both operands fit by the extension: at least one is extended, the other too or a constant.
    fn fit(
        &self,
        a: Term,
        b: Term,
        extended: fn(&Self, Term) -> Option<Term>,
        extend: impl Fn(u64, u32) -> u64,
    ) -> Option<u32> {
        let own = |term: Term| extended(self, term).map(|inner| self.width(inner));
        match (own(a), own(b)) {
            (Some(x), Some(y)) => Some(x.max(y)),
            (Some(x), None) => self.value(b).filter(|value| extend(*value, x) == *value).map(|_| x),
            (None, Some(y)) => self.value(a).filter(|value| extend(*value, y) == *value).map(|_| y),
            (None, None) => None,
        }
    }
}
