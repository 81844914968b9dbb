//! The checker against the values of terms: each operator, on random operands, is what evaluation says, and a claim that
//! differs in one bit is rejected.

use std::sync::Arc;

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use rungbook::logic::certificate::{Certificate, Fact, StateBit};
use rungbook::logic::system::{Input, Labelled, State, System};
use rungbook::logic::term::{Op, Pool, Term, mask};
use rungbook::logic::value::operate;
use rungbook::recheck::invariant::{Rejection, Stop, check};

fn patient() -> Stop {
    Arc::new(|| false)
}

fn labelled(term: Term) -> Labelled {
    Labelled { term, name: String::new(), origin: None }
}

/// A system without memory whose inputs are held at `values`; its obligation is that `op` gives `claim`.
fn claim(op: Op, widths: &[u32], values: &[u64], result: u64) -> System {
    let mut pool = Pool::default();
    let variables: Vec<Term> =
        widths.iter().enumerate().map(|(n, width)| pool.variable(*width, format!("x{n}"))).collect();
    let constraints = variables
        .iter()
        .zip(widths)
        .zip(values)
        .map(|((variable, width), value)| {
            let value = pool.constant(*width, *value);
            labelled(pool.plain(Op::Eq, &[*variable, value]))
        })
        .collect();
    let applied = pool.plain(op, &variables);
    let width = pool.width(applied);
    let wanted = pool.constant(width, result);
    let same = pool.plain(Op::Eq, &[applied, wanted]);
    let inputs = variables.iter().map(|v| Input { variable: *v, name: String::new(), origin: None }).collect();
    System { pool, inputs, constraints, obligations: vec![labelled(same)], ..System::default() }
}

fn trivial() -> Certificate {
    Certificate { k: 1, ..Certificate::default() }
}

/// Operators with the widths of their operands.
fn operation() -> impl Strategy<Value = (Op, Vec<u32>)> {
    let same = |arity: usize| move |(op, width): (Op, u32)| (op, vec![width; arity]);
    let width = prop_oneof![1_u32..=16, Just(32_u32), Just(64)];
    let unary = prop_oneof![Just(Op::Not), Just(Op::Neg)];
    let binary = proptest::sample::select(vec![
        Op::And,
        Op::Or,
        Op::Xor,
        Op::Add,
        Op::Sub,
        Op::Shl,
        Op::Lshr,
        Op::Ashr,
        Op::Eq,
        Op::Ult,
        Op::Ule,
        Op::Slt,
        Op::Sle,
    ]);
    let costly = proptest::sample::select(vec![Op::Mul, Op::Udiv, Op::Sdiv, Op::Urem, Op::Srem]);
    let float = proptest::sample::select(vec![
        Op::FloatAdd,
        Op::FloatSub,
        Op::FloatMul,
        Op::FloatDiv,
        Op::FloatEq,
        Op::FloatLt,
        Op::FloatLe,
    ]);
    let to_integer = proptest::sample::select(vec![
        Op::FloatSqrt,
        Op::FloatToFloat(32),
        Op::FloatToFloat(64),
        Op::FloatToSigned(8),
        Op::FloatToSigned(32),
        Op::FloatToSigned(64),
        Op::FloatToUnsigned(16),
        Op::FloatToUnsigned(64),
        Op::FloatTruncate(16),
        Op::FloatTruncate(64),
    ]);
    let from_integer = proptest::sample::select(vec![
        Op::SignedToFloat(32),
        Op::SignedToFloat(64),
        Op::UnsignedToFloat(32),
        Op::UnsignedToFloat(64),
    ]);
    prop_oneof![
        1 => (unary, width.clone()).prop_map(same(1)),
        5 => (binary, width.clone()).prop_map(same(2)),
        4 => (costly, 1_u32..=12).prop_map(same(2)),
        1 => (costly_wide(), Just(32_u32)).prop_map(same(2)),
        1 => width.clone().prop_map(|width| (Op::Ite, vec![1, width, width])),
        1 => (1_u32..=32, 1_u32..=32).prop_map(|(a, b)| (Op::Concat, vec![a, b])),
        1 => (1_u32..=64).prop_flat_map(|w| (Just(w), 0..w)).prop_flat_map(|(w, low)| (Just(w), Just(low), low..w))
            .prop_map(|(w, low, high)| (Op::Extract { high, low }, vec![w])),
        1 => (1_u32..=32, 32_u32..=64, any::<bool>()).prop_map(|(from, to, signed)| {
            (if signed { Op::SignExtend(to) } else { Op::ZeroExtend(to) }, vec![from])
        }),
        6 => (float, proptest::sample::select(vec![32_u32, 64])).prop_map(same(2)),
        4 => (to_integer, proptest::sample::select(vec![32_u32, 64])).prop_map(same(1)),
        2 => (from_integer, proptest::sample::select(vec![8_u32, 16, 32, 64])).prop_map(same(1)),
    ]
}

