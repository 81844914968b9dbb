//! Integer circuits over words, that is literals from the least significant bit on: ripple-carry sums, shift-and-add
//! products, restoring division, barrel shifters. They are the plain ones: SAT solvers do better on them than on the fast
//! ones of hardware.

use crate::logic::aig::{Aig, Lit};

/// Literals from the least significant bit on.
pub(super) type Word = Vec<Lit>;

/// The constant `value` in `width` bits.
pub(super) fn constant(value: u64, width: usize) -> Word {
    (0..width).map(|bit| if bit < 64 && value >> bit & 1 == 1 { Lit::TRUE } else { Lit::FALSE }).collect()
}

/// The value, where all bits are constant.
pub(super) fn value(word: &[Lit]) -> Option<u64> {
    let bits = word.iter().enumerate();
    bits.rev().try_fold(0, |value, (_, lit)| match *lit {
        Lit::FALSE => Some(value << 1),
        Lit::TRUE => Some(value << 1 | 1),
        _ => None,
    })
}

/// Each bit inverted.
pub(super) fn not(word: &[Lit]) -> Word {
    word.iter().map(|lit| !*lit).collect()
}

/// The word in `width` bits, with zeros in front.
pub(super) fn zero_extend(word: &[Lit], width: usize) -> Word {
    let mut out = word.to_vec();
    out.resize(width, Lit::FALSE);
    out
}

/// The word in `width` bits, with its sign in front.
pub(super) fn sign_extend(word: &[Lit], width: usize) -> Word {
    let mut out = word.to_vec();
    out.resize(width, word[word.len() - 1]);
    out
}

/// The highest bit.
pub(super) fn sign(word: &[Lit]) -> Lit {
    word[word.len() - 1]
}

/// Whether a bit is set.
pub(super) fn any(aig: &mut Aig, word: &[Lit]) -> Lit {
    word.iter().fold(Lit::FALSE, |any, lit| aig.or(any, *lit))
}

/// Whether all bits are set.
pub(super) fn all(aig: &mut Aig, word: &[Lit]) -> Lit {
    word.iter().fold(Lit::TRUE, |all, lit| aig.and(all, *lit))
}

/// Each bit chosen.
pub(super) fn ite(aig: &mut Aig, condition: Lit, then: &[Lit], otherwise: &[Lit]) -> Word {
    then.iter().zip(otherwise).map(|(then, otherwise)| aig.ite(condition, *then, *otherwise)).collect()
}

/// Each bit, where the condition holds, else zero.
pub(super) fn gated(aig: &mut Aig, condition: Lit, word: &[Lit]) -> Word {
    word.iter().map(|lit| aig.and(condition, *lit)).collect()
}

/// The sum of words of one width and a carry, and the carry out of it.
pub(super) fn sum(aig: &mut Aig, a: &[Lit], b: &[Lit], mut carry: Lit) -> (Word, Lit) {
    let mut out = Word::with_capacity(a.len());
    for (a, b) in a.iter().zip(b) {
        let (differ, both) = (aig.xor(*a, *b), aig.and(*a, *b));
        out.push(aig.xor(differ, carry));
        let passed = aig.and(differ, carry);
        carry = aig.or(both, passed);
    }
    (out, carry)
}

