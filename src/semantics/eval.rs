//! The operators on values: raw bits in, raw bits out, by the type of the operands. Faults are values.
//!
//! Integers are computed in 128 bits and cut to the width, which is two's complement by definition. `REAL` and `LREAL` are
//! the host's `f32` and `f64`, which are IEEE 754 with rounding to nearest, ties to even; a result that is not a number is
//! always the same quiet NaN (positive, payload zero), since IEEE 754 leaves its bits open.

mod convert;
mod fixed;
mod real;
#[cfg(test)]
mod tests;

use super::expr::{Expr, ExprKind, Fault, Op};
use super::scalar::Scalar;
use crate::text::Place;

/// A fault and where it happened.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FaultAt {
    /// What went wrong.
    pub fault: Fault,
    /// Where, if a source text says so.
    pub place: Option<Place>,
}

/// What the leaves of an expression hold.
pub trait Leaves<L> {
    /// The value of a leaf.
    ///
    /// # Errors
    /// Where reading it faults: an index out of bounds, a null reference.
    fn read(&mut self, leaf: &L) -> Result<u64, FaultAt>;

    /// Its address.
    ///
    /// # Errors
    /// As for [`Leaves::read`].
    fn address(&mut self, leaf: &L) -> Result<u64, FaultAt>;
}

/// The value of `expr`.
///
/// # Errors
/// The first fault of the parts that are evaluated, from left to right.
pub fn evaluate<L>(expr: &Expr<L>, leaves: &mut impl Leaves<L>) -> Result<u64, FaultAt> {
    match &expr.kind {
        ExprKind::Const(value) => Ok(*value),
        ExprKind::Read(leaf) => leaves.read(leaf),
        ExprKind::Address(leaf) => leaves.address(leaf),
        ExprKind::AndThen(first, second) => match evaluate(first, leaves)? {
            0 => Ok(0),
            _ => evaluate(second, leaves),
        },
        ExprKind::OrElse(first, second) => match evaluate(first, leaves)? {
            0 => evaluate(second, leaves),
            value => Ok(value),
        },
        ExprKind::If(condition, then, otherwise) => {
            let taken = if evaluate(condition, leaves)? == 0 { otherwise } else { then };
            evaluate(taken, leaves)
        }
        ExprKind::Apply(op, operands) => {
            let values: Result<Vec<_>, _> =
                operands.iter().map(|operand| Ok((operand.scalar, evaluate(operand, leaves)?))).collect();
            apply(*op, expr.scalar, &values?).map_err(|fault| FaultAt { fault, place: expr.place })
        }
    }
}

/// The result of `op`, of type `scalar`, for operands with their types. An operand that is left out counts as zero.
///
/// # Errors
/// [`Fault::DivisionByZero`].
pub fn apply(op: Op, scalar: Scalar, operands: &[(Scalar, u64)]) -> Result<u64, Fault> {
    let operand = |index: usize| operands.get(index).copied().unwrap_or((scalar, 0));
    let (of, first) = operand(0);
    match op {
        Op::Select => Ok(if first == 0 { operand(2).1 } else { operand(1).1 }),
        _ if is_unary(op) => Ok(unary(op, scalar, of, first)),
        _ => binary(op, of, first, operand(1).1),
    }
}

/// Whether `op` takes one operand.
#[must_use]
pub const fn is_unary(op: Op) -> bool {
    match op {
        Op::Neg | Op::Not | Op::Abs | Op::Sqrt | Op::Trunc | Op::Convert | Op::Reinterpret => true,
        Op::Real(function) => !real::takes_two(function),
        _ => false,
    }
}

/// The result of an operator with one operand: `value`, of type `from`; the result has type `to`.
#[must_use]
#[inline]
pub fn unary(op: Op, to: Scalar, from: Scalar, value: u64) -> u64 {
    match op {
        Op::Not => mask(to, !value),
        Op::Convert => convert::convert(to, from, value),
        Op::Trunc => convert::truncate(to, from, value),
        Op::Reinterpret => mask(to, value),
        _ => match to {
            Scalar::Real(width) => real::unary(op, width, value),
            Scalar::Fixed { width, .. } => fixed::unary(op, width, value),
            _ => whole_unary(op, to, value),
        },
    }
}

