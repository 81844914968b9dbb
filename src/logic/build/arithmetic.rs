//! Rewrites of sums, products, quotients and shifts.

use crate::logic::term::{Op, Pool, Term, mask};

impl Pool {
    pub(super) fn rewrite_neg(&mut self, a: Term) -> Option<Term> {
        if self.width(a) == 1 {
            return Some(a);
        }
        self.applies(Op::Neg, a).map(|operands| operands[0])
    }

    pub(super) fn rewrite_add(&mut self, a: Term, b: Term) -> Option<Term> {
        if self.width(a) == 1 {
            return Some(self.xor(a, b));
        }
        if let Some(value) = self.value(b) {
            if value == 0 {
                return Some(a);
            }
            if let Some([x, inner, _]) = self.applies(Op::Add, a)
                && let Some(other) = self.value(inner)
            {
                let sum = self.constant(self.width(a), other.wrapping_add(value));
                return Some(self.add(x, sum));
            }
        }
        if let Some([x, ..]) = self.applies(Op::Neg, b) {
            return Some(self.sub(a, x));
        }
        if let Some([x, ..]) = self.applies(Op::Neg, a) {
            return Some(self.sub(b, x));
        }
        self.undone_sum(a, b).or_else(|| self.undone_sum(b, a)).or_else(|| self.reordered(Op::Add, a, b))
    }

    /// `a + (x - a)` is `x`.
    fn undone_sum(&self, a: Term, difference: Term) -> Option<Term> {
        self.applies(Op::Sub, difference).filter(|operands| operands[1] == a).map(|operands| operands[0])
    }

    pub(super) fn rewrite_sub(&mut self, a: Term, b: Term) -> Option<Term> {
        if a == b {
            return Some(self.zero(a));
        }
        if self.width(a) == 1 {
            return Some(self.xor(a, b));
        }
        if let Some(value) = self.value(b) {
            let negative = self.constant(self.width(b), value.wrapping_neg());
            return Some(self.add(a, negative));
        }
        if self.value(a) == Some(0) {
            return Some(self.neg(b));
        }
        if let Some([x, ..]) = self.applies(Op::Neg, b) {
            return Some(self.add(a, x));
        }
        if let Some([x, y, _]) = self.applies(Op::Add, a) {
            if x == b {
                return Some(y);
            }
            if y == b {
                return Some(x);
            }
        }
        None
    }

    pub(super) fn rewrite_mul(&mut self, a: Term, b: Term) -> Option<Term> {
        if self.width(a) == 1 {
            return Some(self.and(a, b));
        }
        if let Some(value) = self.value(b) {
            if value == 0 {
                return Some(b);
            }
            if value == 1 {
                return Some(a);
            }
            if value == mask(self.width(b)) {
                return Some(self.neg(a));
            }
            if value.is_power_of_two() {
                return Some(self.shifted_left(a, value.trailing_zeros()));
            }
            if let Some([x, inner, _]) = self.applies(Op::Mul, a)
                && let Some(other) = self.value(inner)
            {
                let product = self.constant(self.width(a), other.wrapping_mul(value));
                return Some(self.mul(x, product));
            }
        }
        self.reordered(Op::Mul, a, b)
    }

    pub(super) fn rewrite_division(&mut self, op: Op, a: Term, b: Term) -> Option<Term> {
        let value = self.value(b)?;
        let width = self.width(a);
        match (op, value) {
            (Op::Udiv, 0) => Some(self.ones(a)),
            (Op::Urem | Op::Srem, 0) => Some(a),
            (Op::Sdiv, 0) => {
                let negative = self.sign(a);
                let (one, ones) = (self.constant(width, 1), self.ones(a));
                Some(self.ite(negative, one, ones))
            }
            // With one bit, 1 is -1 for the signed operators.
            (Op::Udiv | Op::Sdiv, 1) if width > 1 => Some(a),
            (Op::Urem | Op::Srem, 1) if width > 1 => Some(self.zero(a)),
            (Op::Udiv, _) if value.is_power_of_two() => Some(self.shifted_right(a, value.trailing_zeros())),
            (Op::Urem, _) if value.is_power_of_two() && value > 1 => {
                let low = self.extract(a, value.trailing_zeros() - 1, 0);
                Some(self.zero_extend(low, width))
            }
            _ => None,
        }
    }

    pub(super) fn rewrite_shift(&mut self, op: Op, a: Term, b: Term) -> Option<Term> {
        if self.value(a) == Some(0) {
            return Some(a);
        }
        let (width, by) = (self.width(a), self.value(b)?);
        let by = u32::try_from(by.min(u64::from(width))).unwrap_or(width);
        match op {
            Op::Shl => Some(self.shifted_left(a, by)),
            Op::Lshr => Some(self.shifted_right(a, by)),
            _ => {
                let high = self.extract(a, width - 1, by.min(width - 1));
                Some(self.sign_extend(high, width))
            }
        }
    }

    fn shifted_left(&mut self, a: Term, by: u32) -> Term {
        let width = self.width(a);
        if by == 0 {
            return a;
        }
        if by >= width {
            return self.zero(a);
        }
        let (low, zeros) = (self.extract(a, width - 1 - by, 0), self.constant(by, 0));
        self.concat(low, zeros)
    }

    fn shifted_right(&mut self, a: Term, by: u32) -> Term {
        let width = self.width(a);
        if by >= width {
            return self.zero(a);
        }
        let high = self.extract(a, width - 1, by);
        self.zero_extend(high, width)
    }
}
