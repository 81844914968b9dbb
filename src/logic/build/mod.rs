//! Making terms: an operator applied to operands gives the term of its result, with constants folded and with rewrites
//! that are local, cheap and always sound. They look at most two operators deep, so that making a term takes constant time.
//!
//! Normal forms that the rewrites keep to: a constant operand of a commutative operator stands last, others in the order
//! of making; `x - k` is `x + (-k)`; shifts by a constant are concatenations; `a <= b` is `not (b < a)`; the condition of
//! an if-then-else is not a complement.

mod arithmetic;
mod bitwise;
mod compare;
mod names;
mod structure;
#[cfg(test)]
mod tests;

use super::term::{Node, Op, Pool, Term, mask};
use super::value::operate;

impl Pool {
    /// The term of `op` on `operands`, folded and rewritten.
    ///
    /// The operands must be as many as the operator takes and of fitting widths: equal ones for arithmetic, bitwise operators
    /// and comparisons, 1 for the condition of an if-then-else, 32 or 64 for floats, an extension not narrower than its
    /// operand, an extract within its operand, a concatenation within 64 bits. Debug builds check.
    pub fn apply(&mut self, op: Op, operands: &[Term]) -> Term {
        debug_assert!(self.fits(op, operands), "{op:?} on widths {:?}", self.widths(operands));
        if let Some(value) = self.fold(op, operands) {
            let width = self.width_of(op, operands);
            return self.constant(width, value);
        }
        self.rewrite(op, operands).unwrap_or_else(|| self.plain(op, operands))
    }

    /// The operator applied exactly as it stands, shared but not rewritten.
    pub fn plain(&mut self, op: Op, operands: &[Term]) -> Term {
        let at = |index: usize| operands.get(index).copied().unwrap_or(operands[0]);
        let width = self.width_of(op, operands);
        self.intern(Node::Apply(op, [at(0), at(1), at(2)]), width)
    }

    /// The width of the result of `op` on `operands`.
    #[must_use]
    pub fn width_of(&self, op: Op, operands: &[Term]) -> u32 {
        match op {
            Op::Eq | Op::Ult | Op::Ule | Op::Slt | Op::Sle | Op::FloatEq | Op::FloatLt | Op::FloatLe => 1,
            Op::Ite => self.width(operands[1]),
            Op::Concat => self.width(operands[0]) + self.width(operands[1]),
            Op::Extract { high, low } => high - low + 1,
            Op::ZeroExtend(to)
            | Op::SignExtend(to)
            | Op::FloatToFloat(to)
            | Op::SignedToFloat(to)
            | Op::UnsignedToFloat(to)
            | Op::FloatToSigned(to)
            | Op::FloatToUnsigned(to)
            | Op::FloatTruncate(to) => to,
            _ => self.width(operands[0]),
        }
    }

    fn widths(&self, operands: &[Term]) -> Vec<u32> {
        operands.iter().map(|operand| self.width(*operand)).collect()
    }

    /// Whether the operands are as many, and as wide, as `op` wants them.
    #[must_use]
    pub fn fits(&self, op: Op, operands: &[Term]) -> bool {
        if operands.len() != op.arity() {
            return false;
        }
        let widths = self.widths(operands);
        let (first, float) = (widths[0], |width: u32| width == 32 || width == 64);
        match op {
            Op::Ite => first == 1 && widths[1] == widths[2],
            Op::Concat => first + widths[1] <= 64,
            Op::Extract { high, low } => low <= high && high < first,
            Op::ZeroExtend(to) | Op::SignExtend(to) => first <= to && to <= 64,
            Op::FloatSqrt => float(first),
            Op::FloatToFloat(to) => float(first) && float(to),
            Op::SignedToFloat(to) | Op::UnsignedToFloat(to) => float(to),
            Op::FloatToSigned(to) | Op::FloatToUnsigned(to) | Op::FloatTruncate(to) => {
                float(first) && (1..=64).contains(&to)
            }
            Op::FloatAdd | Op::FloatSub | Op::FloatMul | Op::FloatDiv | Op::FloatEq | Op::FloatLt | Op::FloatLe => {
                float(first) && first == widths[1]
            }
            Op::Not | Op::Neg => true,
            _ => first == widths[1],
        }
    }

