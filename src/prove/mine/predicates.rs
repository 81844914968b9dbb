//! Predicates over pairs of latched words that random runs make worth a guess.

use std::collections::BTreeSet;

use super::super::engine::{Budget, Reason};
use super::super::problem::Problem;
use super::sample::Samples;
use crate::logic::aig::{Aig, Lit};

/// Most pairs of words that are related.
const PAIRS: usize = 300;
/// Most bounds.
const BOUNDS: usize = 200;
/// Most values of a word whose values are told apart one by one, and most such values of all words.
const FEW: usize = 8;
const CASES: usize = 60;

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

/// The relation `y = factor * x + offset` that all of the samples obey, where `x` takes three values or more.
fn relation(samples: impl Iterator<Item = (u64, u64)> + Clone, width: usize) -> Option<(u64, u64)> {
    let mask = mask(width);
    let (x, y) = samples.clone().next()?;
    let (dx, dy) = samples
        .clone()
        .map(|(a, b)| (a.wrapping_sub(x) as i64, b.wrapping_sub(y) as i64))
        .find(|&(dx, dy)| dx != 0 || dy != 0)?;
    if dx == 0 || dy.checked_rem(dx) != Some(0) || dy == 0 {
        return None;
    }
    let factor = (dy / dx) as u64 & mask;
    let offset = y.wrapping_sub(factor.wrapping_mul(x)) & mask;
    let mut values = [x, x.wrapping_add(dx as u64), x];
    for (a, b) in samples {
        if factor.wrapping_mul(a).wrapping_add(offset) & mask != b {
            return None;
        }
        if !values[..2].contains(&a) {
            values[2] = a;
        }
    }
    (values[2] != x).then_some((factor, offset))
}

/// Predicates over words.
pub(super) struct Predicates {
    /// All of them, each once.
    pub(super) all: Vec<Lit>,
    /// Those that say that two words are equal, with the words.
    pub(super) equal: Vec<(Lit, Vec<Lit>, Vec<Lit>)>,
    /// Those that say that a word of few values has one of them.
    pub(super) values: Vec<Lit>,
}

/// Adds the predicates to the problem's graph.
///
/// # Errors
/// If the budget ends before.
pub(super) fn between(
    problem: &mut Problem,
    words: &[Vec<Lit>],
    samples: &Samples,
    budget: &Budget,
) -> Result<Predicates, Reason> {
    let mut predicates = Vec::new();
    let (mut same, mut values) = (Vec::new(), Vec::new());
    let aig = &mut problem.model.aig;
    let pairs: Vec<(usize, usize)> = (0..words.len()).flat_map(|i| (0..i).map(move |j| (i, j))).take(PAIRS).collect();
    for &(i, j) in &pairs {
        let (x, y) = (&words[j], &words[i]);
        if x.len() == y.len() {
            let [less, greater, is_equal, below, above] = orders(aig, x, y);
            predicates.extend([less, greater, is_equal, below, above]);
            same.push((is_equal, x.clone(), y.clone()));
        }
    }
    for (x, y, line) in lines(words, samples, &pairs, budget)? {
        let line = linear(aig, &words[x], line, words[y].len());
        predicates.push(equal(aig, &line, &words[y]));
    }
    for (word, least, most) in bounds(words, samples) {
        let bits = &words[word];
        for (low, high) in [(constant(bits.len(), least), bits.clone()), (bits.clone(), constant(bits.len(), most))] {
            predicates.push(carries(aig, &low, &high, Lit::TRUE));
        }
    }
    for (word, value) in cases(words, samples) {
        let bits = &words[word];
        let number = constant(bits.len(), value);
        values.push(equal(aig, bits, &number));
    }
    predicates.extend(&values);
    let mut seen = BTreeSet::new();
    let mut plain: Vec<Lit> = predicates.iter().map(|p| Lit::of(p.node())).collect();
    plain.retain(|p| p.node() != 0 && seen.insert(*p));
    Ok(Predicates { all: plain, equal: same, values })
}

/// Words that take few values, more than one, and which.
fn cases(words: &[Vec<Lit>], samples: &Samples) -> Vec<(usize, u64)> {
    let values = |word: usize| samples.words[word].iter().copied().collect::<BTreeSet<u64>>();
    let few = (0..words.len()).map(|word| (word, values(word))).filter(|(_, v)| (2..=FEW).contains(&v.len()));
    few.flat_map(|(word, values)| values.into_iter().map(move |value| (word, value))).take(CASES).collect()
}

/// For no guard and for each, the samples in which it is true.
fn kept(samples: &Samples) -> Vec<Vec<usize>> {
    let count = samples.words.first().map_or(0, Vec::len);
    let all = (0..count).collect();
    let guarded = samples.guards.iter().map(|g| (0..count).filter(|&at| g[at]).collect());
    std::iter::once(all).chain(guarded).collect()
}

/// Two words and the factor and offset between them.
type Lines = BTreeSet<(usize, usize, (u64, u64))>;

/// Linear relations between words, in general or under a guard.
fn lines(words: &[Vec<Lit>], samples: &Samples, pairs: &[(usize, usize)], budget: &Budget) -> Result<Lines, Reason> {
    let mut found = BTreeSet::new();
    for places in kept(samples) {
        budget.check()?;
        for &(i, j) in pairs {
            for (x, y) in [(i, j), (j, i)] {
                let both = places.iter().map(|&at| (samples.words[x][at], samples.words[y][at]));
                if let Some(line) = relation(both, words[y].len()) {
                    found.insert((x, y, line));
                    break;
                }
            }
        }
    }
    Ok(found)
}

/// The least and the greatest value of words, in general or under a guard, where these are few.
fn bounds(words: &[Vec<Lit>], samples: &Samples) -> BTreeSet<(usize, u64, u64)> {
    let mut found = BTreeSet::new();
    for places in kept(samples) {
        for word in 0..words.len() {
            let values = places.iter().map(|&at| samples.words[word][at]);
            // What counts takes every value between; of what does not, bounds say little.
            let distinct: BTreeSet<u64> = values.collect();
            if let (Some(&least), Some(&most)) = (distinct.first(), distinct.last())
                && least < most
                && (distinct.len() <= FEW || distinct.len() as u64 == (most - least).saturating_add(1))
                && found.len() < BOUNDS
            {
                found.insert((word, least, most));
            }
        }
    }
    found
}

/// Less, greater and equal, unsigned and signed.
fn orders(aig: &mut Aig, x: &[Lit], y: &[Lit]) -> [Lit; 5] {
    let flip = |w: &[Lit]| {
        let mut w = w.to_vec();
        if let Some(sign) = w.last_mut() {
            *sign = !*sign;
        }
        w
    };
    let (sx, sy) = (flip(x), flip(y));
    [
        carries(aig, &sx, &sy, Lit::FALSE),
        carries(aig, &sy, &sx, Lit::FALSE),
        equal(aig, x, y),
        carries(aig, x, y, Lit::FALSE),
        carries(aig, y, x, Lit::FALSE),
    ]
}
