//! The standard functions over scalars (IEC 61131-3:2013, 6.6.2.5, tables 22 to 36), by their names.
//!
//! Those that use an argument more than once repeat it; who calls them with large arguments puts these into variables first.

use super::binary::{self, Typed, fitted, of_integer, shared};
use super::convert::{self, assigned, logical, moment, truncated};
use super::types::{self, BOOL, DINT, INT};
use super::{Operand, Type, TypeError, apply, constant};
use crate::semantics::expr::{Expr, Op, RealFunction};
use crate::semantics::scalar::Scalar;
use crate::syntax::ast::BinaryOperator;
use crate::text::Place;

const REALS: [(&str, Op); 10] = [
    ("SQRT", Op::Sqrt),
    ("SIN", Op::Real(RealFunction::Sin)),
    ("COS", Op::Real(RealFunction::Cos)),
    ("TAN", Op::Real(RealFunction::Tan)),
    ("ASIN", Op::Real(RealFunction::Asin)),
    ("ACOS", Op::Real(RealFunction::Acos)),
    ("ATAN", Op::Real(RealFunction::Atan)),
    ("EXP", Op::Real(RealFunction::Exp)),
    ("LN", Op::Real(RealFunction::Ln)),
    ("LOG", Op::Real(RealFunction::Log)),
];

/// Functions of two or more arguments that are an operator.
const OPERATORS: [(&str, BinaryOperator, bool); 25] = [
    ("ADD", BinaryOperator::Add, true),
    ("SUB", BinaryOperator::Subtract, false),
    ("MUL", BinaryOperator::Multiply, true),
    ("DIV", BinaryOperator::Divide, false),
    ("MOD", BinaryOperator::Modulo, false),
    ("AND", BinaryOperator::And, true),
    ("OR", BinaryOperator::Or, true),
    ("XOR", BinaryOperator::Xor, true),
    ("EXPT", BinaryOperator::Power, false),
    ("NE", BinaryOperator::NotEqual, false),
    ("ADD_TIME", BinaryOperator::Add, false),
    ("SUB_TIME", BinaryOperator::Subtract, false),
    ("ADD_LTIME", BinaryOperator::Add, false),
    ("SUB_LTIME", BinaryOperator::Subtract, false),
    ("ADD_TOD_TIME", BinaryOperator::Add, false),
    ("SUB_TOD_TIME", BinaryOperator::Subtract, false),
    ("SUB_TOD_TOD", BinaryOperator::Subtract, false),
    ("ADD_DT_TIME", BinaryOperator::Add, false),
    ("SUB_DT_TIME", BinaryOperator::Subtract, false),
    ("SUB_DT_DT", BinaryOperator::Subtract, false),
    ("SUB_DATE_DATE", BinaryOperator::Subtract, false),
    ("MULTIME", BinaryOperator::Multiply, false),
    ("MUL_TIME", BinaryOperator::Multiply, false),
    ("DIVTIME", BinaryOperator::Divide, false),
    ("DIV_TIME", BinaryOperator::Divide, false),
];

/// Comparisons that hold for each argument and the next.
const CHAINS: [(&str, BinaryOperator); 5] = [
    ("GT", BinaryOperator::Greater),
    ("GE", BinaryOperator::GreaterEqual),
    ("EQ", BinaryOperator::Equal),
    ("LE", BinaryOperator::LessEqual),
    ("LT", BinaryOperator::Less),
];

const OTHERS: [&str; 20] = [
    "ABS",
    "ATAN2",
    "SHL",
    "SHR",
    "ROL",
    "ROR",
    "SEL",
    "MIN",
    "MAX",
    "LIMIT",
    "MUX",
    "MOVE",
    "NOT",
    "TRUNC",
    "TRUNC_INT",
    "TRUNC_DINT",
    "ROUND",
    "CONCAT_DATE_TOD",
    "SQR",
    "CONCAT_DATE_TIME",
];

/// Whether [`call`] knows the function.
#[must_use]
pub fn is_standard(name: &str) -> bool {
    let is = |known: &str| known.eq_ignore_ascii_case(name);
    REALS.iter().any(|(known, _)| is(known))
        || OPERATORS.iter().any(|(known, ..)| is(known))
        || CHAINS.iter().any(|(known, _)| is(known))
        || OTHERS.iter().any(|known| is(known))
        || convert::named(name).is_some()
}

