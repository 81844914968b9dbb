//! Sum, product, quotient and square root.

use super::round::round;
use super::{EXPONENT, Format, Parts, Special, exponent};
use crate::logic::aig::{Aig, Lit};
use crate::logic::blast::word::{self, Word};

/// The sum. The smaller significand is shifted to the larger one's exponent with two bits and a sticky one more: a
/// cancellation of more than one leading bit happens only where the shift was at most one, that is nothing was lost.
pub(in crate::logic::blast) fn add(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> Word {
    let (format, high) = (Format::of(a.len()), a.len() - 1);
    let less = word::ult(aig, &a[..high], &b[..high]);
    let (large, small) = (word::ite(aig, less, b, a), word::ite(aig, less, a, b));
    let (large, small) = (Parts::of(aig, format, &large), Parts::of(aig, format, &small));
    let distance = word::sub(aig, &large.exponent, &small.exponent);
    let widened = |significand: &[Lit]| {
        let mut out = word::constant(0, 3);
        out.extend(significand);
        out
    };
    let (mut aligned, lost) = word::shift_right_sticky(aig, &widened(&small.significand), &distance[..format.exponent]);
    aligned[0] = aig.or(aligned[0], lost);
    let differ = aig.xor(large.sign, small.sign);
    let left = word::zero_extend(&widened(&large.significand), format.fraction + 5);
    let right: Word = word::zero_extend(&aligned, left.len()).into_iter().map(|lit| aig.xor(lit, differ)).collect();
    let (total, _) = word::sum(aig, &left, &right, differ);
    let some = word::any(aig, &total);
    let both = aig.and(large.sign, small.sign);
    let sign = aig.ite(some, large.sign, both);
    let power = word::add(aig, &large.exponent, &exponent(1));
    let number = round(aig, format, sign, &power, &total, Lit::FALSE);
    let (nan, infinities) = (aig.or(large.nan, small.nan), aig.and(large.infinite, small.infinite));
    let undefined = aig.and(infinities, differ);
    let nan = aig.or(nan, undefined);
    Special { nan, infinite: large.infinite, zero: Lit::FALSE, sign: large.sign }.or(aig, format, &number)
}

/// The product.
pub(in crate::logic::blast) fn mul(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> Word {
    let format = Format::of(a.len());
    let (x, y) = (Parts::of(aig, format, a), Parts::of(aig, format, b));
    let sign = aig.xor(x.sign, y.sign);
    let product = word::mul(aig, &x.significand, &y.significand, 2 * format.fraction + 2);
    let (power, _) = word::sum(aig, &x.exponent, &y.exponent, Lit::TRUE);
    let number = round(aig, format, sign, &power, &product, Lit::FALSE);
    let (nan, infinite, zero) = (aig.or(x.nan, y.nan), aig.or(x.infinite, y.infinite), aig.or(x.zero, y.zero));
    let undefined = aig.and(infinite, zero);
    let nan = aig.or(nan, undefined);
    Special { nan, infinite, zero, sign }.or(aig, format, &number)
}

/// The quotient, digit by digit; the remainder is the sticky bit.
pub(in crate::logic::blast) fn div(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> Word {
    let format = Format::of(a.len());
    let (x, y) = (Parts::of(aig, format, a).normalized(aig), Parts::of(aig, format, b).normalized(aig));
    let sign = aig.xor(x.sign, y.sign);
    let width = format.fraction + 2;
    let divisor = word::zero_extend(&y.significand, width);
    let mut remainder = word::zero_extend(&x.significand, width);
    let mut quotient = Word::new();
    for _ in 0..format.fraction + 4 {
        let (less, digit) = word::difference(aig, &remainder, &divisor);
        remainder = word::ite(aig, digit, &less, &remainder);
        // What is left is less than the divisor, so that its highest bit is zero.
        remainder.pop();
        remainder.insert(0, Lit::FALSE);
        quotient.insert(0, digit);
    }
    let sticky = word::any(aig, &remainder);
    let power = word::sub(aig, &x.exponent, &y.exponent);
    let number = round(aig, format, sign, &power, &quotient, sticky);
    let (nan, zeros, infinities) = (aig.or(x.nan, y.nan), aig.and(x.zero, y.zero), aig.and(x.infinite, y.infinite));
    let undefined = aig.or(zeros, infinities);
    let nan = aig.or(nan, undefined);
    let (infinite, zero) = (aig.or(x.infinite, y.zero), aig.or(x.zero, y.infinite));
    Special { nan, infinite, zero, sign }.or(aig, format, &number)
}

/// The square root, digit by digit; the remainder is the sticky bit.
pub(in crate::logic::blast) fn sqrt(aig: &mut Aig, a: &[Lit]) -> Word {
    let format = Format::of(a.len());
    let x = Parts::of(aig, format, a).normalized(aig);
    // An odd exponent gives a bit to the significand; then half of it is whole.
    let odd = x.exponent[0];
    let mut doubled = vec![Lit::FALSE];
    doubled.extend(&x.significand);
    let single = word::zero_extend(&x.significand, doubled.len());
    let radicand = word::ite(aig, odd, &doubled, &single);
    let half = word::sign_extend(&x.exponent[1..], EXPONENT);
    let (root, sticky) = integer_root(aig, format, &radicand);
    let number = round(aig, format, Lit::FALSE, &half, &root, sticky);
    let negative = aig.and(x.sign, !x.zero);
    let nan = aig.or(x.nan, negative);
    Special { nan, infinite: x.infinite, zero: x.zero, sign: x.sign }.or(aig, format, &number)
}

/// The root of `radicand`, which has two bits before the point, with two bits more than the significand; and whether
/// something is left.
fn integer_root(aig: &mut Aig, format: Format, radicand: &[Lit]) -> (Word, Lit) {
    let digits = format.fraction + 3;
    let mut bits = word::constant(0, 2 * digits - radicand.len());
    bits.extend(radicand);
    let (mut root, mut remainder) = (Word::new(), Word::new());
    for step in (0..digits).rev() {
        remainder.insert(0, bits[2 * step + 1]);
        remainder.insert(0, bits[2 * step]);
        let mut trial = vec![Lit::TRUE, Lit::FALSE];
        trial.extend(&root);
        let width = remainder.len().max(trial.len());
        let wide = word::zero_extend(&remainder, width);
        let (less, digit) = word::difference(aig, &wide, &word::zero_extend(&trial, width));
        remainder = word::ite(aig, digit, &less, &wide);
        root.insert(0, digit);
        // What is left is at most twice the root.
        remainder.truncate(root.len() + 1);
    }
    let sticky = word::any(aig, &remainder);
    (root, sticky)
}
