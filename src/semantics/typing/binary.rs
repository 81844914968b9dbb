//! Operators in the text: arithmetic, comparison, logic.

use super::convert::logical;
use super::types::{self, BOOL};
use super::{Operand, Type, TypeError, apply, clock, constant, converted, too_large};
use crate::semantics::expr::{Expr, ExprKind, Op, RealFunction};
use crate::semantics::scalar::Scalar;
use crate::syntax::ast::{BinaryOperator, UnaryOperator};
use crate::text::Place;

/// What an operator gives.
pub type Typed<L> = Result<Operand<L>, TypeError>;

/// `left operator right`.
///
/// # Errors
/// If the operator is not defined for these types.
pub fn binary<L: Clone>(
    operator: BinaryOperator,
    left: Operand<L>,
    right: Operand<L>,
    place: Option<Place>,
) -> Typed<L> {
    use BinaryOperator as B;
    match operator {
        B::Add => arithmetic(Op::Add, left, right, place),
        B::Subtract => arithmetic(Op::Sub, left, right, place),
        B::Multiply => arithmetic(Op::Mul, left, right, place),
        B::Divide => arithmetic(Op::Div, left, right, place),
        B::Modulo => arithmetic(Op::Mod, left, right, place),
        B::Power => power(left, right, place),
        B::Equal => compare(Op::Eq, left, right, place),
        B::NotEqual => negated(compare(Op::Eq, left, right, place)?, place),
        B::Less => compare(Op::Lt, left, right, place),
        B::LessEqual => compare(Op::Le, left, right, place),
        B::Greater => compare(Op::Lt, right, left, place),
        B::GreaterEqual => compare(Op::Le, right, left, place),
        B::And => bitwise(Op::And, left, right, place),
        B::Or => bitwise(Op::Or, left, right, place),
        B::Xor => bitwise(Op::Xor, left, right, place),
        B::AndThen => {
            let (left, right) = (logical(left)?, logical(right)?);
            Ok(Operand::of(Expr { kind: ExprKind::AndThen(Box::new(left), Box::new(right)), scalar: BOOL, place }))
        }
        B::OrElse => {
            let (left, right) = (logical(left)?, logical(right)?);
            Ok(Operand::of(Expr { kind: ExprKind::OrElse(Box::new(left), Box::new(right)), scalar: BOOL, place }))
        }
    }
}

/// `operator operand`; the address of something is for the caller to take.
///
/// # Errors
/// If the operator is not defined for this type.
pub fn unary<L: Clone>(operator: UnaryOperator, operand: Operand<L>, place: Option<Place>) -> Typed<L> {
    match operator {
        UnaryOperator::Plus => Ok(operand),
        UnaryOperator::Negate => negate(operand, place),
        UnaryOperator::Not => negated(operand, place),
        UnaryOperator::Address => Err(TypeError::new(place, "the address of a value that is no variable")),
    }
}

fn negate<L: Clone>(operand: Operand<L>, place: Option<Place>) -> Typed<L> {
    let scalar = match operand {
        Operand::Integer(value, _) => return Ok(Operand::Integer(-value, place)),
        Operand::Real(double, single, _) => return Ok(Operand::Real(-double, -single, place)),
        Operand::Typed(..) => operand.scalar(),
    };
    let Operand::Typed(expr, _) = operand else { return Err(undefined("-", &[&operand], place)) };
    match scalar {
        Some(Scalar::Real(_) | Scalar::Int { signed: true, .. } | Scalar::Time(_)) => {
            let scalar = expr.scalar;
            Ok(Operand::of(apply(Op::Neg, scalar, vec![expr], place)))
        }
        Some(Scalar::Int { width, .. } | Scalar::Bits(width)) => {
            let signed = Scalar::Int { signed: true, width: (width * 2).min(64) };
            Ok(Operand::of(apply(Op::Neg, signed, vec![converted(expr, signed)], place)))
        }
        _ => Err(TypeError::new(place, format!("`-` is not defined for `{}`", types::name(expr.scalar)))),
    }
}

/// `NOT operand`.
pub(super) fn negated<L: Clone>(operand: Operand<L>, place: Option<Place>) -> Typed<L> {
    match operand {
        Operand::Integer(value, _) => Ok(Operand::Integer(!value, place)),
        Operand::Typed(expr, _) if matches!(expr.scalar, Scalar::Bool | Scalar::Bits(_) | Scalar::Int { .. }) => {
            let scalar = expr.scalar;
            Ok(Operand::of(apply(Op::Not, scalar, vec![expr], place)))
        }
        other => Err(undefined("NOT", &[&other], place)),
    }
}

