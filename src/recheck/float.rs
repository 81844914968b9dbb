//! IEEE 754 binary32 and binary64 as circuits: unpack, calculate with a significand wide enough for exact rounding, round to
//! nearest with ties to even, pack. Every NaN result is the canonical quiet one.

use batsat::Lit;

use super::gates::{Gates, Word};

/// A format: so many bits of exponent, and of significand with the hidden one.
#[derive(Clone, Copy)]
pub(super) struct Format {
    exponent: usize,
    precision: usize,
}

impl Format {
    pub(super) const fn of(width: usize) -> Self {
        if width == 32 { Self { exponent: 8, precision: 24 } } else { Self { exponent: 11, precision: 53 } }
    }

    const fn width(self) -> usize {
        self.exponent + self.precision
    }

    const fn bias(self) -> i64 {
        (1 << (self.exponent - 1)) - 1
    }
}

/// Wide enough for every exponent that occurs between two roundings, signed.
const EXPONENT: usize = 15;

struct Unpacked {
    sign: Lit,
    nan: Lit,
    infinite: Lit,
    zero: Lit,
    /// The significand with its hidden bit.
    significand: Word,
    /// The exponent of the significand's lowest bit, signed.
    exponent: Word,
}

fn signed(gates: &Gates, value: i64) -> Word {
    (0..EXPONENT).map(|bit| gates.constant(value >> bit & 1 == 1)).collect()
}

fn unpack(gates: &mut Gates, format: Format, word: &[Lit]) -> Unpacked {
    let fraction = &word[..format.precision - 1];
    let field = &word[format.precision - 1..format.width() - 1];
    let (ones, nonzero, some) = (gates.all(field), gates.any(field), gates.any(fraction));
    let mut significand = fraction.to_vec();
    significand.push(nonzero);
    // The field 0 means the same exponent as 1.
    let mut biased = gates.zero_extend(field, EXPONENT);
    biased[0] = gates.or(biased[0], !nonzero);
    let offset = signed(gates, -(format.bias() + format.precision as i64 - 1));
    Unpacked {
        sign: word[format.width() - 1],
        nan: gates.and(ones, some),
        infinite: gates.and(ones, !some),
        zero: gates.and(!nonzero, !some),
        significand,
        exponent: gates.add(&biased, &offset),
    }
}

/// Shifts the leading one to the top, where there is a one; the exponent follows.
fn normalise(gates: &mut Gates, significand: &[Lit], exponent: &[Lit]) -> (Word, Word) {
    let width = significand.len();
    let (mut word, mut exponent) = (significand.to_vec(), exponent.to_vec());
    let stages = usize::BITS - (width - 1).leading_zeros();
    for stage in (0..stages).rev() {
        let by = 1_usize << stage;
        if by >= width {
            continue;
        }
        let high = gates.any(&word[width - by..]);
        let mut moved = gates.number(by, 0);
        moved.extend_from_slice(&word[..width - by]);
        word = gates.choose(high, &word, &moved);
        let less = signed(gates, -(by as i64));
        let lower = gates.add(&exponent, &less);
        exponent = gates.choose(high, &exponent, &lower);
    }
    (word, exponent)
}

fn special(gates: &Gates, format: Format, sign: Lit, exponent: bool, quiet: bool) -> Word {
    let mut word = gates.number(format.precision - 1, 0);
    if quiet {
        word[format.precision - 2] = gates.constant(true);
    }
    word.extend(vec![gates.constant(exponent); format.exponent]);
    word.push(sign);
    word
}

