//! Reals in a fixed-point reading, on values: signed numbers of `width` bits that count 10^-digits. Results are cut toward zero and
//! saturate; division by zero gives the largest number of the dividend's sign. Calculated in 128 bits, where nothing wraps around.

use crate::semantics::expr::Op;
use crate::semantics::scalar::Scalar;

/// What one is.
const fn unit(digits: u32) -> i128 {
    10i128.pow(if digits > 9 { 9 } else { digits })
}

const fn signed(width: u32) -> Scalar {
    Scalar::Int { signed: true, width }
}

/// The ends of a type of integers.
fn ends(of: Scalar) -> (i128, i128) {
    let width = of.width();
    if of.is_signed() { (-(1 << (width - 1)), (1 << (width - 1)) - 1) } else { (0, (1 << width) - 1) }
}

fn held(of: Scalar, number: i128) -> u64 {
    let (low, high) = ends(of);
    of.bits(number.clamp(low, high))
}

pub(super) fn unary(op: Op, width: u32, value: u64) -> u64 {
    let number = signed(width).number(value);
    match op {
        Op::Neg => held(signed(width), -number),
        Op::Abs => held(signed(width), number.abs()),
        _ => value,
    }
}

pub(super) fn binary(op: Op, digits: u32, width: u32, left: u64, right: u64) -> u64 {
    let of = signed(width);
    let (left, right) = (of.number(left), of.number(right));
    let number = match op {
        Op::Add => left + right,
        Op::Sub => left - right,
        Op::Mul => left * right / unit(digits),
        Op::Div if right == 0 => {
            if left < 0 {
                ends(of).0
            } else {
                ends(of).1
            }
        }
        Op::Div => left * unit(digits) / right,
        _ => left,
    };
    held(of, number)
}

/// A value as one of another type: the nearest whole number, ties to even, or toward zero.
pub(super) fn to(to: Scalar, digits: u32, width: u32, value: u64, toward_zero: bool) -> u64 {
    let number = signed(width).number(value);
    let one = unit(digits);
    let (whole, rest) = (number / one, (number % one).abs());
    let away = !toward_zero && (2 * rest > one || (2 * rest == one && whole % 2 != 0));
    match to {
        Scalar::Fixed { .. } => value,
        Scalar::Bool if !toward_zero => u64::from(number != 0),
        _ => held(to, if away { whole + number.signum() } else { whole }),
    }
}

/// A value of another type as a real.
pub(super) fn from(from: Scalar, digits: u32, width: u32, value: u64) -> u64 {
    held(signed(width), from.number(value) * unit(digits))
}