/// How an operator is written.
const fn sign(op: Op) -> &'static str {
    match op {
        Op::Add => "+",
        Op::Sub => "-",
        Op::Mul => "*",
        Op::Div => "/",
        Op::Mod => "MOD",
        Op::And => "AND",
        Op::Or => "OR",
        Op::Xor => "XOR",
        Op::Eq => "=",
        Op::Lt => "<",
        Op::Le => "<=",
        _ => "this operator",
    }
}

/// That an operator is not defined for these operands.
pub(super) fn undefined<L>(sign: &str, operands: &[&Operand<L>], place: Option<Place>) -> TypeError {
    let types: Vec<String> = operands.iter().map(|operand| format!("`{}`", operand.type_name())).collect();
    TypeError::new(place, format!("`{sign}` is not defined for {}", types.join(" and ")))
        .help("convert one of them: `TO_…` or `…_TO_…`")
}

/// `left op right` for `+ - * / MOD`.
///
/// # Errors
/// If it is not defined for these types.
pub fn arithmetic<L: Clone>(op: Op, left: Operand<L>, right: Operand<L>, place: Option<Place>) -> Typed<L> {
    match (&left, &right) {
        (Operand::Integer(a, _), Operand::Integer(b, _)) => return integers(op, *a, *b, place),
        (Operand::Real(..) | Operand::Integer(..), Operand::Real(..) | Operand::Integer(..)) => {
            return reals(op, &left, &right, place);
        }
        _ => {}
    }
    if clock::is_clock(&left) || clock::is_clock(&right) {
        return clock::arithmetic(op, left, right, place);
    }
    let Some(scalar) = shared(&left, &right)? else { return Err(undefined(sign(op), &[&left, &right], place)) };
    if op == Op::Mod && matches!(scalar, Scalar::Real(_)) {
        return Err(undefined("MOD", &[&left, &right], place));
    }
    let operands = vec![fitted(left, scalar)?, fitted(right, scalar)?];
    Ok(Operand::of(apply(op, scalar, operands, place)))
}

fn integers<L>(op: Op, a: i128, b: i128, place: Option<Place>) -> Typed<L> {
    let value = match op {
        Op::Add => a.checked_add(b),
        Op::Sub => a.checked_sub(b),
        Op::Mul => a.checked_mul(b),
        Op::Div => a.checked_div(b),
        _ => a.checked_rem(b),
    };
    if b == 0 && matches!(op, Op::Div | Op::Mod) {
        return Err(TypeError::new(place, "a literal is divided by zero"));
    }
    value.map(|value| Operand::Integer(value, place)).ok_or_else(|| too_large(a.max(b), place))
}

fn reals<L>(op: Op, left: &Operand<L>, right: &Operand<L>, place: Option<Place>) -> Typed<L> {
    let both = |operand: &Operand<L>| match operand {
        Operand::Real(double, single, _) => (*double, *single),
        Operand::Integer(value, _) => (*value as f64, *value as f32),
        Operand::Typed(..) => (f64::NAN, f32::NAN),
    };
    let ((a, x), (b, y)) = (both(left), both(right));
    let (double, single) = match op {
        Op::Add => (a + b, x + y),
        Op::Sub => (a - b, x - y),
        Op::Mul => (a * b, x * y),
        Op::Div => (a / b, x / y),
        _ => return Err(undefined(sign(op), &[left, right], place)),
    };
    Ok(Operand::Real(double, single, place))
}

/// The numeric type that two operands are widened to; `None` where there is none.
pub(super) fn shared<L>(left: &Operand<L>, right: &Operand<L>) -> Result<Option<Scalar>, TypeError> {
    Ok(match (left, right) {
        (Operand::Typed(..), Operand::Typed(..)) => {
            left.scalar().zip(right.scalar()).and_then(|(a, b)| types::common(a, b))
        }
        (Operand::Typed(..), literal) => left.scalar().map(|scalar| beside(literal, scalar)).transpose()?.flatten(),
        (literal, Operand::Typed(..)) => right.scalar().map(|scalar| beside(literal, scalar)).transpose()?.flatten(),
        (Operand::Integer(a, place), Operand::Integer(b, _)) => {
            let size = if *a < 0 || a.unsigned_abs() > b.unsigned_abs() { *a } else { *b };
            let scalar = types::smallest(size, *a < 0 || *b < 0 || types::holds(types::LINT, size), 16);
            Some(scalar.ok_or_else(|| too_large(size, *place))?)
        }
        _ => Some(types::LREAL),
    })
}