/// The position of the formal parameter of a standard function: `G`, `IN0` and `IN1` of `SEL`.
#[must_use]
pub fn position(function: &str, parameter: &str) -> Option<usize> {
    let (function, parameter) = (function.to_ascii_uppercase(), parameter.to_ascii_uppercase());
    let numbered = |from: usize| parameter.strip_prefix("IN")?.parse::<usize>().ok()?.checked_sub(from);
    match (function.as_str(), parameter.as_str()) {
        ("SEL", "G") | ("MUX", "K") | ("LIMIT", "MN") => Some(0),
        ("SEL" | "MUX", _) => numbered(0).map(|n| n + 1),
        ("LIMIT", "IN") | (_, "N") => Some(1),
        ("LIMIT", "MX") => Some(2),
        (_, "IN" | "X") => Some(0),
        _ => numbered(1),
    }
}

/// A call of a standard function by position; `None` if there is none of that name.
pub fn call<L: Clone>(name: &str, arguments: Vec<Operand<L>>, place: Option<Place>) -> Option<Typed<L>> {
    let name = name.to_ascii_uppercase();
    if !is_standard(&name) {
        return None;
    }
    Some(known(&name, arguments, place).map(|operand| operand.at(place)))
}

fn count<L, const N: usize>(
    name: &str,
    arguments: Vec<Operand<L>>,
    place: Option<Place>,
) -> Result<[Operand<L>; N], TypeError> {
    let given = arguments.len();
    let wrong = |_| TypeError::new(place, format!("`{name}` takes {N} arguments, not {given}"));
    arguments.try_into().map_err(wrong)
}

fn known<L: Clone>(name: &str, arguments: Vec<Operand<L>>, place: Option<Place>) -> Typed<L> {
    if let Some((_, op)) = REALS.iter().find(|(known, _)| *known == name) {
        let [x] = count(name, arguments, place)?;
        return real(name, *op, x, place);
    }
    if let Some((_, operator, many)) = OPERATORS.iter().find(|(known, ..)| *known == name) {
        let arguments = if *many { arguments } else { count::<L, 2>(name, arguments, place)?.into() };
        return folded(name, arguments, place, |a, b| binary::binary(*operator, a, b, place));
    }
    if let Some((_, operator)) = CHAINS.iter().find(|(known, _)| *known == name) {
        return chain(name, *operator, arguments, place);
    }
    if let Some((from, to)) = convert::named(name) {
        let [x] = count(name, arguments, place)?;
        return convert::explicit(from, to, x, place);
    }
    other(name, arguments, place)
}

fn other<L: Clone>(name: &str, arguments: Vec<Operand<L>>, place: Option<Place>) -> Typed<L> {
    match name {
        "MIN" => folded(name, arguments, place, |a, b| extreme(a, b, false, place)),
        "MAX" => folded(name, arguments, place, |a, b| extreme(a, b, true, place)),
        "LIMIT" => {
            let [low, x, high] = count(name, arguments, place)?;
            extreme(extreme(x, low, true, place)?, high, false, place)
        }
        "SEL" => {
            let [which, zero, one] = count(name, arguments, place)?;
            select(logical(which)?, one, zero, place)
        }
        "MUX" => multiplexer(arguments, place),
        "SHL" | "SHR" | "ROL" | "ROR" => {
            let [x, n] = count(name, arguments, place)?;
            shift(name, x, n, place)
        }
        "ATAN2" => {
            let [y, x] = count(name, arguments, place)?;
            let scalar = floating(&y, &x);
            let operands = vec![fitted(y, scalar)?, fitted(x, scalar)?];
            Ok(Operand::of(apply(Op::Real(RealFunction::Atan2), scalar, operands, place)))
        }
        "CONCAT_DATE_TOD" | "CONCAT_DATE_TIME" => {
            let [date, time] = count(name, arguments, place)?;
            moment(date, time, place)
        }
        _ => {
            let [x] = count(name, arguments, place)?;
            one(name, x, place)
        }
    }
}

