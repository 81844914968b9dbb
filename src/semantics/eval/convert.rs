//! Conversions between types, IEC 61131-3 §6.6.2.5.

use super::real::{bits32, bits64, value32};
use super::{fixed, mask};
use crate::semantics::scalar::Scalar;

/// Nanoseconds in the unit of `TIME`.
const NANOS_PER_MILLI: u64 = 1_000_000;

/// [`crate::semantics::expr::Op::Convert`].
pub(super) fn convert(to: Scalar, from: Scalar, value: u64) -> u64 {
    match (from, to) {
        (Scalar::Fixed { digits, width }, _) => fixed::to(to, digits, width, value, false),
        (_, Scalar::Fixed { digits, width }) => fixed::from(from, digits, width, value),
        (Scalar::Real(_), Scalar::Real(_)) => to_real(to, real(from, value)),
        (Scalar::Real(_), Scalar::Bool) => u64::from(real(from, value) != 0.0),
        (Scalar::Real(_), _) => saturated(to, real(from, value).round_ties_even()),
        (_, Scalar::Bool) => u64::from(value != 0),
        (_, Scalar::Real(32)) => bits32(from.number(value) as f32),
        (_, Scalar::Real(_)) => bits64(from.number(value) as f64),
        (Scalar::Time(32), Scalar::Time(64)) => value.wrapping_mul(NANOS_PER_MILLI),
        (Scalar::Time(64), Scalar::Time(32)) => mask(to, value / NANOS_PER_MILLI),
        _ => to.bits(from.number(value)),
    }
}

/// [`crate::semantics::expr::Op::Trunc`].
pub(super) fn truncate(to: Scalar, from: Scalar, value: u64) -> u64 {
    match (from, to) {
        (Scalar::Fixed { digits, width }, _) => fixed::to(to, digits, width, value, true),
        (Scalar::Real(_), Scalar::Real(_)) => to_real(to, real(from, value).trunc()),
        (Scalar::Real(_), _) => saturated(to, real(from, value).trunc()),
        _ => convert(to, from, value),
    }
}

/// A value of a floating type; `f64` holds every `f32`.
fn real(from: Scalar, value: u64) -> f64 {
    if from.width() == 32 { f64::from(value32(value)) } else { f64::from_bits(value) }
}

fn to_real(to: Scalar, value: f64) -> u64 {
    if to.width() == 32 { bits32(value as f32) } else { bits64(value) }
}

/// A whole number as the nearest one that the type holds; NaN gives zero.
fn saturated(to: Scalar, value: f64) -> u64 {
    let width = to.width();
    let (low, high) =
        if to.is_signed() { (-(1 << (width - 1)), (1 << (width - 1)) - 1) } else { (0, (1 << width) - 1) };
    to.bits((value as i128).clamp(low, high))
}
