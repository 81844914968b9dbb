//! The operators by the book.

use super::{FaultAt, Leaves, apply, binary, evaluate, unary};
use crate::semantics::expr::{Expr, ExprKind, Fault, Op, RealFunction};
use crate::semantics::scalar::Scalar;

const SINT: Scalar = Scalar::Int { signed: true, width: 8 };
const USINT: Scalar = Scalar::Int { signed: false, width: 8 };
const INT: Scalar = Scalar::Int { signed: true, width: 16 };
const DINT: Scalar = Scalar::Int { signed: true, width: 32 };
const LINT: Scalar = Scalar::Int { signed: true, width: 64 };
const ULINT: Scalar = Scalar::Int { signed: false, width: 64 };
const REAL: Scalar = Scalar::Real(32);
const LREAL: Scalar = Scalar::Real(64);

fn whole(op: Op, of: Scalar, left: i128, right: i128) -> Result<i128, Fault> {
    Ok(of.number(binary(op, of, of.bits(left), of.bits(right))?))
}

fn single(value: f32) -> u64 {
    u64::from(value.to_bits())
}

fn convert(from: Scalar, to: Scalar, value: i128) -> i128 {
    to.number(unary(Op::Convert, to, from, from.bits(value)))
}

fn from_real(to: Scalar, value: f32) -> i128 {
    to.number(unary(Op::Convert, to, REAL, single(value)))
}

#[test]
fn sums_and_products_wrap_around_at_their_width() {
    assert_eq!(whole(Op::Add, SINT, 127, 1), Ok(-128));
    assert_eq!(whole(Op::Sub, SINT, -128, 1), Ok(127));
    assert_eq!(whole(Op::Mul, SINT, 16, 16), Ok(0));
    assert_eq!(whole(Op::Add, USINT, 255, 1), Ok(0));
    assert_eq!(whole(Op::Sub, USINT, 0, 1), Ok(255));
    assert_eq!(whole(Op::Add, INT, 32767, 2), Ok(-32767));
    assert_eq!(whole(Op::Mul, LINT, i128::from(i64::MAX), 2), Ok(-2));
    assert_eq!(whole(Op::Add, ULINT, i128::from(u64::MAX), 1), Ok(0));
    assert_eq!(SINT.number(unary(Op::Neg, SINT, SINT, SINT.bits(-128))), -128);
    assert_eq!(SINT.number(unary(Op::Abs, SINT, SINT, SINT.bits(-128))), -128);
    assert_eq!(INT.number(unary(Op::Abs, INT, INT, INT.bits(-5))), 5);
}

#[test]
fn every_byte_sum_is_that_of_the_host() {
    for a in i8::MIN..=i8::MAX {
        for b in i8::MIN..=i8::MAX {
            let (x, y) = (i128::from(a), i128::from(b));
            assert_eq!(whole(Op::Add, SINT, x, y), Ok(a.wrapping_add(b).into()));
            assert_eq!(whole(Op::Mul, SINT, x, y), Ok(a.wrapping_mul(b).into()));
            assert_eq!(binary(Op::Lt, SINT, SINT.bits(x), SINT.bits(y)), Ok(u64::from(a < b)));
            assert_eq!(binary(Op::Le, SINT, SINT.bits(x), SINT.bits(y)), Ok(u64::from(a <= b)));
            let quotient = if b == 0 { Err(Fault::DivisionByZero) } else { Ok(a.wrapping_div(b).into()) };
            assert_eq!(whole(Op::Div, SINT, x, y), quotient);
            let rest = if b == 0 { Err(Fault::DivisionByZero) } else { Ok(a.wrapping_rem(b).into()) };
            assert_eq!(whole(Op::Mod, SINT, x, y), rest);
        }
    }
}

#[test]
fn division_goes_toward_zero_and_zero_is_a_fault() {
    assert_eq!(whole(Op::Div, INT, -7, 2), Ok(-3));
    assert_eq!(whole(Op::Mod, INT, -7, 2), Ok(-1));
    assert_eq!(whole(Op::Mod, INT, 7, -2), Ok(1));
    assert_eq!(whole(Op::Div, INT, 7, 0), Err(Fault::DivisionByZero));
    assert_eq!(whole(Op::Mod, USINT, 7, 0), Err(Fault::DivisionByZero));
    assert_eq!(whole(Op::Div, LINT, i64::MIN.into(), -1), Ok(i64::MIN.into()));
    let time = Scalar::Time(32);
    assert_eq!(binary(Op::Div, time, 100, 0), Err(Fault::DivisionByZero));
}

