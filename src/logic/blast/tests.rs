//! Circuits against the operators on values: operands are leaves that are simulated, 64 pairs at once.

use proptest::prelude::*;

use super::{Blaster, blast};
use crate::logic::aig::{self, Lit};
use crate::logic::simulate::Stimulus;
use crate::logic::system::{Input, Labelled, State, System};
use crate::logic::term::{Op, Pool, Term, mask};
use crate::logic::value::operate;

/// Applies `op` to new variables, blasts and simulates, and compares with the operator on values.
fn check(op: Op, widths: &[u32], operands: &[[u64; 3]]) {
    let mut pool = Pool::default();
    let variables: Vec<Term> = widths.iter().map(|width| pool.variable(*width, "v")).collect();
    let term = pool.plain(op, &variables);
    let mut blaster = Blaster::new(&pool);
    let leaves: Vec<Vec<Lit>> = variables.iter().map(|variable| blaster.fresh(*variable)).collect();
    blaster.blast([term]);
    let result = blaster.word(term).to_vec();
    let graph = blaster.finish();
    let mut all = [1; 3];
    all[..widths.len()].copy_from_slice(widths);
    for chunk in operands.chunks(64) {
        let mut words = vec![0; graph.len()];
        for (index, leaves) in leaves.iter().enumerate() {
            for (bit, lit) in leaves.iter().enumerate() {
                let bits = chunk.iter().enumerate();
                words[lit.node() as usize] = bits.fold(0, |word, (at, own)| word | (own[index] >> bit & 1) << at);
            }
        }
        graph.propagate(&mut words);
        for (at, own) in chunk.iter().enumerate() {
            let values = [0, 1, 2].map(|index| own[index] & mask(all[index]));
            let expected = operate(op, values, all);
            let bits = result.iter().enumerate();
            let seen = bits.fold(0, |value, (bit, lit)| value | (aig::word(&words, *lit) >> at & 1) << bit);
            assert_eq!(seen, expected, "{op:?} of {values:x?}, widths {widths:?}: {seen:x} and not {expected:x}");
        }
    }
}

/// A small generator of numbers: xorshift.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }
}

