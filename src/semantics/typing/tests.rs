//! Types of operators and values of literals, by the book.

use super::binary::{binary, bit, unary};
use super::convert::assigned;
use super::functions::{call, position};
use super::literal::{Constant, parse};
use super::types::{self, BOOL, DINT, INT, LREAL, REAL, TIME, ULINT};
use super::{Operand, Type, apply};
use crate::semantics::expr::{Expr, ExprKind, Op};
use crate::semantics::scalar::Scalar;
use crate::syntax::TokenKind;
use crate::syntax::ast::{BinaryOperator as B, UnaryOperator};

type Leaf = Operand<&'static str>;

fn read(name: &'static str, scalar: Scalar) -> Leaf {
    Operand::of(Expr { kind: ExprKind::Read(name), scalar, place: None })
}

fn int(value: i128) -> Leaf {
    Operand::Integer(value, None)
}

fn scalar(operator: B, left: Leaf, right: Leaf) -> Option<Scalar> {
    binary(operator, left, right, None).ok().and_then(|operand| operand.scalar())
}

fn of(name: &str) -> Scalar {
    types::elementary(name).expect("an elementary type")
}

#[test]
fn operands_are_widened_to_the_smallest_type_that_holds_both() {
    let sum = |a: &str, b: &str| scalar(B::Add, read("a", of(a)), read("b", of(b))).map(types::name);
    for (a, b, expected) in [
        ("SINT", "INT", "INT"),
        ("USINT", "INT", "INT"),
        ("UINT", "INT", "DINT"),
        ("UDINT", "DINT", "LINT"),
        ("ULINT", "LINT", "LINT"),
        ("BYTE", "WORD", "WORD"),
        ("BYTE", "INT", "INT"),
        ("DINT", "REAL", "REAL"),
        ("REAL", "LREAL", "LREAL"),
        ("TIME", "LTIME", "LTIME"),
        ("DT", "TIME", "DATE_AND_TIME"),
    ] {
        assert_eq!(sum(a, b), Some(expected), "{a} + {b}");
        if !a.starts_with('D') || b != "TIME" {
            assert_eq!(sum(b, a), Some(expected), "{b} + {a}");
        }
    }
    assert_eq!(sum("BOOL", "INT"), None);
    assert_eq!(sum("DT", "DT"), None);
}

#[test]
fn a_literal_takes_the_type_of_its_partner() {
    let sum = |a: &str, value| scalar(B::Add, read("a", of(a)), int(value)).map(types::name);
    assert_eq!(sum("SINT", 100), Some("SINT"));
    assert_eq!(sum("SINT", 1000), Some("INT"));
    assert_eq!(sum("USINT", -1), Some("INT"));
    assert_eq!(sum("BYTE", 255), Some("BYTE"));
    assert_eq!(sum("BYTE", 256), Some("WORD"));
    assert_eq!(sum("REAL", 1), Some("REAL"));
    assert_eq!(sum("TIME", 1), None);
    let half: Leaf = Operand::Real(0.5, 0.5, None);
    assert_eq!(scalar(B::Multiply, read("a", INT), half.clone()), Some(REAL));
    assert_eq!(scalar(B::Multiply, read("a", DINT), half.clone()), Some(LREAL));
    assert_eq!(scalar(B::Multiply, read("a", TIME), half), Some(TIME));
}

#[test]
fn literals_are_calculated_without_a_width() {
    let product: Leaf = binary(B::Multiply, int(1 << 40), int(1 << 40), None).expect("no overflow");
    assert_eq!(product, int(1 << 80));
    assert!(binary::<&str>(B::Divide, int(1), int(0), None).is_err());
    let quotient: Leaf = binary(B::Divide, int(-7), int(2), None).expect("defined");
    assert_eq!(quotient, int(-3));
    let negative: Leaf = unary(UnaryOperator::Negate, int(5), None).expect("defined");
    assert_eq!(negative, int(-5));
}

#[test]
fn constants_of_a_type_are_folded_and_faults_are_not() {
    let constant = |value: i128| Operand::of(super::constant::<&str>(INT, INT.bits(value), None));
    let sum = binary(B::Add, constant(32767), constant(2), None).expect("defined");
    assert_eq!(sum.number(), Some(-32767));
    let quotient = binary(B::Divide, constant(1), constant(0), None).expect("defined");
    assert!(matches!(quotient, Operand::Typed(Expr { kind: ExprKind::Apply(Op::Div, _), .. }, _)));
}