/// Functions of one argument.
fn one<L: Clone>(name: &str, x: Operand<L>, place: Option<Place>) -> Typed<L> {
    match name {
        "MOVE" => Ok(x),
        "NOT" => binary::negated(x, place),
        "ABS" => absolute(x, place),
        "SQR" => binary::arithmetic(Op::Mul, x.clone(), x, place),
        "TRUNC_INT" => truncated(x, INT, place),
        "ROUND" => convert::explicit(None, DINT, x, place),
        _ => truncated(x, DINT, place),
    }
}

fn folded<L>(
    name: &str,
    arguments: Vec<Operand<L>>,
    place: Option<Place>,
    mut with: impl FnMut(Operand<L>, Operand<L>) -> Typed<L>,
) -> Typed<L> {
    let mut rest = arguments.into_iter();
    let (Some(first), Some(second)) = (rest.next(), rest.next()) else {
        return Err(TypeError::new(place, format!("`{name}` takes two arguments or more")));
    };
    let both = with(first, second)?;
    rest.try_fold(both, with)
}

fn chain<L: Clone>(name: &str, operator: BinaryOperator, arguments: Vec<Operand<L>>, place: Option<Place>) -> Typed<L> {
    let pairs: Result<Vec<_>, _> =
        arguments.windows(2).map(|pair| binary::binary(operator, pair[0].clone(), pair[1].clone(), place)).collect();
    let pairs = pairs?.into_iter();
    let all = pairs.reduce_typed(|a, b| binary::bitwise(Op::And, a, b, place))?;
    all.ok_or_else(|| TypeError::new(place, format!("`{name}` takes two arguments or more")))
}

/// `reduce` whose step may fail.
trait ReduceTyped<L>: Iterator<Item = Operand<L>> + Sized {
    fn reduce_typed(
        mut self,
        with: impl FnMut(Operand<L>, Operand<L>) -> Typed<L>,
    ) -> Result<Option<Operand<L>>, TypeError> {
        let Some(first) = self.next() else { return Ok(None) };
        self.try_fold(first, with).map(Some)
    }
}

impl<L, I: Iterator<Item = Operand<L>>> ReduceTyped<L> for I {}

fn floating<L>(a: &Operand<L>, b: &Operand<L>) -> Scalar {
    let width = |operand: &Operand<L>| match operand.scalar() {
        Some(Scalar::Real(width)) => Some(width),
        Some(scalar) => Some(if scalar.width() > 16 { 64 } else { 32 }),
        None => None,
    };
    Scalar::Real(width(a).max(width(b)).unwrap_or(64))
}

fn real<L: Clone>(name: &str, op: Op, x: Operand<L>, place: Option<Place>) -> Typed<L> {
    let scalar = floating(&x, &x);
    match x.scalar() {
        Some(Scalar::Real(_)) | None => {}
        Some(other) if types::is_whole(other) => {}
        Some(_) => return Err(binary::undefined(name, &[&x], place)),
    }
    let expr = fitted(x, scalar)?;
    Ok(Operand::of(apply(op, scalar, vec![expr], place)))
}

fn absolute<L: Clone>(x: Operand<L>, place: Option<Place>) -> Typed<L> {
    match x {
        Operand::Integer(value, _) => Ok(Operand::Integer(value.abs(), place)),
        Operand::Real(double, single, _) => Ok(Operand::Real(double.abs(), single.abs(), place)),
        Operand::Typed(expr, _) if matches!(expr.scalar, Scalar::Real(_) | Scalar::Int { signed: true, .. }) => {
            let scalar = expr.scalar;
            Ok(Operand::of(apply(Op::Abs, scalar, vec![expr], place)))
        }
        Operand::Typed(expr, type_) if types::is_whole(expr.scalar) => Ok(Operand::Typed(expr, type_)),
        other => Err(binary::undefined("ABS", &[&other], place)),
    }
}

