//! The operators of `REAL` and `LREAL`, by the host's IEEE 754 arithmetic; functions by its mathematical library.

use crate::semantics::expr::{Op, RealFunction};

/// Bits of the one NaN that operators give.
pub(super) const NAN_32: u64 = 0x7FC0_0000;
/// The same in 64 bits.
pub(super) const NAN_64: u64 = 0x7FF8_0000_0000_0000;

/// The bits of a `REAL`; every NaN is [`NAN_32`].
pub(super) fn bits32(value: f32) -> u64 {
    if value.is_nan() { NAN_32 } else { u64::from(value.to_bits()) }
}

/// The bits of an `LREAL`; every NaN is [`NAN_64`].
pub(super) fn bits64(value: f64) -> u64 {
    if value.is_nan() { NAN_64 } else { value.to_bits() }
}

/// The `REAL` with these bits.
pub(super) const fn value32(bits: u64) -> f32 {
    f32::from_bits(bits as u32)
}

/// Whether the function has two operands.
pub(super) const fn takes_two(function: RealFunction) -> bool {
    matches!(function, RealFunction::Atan2 | RealFunction::Power)
}

pub(super) fn unary(op: Op, width: u32, value: u64) -> u64 {
    let sign = 1 << (width - 1);
    match op {
        Op::Neg => value ^ sign,
        Op::Abs => value & !sign,
        _ if width == 32 => bits32(single(op, value32(value))),
        _ => bits64(double(op, f64::from_bits(value))),
    }
}

pub(super) fn binary(op: Op, width: u32, left: u64, right: u64) -> u64 {
    if width == 32 {
        let (left, right) = (value32(left), value32(right));
        match compare(op, left.partial_cmp(&right)) {
            Some(holds) => u64::from(holds),
            None => bits32(single_pair(op, left, right)),
        }
    } else {
        let (left, right) = (f64::from_bits(left), f64::from_bits(right));
        match compare(op, left.partial_cmp(&right)) {
            Some(holds) => u64::from(holds),
            None => bits64(double_pair(op, left, right)),
        }
    }
}

/// The comparison that `op` is, if it is one. NaN is neither equal to, nor less than, anything.
fn compare(op: Op, order: Option<std::cmp::Ordering>) -> Option<bool> {
    match op {
        Op::Eq => Some(order.is_some_and(std::cmp::Ordering::is_eq)),
        Op::Lt => Some(order.is_some_and(std::cmp::Ordering::is_lt)),
        Op::Le => Some(order.is_some_and(std::cmp::Ordering::is_le)),
        _ => None,
    }
}

macro_rules! functions {
    ($single:ident, $pair:ident, $float:ty) => {
        fn $single(op: Op, x: $float) -> $float {
            match op {
                Op::Sqrt => x.sqrt(),
                Op::Real(RealFunction::Sin) => x.sin(),
                Op::Real(RealFunction::Cos) => x.cos(),
                Op::Real(RealFunction::Tan) => x.tan(),
                Op::Real(RealFunction::Asin) => x.asin(),
                Op::Real(RealFunction::Acos) => x.acos(),
                Op::Real(RealFunction::Atan) => x.atan(),
                Op::Real(RealFunction::Exp) => x.exp(),
                Op::Real(RealFunction::Ln) => x.ln(),
                Op::Real(RealFunction::Log) => x.log10(),
                _ => x,
            }
        }

        fn $pair(op: Op, x: $float, y: $float) -> $float {
            match op {
                Op::Add => x + y,
                Op::Sub => x - y,
                Op::Mul => x * y,
                Op::Div => x / y,
                Op::Mod => x % y,
                Op::Real(RealFunction::Atan2) => x.atan2(y),
                Op::Real(RealFunction::Power) => x.powf(y),
                _ => x,
            }
        }
    };
}

functions!(single, single_pair, f32);
functions!(double, double_pair, f64);