#[test]
fn comparison_and_logic() {
    assert_eq!(scalar(B::Less, read("a", of("UINT")), int(-1)), Some(BOOL));
    assert_eq!(scalar(B::Equal, read("a", BOOL), int(1)), Some(BOOL));
    assert_eq!(scalar(B::Equal, read("a", BOOL), read("b", INT)), None);
    assert_eq!(scalar(B::Equal, read("a", TIME), read("b", INT)), None);
    assert_eq!(scalar(B::And, read("a", of("WORD")), int(0xFF)), Some(of("WORD")));
    assert_eq!(scalar(B::And, read("a", of("WORD")), read("b", INT)), Some(of("WORD")));
    assert_eq!(scalar(B::And, read("a", INT), int(0xFFFF)), Some(INT));
    assert_eq!(scalar(B::AndThen, read("a", BOOL), read("b", BOOL)), Some(BOOL));
    assert_eq!(scalar(B::And, read("a", BOOL), read("b", INT)), None);
    assert!(bit(read("a", of("BYTE")), 7, None).is_ok());
    assert!(bit(read("a", of("BYTE")), 8, None).is_err());
}

#[test]
fn assignments_convert_and_tell_what_they_lose() {
    let lossy = |from: &str, to: &str| {
        assigned(read("a", of(from)), &Type::Scalar(of(to))).ok().map(|converted| converted.lossy)
    };
    assert_eq!(lossy("INT", "DINT"), Some(false));
    assert_eq!(lossy("DINT", "INT"), Some(true));
    assert_eq!(lossy("UINT", "INT"), Some(true));
    assert_eq!(lossy("UINT", "DINT"), Some(false));
    assert_eq!(lossy("INT", "REAL"), Some(false));
    assert_eq!(lossy("DINT", "REAL"), Some(true));
    assert_eq!(lossy("INT", "BOOL"), None);
    assert_eq!(lossy("TIME", "INT"), None);
    assert_eq!(lossy("TIME", "LTIME"), Some(false));
    let bits = |value, to: &str| assigned(int(value), &Type::Scalar(of(to))).ok().map(|converted| converted.expr.kind);
    assert_eq!(bits(-1, "WORD"), Some(ExprKind::Const(0xFFFF)));
    assert_eq!(bits(1, "REAL"), Some(ExprKind::Const(u64::from(1_f32.to_bits()))));
    assert_eq!(bits(2, "BOOL"), None);
}

fn value(name: &str, arguments: Vec<Leaf>) -> Option<i128> {
    call(name, arguments, None)?.ok()?.settled().ok().and_then(|(expr, type_)| match expr.kind {
        ExprKind::Const(bits) => type_.scalar().map(|scalar| scalar.number(bits)),
        _ => None,
    })
}

fn typed(name: &str, value: i128) -> Leaf {
    Operand::of(super::constant(of(name), of(name).bits(value), None))
}

#[test]
fn standard_functions_of_constants() {
    assert_eq!(value("ABS", vec![typed("INT", -5)]), Some(5));
    assert_eq!(value("LIMIT", vec![int(0), typed("INT", 12), int(10)]), Some(10));
    assert_eq!(value("LIMIT", vec![int(0), typed("INT", -3), int(10)]), Some(0));
    assert_eq!(value("MAX", vec![typed("INT", 3), typed("INT", 9), typed("INT", 5)]), Some(9));
    assert_eq!(value("SEL", vec![typed("BOOL", 1), typed("INT", 3), typed("INT", 4)]), Some(4));
    assert_eq!(value("MUX", vec![typed("INT", 1), typed("INT", 3), typed("INT", 4), typed("INT", 5)]), Some(4));
    assert_eq!(value("MUX", vec![typed("INT", 7), typed("INT", 3), typed("INT", 4)]), Some(4));
    assert_eq!(value("SHR", vec![typed("INT", -4), int(1)]), Some(-2));
    assert_eq!(value("SHR", vec![typed("WORD", 0x8000), int(15)]), Some(1));
    assert_eq!(value("ROL", vec![typed("BYTE", 0x81), int(1)]), Some(3));
    assert_eq!(value("GT", vec![typed("INT", 3), typed("INT", 2), typed("INT", 1)]), Some(1));
    assert_eq!(value("GT", vec![typed("INT", 3), typed("INT", 1), typed("INT", 2)]), Some(0));
    assert_eq!(value("DINT_TO_INT", vec![typed("DINT", 65537)]), Some(1));
    assert_eq!(value("TO_USINT", vec![typed("INT", -1)]), Some(255));
    assert_eq!(value("TIME_TO_DINT", vec![typed("TIME", 1500)]), Some(1500));
    assert_eq!(value("DT_TO_TOD", vec![typed("DT", 86_400 + 61)]), Some(61_000));
    assert_eq!(value("DT_TO_DATE", vec![typed("DT", 86_400 + 61)]), Some(86_400));
    assert_eq!(value("TRUNC", vec![Operand::Real(-2.7, -2.7, None)]), Some(-2));
    assert_eq!(value("REAL_TO_INT", vec![Operand::Real(2.5, 2.5, None)]), Some(2));
    assert!(call("NO_SUCH", vec![int(1)], None).is_none());
    assert!(call("ABS", vec![int(1), int(2)], None).is_some_and(|result| result.is_err()));
    assert_eq!(position("SEL", "IN0"), Some(1));
    assert_eq!(position("LIMIT", "mx"), Some(2));
    assert_eq!(position("ADD", "IN2"), Some(1));
}