/// Rounds `significand * 2^exponent` and packs it. The lowest bit of the significand may stand for more bits below.
fn round(gates: &mut Gates, format: Format, sign: Lit, significand: &[Lit], exponent: &[Lit]) -> Word {
    let p = format.precision;
    let (mut word, mut exponent) = (significand.to_vec(), exponent.to_vec());
    let missing = (p + 3).saturating_sub(word.len());
    if missing > 0 {
        word.splice(0..0, gates.number(missing, 0));
        let less = signed(gates, -(missing as i64));
        exponent = gates.add(&exponent, &less);
    }
    let nonzero = gates.any(&word);
    let (word, exponent) = normalise(gates, &word, &exponent);
    let to_biased = signed(gates, word.len() as i64 - 1 + format.bias());
    let biased = gates.add(&exponent, &to_biased);
    let one = signed(gates, 1);
    let tiny = gates.signed_less(&biased, &one);
    let below = gates.subtract(&one, &biased).0;
    let none = gates.number(EXPONENT, 0);
    let shift = gates.choose(tiny, &below, &none);
    let word = gates.shift_right_sticky(&word, &shift[..EXPONENT - 1]);
    let field = gates.subtract(&biased, &one).0;
    let field = gates.choose(tiny, &none, &field);
    let cut = word.len() - p;
    let (kept, guard) = (word[cut..].to_vec(), word[cut - 1]);
    let rest = gates.any(&word[..cut - 1]);
    let odd = gates.or(rest, kept[0]);
    let up = gates.and(guard, odd);
    // The hidden bit adds one to the field, and so does a carry.
    let mut packed = gates.number(p - 1, 0);
    packed.extend_from_slice(&field);
    let kept = gates.zero_extend(&kept, packed.len());
    let (packed, _) = gates.add_carry(&packed, &kept, up);
    let exponent = &packed[p - 1..];
    let largest = gates.number(exponent.len(), (1 << format.exponent) - 1);
    let over = !gates.signed_less(exponent, &largest);
    let mut finite = packed[..format.width() - 1].to_vec();
    finite.push(sign);
    let infinity = special(gates, format, sign, true, false);
    let zero = special(gates, format, sign, false, false);
    let out = gates.choose(over, &infinity, &finite);
    gates.choose(nonzero, &out, &zero)
}

fn nan(gates: &Gates, format: Format) -> Word {
    special(gates, format, gates.constant(false), true, true)
}

pub(super) fn add(gates: &mut Gates, format: Format, a: &[Lit], b: &[Lit]) -> Word {
    // The one with the larger magnitude comes first.
    let top = format.width() - 1;
    let swap = gates.unsigned_less(&a[..top], &b[..top]);
    let (a, b) = (gates.choose(swap, b, a), gates.choose(swap, a, b));
    let (x, y) = (unpack(gates, format, &a), unpack(gates, format, &b));
    let distance = gates.subtract(&x.exponent, &y.exponent).0;
    let widen = |gates: &Gates, word: &Word| {
        let mut out = gates.number(3, 0);
        out.extend_from_slice(word);
        out.push(gates.constant(false));
        out
    };
    let (left, right) = (widen(gates, &x.significand), widen(gates, &y.significand));
    let right = gates.shift_right_sticky(&right, &distance[..EXPONENT - 1]);
    let differ = gates.xor(x.sign, y.sign);
    let (sum, (difference, _)) = (gates.add(&left, &right), gates.subtract(&left, &right));
    let result = gates.choose(differ, &difference, &sum);
    let three = signed(gates, -3);
    let exponent = gates.add(&x.exponent, &three);
    // An exact zero is positive, unless both are negative zeros.
    let some = gates.any(&result);
    let both = gates.and(x.sign, y.sign);
    let sign = gates.mux(some, x.sign, both);
    let finite = round(gates, format, sign, &result, &exponent);
    let out = gates.choose(x.infinite, &a, &finite);
    let infinities = gates.and(x.infinite, y.infinite);
    let clash = gates.and(infinities, differ);
    let invalid = [x.nan, y.nan, clash];
    let invalid = gates.any(&invalid);
    let quiet = nan(gates, format);
    gates.choose(invalid, &quiet, &out)
}

pub(super) fn multiply(gates: &mut Gates, format: Format, a: &[Lit], b: &[Lit]) -> Word {
    let (x, y) = (unpack(gates, format, a), unpack(gates, format, b));
    let sign = gates.xor(x.sign, y.sign);
    let product = gates.multiply(&x.significand, &y.significand, 2 * format.precision);
    let exponent = gates.add(&x.exponent, &y.exponent);
    let finite = round(gates, format, sign, &product, &exponent);
    let infinite = gates.or(x.infinite, y.infinite);
    let zero = gates.or(x.zero, y.zero);
    let clash = gates.and(infinite, zero);
    finish(gates, format, sign, (infinite, clash), [x.nan, y.nan], &finite)
}

fn finish(gates: &mut Gates, format: Format, sign: Lit, extra: (Lit, Lit), nans: [Lit; 2], finite: &[Lit]) -> Word {
    let (infinite, clash) = extra;
    let infinity = special(gates, format, sign, true, false);
    let out = gates.choose(infinite, &infinity, finite);
    let invalid = gates.any(&[nans[0], nans[1], clash]);
    let quiet = nan(gates, format);
    gates.choose(invalid, &quiet, &out)
}