fn costly_wide() -> impl Strategy<Value = Op> {
    proptest::sample::select(vec![Op::Mul, Op::Udiv, Op::Sdiv, Op::Urem, Op::Srem])
}

/// Bits that are numbers of interest: small ones, powers, and those at the edges of floats.
fn bits() -> impl Strategy<Value = u64> {
    let double = prop_oneof![
        any::<f64>().prop_map(f64::to_bits),
        (-40_i32..40, -9_i64..9).prop_map(|(e, m)| (m as f64 * 2f64.powi(e) / 4.0).to_bits()),
        proptest::sample::select(vec![
            0.0,
            -0.0,
            0.5,
            1.5,
            2.5,
            -0.5,
            f64::MAX,
            f64::MIN_POSITIVE,
            f64::NAN,
            f64::INFINITY
        ])
        .prop_map(f64::to_bits),
        0_u64..3,
    ];
    let single = prop_oneof![
        any::<f32>().prop_map(|x| u64::from(x.to_bits())),
        (-40_i32..40, -9_i64..9).prop_map(|(e, m)| u64::from((m as f32 * 2f32.powi(e) / 4.0).to_bits())),
        proptest::sample::select(vec![
            0.0_f32,
            -0.0,
            0.5,
            1.5,
            2.5,
            f32::MAX,
            f32::MIN_POSITIVE,
            f32::NAN,
            f32::INFINITY
        ])
        .prop_map(|x| u64::from(x.to_bits())),
    ];
    prop_oneof![
        any::<u64>(),
        0_u64..20,
        (0_u32..64, 0_u64..3).prop_map(|(s, d)| (1_u64 << s).wrapping_sub(d)),
        double,
        single
    ]
}

fn agrees(op: Op, widths: &[u32], raw: [u64; 3]) -> Result<(), TestCaseError> {
    let mut values = [0; 3];
    let mut wide = [0; 3];
    for index in 0..3 {
        let width = widths.get(index).copied().unwrap_or(widths[0]);
        wide[index] = width;
        values[index] = raw[index] & mask(width);
    }
    let arity = widths.len();
    let pool_width = {
        let mut pool = Pool::default();
        let terms: Vec<Term> = widths.iter().map(|w| pool.variable(*w, "x")).collect();
        let term = pool.plain(op, &terms);
        pool.width(term)
    };
    let result = operate(op, values, wide);
    let right = check(&claim(op, widths, &values[..arity], result), &trivial(), &patient());
    prop_assert_eq!(right, Ok(()), "{:?} {:?} {:x?} is {:x}", op, widths, &values[..arity], result);
    let wrong = result ^ 1 << (raw[0] % u64::from(pool_width));
    let wrong = check(&claim(op, widths, &values[..arity], wrong), &trivial(), &patient());
    prop_assert_eq!(wrong, Err(Rejection::NotSafe));
    Ok(())
}

#[test]
fn the_encoding_calculates_what_terms_mean() {
    let cases = super::support::cases() / 5;
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 200, ..Config::default() };
    let strategy = (operation(), [bits(), bits(), bits()]);
    if let Err(error) = TestRunner::new(config).run(&strategy, |((op, widths), raw)| agrees(op, &widths, raw)) {
        panic!("{error}");
    }
}

/// A counter from 0 that goes up to 5 and stays; it must never be 7.
fn counter() -> System {
    let mut pool = Pool::default();
    let x = pool.variable(3, "x");
    let (zero, one, five, seven) = (pool.constant(3, 0), pool.constant(3, 1), pool.constant(3, 5), pool.constant(3, 7));
    let (full, more) = (pool.eq(x, five), pool.add(x, one));
    let next = pool.ite(full, five, more);
    let bad = pool.eq(x, seven);
    let good = pool.not(bad);
    let state = State { variable: x, name: "x".to_owned(), initial: Some(zero), next, origin: None };
    System { pool, states: vec![state], obligations: vec![labelled(good)], ..System::default() }
}

fn literal(bit: u32, value: bool) -> Fact {
    Fact::Bit(StateBit { state: 0, bit, value })
}

