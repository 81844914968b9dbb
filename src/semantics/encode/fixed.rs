//! The fixed-point reading of reals: a signed integer of `width` bits that counts 10^-digits. Sums, products and quotients
//! are made in 64 bits, cut toward zero, and saturate, as a real does not wrap around; division by zero gives
//! the largest number of the dividend's sign. There is no NaN and no infinity.

use super::super::expr::Op;
use super::super::scalar::Scalar;
use super::convert::{clamp, resize};
use super::operator::absolute;
use crate::logic::term::{Op as T, Pool, Term, mask};

/// What one is.
const fn unit(digits: u32) -> i64 {
    10i64.pow(if digits > 9 { 9 } else { digits })
}

/// The largest number of a width.
const fn largest(width: u32) -> i64 {
    (mask(width - 1)) as i64
}

/// The operators on reals; `None` where there is none.
pub(super) fn apply(pool: &mut Pool, op: Op, digits: u32, width: u32, terms: &[Term]) -> Option<Term> {
    Some(match op {
        Op::Eq => pool.apply(T::Eq, terms),
        Op::Lt => pool.apply(T::Slt, terms),
        Op::Le => pool.apply(T::Sle, terms),
        Op::Neg => {
            let long = resize(pool, terms[0], 64, true);
            let opposite = pool.apply(T::Neg, &[long]);
            saturate(pool, opposite, width)
        }
        Op::Abs => {
            let long = resize(pool, terms[0], 64, true);
            let positive = absolute(pool, long);
            saturate(pool, positive, width)
        }
        Op::Add | Op::Sub | Op::Mul | Op::Div => {
            terms[1..].iter().fold(terms[0], |left, right| arithmetic(pool, op, digits, width, left, *right))
        }
        _ => return None,
    })
}

/// A sum, difference, product or quotient.
fn arithmetic(pool: &mut Pool, op: Op, digits: u32, width: u32, left: Term, right: Term) -> Term {
    let (left, right) = (resize(pool, left, 64, true), resize(pool, right, 64, true));
    let unit = pool.constant(64, unit(digits).cast_unsigned());
    let result = match op {
        Op::Add => pool.apply(T::Add, &[left, right]),
        Op::Sub => pool.apply(T::Sub, &[left, right]),
        Op::Mul => {
            let product = pool.apply(T::Mul, &[left, right]);
            pool.apply(T::Sdiv, &[product, unit])
        }
        _ => {
            let zero = pool.constant(64, 0);
            let scaled = pool.apply(T::Mul, &[left, unit]);
            let quotient = pool.apply(T::Sdiv, &[scaled, right]);
            let by_zero = pool.apply(T::Eq, &[right, zero]);
            let negative = pool.apply(T::Slt, &[left, zero]);
            let (top, bottom) = (pool.constant(64, mask(63)), pool.constant(64, 1 << 63));
            let largest = pool.apply(T::Ite, &[negative, bottom, top]);
            pool.apply(T::Ite, &[by_zero, largest, quotient])
        }
    };
    saturate(pool, result, width)
}

/// A number of 64 bits, held in `width` bits.
fn saturate(pool: &mut Pool, term: Term, width: u32) -> Term {
    let held = clamp(pool, term, -largest(width) - 1, largest(width));
    resize(pool, held, width, true)
}

/// Conversions from and to reals.
pub(super) fn convert(pool: &mut Pool, digits: u32, width: u32, from: Scalar, to: Scalar, term: Term) -> Term {
    match (from, to) {
        (Scalar::Fixed { .. }, Scalar::Fixed { .. }) => term,
        (Scalar::Fixed { .. }, Scalar::Bool) => {
            let zero = pool.constant(width, 0);
            let is_zero = pool.apply(T::Eq, &[term, zero]);
            pool.apply(T::Not, &[is_zero])
        }
        (Scalar::Fixed { .. }, _) => {
            let nearest = round(pool, digits, term);
            integer(pool, to, nearest)
        }
        _ => {
            let (signed, limit) = (from.is_signed(), largest(width) / unit(digits) + 1);
            let long = resize(pool, term, 64, signed);
            // A number of 64 bits without a sign that looks negative is large.
            let long = if !signed && from.width() == 64 {
                let (zero, top) = (pool.constant(64, 0), pool.constant(64, mask(63)));
                let large = pool.apply(T::Slt, &[long, zero]);
                pool.apply(T::Ite, &[large, top, long])
            } else {
                long
            };
            let held = clamp(pool, long, -limit, limit);
            let unit = pool.constant(64, unit(digits).cast_unsigned());
            let scaled = pool.apply(T::Mul, &[held, unit]);
            saturate(pool, scaled, width)
        }
    }
}

/// The nearest whole number, in 64 bits, ties to even.
fn round(pool: &mut Pool, digits: u32, term: Term) -> Term {
    let long = resize(pool, term, 64, true);
    if digits == 0 {
        return long;
    }
    let one = unit(digits);
    let (unit, half, zero) =
        (pool.constant(64, one.cast_unsigned()), pool.constant(64, (one / 2).cast_unsigned()), pool.constant(64, 0));
    let whole = pool.apply(T::Sdiv, &[long, unit]);
    let rest = pool.apply(T::Srem, &[long, unit]);
    let rest = absolute(pool, rest);
    let odd = pool.apply(T::Extract { high: 0, low: 0 }, &[whole]);
    let (above, tie) = (pool.apply(T::Slt, &[half, rest]), pool.apply(T::Eq, &[half, rest]));
    let tie = pool.apply(T::And, &[tie, odd]);
    let away = pool.apply(T::Or, &[above, tie]);
    let (plus, minus) = (pool.constant(64, 1), pool.constant(64, u64::MAX));
    let negative = pool.apply(T::Slt, &[long, zero]);
    let step = pool.apply(T::Ite, &[negative, minus, plus]);
    let further = pool.apply(T::Add, &[whole, step]);
    pool.apply(T::Ite, &[away, further, whole])
}

/// Toward zero.
pub(super) fn trunc(pool: &mut Pool, digits: u32, to: Scalar, term: Term) -> Term {
    let long = resize(pool, term, 64, true);
    let unit = pool.constant(64, unit(digits).cast_unsigned());
    let whole = pool.apply(T::Sdiv, &[long, unit]);
    integer(pool, to, whole)
}

/// A signed number of 64 bits, held in an integer type.
fn integer(pool: &mut Pool, to: Scalar, term: Term) -> Term {
    let width = to.width();
    let (low, high) = match (to.is_signed(), width) {
        (true, _) => (-largest(width) - 1, largest(width)),
        (false, 64) => (0, i64::MAX),
        (false, _) => (0, mask(width).cast_signed()),
    };
    let held = clamp(pool, term, low, high);
    resize(pool, held, width, true)
}
