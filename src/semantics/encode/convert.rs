//! Conversions as terms: [`Op::Convert`](super::super::expr::Op::Convert) and `TRUNC`, for each pair of types.

use super::super::scalar::Scalar;
use super::fixed;
use crate::logic::term::{Op as T, Pool, Term, mask};

/// How many nanoseconds a millisecond has: `TIME` and `LTIME` count these.
const NANOSECONDS: u64 = 1_000_000;

/// The term cut or extended to a width.
pub fn resize(pool: &mut Pool, term: Term, width: u32, signed: bool) -> Term {
    let from = pool.width(term);
    match from.cmp(&width) {
        std::cmp::Ordering::Equal => term,
        std::cmp::Ordering::Less if signed => pool.apply(T::SignExtend(width), &[term]),
        std::cmp::Ordering::Less => pool.apply(T::ZeroExtend(width), &[term]),
        std::cmp::Ordering::Greater => pool.apply(T::Extract { high: width - 1, low: 0 }, &[term]),
    }
}

/// A value of one type as one of another.
pub(super) fn convert(pool: &mut Pool, from: Scalar, to: Scalar, term: Term) -> Term {
    match (from, to) {
        (Scalar::Fixed { digits, width }, _) | (_, Scalar::Fixed { digits, width }) => {
            fixed::convert(pool, digits, width, from, to, term)
        }
        (Scalar::Real(_), _) | (_, Scalar::Real(_)) => ieee(pool, from, to, term),
        (_, Scalar::Bool) => {
            let zero = pool.constant(from.width(), 0);
            let is_zero = pool.apply(T::Eq, &[term, zero]);
            pool.apply(T::Not, &[is_zero])
        }
        (Scalar::Time(32), Scalar::Time(64)) => {
            let (long, factor) = (resize(pool, term, 64, false), pool.constant(64, NANOSECONDS));
            pool.apply(T::Mul, &[long, factor])
        }
        (Scalar::Time(64), Scalar::Time(32)) => {
            let factor = pool.constant(64, NANOSECONDS);
            let short = pool.apply(T::Udiv, &[term, factor]);
            resize(pool, short, 32, false)
        }
        _ => resize(pool, term, to.width(), from.is_signed()),
    }
}

/// Conversions from and to IEEE 754 numbers.
fn ieee(pool: &mut Pool, from: Scalar, to: Scalar, term: Term) -> Term {
    match (from, to) {
        (Scalar::Real(a), Scalar::Real(b)) if a == b => {
            // The one NaN for each of them.
            let quiet = pool.constant(a, if a == 32 { 0x7FC0_0000 } else { 0x7FF8_0000_0000_0000 });
            let is_number = pool.apply(T::FloatEq, &[term, term]);
            pool.apply(T::Ite, &[is_number, term, quiet])
        }
        (Scalar::Real(_), Scalar::Real(format)) => pool.apply(T::FloatToFloat(format), &[term]),
        (Scalar::Real(format), Scalar::Bool) => {
            let zero = pool.constant(format, 0);
            let is_zero = pool.apply(T::FloatEq, &[term, zero]);
            pool.apply(T::Not, &[is_zero])
        }
        (_, Scalar::Real(format)) if from.is_signed() => pool.apply(T::SignedToFloat(format), &[term]),
        (_, Scalar::Real(format)) => pool.apply(T::UnsignedToFloat(format), &[term]),
        _ if to.is_signed() => pool.apply(T::FloatToSigned(to.width()), &[term]),
        _ => pool.apply(T::FloatToUnsigned(to.width()), &[term]),
    }
}

/// A real toward zero as an integer, which saturates.
pub(super) fn trunc(pool: &mut Pool, from: Scalar, to: Scalar, term: Term) -> Term {
    match from {
        Scalar::Fixed { digits, .. } => fixed::trunc(pool, digits, to, term),
        Scalar::Real(_) if to.is_signed() => pool.apply(T::FloatTruncate(to.width()), &[term]),
        Scalar::Real(format) => trunc_unsigned(pool, format, to.width(), term),
        _ => convert(pool, from, to, term),
    }
}

/// Toward zero as an unsigned integer: through a signed one of 64 bits where the number is below 2^62, else by rounding, since
/// such large numbers are whole.
fn trunc_unsigned(pool: &mut Pool, format: u32, width: u32, term: Term) -> Term {
    let signed = pool.apply(T::FloatTruncate(64), &[term]);
    let small = clamp(pool, signed, 0, i64::try_from(mask(width)).unwrap_or(i64::MAX));
    let small = resize(pool, small, width, false);
    if width < 64 {
        return small;
    }
    let limit = if format == 32 { u64::from((2f32.powi(62)).to_bits()) } else { 2f64.powi(62).to_bits() };
    let limit = pool.constant(format, limit);
    let is_large = pool.apply(T::FloatLe, &[limit, term]);
    let large = pool.apply(T::FloatToUnsigned(64), &[term]);
    pool.apply(T::Ite, &[is_large, large, small])
}

/// A signed term held between two numbers.
pub(super) fn clamp(pool: &mut Pool, term: Term, low: i64, high: i64) -> Term {
    let width = pool.width(term);
    let (low, high) = (pool.constant(width, low.cast_unsigned()), pool.constant(width, high.cast_unsigned()));
    let (below, above) = (pool.apply(T::Slt, &[term, low]), pool.apply(T::Slt, &[high, term]));
    let held = pool.apply(T::Ite, &[above, high, term]);
    pool.apply(T::Ite, &[below, low, held])
}