/// The type that a literal without a type and a value of `scalar` are both widened to.
fn beside<L>(literal: &Operand<L>, scalar: Scalar) -> Result<Option<Scalar>, TypeError> {
    Ok(match (literal, scalar) {
        (_, Scalar::Real(_)) => Some(scalar),
        (Operand::Real(..), _) if types::is_whole(scalar) => {
            Some(if scalar.width() > 16 { types::LREAL } else { types::REAL })
        }
        (Operand::Integer(value, _), _) if types::is_whole(scalar) && types::holds(scalar, *value) => Some(scalar),
        (Operand::Integer(value, place), _) if types::is_whole(scalar) => {
            let own = types::smallest(*value, scalar.is_signed(), 8).ok_or_else(|| too_large(*value, *place))?;
            match (scalar, own) {
                (Scalar::Bits(_), Scalar::Int { signed: false, width }) => Some(Scalar::Bits(width)),
                _ => types::common(scalar, own),
            }
        }
        _ => None,
    })
}

/// An operand as an expression of the type that it was widened to.
pub(super) fn fitted<L: Clone>(operand: Operand<L>, scalar: Scalar) -> Result<Expr<L>, TypeError> {
    Ok(match operand {
        Operand::Typed(expr, _) => converted(expr, scalar),
        Operand::Integer(value, place) => constant(scalar, of_integer(value, scalar), place),
        Operand::Real(double, single, place) => constant(scalar, of_real(double, single, scalar), place),
    })
}

/// The bits of an integer literal in a numeric type.
pub(super) const fn of_integer(value: i128, scalar: Scalar) -> u64 {
    match scalar {
        Scalar::Real(32) => (value as f32).to_bits() as u64,
        Scalar::Real(_) => (value as f64).to_bits(),
        _ => scalar.bits(value),
    }
}

pub(super) const fn of_real(double: f64, single: f32, scalar: Scalar) -> u64 {
    match scalar {
        Scalar::Real(32) => single.to_bits() as u64,
        Scalar::Real(_) => double.to_bits(),
        _ => scalar.bits(double.round_ties_even() as i128),
    }
}

/// `base ** exponent`: always of a floating type.
pub(super) fn power<L: Clone>(base: Operand<L>, exponent: Operand<L>, place: Option<Place>) -> Typed<L> {
    let of = |operand: &Operand<L>| match operand {
        Operand::Typed(..) => match operand.scalar() {
            Some(Scalar::Real(width)) => Some(width),
            Some(scalar) if types::is_whole(scalar) => Some(if scalar.width() > 16 { 64 } else { 32 }),
            _ => None,
        },
        Operand::Integer(..) | Operand::Real(..) => Some(32),
    };
    let Some((a, b)) = of(&base).zip(of(&exponent)) else { return Err(undefined("**", &[&base, &exponent], place)) };
    let literals = base.scalar().is_none() && exponent.scalar().is_none();
    let scalar = Scalar::Real(match base.scalar() {
        Some(Scalar::Real(width)) => width,
        _ if literals => 64,
        _ => a.max(b),
    });
    let operands = vec![fitted(base, scalar)?, fitted(exponent, scalar)?];
    Ok(Operand::of(apply(Op::Real(RealFunction::Power), scalar, operands, place)))
}