pub(super) fn divide(gates: &mut Gates, format: Format, a: &[Lit], b: &[Lit]) -> Word {
    let p = format.precision;
    let (x, y) = (unpack(gates, format, a), unpack(gates, format, b));
    let sign = gates.xor(x.sign, y.sign);
    let (left, left_exponent) = normalise(gates, &x.significand, &x.exponent);
    let (right, right_exponent) = normalise(gates, &y.significand, &y.exponent);
    let mut dividend = gates.number(p + 2, 0);
    dividend.extend_from_slice(&left);
    let (quotient, rest) = gates.divide(&dividend, &right);
    let mut significand = vec![gates.any(&rest)];
    significand.extend_from_slice(&quotient[..p + 3]);
    let exponent = gates.subtract(&left_exponent, &right_exponent).0;
    let less = signed(gates, -(p as i64 + 3));
    let exponent = gates.add(&exponent, &less);
    let finite = round(gates, format, sign, &significand, &exponent);
    let zero = special(gates, format, sign, false, false);
    let nothing = gates.or(x.zero, y.infinite);
    let finite = gates.choose(nothing, &zero, &finite);
    let infinite = gates.or(x.infinite, y.zero);
    let clash = gates.and(infinite, nothing);
    finish(gates, format, sign, (infinite, clash), [x.nan, y.nan], &finite)
}

/// By the school's method, two bits of the radicand for each of the root.
pub(super) fn square_root(gates: &mut Gates, format: Format, a: &[Lit]) -> Word {
    let p = format.precision;
    let x = unpack(gates, format, a);
    let (significand, exponent) = normalise(gates, &x.significand, &x.exponent);
    // An even exponent: an odd one gives a bit to the significand.
    let odd = exponent[0];
    let mut radicand = significand.clone();
    radicand.push(gates.constant(false));
    let mut doubled = vec![gates.constant(false)];
    doubled.extend_from_slice(&significand);
    let radicand = gates.choose(odd, &doubled, &radicand);
    let mut even = exponent.clone();
    even[0] = gates.constant(false);
    // So many zeros behind that the root has p + 2 bits at least; an even number.
    let zeros = p + 5 + (p + 5) % 2;
    let mut wide = gates.number(zeros, 0);
    wide.extend_from_slice(&radicand);
    if wide.len() % 2 == 1 {
        wide.push(gates.constant(false));
    }
    let (root, rest) = integer_root(gates, &wide);
    let mut word = vec![gates.any(&rest)];
    word.extend(root);
    let less = signed(gates, -(zeros as i64));
    let mut halved = gates.add(&even, &less);
    halved.remove(0);
    let halved = gates.sign_extend(&halved, EXPONENT);
    let one = signed(gates, -1);
    let exponent = gates.add(&halved, &one);
    let finite = round(gates, format, gates.constant(false), &word, &exponent);
    let out = gates.choose(x.zero, a, &finite);
    let out = gates.choose(x.infinite, a, &out);
    let negative = gates.and(x.sign, !x.zero);
    let invalid = gates.or(x.nan, negative);
    let quiet = nan(gates, format);
    gates.choose(invalid, &quiet, &out)
}

fn integer_root(gates: &mut Gates, radicand: &[Lit]) -> (Word, Word) {
    let digits = radicand.len() / 2;
    let width = digits + 3;
    let mut root = gates.number(width, 0);
    let mut rest = gates.number(width, 0);
    for digit in (0..digits).rev() {
        rest.splice(0..0, [radicand[2 * digit], radicand[2 * digit + 1]]);
        rest.truncate(width);
        let mut trial = vec![gates.constant(true), gates.constant(false)];
        trial.extend_from_slice(&root[..width - 2]);
        let (difference, fits) = gates.subtract(&rest, &trial);
        rest = gates.choose(fits, &difference, &rest);
        root.insert(0, fits);
        root.truncate(width);
    }
    root.truncate(digits);
    (root, rest)
}

pub(super) fn equal(gates: &mut Gates, format: Format, a: &[Lit], b: &[Lit]) -> Lit {
    let (x, y) = (unpack(gates, format, a), unpack(gates, format, b));
    let same = gates.equal(a, b);
    let zeros = gates.and(x.zero, y.zero);
    let either = gates.or(same, zeros);
    let invalid = gates.or(x.nan, y.nan);
    gates.and(either, !invalid)
}

