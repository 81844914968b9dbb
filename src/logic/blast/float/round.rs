//! Rounding: the nearest number of a format, ties to even.

use super::{EXPONENT, Format, exponent};
use crate::logic::aig::{Aig, Lit};
use crate::logic::blast::word::{self, Word};

/// The number nearest to `significand`, whose highest bit has the weight `2^power`, plus something less than its lowest bit
/// where `sticky` holds; with the sign `sign`. Zero stays zero. Where `sticky` may hold and leading bits may be zero, the
/// significand needs as many bits more.
pub(super) fn round(aig: &mut Aig, format: Format, sign: Lit, power: &[Lit], significand: &[Lit], sticky: Lit) -> Word {
    let missing = (format.fraction + 3).saturating_sub(significand.len());
    let mut wide = word::constant(0, missing);
    wide.extend(significand);
    let (normal, by) = word::normalized(aig, &wide, 7);
    let power = word::sub(aig, power, &word::zero_extend(&by, EXPONENT));
    let (shifted, lost) = subnormal(aig, format, &power, &normal);
    let sticky = aig.or(sticky, lost);
    let kept = shifted.len() - format.fraction - 1;
    let below = word::any(aig, &shifted[..kept - 1]);
    let (rest, guard) = (aig.or(below, sticky), shifted[kept - 1]);
    let odd = aig.or(rest, shifted[kept]);
    let up = aig.and(guard, odd);
    // A significand without its highest bit has the field 0. A carry out of the fraction raises the field as it should.
    let field = word::add(aig, &power, &exponent(format.bias()));
    let field = word::gated(aig, word::sign(&shifted), &field);
    let mut packed = shifted[kept..shifted.len() - 1].to_vec();
    packed.extend(field);
    let zero = word::constant(0, packed.len());
    let (rounded, _) = word::sum(aig, &packed, &zero, up);
    finish(aig, format, sign, &rounded)
}

/// Shifts right where the power is below the least one; what is lost is told.
fn subnormal(aig: &mut Aig, format: Format, power: &[Lit], significand: &[Lit]) -> (Word, Lit) {
    let under = word::sub(aig, &exponent(format.least()), power);
    let (negative, some) = (word::sign(&under), word::any(aig, &under));
    let below = aig.and(!negative, some);
    let by = word::gated(aig, below, &under);
    word::shift_right_sticky(aig, significand, &by)
}

/// Infinity where the field does not fit.
fn finish(aig: &mut Aig, format: Format, sign: Lit, rounded: &[Lit]) -> Word {
    let end = format.fraction + format.exponent;
    let (full, over) = (word::all(aig, &rounded[format.fraction..end]), word::any(aig, &rounded[end..]));
    let infinite = aig.or(full, over);
    let mut number = rounded[..end].to_vec();
    number.push(sign);
    word::ite(aig, infinite, &format.infinity(sign), &number)
}
