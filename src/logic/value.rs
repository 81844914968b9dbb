//! Operators on values: bit-vectors in the low bits of a `u64`, floats by the machine's own `f32` and `f64`, whose sums,
//! products, quotients, roots and conversions are those of IEEE 754 to nearest, ties to even. A NaN result is canonical.

use super::term::{Op, mask};

/// The canonical quiet NaN of the format of `width` bits.
#[must_use]
pub const fn canonical_nan(width: u32) -> u64 {
    if width == 32 { 0x7fc0_0000 } else { 0x7ff8_0000_0000_0000 }
}

/// A value of `width` bits as a signed number.
#[must_use]
pub const fn signed(value: u64, width: u32) -> i64 {
    let spare = 64 - width;
    ((value << spare) as i64) >> spare
}

/// What `op` gives on `values`, the operands as they are, whose widths are `widths`. A bit beyond a width must be zero.
/// Operands that the operator does not take are ignored.
#[must_use]
pub fn operate(op: Op, values: [u64; 3], widths: [u32; 3]) -> u64 {
    let ([a, b, c], width) = (values, widths[0]);
    match op {
        Op::Ite => {
            if a == 0 {
                c
            } else {
                b
            }
        }
        Op::Concat => a << widths[1] | b,
        Op::Extract { high, low } => (a >> low) & mask(high - low + 1),
        Op::ZeroExtend(_) => a,
        Op::SignExtend(to) => signed(a, width).cast_unsigned() & mask(to),
        Op::Eq | Op::Ult | Op::Ule | Op::Slt | Op::Sle => u64::from(compare(op, a, b, width)),
        Op::Not
        | Op::Neg
        | Op::And
        | Op::Or
        | Op::Xor
        | Op::Add
        | Op::Sub
        | Op::Mul
        | Op::Udiv
        | Op::Sdiv
        | Op::Urem
        | Op::Srem
        | Op::Shl
        | Op::Lshr
        | Op::Ashr => integer(op, a, b, width) & mask(width),
        _ if width == 32 && float_operands(op) => single(op, a, b),
        _ if float_operands(op) => double(op, a, b),
        Op::SignedToFloat(to) => signed_to_float(signed(a, width), to),
        _ => unsigned_to_float(a, if let Op::UnsignedToFloat(to) = op { to } else { 64 }),
    }
}

const fn float_operands(op: Op) -> bool {
    !matches!(op, Op::SignedToFloat(_) | Op::UnsignedToFloat(_))
}

const fn compare(op: Op, a: u64, b: u64, width: u32) -> bool {
    match op {
        Op::Eq => a == b,
        Op::Ult => a < b,
        Op::Ule => a <= b,
        Op::Slt => signed(a, width) < signed(b, width),
        _ => signed(a, width) <= signed(b, width),
    }
}

/// The low `width` bits of the result are right, others are whatever they are.
const fn integer(op: Op, a: u64, b: u64, width: u32) -> u64 {
    let (sa, sb) = (signed(a, width), signed(b, width));
    match op {
        Op::Not => !a,
        Op::Neg => a.wrapping_neg(),
        Op::And => a & b,
        Op::Or => a | b,
        Op::Xor => a ^ b,
        Op::Add => a.wrapping_add(b),
        Op::Sub => a.wrapping_sub(b),
        Op::Mul => a.wrapping_mul(b),
        Op::Udiv if b == 0 => u64::MAX,
        Op::Udiv => a / b,
        Op::Urem if b == 0 => a,
        Op::Urem => a % b,
        // BTOR2 divides the magnitudes and then sets the sign: by zero, all ones, or one where the dividend is negative.
        Op::Sdiv if b == 0 => {
            if sa < 0 {
                1
            } else {
                u64::MAX
            }
        }
        Op::Sdiv => sa.wrapping_div(sb).cast_unsigned(),
        Op::Srem if b == 0 => a,
        Op::Srem => sa.wrapping_rem(sb).cast_unsigned(),
        Op::Shl if b >= width as u64 => 0,
        Op::Shl => a << b,
        Op::Lshr if b >= width as u64 => 0,
        Op::Lshr => a >> b,
        Op::Ashr if b >= width as u64 => (sa >> 63).cast_unsigned(),
        _ => (sa >> b).cast_unsigned(),
    }
}

fn single_bits(value: f32) -> u64 {
    if value.is_nan() { canonical_nan(32) } else { u64::from(value.to_bits()) }
}

fn double_bits(value: f64) -> u64 {
    if value.is_nan() { canonical_nan(64) } else { value.to_bits() }
}

fn single(op: Op, a: u64, b: u64) -> u64 {
    let number = |bits: u64| f32::from_bits(u32::try_from(bits & mask(32)).unwrap_or_default());
    let (x, y) = (number(a), number(b));
    match op {
        Op::FloatAdd => single_bits(x + y),
        Op::FloatSub => single_bits(x - y),
        Op::FloatMul => single_bits(x * y),
        Op::FloatDiv => single_bits(x / y),
        Op::FloatSqrt => single_bits(x.sqrt()),
        Op::FloatToFloat(32) => single_bits(x),
        // Every binary32 is a binary64, so that comparisons and integers are the same from there.
        _ => double(op, f64::from(x).to_bits(), f64::from(y).to_bits()),
    }
}

fn double(op: Op, a: u64, b: u64) -> u64 {
    let (x, y) = (f64::from_bits(a), f64::from_bits(b));
    match op {
        Op::FloatAdd => double_bits(x + y),
        Op::FloatSub => double_bits(x - y),
        Op::FloatMul => double_bits(x * y),
        Op::FloatDiv => double_bits(x / y),
        Op::FloatSqrt => double_bits(x.sqrt()),
        Op::FloatToFloat(32) => single_bits(x as f32),
        Op::FloatEq => u64::from(x == y),
        Op::FloatLt => u64::from(x < y),
        Op::FloatLe => u64::from(x <= y),
        Op::FloatToSigned(to) => saturate(x.round_ties_even(), to),
        Op::FloatTruncate(to) => saturate(x.trunc(), to),
        Op::FloatToUnsigned(to) => (x.round_ties_even() as u64).min(mask(to)),
        _ => double_bits(x),
    }
}

/// A whole number as a signed one of `width` bits; NaN gives 0.
fn saturate(whole: f64, width: u32) -> u64 {
    let limit = signed(mask(width) >> 1, 64);
    (whole as i64).clamp(-limit - 1, limit).cast_unsigned() & mask(width)
}

fn signed_to_float(value: i64, to: u32) -> u64 {
    if to == 32 { single_bits(value as f32) } else { double_bits(value as f64) }
}

fn unsigned_to_float(value: u64, to: u32) -> u64 {
    if to == 32 { single_bits(value as f32) } else { double_bits(value as f64) }
}
