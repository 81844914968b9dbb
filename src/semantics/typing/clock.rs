//! Arithmetic of `TIME` and the date types (IEC 61131-3:2013, table 35), in the units of CODESYS and TwinCAT: milliseconds
//! for `TIME` and `TIME_OF_DAY`, seconds for `DATE` and `DATE_AND_TIME`, nanoseconds for the long types.

use super::binary::{Typed, fitted, undefined};
use super::types;
use super::{Operand, TypeError, apply, constant, converted, reinterpreted};
use crate::semantics::expr::{Expr, Op};
use crate::semantics::scalar::{DateKind, Scalar};
use crate::text::Place;

/// Nanoseconds in a second.
pub(super) const NANOS: u64 = 1_000_000_000;

/// Whether the operand is a time or a date.
pub(super) fn is_clock<L>(operand: &Operand<L>) -> bool {
    matches!(operand.scalar(), Some(Scalar::Time(_) | Scalar::Date(..)))
}

/// The wider one of two types of one kind.
pub(super) fn widest(a: Scalar, b: Scalar) -> Option<Scalar> {
    match (a, b) {
        (Scalar::Time(x), Scalar::Time(y)) => Some(Scalar::Time(x.max(y))),
        (Scalar::Date(k, x), Scalar::Date(l, y)) if k == l => Some(Scalar::Date(k, x.max(y))),
        _ => None,
    }
}

/// A count of the type's unit as an unsigned integer.
pub(super) fn count<L>(expr: Expr<L>) -> Expr<L> {
    let scalar = unsigned(expr.scalar);
    reinterpreted(expr, scalar)
}

const fn unsigned(scalar: Scalar) -> Scalar {
    Scalar::Int { signed: false, width: scalar.width() }
}

/// `expr op number`, in the type of `expr`.
pub(super) fn scale<L>(op: Op, expr: Expr<L>, number: u64) -> Expr<L> {
    let (scalar, place) = (expr.scalar, expr.place);
    apply(op, scalar, vec![expr, constant(scalar, number, place)], place)
}

/// Nanoseconds in the unit of a 32-bit type.
const fn unit(scalar: Scalar) -> u64 {
    match scalar {
        Scalar::Time(32) | Scalar::Date(DateKind::TimeOfDay, 32) => 1_000_000,
        Scalar::Time(_) | Scalar::Date(_, 64) => 1,
        _ => NANOS,
    }
}

/// A time or date as `scalar`, another width of its kind, or another kind that counts from the same origin.
pub(super) fn recounted<L>(expr: Expr<L>, scalar: Scalar) -> Expr<L> {
    let (from, to) = (unit(expr.scalar), unit(scalar));
    if expr.scalar == scalar {
        return expr;
    }
    let wide = unsigned(Scalar::Time(64));
    let number = converted(count(expr), wide);
    let number = if from >= to { scale(Op::Mul, number, from / to) } else { scale(Op::Div, number, to / from) };
    reinterpreted(converted(number, unsigned(scalar)), scalar)
}

/// An operand as a wider type of its kind.
pub(super) fn widened<L>(operand: Operand<L>, scalar: Scalar) -> Result<Expr<L>, TypeError> {
    match operand {
        Operand::Typed(expr, _) => Ok(recounted(expr, scalar)),
        other => Err(undefined("=", &[&other], other.place())),
    }
}

/// `left op right`, where one of them is a time or a date.
pub(super) fn arithmetic<L: Clone>(op: Op, left: Operand<L>, right: Operand<L>, place: Option<Place>) -> Typed<L> {
    let sign = match op {
        Op::Add => "+",
        Op::Sub => "-",
        Op::Mul => "*",
        Op::Div => "/",
        _ => "MOD",
    };
    match (left.scalar(), right.scalar()) {
        (Some(a @ Scalar::Time(_)), Some(b @ Scalar::Time(_))) if matches!(op, Op::Add | Op::Sub | Op::Mod) => {
            let scalar = widest(a, b).unwrap_or(a);
            let operands = vec![widened(left, scalar)?, widened(right, scalar)?];
            Ok(Operand::of(apply(op, scalar, operands, place)))
        }
        (Some(Scalar::Time(_)), other) if matches!(op, Op::Mul | Op::Div) && is_number(other) => {
            scaled(op, left, right, place)
        }
        (other, Some(Scalar::Time(_))) if op == Op::Mul && is_number(other) => scaled(op, right, left, place),
        (Some(a @ Scalar::Date(..)), Some(Scalar::Time(_))) if matches!(op, Op::Add | Op::Sub) => {
            let operands = vec![widened(left, a)?, moved(right, a)?];
            Ok(Operand::of(apply(op, a, operands, place)))
        }
        (Some(Scalar::Time(_)), Some(b @ Scalar::Date(..))) if op == Op::Add => {
            let operands = vec![moved(left, b)?, widened(right, b)?];
            Ok(Operand::of(apply(op, b, operands, place)))
        }
        (Some(a @ Scalar::Date(..)), Some(b @ Scalar::Date(..))) if op == Op::Sub && widest(a, b).is_some() => {
            let scalar = widest(a, b).unwrap_or(a);
            let operands = vec![widened(left, scalar)?, widened(right, scalar)?];
            let difference = apply(op, scalar, operands, place);
            Ok(Operand::of(recounted_wrapping(difference, Scalar::Time(scalar.width()))))
        }
        _ => Err(undefined(sign, &[&left, &right], place)),
    }
}

/// A difference of moments as a duration of the same width; it wraps around as the difference does.
fn recounted_wrapping<L>(difference: Expr<L>, time: Scalar) -> Expr<L> {
    let factor = unit(difference.scalar) / unit(time);
    let number = count(difference);
    let number = if factor > 1 { scale(Op::Mul, number, factor) } else { number };
    reinterpreted(number, time)
}

fn is_number(scalar: Option<Scalar>) -> bool {
    scalar.is_none_or(|scalar| types::is_whole(scalar) || matches!(scalar, Scalar::Real(_)))
}

/// A duration in the unit of a date type.
fn moved<L>(time: Operand<L>, date: Scalar) -> Result<Expr<L>, TypeError> {
    match time {
        Operand::Typed(expr, _) => Ok(recounted(expr, date)),
        other => Err(undefined("+", &[&other], other.place())),
    }
}

/// A duration times or divided by a number. A `REAL` is calculated with as `LREAL`, which holds every `TIME`.
fn scaled<L: Clone>(op: Op, time: Operand<L>, number: Operand<L>, place: Option<Place>) -> Typed<L> {
    let Operand::Typed(time, _) = time else { return Err(undefined("*", &[&time, &number], place)) };
    let scalar = time.scalar;
    let real = matches!(number, Operand::Real(..)) || matches!(number.scalar(), Some(Scalar::Real(_)));
    if real {
        let operands = vec![converted(time, types::LREAL), fitted(number, types::LREAL)?];
        return Ok(Operand::of(converted(apply(op, types::LREAL, operands, place), scalar)));
    }
    let whole = unsigned(scalar);
    let operands = vec![count(time), fitted(number, whole)?];
    Ok(Operand::of(reinterpreted(apply(op, whole, operands, place), scalar)))
}