fn whole_unary(op: Op, scalar: Scalar, value: u64) -> u64 {
    let negative = scalar.is_signed() && scalar.number(value) < 0;
    match op {
        Op::Neg => mask(scalar, value.wrapping_neg()),
        Op::Abs if negative => mask(scalar, value.wrapping_neg()),
        _ => value,
    }
}

/// The result of an operator with two operands of type `of`.
///
/// # Errors
/// [`Fault::DivisionByZero`].
#[inline]
pub fn binary(op: Op, of: Scalar, left: u64, right: u64) -> Result<u64, Fault> {
    match op {
        Op::And => Ok(left & right),
        Op::Or => Ok(left | right),
        Op::Xor => Ok(left ^ right),
        Op::Bit => Ok(left.checked_shr(shift_count(right)).unwrap_or(0) & 1),
        Op::Shl | Op::Shr | Op::Sar | Op::Rol | Op::Ror => Ok(shift(op, of, left, right)),
        _ => match of {
            Scalar::Real(width) => Ok(real::binary(op, width, left, right)),
            Scalar::Fixed { digits, width } if !matches!(op, Op::Eq | Op::Lt | Op::Le) => {
                Ok(fixed::binary(op, digits, width, left, right))
            }
            _ => whole_binary(op, of, left, right),
        },
    }
}

#[inline]
fn whole_binary(op: Op, of: Scalar, left: u64, right: u64) -> Result<u64, Fault> {
    Ok(match op {
        Op::Eq => u64::from(left == right),
        Op::Lt => u64::from(ordered(of, left) < ordered(of, right)),
        Op::Le => u64::from(ordered(of, left) <= ordered(of, right)),
        Op::Add => mask(of, left.wrapping_add(right)),
        Op::Sub => mask(of, left.wrapping_sub(right)),
        Op::Mul => mask(of, left.wrapping_mul(right)),
        Op::Div | Op::Mod => return divide(op, of, left, right),
        _ => left,
    })
}

/// The quotient or the remainder; that of the least number and -1 wraps around.
fn divide(op: Op, of: Scalar, left: u64, right: u64) -> Result<u64, Fault> {
    if right == 0 {
        return Err(Fault::DivisionByZero);
    }
    let (left, right) = (of.number(left), of.number(right));
    Ok(of.bits(if op == Op::Div { left / right } else { left % right }))
}

/// A number that is ordered as the values of the type are.
#[inline]
const fn ordered(of: Scalar, value: u64) -> u64 {
    let width = of.width();
    if of.is_signed() { (value << (64 - width)) ^ (1 << 63) } else { value }
}

/// `value` cut to the width of `scalar`.
#[must_use]
#[inline]
pub const fn mask(scalar: Scalar, value: u64) -> u64 {
    value & (u64::MAX >> (64 - scalar.width()))
}

fn shift_count(count: u64) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

fn shift(op: Op, of: Scalar, value: u64, count: u64) -> u64 {
    let width = of.width();
    match op {
        Op::Shl => mask(of, value.checked_shl(shift_count(count)).unwrap_or(0)),
        Op::Shr => value.checked_shr(shift_count(count)).unwrap_or(0),
        Op::Sar => {
            let unused = 64 - width;
            let extended = (value << unused).cast_signed() >> unused;
            mask(of, (extended >> count.min(63)).cast_unsigned())
        }
        Op::Rol => rotate_left(of, value, count % u64::from(width)),
        _ => rotate_left(of, value, u64::from(width) - count % u64::from(width)),
    }
}

/// Rotates by at most the width.
fn rotate_left(of: Scalar, value: u64, count: u64) -> u64 {
    let count = shift_count(count);
    let high = value.checked_shl(count).unwrap_or(0);
    let low = value.checked_shr(of.width() - count).unwrap_or(0);
    mask(of, high | low)
}
