//! IEEE 754 circuits, exact: a number is taken apart into sign, exponent and significand, the operation is done with enough
//! bits and a sticky one, and the result is rounded to nearest, ties to even, subnormals included. The scheme is that of
//! Brain, Schanda and Sun, *Building Better Bit-Blasting for Floating-Point Problems*, TACAS 2019, without their
//! shortcuts for the close and the far path of a sum.

mod arithmetic;
mod convert;
mod round;

pub(super) use arithmetic::{add, div, mul, sqrt};
pub(super) use convert::{ToInteger, from_integer, to_float, to_integer};

use super::word::{self, Word};
use crate::logic::aig::{Aig, Lit};
use crate::logic::value::canonical_nan;

/// Bits of a signed exponent, enough for every sum and difference of exponents here.
const EXPONENT: usize = 14;

/// A format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Format {
    /// Bits of the exponent field.
    exponent: usize,
    /// Bits of the fraction field.
    fraction: usize,
}

impl Format {
    /// binary32 or binary64.
    pub(super) const fn of(width: usize) -> Self {
        if width == 32 { Self { exponent: 8, fraction: 23 } } else { Self { exponent: 11, fraction: 52 } }
    }

    const fn width(self) -> usize {
        1 + self.exponent + self.fraction
    }

    const fn bias(self) -> i64 {
        (1 << (self.exponent - 1)) - 1
    }

    /// The exponent of the least normal numbers and of all subnormal ones.
    const fn least(self) -> i64 {
        1 - self.bias()
    }

    fn nan(self) -> Word {
        word::constant(canonical_nan(if self.fraction == 23 { 32 } else { 64 }), self.width())
    }

    fn infinity(self, sign: Lit) -> Word {
        let mut out = word::constant(0, self.fraction);
        out.resize(self.fraction + self.exponent, Lit::TRUE);
        out.push(sign);
        out
    }

    fn zero(self, sign: Lit) -> Word {
        let mut out = word::constant(0, self.width() - 1);
        out.push(sign);
        out
    }
}

/// A signed exponent that is a constant.
fn exponent(value: i64) -> Word {
    word::constant(value.cast_unsigned(), EXPONENT)
}

/// A number taken apart. Its value is `significand / 2^fraction * 2^exponent`.
struct Parts {
    sign: Lit,
    nan: Lit,
    infinite: Lit,
    zero: Lit,
    exponent: Word,
    /// With the hidden bit; not normalized where the number is subnormal.
    significand: Word,
}

impl Parts {
    fn of(aig: &mut Aig, format: Format, bits: &[Lit]) -> Self {
        let (fraction, field) = (&bits[..format.fraction], &bits[format.fraction..bits.len() - 1]);
        let (normal, full, rest) = (word::any(aig, field), word::all(aig, field), word::any(aig, fraction));
        // A subnormal number has the exponent of the field 1.
        let mut field = word::zero_extend(field, EXPONENT);
        field[0] = aig.or(field[0], !normal);
        let mut significand = fraction.to_vec();
        significand.push(normal);
        Self {
            sign: word::sign(bits),
            nan: aig.and(full, rest),
            infinite: aig.and(full, !rest),
            zero: aig.and(!normal, !rest),
            exponent: word::add(aig, &field, &exponent(-format.bias())),
            significand,
        }
    }

    /// The same with the highest bit of the significand set, unless it is zero.
    fn normalized(mut self, aig: &mut Aig) -> Self {
        let (significand, by) = word::normalized(aig, &self.significand, 6);
        self.exponent = word::sub(aig, &self.exponent, &word::zero_extend(&by, EXPONENT));
        self.significand = significand;
        self
    }
}

/// The results for NaN, infinity and zero laid over that for other numbers; NaN before infinity before zero.
struct Special {
    nan: Lit,
    infinite: Lit,
    zero: Lit,
    sign: Lit,
}

impl Special {
    fn or(&self, aig: &mut Aig, format: Format, number: &[Lit]) -> Word {
        let out = word::ite(aig, self.zero, &format.zero(self.sign), number);
        let out = word::ite(aig, self.infinite, &format.infinity(self.sign), &out);
        word::ite(aig, self.nan, &format.nan(), &out)
    }
}

/// What comparisons are made of: whether one is NaN, whether both are zeros.
fn unordered_and_zeros(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> (Lit, Lit) {
    let format = Format::of(a.len());
    let (x, y) = (Parts::of(aig, format, a), Parts::of(aig, format, b));
    (aig.or(x.nan, y.nan), aig.and(x.zero, y.zero))
}

/// Equality of numbers.
pub(super) fn eq(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> Lit {
    let (unordered, zeros) = unordered_and_zeros(aig, a, b);
    let same = word::eq(aig, a, b);
    let equal = aig.or(same, zeros);
    aig.and(!unordered, equal)
}

/// Less.
pub(super) fn lt(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> Lit {
    let (unordered, zeros) = unordered_and_zeros(aig, a, b);
    let (high, same) = (a.len() - 1, word::eq(aig, a, b));
    // Magnitudes are ordered as their bits are.
    let below = word::ult(aig, &a[..high], &b[..high]);
    let turned = aig.xor(below, a[high]);
    let within = aig.and(turned, !same);
    let differ = aig.xor(a[high], b[high]);
    let less = aig.ite(differ, a[high], within);
    let ordered = aig.and(!unordered, !zeros);
    aig.and(ordered, less)
}

/// Less or equal.
pub(super) fn le(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> Lit {
    let (less, equal) = (lt(aig, a, b), eq(aig, a, b));
    aig.or(less, equal)
}