#[test]
fn real_division_by_zero_is_infinite_and_nan_is_one_pattern() {
    let divide = |a: f32, b: f32| binary(Op::Div, REAL, single(a), single(b)).expect("REAL never faults");
    assert_eq!(divide(1.0, 0.0), single(f32::INFINITY));
    assert_eq!(divide(-1.0, 0.0), single(f32::NEG_INFINITY));
    assert_eq!(divide(0.0, 0.0), 0x7FC0_0000);
    let root = unary(Op::Sqrt, LREAL, LREAL, (-1.0_f64).to_bits());
    assert_eq!(root, 0x7FF8_0000_0000_0000);
    for op in [Op::Eq, Op::Lt, Op::Le] {
        assert_eq!(binary(op, REAL, 0x7FC0_0000, 0x7FC0_0000), Ok(0), "{op:?}");
    }
    assert_eq!(binary(Op::Eq, REAL, single(0.0), single(-0.0)), Ok(1));
    assert_eq!(unary(Op::Neg, REAL, REAL, single(0.0)), single(-0.0));
    assert_eq!(unary(Op::Abs, LREAL, LREAL, (-2.5_f64).to_bits()), 2.5_f64.to_bits());
}

#[test]
fn real_sums_are_rounded_in_their_own_width() {
    let sum = binary(Op::Add, REAL, single(16_777_216.0), single(1.0));
    assert_eq!(sum, Ok(single(16_777_216.0)));
    let sum = binary(Op::Add, LREAL, 16_777_216.0_f64.to_bits(), 1.0_f64.to_bits());
    assert_eq!(sum, Ok(16_777_217.0_f64.to_bits()));
}

#[test]
fn shifts_beyond_the_width_give_zero_or_the_sign() {
    let byte = Scalar::Bits(8);
    assert_eq!(binary(Op::Shl, byte, 0x81, 1), Ok(0x02));
    assert_eq!(binary(Op::Shl, byte, 0x81, 8), Ok(0));
    assert_eq!(binary(Op::Shl, Scalar::Bits(64), 1, 64), Ok(0));
    assert_eq!(binary(Op::Shl, byte, 0xFF, u64::MAX), Ok(0));
    assert_eq!(binary(Op::Shr, byte, 0x81, 1), Ok(0x40));
    assert_eq!(binary(Op::Shr, byte, 0x81, 200), Ok(0));
    assert_eq!(binary(Op::Shr, SINT, 0x81, 1), Ok(0x40));
    assert_eq!(binary(Op::Sar, SINT, 0x81, 1), Ok(0xC0));
    assert_eq!(binary(Op::Sar, SINT, 0x81, 100), Ok(0xFF));
    assert_eq!(binary(Op::Sar, SINT, 0x41, 100), Ok(0));
    assert_eq!(binary(Op::Sar, LINT, 1 << 63, 64), Ok(u64::MAX));
}

#[test]
fn rotations_turn_modulo_the_width() {
    let byte = Scalar::Bits(8);
    assert_eq!(binary(Op::Rol, byte, 0x81, 1), Ok(0x03));
    assert_eq!(binary(Op::Rol, byte, 0x81, 8), Ok(0x81));
    assert_eq!(binary(Op::Rol, byte, 0x81, 9), Ok(0x03));
    assert_eq!(binary(Op::Ror, byte, 0x81, 1), Ok(0xC0));
    assert_eq!(binary(Op::Ror, byte, 0x81, 0), Ok(0x81));
    assert_eq!(binary(Op::Ror, byte, 0x81, 16), Ok(0x81));
    assert_eq!(binary(Op::Rol, Scalar::Bits(64), 1 << 63, 1), Ok(1));
    assert_eq!(binary(Op::Ror, Scalar::Bits(64), 1, 65), Ok(1 << 63));
}

#[test]
fn complement_and_bits() {
    assert_eq!(unary(Op::Not, Scalar::Bool, Scalar::Bool, 1), 0);
    assert_eq!(unary(Op::Not, Scalar::Bool, Scalar::Bool, 0), 1);
    assert_eq!(unary(Op::Not, Scalar::Bits(8), Scalar::Bits(8), 0x0F), 0xF0);
    assert_eq!(binary(Op::Bit, Scalar::Bits(8), 0x82, 7), Ok(1));
    assert_eq!(binary(Op::Bit, Scalar::Bits(8), 0x82, 0), Ok(0));
    assert_eq!(apply(Op::Select, INT, &[(Scalar::Bool, 1), (INT, 7), (INT, 9)]), Ok(7));
    assert_eq!(apply(Op::Select, INT, &[(Scalar::Bool, 0), (INT, 7), (INT, 9)]), Ok(9));
}

#[test]
fn integers_extend_by_their_sign_and_are_cut() {
    assert_eq!(convert(SINT, INT, -1), -1);
    assert_eq!(convert(USINT, INT, 255), 255);
    assert_eq!(convert(INT, SINT, 200), -56);
    assert_eq!(convert(SINT, ULINT, -1), u64::MAX.into());
    assert_eq!(convert(SINT, Scalar::Bits(16), -1), 0xFFFF);
    assert_eq!(convert(INT, Scalar::Bool, 2), 1);
    assert_eq!(convert(INT, Scalar::Bool, 0), 0);
    assert_eq!(convert(Scalar::Bool, DINT, 1), 1);
}