/// `left op right` for `=`, `<` and `<=`.
///
/// # Errors
/// If values of these types are not compared.
pub fn compare<L: Clone>(op: Op, left: Operand<L>, right: Operand<L>, place: Option<Place>) -> Typed<L> {
    let scalar = match (left.scalar(), right.scalar()) {
        (Some(Scalar::Bool), Some(Scalar::Bool)) => Some(BOOL),
        (Some(Scalar::Bool), None) | (None, Some(Scalar::Bool)) => {
            let operands = vec![logical(left)?, logical(right)?];
            return Ok(Operand::of(apply(op, BOOL, operands, place)));
        }
        (Some(a @ (Scalar::Time(_) | Scalar::Date(..))), Some(b)) => clock::widest(a, b),
        (Some(Scalar::Ref), _) | (_, Some(Scalar::Ref)) => {
            return Ok(Operand::of(apply(op, BOOL, vec![address(left)?, address(right)?], place)));
        }
        _ => shared(&left, &right)?,
    };
    let Some(scalar) = scalar else { return Err(undefined(sign(op), &[&left, &right], place)) };
    let fit = |operand| match scalar {
        Scalar::Time(_) | Scalar::Date(..) => clock::widened(operand, scalar),
        _ => fitted(operand, scalar),
    };
    Ok(Operand::of(apply(op, BOOL, vec![fit(left)?, fit(right)?], place)))
}

/// A reference, or zero as the null reference.
fn address<L: Clone>(operand: Operand<L>) -> Result<Expr<L>, TypeError> {
    match operand {
        Operand::Typed(expr, _) if expr.scalar == Scalar::Ref => Ok(expr),
        Operand::Integer(0, place) => Ok(constant(Scalar::Ref, 0, place)),
        other => {
            let place = other.place();
            Err(TypeError::new(place, format!("a reference is compared with `{}`", other.type_name()))
                .help("compare it with a reference, or with 0"))
        }
    }
}

/// `left op right` for `AND`, `OR` and `XOR`: logical for `BOOL`, bit by bit for integers and strings of bits.
///
/// # Errors
/// If it is not defined for these types.
pub fn bitwise<L: Clone>(op: Op, left: Operand<L>, right: Operand<L>, place: Option<Place>) -> Typed<L> {
    if let (Operand::Integer(a, _), Operand::Integer(b, _)) = (&left, &right) {
        let value = match op {
            Op::And => a & b,
            Op::Or => a | b,
            _ => a ^ b,
        };
        return Ok(Operand::Integer(value, place));
    }
    if left.scalar() == Some(BOOL) || right.scalar() == Some(BOOL) {
        let fits =
            |operand: &Operand<L>| operand.scalar() == Some(BOOL) || matches!(operand, Operand::Integer(0 | 1, _));
        if !fits(&left) || !fits(&right) {
            return Err(undefined(sign(op), &[&left, &right], place));
        }
        return Ok(Operand::of(apply(op, BOOL, vec![logical(left)?, logical(right)?], place)));
    }
    let Some(scalar) = bits_of_both(&left, &right) else { return Err(undefined(sign(op), &[&left, &right], place)) };
    let operands = vec![fitted(left, scalar)?, fitted(right, scalar)?];
    Ok(Operand::of(apply(op, scalar, operands, place)))
}

/// The type of `AND` over two whole types: that of both, or bits of the greater width.
fn bits_of_both<L>(left: &Operand<L>, right: &Operand<L>) -> Option<Scalar> {
    let width = |value: i128, beside: Scalar| {
        let own = types::smallest(value, false, 8)?;
        Some(if own.width() <= beside.width() { beside } else { Scalar::Bits(own.width()) })
    };
    match (left.scalar(), right.scalar()) {
        (Some(a), Some(b)) if types::is_whole(a) && types::is_whole(b) => Some(match (a, b) {
            _ if a == b => a,
            (Scalar::Int { signed: x, .. }, Scalar::Int { signed: y, .. }) if x == y => {
                Scalar::Int { signed: x, width: a.width().max(b.width()) }
            }
            _ => Scalar::Bits(a.width().max(b.width())),
        }),
        (Some(scalar), None) if types::is_whole(scalar) => width(right.number()?, scalar),
        (None, Some(scalar)) if types::is_whole(scalar) => width(left.number()?, scalar),
        _ => None,
    }
}

/// `operand.bit`.
///
/// # Errors
/// If it has no such bit.
pub fn bit<L: Clone>(operand: Operand<L>, number: u32, place: Option<Place>) -> Typed<L> {
    match operand {
        Operand::Typed(expr, Type::Scalar(scalar) | Type::Subrange { base: scalar, .. })
            if types::is_whole(scalar) && number < scalar.width() =>
        {
            let number = constant(Scalar::Bits(8), u64::from(number), place);
            Ok(Operand::of(apply(Op::Bit, BOOL, vec![expr, number], place)))
        }
        other => Err(TypeError::new(place, format!("`{}` has no bit {number}", other.type_name()))),
    }
}