#[test]
fn times_are_scaled_in_their_units() {
    let constant = |name: &str, value| typed(name, value);
    let number = |operator, a, b| binary(operator, a, b, None).ok().and_then(|operand| operand.number());
    assert_eq!(number(B::Subtract, constant("DT", 100), constant("DT", 90)), Some(10_000));
    assert_eq!(number(B::Add, constant("DT", 100), constant("TIME", 5_000)), Some(105));
    assert_eq!(number(B::Multiply, int(3), constant("TIME", 500)), Some(1_500));
    assert_eq!(number(B::Divide, constant("TIME", 500), constant("INT", 2)), Some(250));
    assert_eq!(number(B::Multiply, constant("TIME", 500), Operand::Real(1.5, 1.5, None)), Some(750));
    assert_eq!(number(B::Add, constant("TIME", 1), constant("LTIME", 1)), Some(1_000_001));
}

fn literal(prefix: Option<&str>, kind: TokenKind, text: &str) -> Result<Constant, String> {
    parse(prefix, false, kind, text)
}

#[test]
fn literals_by_the_standard() {
    assert_eq!(literal(None, TokenKind::Integer, "1_000"), Ok(Constant::Integer(1000)));
    assert_eq!(literal(None, TokenKind::Based, "16#FF_FF"), Ok(Constant::Integer(0xFFFF)));
    assert_eq!(literal(Some("INT"), TokenKind::Based, "16#FFFF"), Ok(Constant::Typed(INT, 0xFFFF)));
    assert!(literal(Some("INT"), TokenKind::Integer, "40000").is_err());
    assert_eq!(parse(Some("INT"), true, TokenKind::Integer, "5"), Ok(Constant::Typed(INT, 0xFFFB)));
    assert_eq!(literal(None, TokenKind::Duration, "T#1d2h3m4s5ms"), Ok(Constant::Typed(TIME, 93_784_005)));
    assert_eq!(literal(None, TokenKind::Duration, "TIME#1.5s"), Ok(Constant::Typed(TIME, 1500)));
    assert_eq!(literal(None, TokenKind::Duration, "LTIME#1us2ns"), Ok(Constant::Typed(types::LTIME, 1002)));
    assert!(literal(None, TokenKind::Duration, "T#60d").is_err());
    assert_eq!(literal(None, TokenKind::Date, "D#1970-01-02"), Ok(Constant::Typed(of("DATE"), 86_400)));
    assert_eq!(literal(None, TokenKind::Date, "D#2000-03-01"), Ok(Constant::Typed(of("DATE"), 951_868_800)));
    assert!(literal(None, TokenKind::Date, "D#2001-02-29").is_err());
    assert_eq!(literal(None, TokenKind::TimeOfDay, "TOD#1:00:00.5"), Ok(Constant::Typed(of("TOD"), 3_600_500)));
    assert_eq!(literal(None, TokenKind::DateAndTime, "DT#1970-01-01-00:01:01"), Ok(Constant::Typed(of("DT"), 61)));
    let codes = vec![u16::from(b'a'), u16::from(b'$'), 10, 0x41, u16::from(b'\'')];
    assert_eq!(literal(None, TokenKind::String, "'a$$$N$41$''"), Ok(Constant::Text(codes, false)));
    assert!(literal(None, TokenKind::String, "'$4'").is_err());
}

#[test]
fn unsigned_negation_gets_a_sign() {
    let negative = unary(UnaryOperator::Negate, typed("UINT", 40_000), None).expect("defined");
    assert_eq!((negative.scalar(), negative.number()), (Some(DINT), Some(-40_000)));
    let huge: Leaf = Operand::of(apply(Op::Not, ULINT, vec![super::constant(ULINT, 0, None)], None));
    assert_eq!(huge.number(), Some(i128::from(u64::MAX)));
}