/// The sum.
pub(super) fn add(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> Word {
    sum(aig, a, b, Lit::FALSE).0
}

/// The difference.
pub(super) fn sub(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> Word {
    sum(aig, a, &not(b), Lit::TRUE).0
}

/// The difference, and whether the first is not less than the second.
pub(super) fn difference(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> (Word, Lit) {
    sum(aig, a, &not(b), Lit::TRUE)
}

/// The negation.
pub(super) fn neg(aig: &mut Aig, a: &[Lit]) -> Word {
    negated_if(aig, Lit::TRUE, a)
}

/// The negation where the condition holds.
pub(super) fn negated_if(aig: &mut Aig, condition: Lit, a: &[Lit]) -> Word {
    let flipped: Word = a.iter().map(|lit| aig.xor(condition, *lit)).collect();
    let zero = constant(0, a.len());
    sum(aig, &flipped, &zero, condition).0
}

/// Equality.
pub(super) fn eq(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> Lit {
    a.iter().zip(b).fold(Lit::TRUE, |equal, (a, b)| {
        let differ = aig.xor(*a, *b);
        aig.and(equal, !differ)
    })
}

/// Unsigned less, from the least significant bit on: the last bit that differs decides.
pub(super) fn ult(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> Lit {
    a.iter().zip(b).fold(Lit::FALSE, |less, (a, b)| {
        let (below, not_above) = (aig.and(!*a, *b), aig.or(!*a, *b));
        let kept = aig.and(less, not_above);
        aig.or(below, kept)
    })
}

/// Signed less.
pub(super) fn slt(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> Lit {
    let (mut a, mut b) = (a.to_vec(), b.to_vec());
    let high = a.len() - 1;
    (a[high], b[high]) = (!a[high], !b[high]);
    ult(aig, &a, &b)
}

/// The low `width` bits of the product.
pub(super) fn mul(aig: &mut Aig, a: &[Lit], b: &[Lit], width: usize) -> Word {
    match (value(a), value(b)) {
        (_, Some(factor)) if b.len() <= 64 => mul_constant(aig, a, factor, width),
        (Some(factor), _) if a.len() <= 64 => mul_constant(aig, b, factor, width),
        _ => mul_words(aig, a, b, width),
    }
}

fn mul_words(aig: &mut Aig, a: &[Lit], b: &[Lit], width: usize) -> Word {
    let mut out = constant(0, width);
    for (shift, bit) in b.iter().enumerate().take(width) {
        let row = gated(aig, *bit, a);
        let end = (shift + row.len()).min(width);
        let (bits, carry) = sum(aig, &out[shift..end], &row[..end - shift], Lit::FALSE);
        out[shift..end].copy_from_slice(&bits);
        if end < width {
            out[end] = carry;
        }
    }
    out
}

/// By the digits -1, 0 and 1 of the factor's non-adjacent form, of which few are not 0 (Reitwiesner, *Binary Arithmetic*,
/// 1960).
fn mul_constant(aig: &mut Aig, a: &[Lit], factor: u64, width: usize) -> Word {
    let (mut out, mut rest) = (constant(0, width), u128::from(factor));
    let mut shift = 0;
    while rest != 0 && shift < width {
        if rest & 1 == 1 {
            let negative = rest & 2 == 2;
            let mut row = constant(0, shift);
            row.extend(a);
            let row = zero_extend(&row[..row.len().min(width)], width);
            out = if negative { sub(aig, &out, &row) } else { add(aig, &out, &row) };
            rest = if negative { rest + 1 } else { rest - 1 };
        }
        rest >>= 1;
        shift += 1;
    }
    out
}

/// Quotient and remainder, unsigned, of words of one width; by zero, all ones and the dividend. After `k` digits the
/// remainder has `k` bits at most, and a divisor with a bit beyond them gives the digit 0.
pub(super) fn divide(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> (Word, Word) {
    let width = a.len();
    let mut beyond = vec![Lit::FALSE; width + 1];
    for bit in (0..width).rev() {
        beyond[bit] = aig.or(beyond[bit + 1], b[bit]);
    }
    let (mut quotient, mut remainder) = (constant(0, width), Word::new());
    for bit in (0..width).rev() {
        remainder.insert(0, a[bit]);
        let bits = remainder.len();
        let (less, enough) = difference(aig, &remainder, &b[..bits]);
        let digit = aig.and(enough, !beyond[bits]);
        remainder = ite(aig, digit, &less, &remainder);
        quotient[bit] = digit;
    }
    (quotient, remainder)
}

/// Shifted left by `amount`, zeros coming in.
pub(super) fn shift_left(aig: &mut Aig, a: &[Lit], amount: &[Lit]) -> Word {
    let reversed: Word = a.iter().rev().copied().collect();
    let mut out = shift_right(aig, &reversed, amount, Lit::FALSE);
    out.reverse();
    out
}

/// Shifted right by `amount`, with `fill` coming in.
pub(super) fn shift_right(aig: &mut Aig, a: &[Lit], amount: &[Lit], fill: Lit) -> Word {
    let (mut out, mut beyond) = (a.to_vec(), Lit::FALSE);
    for (stage, bit) in amount.iter().enumerate() {
        if stage < usize::BITS as usize - 1 && 1 << stage < a.len() {
            let moved = moved_right(&out, 1 << stage, fill);
            out = ite(aig, *bit, &moved, &out);
        } else {
            beyond = aig.or(beyond, *bit);
        }
    }
    let filled = vec![fill; a.len()];
    ite(aig, beyond, &filled, &out)
}

/// Shifted right by `amount`, and whether a set bit was lost.
pub(super) fn shift_right_sticky(aig: &mut Aig, a: &[Lit], amount: &[Lit]) -> (Word, Lit) {
    let (mut out, mut lost, mut beyond) = (a.to_vec(), Lit::FALSE, Lit::FALSE);
    for (stage, bit) in amount.iter().enumerate() {
        if stage < usize::BITS as usize - 1 && 1 << stage < a.len() {
            let falling = any(aig, &out[..1 << stage]);
            let falls = aig.and(*bit, falling);
            lost = aig.or(lost, falls);
            let moved = moved_right(&out, 1 << stage, Lit::FALSE);
            out = ite(aig, *bit, &moved, &out);
        } else {
            beyond = aig.or(beyond, *bit);
        }
    }
    let left = any(aig, &out);
    let all_lost = aig.and(beyond, left);
    (gated(aig, !beyond, &out), aig.or(lost, all_lost))
}

fn moved_right(word: &[Lit], by: usize, fill: Lit) -> Word {
    let mut out = word[by.min(word.len())..].to_vec();
    out.resize(word.len(), fill);
    out
}

/// Shifted left until the highest bit is set, and by how much, in `count` bits; a zero stays one.
pub(super) fn normalized(aig: &mut Aig, a: &[Lit], count: usize) -> (Word, Word) {
    let (mut out, mut by) = (a.to_vec(), constant(0, count));
    for stage in (0..count).rev().filter(|stage| *stage < 16 && 1 << stage < a.len()) {
        let size = 1 << stage;
        let used = any(aig, &out[a.len() - size..]);
        let mut moved = constant(0, size);
        moved.extend(&out[..a.len() - size]);
        out = ite(aig, used, &out, &moved);
        by[stage] = !used;
    }
    (out, by)
}