#[test]
fn reals_round_to_even_and_saturate() {
    assert_eq!(from_real(INT, 0.5), 0);
    assert_eq!(from_real(INT, 1.5), 2);
    assert_eq!(from_real(INT, 2.5), 2);
    assert_eq!(from_real(INT, -1.5), -2);
    assert_eq!(from_real(INT, 1e9), 32767);
    assert_eq!(from_real(INT, -1e9), -32768);
    assert_eq!(from_real(USINT, -3.0), 0);
    assert_eq!(from_real(ULINT, 1e30), u64::MAX.into());
    assert_eq!(from_real(LINT, f32::NEG_INFINITY), i64::MIN.into());
    assert_eq!(from_real(LINT, f32::NAN), 0);
    assert_eq!(from_real(Scalar::Bool, 0.1), 1);
    assert_eq!(from_real(Scalar::Bool, -0.0), 0);
    assert_eq!(unary(Op::Trunc, INT, REAL, single(-1.9)), INT.bits(-1));
    assert_eq!(unary(Op::Trunc, INT, REAL, single(1e9)), INT.bits(32767));
}

#[test]
fn numbers_become_the_nearest_real() {
    assert_eq!(unary(Op::Convert, REAL, DINT, 16_777_217), single(16_777_216.0));
    assert_eq!(unary(Op::Convert, REAL, SINT, SINT.bits(-3)), single(-3.0));
    assert_eq!(unary(Op::Convert, LREAL, REAL, single(0.1)), f64::from(0.1_f32).to_bits());
    assert_eq!(unary(Op::Convert, REAL, LREAL, 1e300_f64.to_bits()), single(f32::INFINITY));
    assert_eq!(unary(Op::Convert, LREAL, ULINT, u64::MAX), 18_446_744_073_709_551_615.0_f64.to_bits());
}

#[test]
fn durations_convert_between_their_units() {
    let (time, ltime) = (Scalar::Time(32), Scalar::Time(64));
    assert_eq!(convert(time, ltime, 1500), 1_500_000_000);
    assert_eq!(convert(ltime, time, 1_500_999_999), 1500);
    assert_eq!(convert(time, DINT, 250), 250);
    assert_eq!(convert(DINT, time, -1), 0xFFFF_FFFF);
}

#[test]
fn functions_are_those_of_the_host() {
    let sine = unary(Op::Real(RealFunction::Sin), LREAL, LREAL, 1.0_f64.to_bits());
    assert_eq!(sine, 1.0_f64.sin().to_bits());
    let power = apply(Op::Real(RealFunction::Power), REAL, &[(REAL, single(2.0)), (REAL, single(10.0))]);
    assert_eq!(power, Ok(single(1024.0)));
    assert_eq!(unary(Op::Real(RealFunction::Log), LREAL, LREAL, 1000.0_f64.to_bits()), 3.0_f64.to_bits());
    assert_eq!(unary(Op::Real(RealFunction::Ln), REAL, REAL, single(-1.0)), 0x7FC0_0000);
}

/// Leaves by number; the leaf 99 cannot be read.
struct Numbers;

impl Leaves<u64> for Numbers {
    fn read(&mut self, leaf: &u64) -> Result<u64, FaultAt> {
        if *leaf == 99 { Err(FaultAt { fault: Fault::NullReference, place: None }) } else { Ok(*leaf) }
    }

    fn address(&mut self, leaf: &u64) -> Result<u64, FaultAt> {
        Ok(leaf + 1)
    }
}

fn expr(kind: ExprKind<u64>, scalar: Scalar) -> Expr<u64> {
    Expr { kind, scalar, place: None }
}

#[test]
fn short_circuits_hide_the_faults_of_what_they_skip() {
    let boolean = |value| Box::new(expr(ExprKind::Const(value), Scalar::Bool));
    let bad = || Box::new(expr(ExprKind::Read(99), Scalar::Bool));
    let value = |kind| evaluate(&expr(kind, Scalar::Bool), &mut Numbers).map_err(|at| at.fault);
    assert_eq!(value(ExprKind::AndThen(boolean(0), bad())), Ok(0));
    assert_eq!(value(ExprKind::AndThen(boolean(1), bad())), Err(Fault::NullReference));
    assert_eq!(value(ExprKind::OrElse(boolean(1), bad())), Ok(1));
    assert_eq!(value(ExprKind::OrElse(boolean(0), bad())), Err(Fault::NullReference));
    assert_eq!(value(ExprKind::If(boolean(1), boolean(1), bad())), Ok(1));
    assert_eq!(value(ExprKind::Apply(Op::And, vec![*boolean(0), *bad()])), Err(Fault::NullReference));
    assert_eq!(value(ExprKind::Address(4)), Ok(5));
}
