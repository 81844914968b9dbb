//! Every rewrite against the operator itself, on random terms made twice: with and without rewriting.

use proptest::prelude::*;

use crate::logic::eval::evaluate;
use crate::logic::term::{Op, Pool, Term, mask};

/// A recipe for a term: numbers that a stack machine turns into one, whatever they are.
fn recipe() -> impl Strategy<Value = Vec<(u8, u64)>> {
    let number = prop_oneof![0_u64..4, any::<u64>(), Just(u64::MAX), (0_u32..64).prop_map(|by| 1 << by)];
    proptest::collection::vec((any::<u8>(), number), 1..24)
}

const BINARY: [Op; 19] = [
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
    Op::Concat,
];

struct Maker<'a> {
    folded: &'a mut Pool,
    plain: &'a mut Pool,
    stack: Vec<(Term, Term)>,
}

impl Maker<'_> {
    fn apply(&mut self, op: Op, operands: &[(Term, Term)]) -> (Term, Term) {
        let (left, right): (Vec<_>, Vec<_>) = operands.iter().copied().unzip();
        (self.folded.apply(op, &left), self.plain.plain(op, &right))
    }

    fn width(&self, at: (Term, Term)) -> u32 {
        self.plain.width(at.1)
    }

    fn fit(&mut self, term: (Term, Term), to: u32) -> (Term, Term) {
        let width = self.width(term);
        if width < to {
            let op = if to.is_multiple_of(2) { Op::ZeroExtend(to) } else { Op::SignExtend(to) };
            self.apply(op, &[term])
        } else {
            self.apply(Op::Extract { high: to - 1, low: 0 }, &[term])
        }
    }

    fn pick(&self, number: u64) -> (Term, Term) {
        self.stack[usize::try_from(number % self.stack.len() as u64).unwrap_or(0)]
    }

    fn step(&mut self, code: u8, number: u64) {
        let (a, b) = (self.pick(number), self.pick(number >> 8));
        let width = self.width(a);
        let made = match code % 32 {
            code @ 0..19 => {
                let op = BINARY[usize::from(code)];
                let b = if op == Op::Concat { b } else { self.fit(b, width) };
                if op == Op::Concat && width + self.width(b) > 64 { a } else { self.apply(op, &[a, b]) }
            }
            19 | 20 => self.apply(Op::Not, &[a]),
            21 => self.apply(Op::Neg, &[a]),
            22..25 => {
                let (condition, other) = (self.fit(b, 1), self.pick(number >> 16));
                let other = self.fit(other, width);
                self.apply(Op::Ite, &[condition, a, other])
            }
            25 | 26 => {
                let low = u32::try_from(number >> 16 & 63).unwrap_or(0) % width;
                let high = low + u32::try_from(number >> 24 & 63).unwrap_or(0) % (width - low);
                self.apply(Op::Extract { high, low }, &[a])
            }
            27 => self.fit(a, (width + 3).min(64)),
            28 => self.fit(a, (width + 4).min(64)),
            _ => (self.folded.constant(width, number), self.plain.constant(width, number)),
        };
        self.stack.push(made);
    }
}

fn cases() -> u32 {
    std::env::var("RUNGBOOK_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(2000)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases()))]
    #[test]
    fn rewriting_keeps_the_value(steps in recipe(), widths in [1_u32..9, 1_u32..65, 1_u32..4], values: [u64; 8]) {
        let (mut folded, mut plain) = (Pool::default(), Pool::default());
        let variables = widths.map(|width| (folded.variable(width, "v"), plain.variable(width, "v")));
        let mut maker = Maker { folded: &mut folded, plain: &mut plain, stack: variables.to_vec() };
        for (code, number) in steps {
            maker.step(code, number);
        }
        let all = maker.stack;
        for shift in values {
            for (left, right) in &all {
                let value = |var: crate::logic::term::Var| shift.rotate_left(var.0 * 7) & mask(widths[var.0 as usize]);
                prop_assert_eq!(folded.width(*left), plain.width(*right));
                prop_assert_eq!(evaluate(&folded, *left, value), evaluate(&plain, *right, value));
            }
        }
    }
}

#[test]
fn normal_forms_are_shared() {
    let mut pool = Pool::default();
    let (x, y) = (pool.variable(16, "x"), pool.variable(16, "y"));
    assert_eq!(pool.add(x, y), pool.add(y, x));
    let (one, two) = (pool.constant(16, 1), pool.constant(16, 2));
    let once = pool.add(x, one);
    let twice = pool.add(one, once);
    assert_eq!(twice, pool.add(x, two));
    let (wide, limit) = (pool.zero_extend(x, 32), pool.constant(32, 0x1_0000));
    let equal = pool.eq(wide, limit);
    assert_eq!(pool.value(equal), Some(0));
    let (less, not_less) = (pool.ult(x, y), pool.ule(y, x));
    assert_eq!(pool.not(less), not_less);
    let c = pool.variable(1, "c");
    let choice = pool.ite(c, one, two);
    assert_eq!(pool.eq(choice, one), c);
}

#[test]
fn fitting_is_checked() {
    let mut pool = Pool::default();
    let (x, y) = (pool.variable(16, "x"), pool.variable(8, "y"));
    assert!(!pool.fits(Op::Add, &[x, y]));
    assert!(!pool.fits(Op::Not, &[x, x]));
    assert!(!pool.fits(Op::Extract { high: 8, low: 0 }, &[y]));
    assert!(!pool.fits(Op::FloatAdd, &[x, x]));
    assert!(pool.fits(Op::Concat, &[x, y]));
}
