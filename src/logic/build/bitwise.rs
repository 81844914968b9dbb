//! Rewrites of bitwise operators and of if-then-else.

use crate::logic::term::{Op, Pool, Term, mask};

impl Pool {
    pub(super) fn rewrite_not(&mut self, a: Term) -> Option<Term> {
        self.complement(a)
    }

    pub(super) fn rewrite_and(&mut self, a: Term, b: Term) -> Option<Term> {
        if a == b {
            return Some(a);
        }
        if let Some(value) = self.value(b) {
            if value == 0 {
                return Some(b);
            }
            if value == mask(self.width(b)) {
                return Some(a);
            }
        }
        if self.opposite(a, b) {
            return Some(self.zero(a));
        }
        self.absorbed(Op::And, Op::Or, a, b)
            .or_else(|| self.absorbed(Op::And, Op::Or, b, a))
            .or_else(|| self.reordered(Op::And, a, b))
    }

    pub(super) fn rewrite_or(&mut self, a: Term, b: Term) -> Option<Term> {
        if a == b {
            return Some(a);
        }
        if let Some(value) = self.value(b) {
            if value == 0 {
                return Some(a);
            }
            if value == mask(self.width(b)) {
                return Some(b);
            }
        }
        if self.opposite(a, b) {
            return Some(self.ones(a));
        }
        self.absorbed(Op::Or, Op::And, a, b)
            .or_else(|| self.absorbed(Op::Or, Op::And, b, a))
            .or_else(|| self.reordered(Op::Or, a, b))
    }

    /// `a op inner` where `inner` is made of `a` and another: `a op (a op y)`, `a op (a dual y)`, `a op (!a op y)`,
    /// `a op (!a dual y)`, and the complement of `a dual y`.
    fn absorbed(&mut self, op: Op, dual: Op, a: Term, inner: Term) -> Option<Term> {
        if let Some([x, y, _]) = self.applies(op, inner) {
            if x == a || y == a {
                return Some(inner);
            }
            if self.opposite(x, a) || self.opposite(y, a) {
                return Some(if op == Op::And { self.zero(a) } else { self.ones(a) });
            }
        }
        if let Some([x, y, _]) = self.applies(dual, inner) {
            if x == a || y == a {
                return Some(a);
            }
            if self.opposite(x, a) {
                return Some(self.apply(op, &[a, y]));
            }
            if self.opposite(y, a) {
                return Some(self.apply(op, &[a, x]));
            }
        }
        None
    }

    pub(super) fn rewrite_xor(&mut self, a: Term, b: Term) -> Option<Term> {
        if a == b {
            return Some(self.zero(a));
        }
        if let Some(value) = self.value(b) {
            if value == 0 {
                return Some(a);
            }
            if value == mask(self.width(b)) {
                return Some(self.not(a));
            }
        }
        if self.opposite(a, b) {
            return Some(self.ones(a));
        }
        match (self.complement(a), self.complement(b)) {
            (Some(x), Some(y)) => Some(self.xor(x, y)),
            (Some(x), None) if self.value(b).is_none() => {
                let both = self.xor(x, b);
                Some(self.not(both))
            }
            (None, Some(y)) => {
                let both = self.xor(a, y);
                Some(self.not(both))
            }
            _ => self.reordered(Op::Xor, a, b),
        }
    }

    pub(super) fn rewrite_ite(&mut self, condition: Term, then: Term, otherwise: Term) -> Option<Term> {
        if then == otherwise {
            return Some(then);
        }
        if let Some(value) = self.value(condition) {
            return Some(if value == 1 { then } else { otherwise });
        }
        if let Some(inner) = self.complement(condition) {
            return Some(self.ite(inner, otherwise, then));
        }
        if self.width(then) == 1
            && let Some(term) = self.rewrite_choice_of_truth(condition, then, otherwise)
        {
            return Some(term);
        }
        self.rewrite_nested_ite(condition, then, otherwise)
    }

    fn rewrite_choice_of_truth(&mut self, condition: Term, then: Term, otherwise: Term) -> Option<Term> {
        if condition == then {
            return Some(self.or(condition, otherwise));
        }
        if condition == otherwise {
            return Some(self.and(condition, then));
        }
        match (self.value(then), self.value(otherwise)) {
            (Some(1), _) => Some(self.or(condition, otherwise)),
            (Some(_), _) => {
                let not = self.not(condition);
                Some(self.and(not, otherwise))
            }
            (_, Some(0)) => Some(self.and(condition, then)),
            (_, Some(_)) => {
                let not = self.not(condition);
                Some(self.or(not, then))
            }
            _ if self.opposite(then, otherwise) => {
                let differ = self.xor(condition, then);
                Some(self.not(differ))
            }
            _ => None,
        }
    }

    /// A branch that asks the same again, and branches that share one of their own.
    fn rewrite_nested_ite(&mut self, condition: Term, then: Term, otherwise: Term) -> Option<Term> {
        if let Some([inner, first, second]) = self.applies(Op::Ite, then) {
            if inner == condition {
                return Some(self.ite(condition, first, otherwise));
            }
            if second == otherwise {
                let both = self.and(condition, inner);
                return Some(self.ite(both, first, otherwise));
            }
            if first == otherwise {
                let not = self.not(inner);
                let both = self.and(condition, not);
                return Some(self.ite(both, second, otherwise));
            }
        }
        if let Some([inner, first, second]) = self.applies(Op::Ite, otherwise) {
            if inner == condition {
                return Some(self.ite(condition, then, second));
            }
            if first == then {
                let either = self.or(condition, inner);
                return Some(self.ite(either, then, second));
            }
            if second == then {
                let not = self.not(inner);
                let either = self.or(condition, not);
                return Some(self.ite(either, then, first));
            }
        }
        None
    }
}