fn count(default: usize) -> usize {
    std::env::var("RUNGBOOK_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

#[test]
fn integer_circuits_are_the_operators() {
    let mut numbers = Numbers(0x9e37_79b9_7f4a_7c15);
    let binary = [
        Op::And,
        Op::Or,
        Op::Xor,
        Op::Add,
        Op::Sub,
        Op::Mul,
        Op::Udiv,
        Op::Sdiv,
        Op::Urem,
        Op::Srem,
        Op::Shl,
        Op::Lshr,
        Op::Ashr,
        Op::Eq,
        Op::Ult,
        Op::Ule,
        Op::Slt,
        Op::Sle,
    ];
    for width in (1..=16).chain([24, 31, 32, 33, 48, 63, 64]) {
        let special = [0, 1, 2, 3, mask(width), mask(width) - 1, mask(width) >> 1, 1 << (width - 1), u64::from(width)];
        let mut operands: Vec<[u64; 3]> = special.iter().flat_map(|a| special.map(|b| [*a, b, 0])).collect();
        if width <= 4 {
            operands.extend((0..1 << (2 * width)).map(|pair: u64| [pair & mask(width), pair >> width, 0]));
        }
        operands.extend((0..count(200)).map(|_| {
            let (a, b) = (numbers.next(), numbers.next());
            [a & mask(width), (b & mask(width)) >> (numbers.next() % u64::from(width)), 0]
        }));
        for op in binary {
            check(op, &[width, width], &operands);
        }
        check(Op::Not, &[width], &operands);
        check(Op::Neg, &[width], &operands);
        check(Op::Extract { high: width - 1, low: width / 2 }, &[width], &operands);
        check(Op::ZeroExtend(64), &[width], &operands);
        check(Op::SignExtend((width + 5).min(64)), &[width], &operands);
        let turned: Vec<[u64; 3]> = operands.iter().map(|[a, b, _]| [a & 1, *a, *b]).collect();
        check(Op::Ite, &[1, width, width], &turned);
        if width <= 32 {
            check(Op::Concat, &[width, 32], &operands);
        }
    }
}

/// Bits of numbers of a format that are likely to be rounded in every way: by the parts, special or random.
fn float(numbers: &mut Numbers, width: u32) -> u64 {
    let (exponent_bits, fraction_bits) = if width == 32 { (8, 23) } else { (11, 52) };
    let top = mask(exponent_bits);
    let bias = top >> 1;
    let random = numbers.next();
    let exponent = match random % 8 {
        0 => 0,
        1 => top,
        2 => 1,
        3 => top - 1,
        4 | 5 => bias.wrapping_sub(40).wrapping_add(numbers.next() % 80) & top,
        _ => numbers.next() & top,
    };
    let fraction = match random >> 8 & 7 {
        0 => 0,
        1 => mask(fraction_bits),
        2 => 1,
        3 => 1 << (numbers.next() % u64::from(fraction_bits)),
        4 => mask(fraction_bits) ^ mask((numbers.next() % u64::from(fraction_bits)) as u32),
        5 => numbers.next() & 0b1111,
        _ => numbers.next(),
    };
    (random >> 16 & 1) << (width - 1) | exponent << fraction_bits | fraction & mask(fraction_bits)
}

/// Pairs, some of which are near each other, and halfway cases for sums.
fn float_pairs(numbers: &mut Numbers, width: u32, count: usize) -> Vec<[u64; 3]> {
    let pair = |numbers: &mut Numbers| {
        let a = float(numbers, width);
        let b = match numbers.next() % 4 {
            0 => a ^ numbers.next() & 3,
            1 => (a ^ 1 << (width - 1)).wrapping_add(numbers.next() % 5) & mask(width),
            _ => float(numbers, width),
        };
        [a, b, 0]
    };
    (0..count).map(|_| pair(numbers)).collect()
}

#[test]
fn float_circuits_are_those_of_the_machine() {
    let mut numbers = Numbers(0x1234_5678_9abc_def1);
    for width in [32, 64] {
        let operands = float_pairs(&mut numbers, width, count(6000));
        for op in [Op::FloatAdd, Op::FloatSub, Op::FloatMul, Op::FloatEq, Op::FloatLt, Op::FloatLe, Op::FloatDiv] {
            check(op, &[width, width], &operands);
        }
        check(Op::FloatSqrt, &[width], &operands);
        check(Op::FloatToFloat(32), &[width], &operands);
        check(Op::FloatToFloat(64), &[width], &operands);
        for to in [1, 5, 8, 16, 31, 32, 33, 64] {
            check(Op::FloatToSigned(to), &[width], &operands);
            check(Op::FloatToUnsigned(to), &[width], &operands);
            check(Op::FloatTruncate(to), &[width], &operands);
        }
    }
}

#[test]
fn integers_become_the_nearest_floats() {
    let mut numbers = Numbers(0x0dd5_eed5_0dd5_eed5);
    for width in [1, 2, 8, 16, 24, 25, 32, 53, 54, 63, 64] {
        let operands: Vec<[u64; 3]> = (0..count(2000))
            .map(|at| {
                let shift = numbers.next() % u64::from(width);
                let ties = [numbers.next(), mask(width), 1 << (width - 1), (numbers.next() | 1) << (shift / 2)];
                [(ties[at % 4] & mask(width)) >> if at % 3 == 0 { shift } else { 0 }, 0, 0]
            })
            .collect();
        for to in [32, 64] {
            check(Op::SignedToFloat(to), &[width], &operands);
            check(Op::UnsignedToFloat(to), &[width], &operands);
        }
    }
}

fn labelled(term: Term) -> Labelled {
    Labelled { term, name: String::new(), origin: None }
}

/// A system with initial values of every kind: constant, by a constant one, by a free one.
fn system(start: u64, factor: u64) -> System {
    let mut system = System::default();
    let pool = &mut system.pool;
    let input = pool.variable(8, "in");
    let names = ["free", "start", "next", "twice"];
    let vars = names.map(|name| pool.variable(8, name));
    let [free, first, next, twice] = vars;
    let (start, factor) = (pool.constant(8, start), pool.constant(8, factor));
    let (after, product) = (pool.add(first, factor), pool.mul(free, factor));
    let product = pool.add(product, next);
    let (sum, step) = (pool.add(next, input), pool.xor(twice, first));
    let (limit, inside) = (pool.constant(8, 250), pool.ult(input, factor));
    let (safe, equal) = (pool.ult(twice, limit), pool.ne(sum, twice));
    let either = pool.or(inside, equal);
    system.inputs.push(Input { variable: input, name: "in".to_owned(), origin: None });
    let rows = [(None, free), (Some(start), sum), (Some(after), step), (Some(product), sum)];
    for ((name, variable), (initial, next)) in names.into_iter().zip(vars).zip(rows) {
        system.states.push(State { variable, name: name.to_owned(), initial, next, origin: None });
    }
    system.constraints.push(labelled(either));
    system.obligations.extend([labelled(safe), labelled(equal)]);
    system.outputs.push(labelled(sum));
    system
}

proptest! {
    #[test]
    fn a_blasted_system_runs_as_the_system(start: u8, factor: u8, free: [u64; 4], inputs: Vec<u8>) {
        let system = system(u64::from(start), u64::from(factor));
        let blasted = blast(&system);
        let stimulus = Stimulus { free: free.to_vec(), inputs: inputs.iter().map(|own| vec![u64::from(*own)]).collect() };
        let trace = blasted.trace(&system, &stimulus);
        let (words, bits) = (system.run(&stimulus), blasted.model.simulate(&trace));
        prop_assert_eq!(words.len(), bits.len());
        for (words, bits) in words.iter().zip(&bits) {
            let mut own = bits.latches.iter().copied();
            let states: Vec<u64> = blasted.states.iter().map(|word| super::packed(word.len(), &mut own)).collect();
            prop_assert_eq!(&words.states, &states);
            prop_assert_eq!(words.constraints.iter().all(|holds| *holds), bits.constrained);
            prop_assert!(words.obligations.iter().zip(&bits.bad).all(|(holds, bad)| holds != bad));
        }
        let back = blasted.stimulus(&trace);
        prop_assert_eq!(system.run(&back), words);
        // A first value that is not what it must be breaks the constraint of the first cycle, where it is not a constant.
        for latch in (24..32).filter(|latch| blasted.model.latches[*latch].initial.is_none() && !bits.is_empty()) {
            let mut wrong = trace.clone();
            wrong.latches[latch] = !wrong.latches[latch];
            prop_assert!(!blasted.model.simulate(&wrong)[0].constrained);
        }
    }
}

#[test]
fn clauses_without_the_first_cycle_are_pairs() {
    let blasted = blast(&system(1, 3));
    let first = blasted.first().expect("the last variable starts by a free one");
    assert_eq!(first, 32);
    let clauses = [vec![(0, true), (first, true)], vec![(1, true), (first, false)], vec![(2, false)]];
    let bits: Vec<Vec<(u32, bool)>> = blasted
        .project(&clauses)
        .into_iter()
        .map(|clause| clause.into_iter().map(|bit| (bit.bit, bit.value)).collect())
        .collect();
    let expected =
        [vec![(0, true), (1, true)], vec![(0, true), (2, false)], vec![(1, true), (2, false)], vec![(2, false)]];
    assert_eq!(bits, expected);
}