/// Two operands in one type: a common numeric one, or the type that both have.
fn unified<L: Clone>(
    name: &str,
    a: Operand<L>,
    b: Operand<L>,
    place: Option<Place>,
) -> Result<(Expr<L>, Expr<L>, Type), TypeError> {
    if let (Operand::Typed(x, left), Operand::Typed(y, right)) = (&a, &b)
        && (left == right || x.scalar == y.scalar)
    {
        let type_ = if left == right { left.clone() } else { Type::Scalar(x.scalar) };
        return Ok((x.clone(), y.clone(), type_));
    }
    if let Some(scalar) = shared(&a, &b)? {
        return Ok((fitted(a, scalar)?, fitted(b, scalar)?, Type::Scalar(scalar)));
    }
    // A literal beside a type that is not numeric, or two widths of one kind of time.
    let wider = |a: &Operand<L>, b: &Operand<L>| match (a.scalar(), b.scalar()) {
        (Some(x), Some(y)) if x.width() >= y.width() => Some(x),
        (Some(x), None) => Some(x),
        (_, y) => y,
    };
    let Some(scalar) = wider(&a, &b) else { return Err(binary::undefined(name, &[&a, &b], place)) };
    let type_ = Type::Scalar(scalar);
    Ok((assigned(a, &type_)?.expr, assigned(b, &type_)?.expr, type_))
}

fn extreme<L: Clone>(a: Operand<L>, b: Operand<L>, greatest: bool, place: Option<Place>) -> Typed<L> {
    let (a, b, type_) = unified(if greatest { "MAX" } else { "MIN" }, a, b, place)?;
    let scalar = a.scalar;
    let pair = if greatest { vec![b.clone(), a.clone()] } else { vec![a.clone(), b.clone()] };
    let first = apply(Op::Lt, BOOL, pair, place);
    Ok(Operand::Typed(apply(Op::Select, scalar, vec![first, a, b], place), type_))
}

/// `then` where the condition holds, else `otherwise`; both are evaluated.
///
/// # Errors
/// If they have no common type.
pub fn select<L: Clone>(condition: Expr<L>, then: Operand<L>, otherwise: Operand<L>, place: Option<Place>) -> Typed<L> {
    let (then, otherwise, type_) = unified("SEL", then, otherwise, place)?;
    let scalar = then.scalar;
    Ok(Operand::Typed(apply(Op::Select, scalar, vec![condition, then, otherwise], place), type_))
}

/// `MUX`: the last input where the selector is outside of their numbers.
fn multiplexer<L: Clone>(arguments: Vec<Operand<L>>, place: Option<Place>) -> Typed<L> {
    let mut rest = arguments.into_iter();
    let (Some(selector), Some(last)) = (rest.next(), rest.next_back()) else {
        return Err(TypeError::new(place, "`MUX` takes a selector and inputs"));
    };
    let (selector, _) = selector.settled()?;
    if !types::is_whole(selector.scalar) {
        return Err(TypeError::new(place, "the selector of `MUX` is no integer"));
    }
    let inputs: Vec<Operand<L>> = rest.collect();
    let mut result = last;
    for (n, input) in inputs.into_iter().enumerate().rev() {
        let number = i128::try_from(n).unwrap_or(i128::MAX);
        let number = constant(selector.scalar, of_integer(number, selector.scalar), place);
        let chosen = apply(Op::Eq, BOOL, vec![selector.clone(), number], place);
        result = select(chosen, input, result, place)?;
    }
    Ok(result)
}

/// Shifts keep the type of what is shifted; to the right the sign comes in where there is one, as CODESYS has it.
fn shift<L: Clone>(name: &str, x: Operand<L>, n: Operand<L>, place: Option<Place>) -> Typed<L> {
    let x = match x {
        Operand::Integer(value, place) if value >= 0 => {
            let scalar = types::smallest(value, false, 8).ok_or_else(|| super::too_large(value, place))?;
            constant(Scalar::Bits(scalar.width()), scalar.bits(value), place)
        }
        other => other.settled()?.0,
    };
    let (n, _) = n.settled()?;
    if !types::is_whole(x.scalar) || !types::is_whole(n.scalar) {
        let pair = [&Operand::of(x), &Operand::of(n)];
        return Err(binary::undefined(name, &pair, place));
    }
    let op = match name {
        "SHL" => Op::Shl,
        "SHR" if x.scalar.is_signed() => Op::Sar,
        "SHR" => Op::Shr,
        "ROL" => Op::Rol,
        _ => Op::Ror,
    };
    let scalar = x.scalar;
    Ok(Operand::of(apply(op, scalar, vec![x, n], place)))
}