/// `a < b`, or `a <= b` where `or_equal`.
pub(super) fn less(gates: &mut Gates, format: Format, a: &[Lit], b: &[Lit], or_equal: bool) -> Lit {
    let (x, y) = (unpack(gates, format, a), unpack(gates, format, b));
    let top = format.width() - 1;
    let smaller = gates.unsigned_less(&a[..top], &b[..top]);
    let larger = gates.unsigned_less(&b[..top], &a[..top]);
    let magnitudes = gates.mux(x.sign, larger, smaller);
    let signs_differ = gates.xor(x.sign, y.sign);
    let by_order = gates.mux(signs_differ, x.sign, magnitudes);
    let zeros = gates.and(x.zero, y.zero);
    let strictly = gates.and(by_order, !zeros);
    let invalid = gates.or(x.nan, y.nan);
    let same = gates.equal(a, b);
    let equal = gates.or(same, zeros);
    let out = if or_equal { gates.or(strictly, equal) } else { strictly };
    gates.and(out, !invalid)
}

pub(super) fn to_float(gates: &mut Gates, from: Format, to: Format, a: &[Lit]) -> Word {
    let x = unpack(gates, from, a);
    let finite = round(gates, to, x.sign, &x.significand, &x.exponent);
    let never = gates.constant(false);
    finish(gates, to, x.sign, (x.infinite, never), [x.nan, never], &finite)
}

pub(super) fn from_integer(gates: &mut Gates, to: Format, a: &[Lit], is_signed: bool) -> Word {
    let sign = if is_signed { a.last().copied().unwrap_or(gates.constant(false)) } else { gates.constant(false) };
    let negated = gates.negate(a);
    let magnitude = gates.choose(sign, &negated, a);
    let exponent = signed(gates, 0);
    round(gates, to, sign, &magnitude, &exponent)
}

/// To an integer of `width` bits: to nearest, or toward zero; saturating; NaN gives 0.
pub(super) fn to_integer(
    gates: &mut Gates,
    from: Format,
    a: &[Lit],
    width: usize,
    is_signed: bool,
    truncate: bool,
) -> Word {
    let x = unpack(gates, from, a);
    let fraction = from.precision + 1;
    // The value times 2^fraction, as far as it fits; larger ones are told by their exponent.
    let total = width + 2 + fraction;
    let places = signed(gates, fraction as i64);
    let shift = gates.add(&x.exponent, &places);
    let left = !shift[EXPONENT - 1];
    let wide = gates.zero_extend(&x.significand, total);
    let up = gates.shift_left(&wide, &shift[..EXPONENT - 1]);
    let back = gates.negate(&shift);
    let down = gates.shift_right_sticky(&wide, &back[..EXPONENT - 1]);
    let fixed = gates.choose(left, &up, &down);
    let whole = fixed[fraction..].to_vec();
    let rest = gates.any(&fixed[..fraction - 1]);
    let odd = gates.or(rest, whole[0]);
    let nearest = gates.and(fixed[fraction - 1], odd);
    let round_up = if truncate { gates.constant(false) } else { nearest };
    let zero = gates.number(whole.len(), 0);
    let (whole, _) = gates.add_carry(&whole, &zero, round_up);
    // 2^(width + 1) or more is certainly outside.
    let limit = signed(gates, width as i64 + 1 - (from.precision as i64 - 1));
    let beyond = !gates.signed_less(&x.exponent, &limit);
    let normal = x.significand[from.precision - 1];
    let huge = gates.and(beyond, normal);
    let huge = gates.or(huge, x.infinite);
    let largest = if is_signed { mask(width - 1) } else { mask(width) };
    let (high, low) = (gates.number(whole.len(), largest), gates.number(whole.len(), largest.wrapping_add(1)));
    let over = gates.unsigned_less(&high, &whole);
    let over = gates.or(over, huge);
    let under = if is_signed {
        let below = gates.unsigned_less(&low, &whole);
        gates.or(below, huge)
    } else {
        gates.any(&whole)
    };
    let under = if is_signed { under } else { gates.or(under, huge) };
    let negated = gates.negate(&whole);
    let (top, bottom) = (gates.number(width, largest), gates.number(width, if is_signed { largest + 1 } else { 0 }));
    let positive = gates.choose(over, &top, &whole[..width]);
    let negative = gates.choose(under, &bottom, &negated[..width]);
    let value = gates.choose(x.sign, &negative, &positive);
    let none = gates.number(width, 0);
    gates.choose(x.nan, &none, &value)
}

const fn mask(width: usize) -> u64 {
    if width >= 64 { u64::MAX } else { (1 << width) - 1 }
}