#[test]
fn certificates_are_accepted_for_what_they_prove_and_nothing_else() {
    let system = counter();
    let certificate = |clauses: Vec<Vec<Fact>>, k| Certificate { clauses, k, ..Certificate::default() };
    // Not 6 and not 7.
    let invariant = vec![vec![literal(1, false), literal(2, false)]];
    assert_eq!(check(&system, &certificate(invariant.clone(), 1), &patient()), Ok(()));
    assert_eq!(check(&system, &certificate(Vec::new(), 1), &patient()), Err(Rejection::NotSafe));
    assert_eq!(check(&system, &certificate(invariant, 0), &patient()), Err(Rejection::Malformed));
    let wrong = |literals: Vec<Fact>| check(&system, &certificate(vec![literals], 1), &patient());
    assert_eq!(wrong(vec![literal(0, true)]), Err(Rejection::NotInitial));
    assert_eq!(wrong(vec![literal(0, false)]), Err(Rejection::NotInductive(0)));
    assert_eq!(wrong(vec![literal(3, false)]), Err(Rejection::Malformed));
    assert_eq!(wrong(vec![Fact::Bit(StateBit { state: 1, bit: 0, value: true })]), Err(Rejection::Malformed));
    // The same by a gate: not (bit 1 and bit 2).
    let gates = vec![[literal(1, true), literal(2, true)]];
    let gated = |gate| Certificate {
        gates: gates.clone(),
        clauses: vec![vec![Fact::Gate(gate, false)]],
        k: 1,
        simple_path: false,
    };
    assert_eq!(check(&system, &gated(0), &patient()), Ok(()));
    assert_eq!(check(&system, &gated(1), &patient()), Err(Rejection::Malformed));
    // 6 leads to 7 and nothing leads to 6: two steps of induction.
    assert_eq!(check(&system, &certificate(Vec::new(), 2), &patient()), Ok(()));
    let impatient: Stop = Arc::new(|| true);
    assert_eq!(check(&system, &certificate(Vec::new(), 2), &impatient), Err(Rejection::OutOfTime));
}

/// A block that divides what it remembers, and a table that divides what it remembers: while `g`, the two are equal.
fn remembering() -> System {
    let mut system = System::default();
    let input = |system: &mut System, width: u32, name: &str| {
        let variable = system.pool.variable(width, name);
        system.inputs.push(Input { variable, name: name.to_owned(), origin: None });
        variable
    };
    let [guard, x, y, c] =
        [("in g", 1), ("x", 32), ("y", 32), ("c", 32)].map(|(name, width)| input(&mut system, width, name));
    let [g, a, b] = [("g", 1), ("a", 32), ("b", 32)].map(|(name, width)| system.pool.variable(width, name));
    let other = system.pool.ite(guard, x, y);
    for (variable, next, name) in [(g, guard, "g"), (a, x, "a"), (b, other, "b")] {
        let initial = Some(system.pool.constant(system.pool.width(variable), 0));
        system.states.push(State { variable, name: name.to_owned(), initial, next, origin: None });
    }
    let mut of = |word: Term| {
        let (product, quotient) = (system.pool.plain(Op::Mul, &[word, c]), system.pool.plain(Op::Udiv, &[word, c]));
        system.pool.plain(Op::Add, &[product, quotient])
    };
    let (left, right) = (of(a), of(b));
    let same = system.pool.plain(Op::Eq, &[left, right]);
    let not = system.pool.plain(Op::Not, &[g]);
    let safe = system.pool.plain(Op::Or, &[not, same]);
    system.obligations = vec![labelled(safe)];
    system
}

/// That `a` and `b` are equal in `bits` while `g`.
fn equal_while(bits: std::ops::Range<u32>) -> Certificate {
    let fact = |state: u32, bit: u32, value: bool| Fact::Bit(StateBit { state, bit, value });
    let clauses = bits
        .flat_map(|bit| [true, false].map(|value| vec![fact(0, 0, false), fact(1, bit, value), fact(2, bit, !value)]));
    Certificate { k: 1, clauses: clauses.collect(), ..Certificate::default() }.sorted()
}

#[test]
fn what_an_invariant_makes_equal_is_calculated_once() {
    let system = remembering();
    assert_eq!(check(&system, &equal_while(0..32), &patient()), Ok(()));
    assert_eq!(check(&system, &equal_while(1..32), &patient()), Err(Rejection::NotSafe));
    assert_eq!(check(&system, &equal_while(0..31), &patient()), Err(Rejection::NotSafe));
    assert_eq!(check(&system, &trivial(), &patient()), Err(Rejection::NotSafe));
    // A case that the invariant rules out says nothing about the others.
    let mut ruled_out = equal_while(0..0);
    ruled_out.clauses.push(vec![Fact::Bit(StateBit { state: 0, bit: 0, value: false })]);
    assert_eq!(check(&system, &ruled_out, &patient()), Err(Rejection::NotInductive(0)));
}