    /// The value, where all operands are constants.
    fn fold(&self, op: Op, operands: &[Term]) -> Option<u64> {
        let (mut values, mut widths) = ([0; 3], [1; 3]);
        for (index, operand) in operands.iter().enumerate() {
            values[index] = self.value(*operand)?;
            widths[index] = self.width(*operand);
        }
        Some(operate(op, values, widths))
    }

    fn rewrite(&mut self, op: Op, operands: &[Term]) -> Option<Term> {
        let (a, b) = (operands[0], operands.get(1).copied().unwrap_or(operands[0]));
        match op {
            Op::Not => self.rewrite_not(a),
            Op::And => self.rewrite_and(a, b),
            Op::Or => self.rewrite_or(a, b),
            Op::Xor => self.rewrite_xor(a, b),
            Op::Neg => self.rewrite_neg(a),
            Op::Add => self.rewrite_add(a, b),
            Op::Sub => self.rewrite_sub(a, b),
            Op::Mul => self.rewrite_mul(a, b),
            Op::Udiv | Op::Urem | Op::Sdiv | Op::Srem => self.rewrite_division(op, a, b),
            Op::Shl | Op::Lshr | Op::Ashr => self.rewrite_shift(op, a, b),
            Op::Eq => self.rewrite_eq(a, b),
            Op::Ult => self.rewrite_ult(a, b),
            Op::Slt => self.rewrite_slt(a, b),
            Op::Ule => Some(self.not_less(Op::Ult, b, a)),
            Op::Sle => Some(self.not_less(Op::Slt, b, a)),
            Op::Ite => self.rewrite_ite(a, b, operands[2]),
            Op::Concat => self.rewrite_concat(a, b),
            Op::Extract { high, low } => self.rewrite_extract(a, high, low),
            Op::ZeroExtend(to) => self.rewrite_zero_extend(a, to),
            Op::SignExtend(to) => self.rewrite_sign_extend(a, to),
            Op::FloatToFloat(to) => self.rewrite_float_to_float(a, to),
            Op::FloatAdd | Op::FloatMul | Op::FloatEq if b < a => Some(self.plain(op, &[b, a])),
            _ => None,
        }
    }

    fn not_less(&mut self, op: Op, left: Term, right: Term) -> Term {
        let less = self.apply(op, &[left, right]);
        self.not(less)
    }

    /// Operands of a commutative operator in normal order; `None` where they stand so already.
    fn reordered(&mut self, op: Op, a: Term, b: Term) -> Option<Term> {
        let constant = self.value(a).is_some();
        (constant || (b < a && self.value(b).is_none())).then(|| self.apply(op, &[b, a]))
    }

    /// The operands of a term that applies exactly `op`.
    fn applies(&self, op: Op, term: Term) -> Option<[Term; 3]> {
        match self.node(term) {
            Node::Apply(own, operands) if own == op => Some(operands),
            _ => None,
        }
    }

    /// What the term is the complement of.
    fn complement(&self, term: Term) -> Option<Term> {
        self.applies(Op::Not, term).map(|operands| operands[0])
    }

    /// Whether each term is the complement of the other.
    fn opposite(&self, a: Term, b: Term) -> bool {
        self.complement(a) == Some(b) || self.complement(b) == Some(a)
    }

    /// The operand of a zero extension.
    fn zero_extended(&self, term: Term) -> Option<Term> {
        match self.node(term) {
            Node::Apply(Op::ZeroExtend(_), operands) => Some(operands[0]),
            _ => None,
        }
    }

    /// The operand of a sign extension.
    fn sign_extended(&self, term: Term) -> Option<Term> {
        match self.node(term) {
            Node::Apply(Op::SignExtend(_), operands) => Some(operands[0]),
            _ => None,
        }
    }

    /// The constant with all bits set, as wide as `like`.
    fn ones(&mut self, like: Term) -> Term {
        let width = self.width(like);
        self.constant(width, mask(width))
    }

    /// Zero, as wide as `like`.
    fn zero(&mut self, like: Term) -> Term {
        let width = self.width(like);
        self.constant(width, 0)
    }
}
