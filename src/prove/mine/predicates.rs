//! Predicates over pairs of latched words that random runs make worth a guess.

use super::super::problem::Problem;
use super::sample::Samples;
use crate::logic::aig::{Aig, Lit};

/// Most pairs of words that are related.
const PAIRS: usize = 400;

/// `b + not a + carry`: whether that carries, which is `a < b` or, with a carry in, `a <= b`, unsigned.
fn carries(aig: &mut Aig, a: &[Lit], b: &[Lit], carry: Lit) -> Lit {
    let mut carry = carry;
    for (&x, &y) in a.iter().zip(b) {
        let (both, either) = (aig.and(!x, y), aig.or(!x, y));
        let through = aig.and(either, carry);
        carry = aig.or(both, through);
    }
    carry
}

fn equal(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> Lit {
    let mut all = Lit::TRUE;
    for (&x, &y) in a.iter().zip(b) {
        let differ = aig.xor(x, y);
        all = aig.and(all, !differ);
    }
    all
}

fn add(aig: &mut Aig, a: &[Lit], b: &[Lit]) -> Vec<Lit> {
    let mut carry = Lit::FALSE;
    let mut sum = Vec::new();
    for (&x, &y) in a.iter().zip(b) {
        let half = aig.xor(x, y);
        sum.push(aig.xor(half, carry));
        let (both, through) = (aig.and(x, y), aig.and(half, carry));
        carry = aig.or(both, through);
    }
    sum
}

fn constant(width: usize, value: u64) -> Vec<Lit> {
    (0..width).map(|i| Lit::FALSE.invert_if(i < 64 && value >> i & 1 == 1)).collect()
}

/// `factor * word + offset`, as wide as `width`.
fn linear(aig: &mut Aig, word: &[Lit], (factor, offset): (u64, u64), width: usize) -> Vec<Lit> {
    let mut sum = constant(width, offset);
    for shift in (0..width.min(64)).filter(|s| factor >> s & 1 == 1) {
        let row: Vec<Lit> = (0..width)
            .map(|i| if i >= shift { word.get(i - shift).copied().unwrap_or(Lit::FALSE) } else { Lit::FALSE })
            .collect();
        sum = add(aig, &sum, &row);
    }
    sum
}

fn mask(width: usize) -> u64 {
    if width >= 64 { u64::MAX } else { (1 << width) - 1 }
}

/// The relation `y = factor * x + offset` that most of the samples obey, where one does.
fn relation(xs: &[u64], ys: &[u64], width: usize) -> Option<(u64, u64)> {
    let mask = mask(width);
    let mut votes: std::collections::BTreeMap<(u64, u64), usize> = std::collections::BTreeMap::new();
    for at in 1..xs.len() {
        let (dx, dy) = (xs[at].wrapping_sub(xs[at - 1]) as i64, ys[at].wrapping_sub(ys[at - 1]) as i64);
        if dx != 0 && dy.checked_rem(dx) == Some(0) {
            let factor = (dy / dx) as u64 & mask;
            let offset = ys[at].wrapping_sub(factor.wrapping_mul(xs[at])) & mask;
            if factor != 0 {
                *votes.entry((factor, offset)).or_default() += 1;
            }
        }
    }
    let (&best, &count) = votes.iter().max_by_key(|(key, n)| (**n, std::cmp::Reverse(**key)))?;
    (count * 5 >= xs.len()).then_some(best)
}

/// Adds the predicates to the problem's graph.
pub(super) fn between(problem: &mut Problem, words: &[Vec<Lit>], samples: &Samples) -> Vec<Lit> {
    let mut predicates = Vec::new();
    let pairs = (0..words.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    for (i, j) in pairs.take(PAIRS) {
        let (x, y) = (&words[j], &words[i]);
        let aig = &mut problem.model.aig;
        if x.len() == y.len() && x.len() > 1 {
            predicates.extend(orders(aig, x, y));
        }
        for (x, y, xs, ys) in [(x, y, j, i), (y, x, i, j)] {
            let found = relation(&samples.words[xs], &samples.words[ys], y.len());
            if let Some(found) = found
                && found != (1, 0)
            {
                let line = linear(aig, x, found, y.len());
                predicates.push(equal(aig, &line, y));
            }
        }
    }
    let mut seen = std::collections::BTreeSet::new();
    let mut plain: Vec<Lit> = predicates.iter().map(|p| Lit::of(p.node())).collect();
    plain.retain(|p| p.node() != 0 && seen.insert(*p));
    plain
}

/// Less, greater and equal, unsigned and signed.
fn orders(aig: &mut Aig, x: &[Lit], y: &[Lit]) -> Vec<Lit> {
    let flip = |w: &[Lit]| {
        let mut w = w.to_vec();
        if let Some(sign) = w.last_mut() {
            *sign = !*sign;
        }
        w
    };
    let (sx, sy) = (flip(x), flip(y));
    vec![
        carries(aig, &sx, &sy, Lit::FALSE),
        carries(aig, &sy, &sx, Lit::FALSE),
        equal(aig, x, y),
        carries(aig, x, y, Lit::FALSE),
        carries(aig, y, x, Lit::FALSE),
    ]
}
