//! Conversions between formats, and between floats and integers.

use super::round::round;
use super::{EXPONENT, Format, Parts, Special, exponent};
use crate::logic::aig::{Aig, Lit};
use crate::logic::blast::word::{self, Word};

/// To the nearest number of another format.
pub(in crate::logic::blast) fn to_float(aig: &mut Aig, a: &[Lit], width: usize) -> Word {
    let (from, to) = (Format::of(a.len()), Format::of(width));
    let x = Parts::of(aig, from, a);
    if from == to {
        return word::ite(aig, x.nan, &to.nan(), a);
    }
    let number = round(aig, to, x.sign, &x.exponent, &x.significand, Lit::FALSE);
    Special { nan: x.nan, infinite: x.infinite, zero: x.zero, sign: x.sign }.or(aig, to, &number)
}

/// An integer, signed or not, to the nearest number.
pub(in crate::logic::blast) fn from_integer(aig: &mut Aig, a: &[Lit], signed: bool, width: usize) -> Word {
    let sign = if signed { word::sign(a) } else { Lit::FALSE };
    let magnitude = word::negated_if(aig, sign, a);
    let highest = i64::try_from(a.len()).unwrap_or(i64::MAX) - 1;
    round(aig, Format::of(width), sign, &exponent(highest), &magnitude, Lit::FALSE)
}

/// How a float becomes an integer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::logic::blast) struct ToInteger {
    /// Bits of the integer.
    pub(in crate::logic::blast) width: usize,
    /// Whether it is signed.
    pub(in crate::logic::blast) signed: bool,
    /// Toward zero, and not to nearest.
    pub(in crate::logic::blast) truncate: bool,
}

/// To an integer, saturating; NaN gives 0. The significand is shifted left from right below the point: what passes it is
/// the whole part.
pub(in crate::logic::blast) fn to_integer(aig: &mut Aig, a: &[Lit], how: ToInteger) -> Word {
    let (format, width) = (Format::of(a.len()), how.width);
    let x = Parts::of(aig, format, a);
    let point = x.significand.len();
    let by = word::add(aig, &x.exponent, &exponent(1));
    let small = word::sign(&by);
    let limit = exponent(i64::try_from(width).unwrap_or(i64::MAX) + 1);
    let above = word::slt(aig, &limit, &by);
    let large = aig.or(above, x.infinite);
    let stages = (usize::BITS - (width + 1).leading_zeros()) as usize;
    let wide = word::zero_extend(&x.significand, point + width + 1);
    let shifted = word::shift_left(aig, &wide, &by[..stages.min(EXPONENT)]);
    let shifted = word::gated(aig, !small, &shifted);
    let whole = if how.truncate { shifted[point..].to_vec() } else { nearest(aig, &shifted, point) };
    let whole = word::zero_extend(&whole, width + 2);
    let out = saturated(aig, &whole, x.sign, large, how);
    let number = word::gated(aig, !x.nan, &out);
    word::gated(aig, !x.zero, &number)
}

/// The bits from `point` on, rounded to nearest, ties to even; one bit more.
fn nearest(aig: &mut Aig, bits: &[Lit], point: usize) -> Word {
    let rest = word::any(aig, &bits[..point - 1]);
    let odd = aig.or(rest, bits[point]);
    let up = aig.and(bits[point - 1], odd);
    let whole = word::zero_extend(&bits[point..], bits.len() - point + 1);
    let zero = word::constant(0, whole.len());
    word::sum(aig, &whole, &zero, up).0
}

/// The magnitude with its sign, cut to what fits.
fn saturated(aig: &mut Aig, magnitude: &[Lit], sign: Lit, large: Lit, how: ToInteger) -> Word {
    let width = how.width;
    let ones = word::constant(u64::MAX, width);
    if !how.signed {
        let beyond = word::any(aig, &magnitude[width..]);
        let over = aig.or(beyond, large);
        let out = word::ite(aig, over, &ones, &magnitude[..width]);
        return word::gated(aig, !sign, &out);
    }
    let mut most = ones;
    most[width - 1] = Lit::FALSE;
    // The greatest magnitude is one more where the sign is negative.
    let (bound, _) = word::sum(aig, &most, &word::constant(0, width), sign);
    let bound = word::zero_extend(&bound, magnitude.len());
    let beyond = word::ult(aig, &bound, magnitude);
    let over = aig.or(beyond, large);
    let cut = word::ite(aig, over, &bound, magnitude);
    word::negated_if(aig, sign, &cut[..width])
}
