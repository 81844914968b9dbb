//! Rewrites of extracts, concatenations and extensions.

use crate::logic::term::{Node, Op, Pool, Term};

impl Pool {
    pub(super) fn rewrite_extract(&mut self, a: Term, high: u32, low: u32) -> Option<Term> {
        let width = self.width(a);
        if low == 0 && high + 1 == width {
            return Some(a);
        }
        let Node::Apply(op, operands) = self.node(a) else { return None };
        let inner = operands[0];
        match op {
            Op::Extract { low: below, .. } => Some(self.extract(inner, high + below, low + below)),
            Op::Concat => self.extract_of_concat(operands, high, low),
            Op::ZeroExtend(_) | Op::SignExtend(_) => self.extract_of_extension(op, inner, high, low),
            Op::Not | Op::And | Op::Or | Op::Xor if self.all_shrink(op, &operands) => {
                self.distributed(op, &operands, high, low)
            }
            Op::Neg | Op::Add | Op::Sub | Op::Mul if low == 0 && self.all_shrink(op, &operands) => {
                self.distributed(op, &operands, high, low)
            }
            Op::Ite if self.shrinks(operands[1]) && self.shrinks(operands[2]) => {
                let (then, otherwise) = (self.extract(operands[1], high, low), self.extract(operands[2], high, low));
                Some(self.ite(inner, then, otherwise))
            }
            _ => None,
        }
    }

    fn extract_of_concat(&mut self, operands: [Term; 3], high: u32, low: u32) -> Option<Term> {
        let [front, back, _] = operands;
        let border = self.width(back);
        if high < border {
            return Some(self.extract(back, high, low));
        }
        if low >= border {
            return Some(self.extract(front, high - border, low - border));
        }
        let (upper, lower) = (self.extract(front, high - border, 0), self.extract(back, border - 1, low));
        Some(self.concat(upper, lower))
    }

    fn extract_of_extension(&mut self, op: Op, inner: Term, high: u32, low: u32) -> Option<Term> {
        let (border, width) = (self.width(inner), high - low + 1);
        if high < border {
            return Some(self.extract(inner, high, low));
        }
        let zeros = matches!(op, Op::ZeroExtend(_));
        if low >= border && zeros {
            return Some(self.constant(width, 0));
        }
        let kept = self.extract(inner, border - 1, low.min(border - 1));
        Some(if zeros { self.zero_extend(kept, width) } else { self.sign_extend(kept, width) })
    }

    /// Whether an extract of the term is certainly no larger than the term.
    fn shrinks(&self, term: Term) -> bool {
        match self.node(term) {
            Node::Const(_) => true,
            Node::Var(_) => false,
            Node::Apply(op, _) => {
                matches!(op, Op::ZeroExtend(_) | Op::SignExtend(_) | Op::Extract { .. } | Op::Concat)
            }
        }
    }

    fn all_shrink(&self, op: Op, operands: &[Term; 3]) -> bool {
        operands[..op.arity()].iter().all(|operand| self.shrinks(*operand))
    }

    fn distributed(&mut self, op: Op, operands: &[Term; 3], high: u32, low: u32) -> Option<Term> {
        let mut parts = [operands[0]; 3];
        for (part, operand) in parts.iter_mut().zip(operands).take(op.arity()) {
            *part = self.extract(*operand, high, low);
        }
        Some(self.apply(op, &parts[..op.arity()]))
    }

    pub(super) fn rewrite_concat(&mut self, a: Term, b: Term) -> Option<Term> {
        let (front, back) = (self.width(a), self.width(b));
        if self.value(a) == Some(0) {
            return Some(self.zero_extend(b, front + back));
        }
        if let (
            Node::Apply(Op::Extract { high, low }, [x, ..]),
            Node::Apply(Op::Extract { high: top, low: bottom }, [y, ..]),
        ) = (self.node(a), self.node(b))
            && x == y
            && low == top + 1
        {
            return Some(self.extract(x, high, bottom));
        }
        if let Some(x) = self.zero_extended(a) {
            let both = self.concat(x, b);
            return Some(self.zero_extend(both, front + back));
        }
        if let Some(value) = self.value(b)
            && let Some([x, y, _]) = self.applies(Op::Concat, a)
            && let Some(middle) = self.value(y)
        {
            let tail = self.constant(self.width(y) + back, middle << back | value);
            return Some(self.concat(x, tail));
        }
        None
    }

    pub(super) fn rewrite_zero_extend(&mut self, a: Term, to: u32) -> Option<Term> {
        if self.width(a) == to {
            return Some(a);
        }
        self.zero_extended(a).map(|inner| self.zero_extend(inner, to))
    }

    pub(super) fn rewrite_sign_extend(&mut self, a: Term, to: u32) -> Option<Term> {
        if self.width(a) == to {
            return Some(a);
        }
        if let Some(inner) = self.sign_extended(a) {
            return Some(self.sign_extend(inner, to));
        }
        // A zero extension has a zero in front, since it is wider than its operand.
        self.zero_extended(a).map(|inner| self.zero_extend(inner, to))
    }

    /// Widening and narrowing back changes nothing but the bits of a NaN, so that only a number made by an operator, where a
    /// NaN is canonical already, comes back as it was.
    pub(super) fn rewrite_float_to_float(&mut self, a: Term, to: u32) -> Option<Term> {
        let Node::Apply(op, [inner, ..]) = self.node(a) else { return None };
        let canonical = |op| {
            matches!(
                op,
                Op::FloatAdd
                    | Op::FloatSub
                    | Op::FloatMul
                    | Op::FloatDiv
                    | Op::FloatSqrt
                    | Op::FloatToFloat(_)
                    | Op::SignedToFloat(_)
                    | Op::UnsignedToFloat(_)
            )
        };
        if to == self.width(a) && canonical(op) {
            return Some(a);
        }
        let back = op == Op::FloatToFloat(64) && to == 32 && self.width(inner) == 32;
        let made = matches!(self.node(inner), Node::Apply(op, _) if canonical(op));
        (back && made).then_some(inner)
    }
}
