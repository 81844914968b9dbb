//! Conversions: implicit ones to the type of a target (IEC 61131-3:2013, 6.4.4.3 and figure 11), and those that are called
//! by name, `INT_TO_REAL` and `TO_REAL` (6.6.2.5).
//!
//! The vendors' compilers warn of an assignment that may lose something, and translate it; so it is accepted here and told.

use super::binary::{fitted, of_integer, of_real};
use super::clock::{NANOS, count, recounted, scale};
use super::types::{self, BOOL, TIME, UDINT};
use super::{Operand, Type, TypeError, apply, constant, converted, reinterpreted};
use crate::semantics::expr::{Expr, ExprKind, Op};
use crate::semantics::scalar::{DateKind, Scalar};
use crate::text::Place;

/// A value in the type of its target.
#[derive(Clone, Debug, PartialEq)]
pub struct Converted<L> {
    /// The value.
    pub expr: Expr<L>,
    /// Whether the conversion may change the number.
    pub lossy: bool,
}

/// `operand` as a `BOOL`; the literals 0 and 1 are such.
///
/// # Errors
/// If it is none.
pub fn logical<L: Clone>(operand: Operand<L>) -> Result<Expr<L>, TypeError> {
    match operand {
        Operand::Typed(expr, _) if expr.scalar == BOOL => Ok(expr),
        Operand::Integer(value @ (0 | 1), place) => Ok(constant(BOOL, u64::from(value == 1), place)),
        other => Err(TypeError::new(other.place(), format!("`{}` where a `BOOL` is needed", other.type_name()))
            .help("compare it with zero: `… <> 0`")),
    }
}

/// `operand` as a value of the scalar type `to`, as an assignment or an argument needs it.
///
/// # Errors
/// If there is no implicit conversion.
pub fn assigned<L: Clone>(operand: Operand<L>, to: &Type) -> Result<Converted<L>, TypeError> {
    let fail = |operand: &Operand<L>| {
        TypeError::new(operand.place(), format!("`{}` cannot become `{to}`", operand.type_name()))
    };
    let Some(scalar) = to.scalar() else { return Err(fail(&operand)) };
    match operand {
        Operand::Integer(value, place) => literal_integer(value, place, scalar).ok_or_else(|| fail(&operand)),
        Operand::Real(double, single, place) => match scalar {
            Scalar::Real(_) => Ok(exact(constant(scalar, of_real(double, single, scalar), place))),
            _ if types::is_whole(scalar) => {
                Ok(Converted { expr: constant(scalar, of_real(double, single, scalar), place), lossy: true })
            }
            _ => Err(fail(&operand)),
        },
        Operand::Typed(ref expr, ref from) => {
            if let (Type::Enumeration { name: a, .. }, Type::Enumeration { name: b, .. }) = (from, to)
                && a != b
            {
                return Ok(Converted { expr: converted(expr.clone(), scalar), lossy: true });
            }
            let lossy = loses(expr.scalar, scalar).ok_or_else(|| fail(&operand))?;
            Ok(Converted { lossy, expr: between(expr.clone(), scalar) })
        }
    }
}

const fn exact<L>(expr: Expr<L>) -> Converted<L> {
    Converted { expr, lossy: false }
}

fn literal_integer<L>(value: i128, place: Option<Place>, scalar: Scalar) -> Option<Converted<L>> {
    match scalar {
        Scalar::Bool if matches!(value, 0 | 1) => Some(exact(constant(scalar, u64::from(value == 1), place))),
        Scalar::Real(_) => Some(exact(constant(scalar, of_integer(value, scalar), place))),
        Scalar::Ref | Scalar::Time(_) if value == 0 => Some(exact(constant(scalar, 0, place))),
        _ if types::is_whole(scalar) => {
            Some(Converted { expr: constant(scalar, scalar.bits(value), place), lossy: !types::holds(scalar, value) })
        }
        _ => None,
    }
}

/// Whether the implicit conversion may change the number; `None` where there is none.
fn loses(from: Scalar, to: Scalar) -> Option<bool> {
    match (from, to) {
        _ if from == to => Some(false),
        (Scalar::Bool, _) if types::is_whole(to) => Some(matches!(to, Scalar::Int { .. })),
        (Scalar::Real(a), Scalar::Real(b)) => Some(a > b),
        (Scalar::Time(a), Scalar::Time(b)) => Some(a > b),
        (Scalar::Date(k, a), Scalar::Date(l, b)) if k == l => Some(a > b),
        (Scalar::Real(_), _) if types::is_whole(to) => Some(true),
        (_, Scalar::Real(width)) if types::is_whole(from) => Some(from.width() >= width),
        _ if types::is_whole(from) && types::is_whole(to) => Some(loses_whole(from, to)),
        _ => None,
    }
}

fn loses_whole(from: Scalar, to: Scalar) -> bool {
    match (from.is_signed(), to.is_signed()) {
        (false, true) => from.width() >= to.width(),
        (true, false) => true,
        _ => from.width() > to.width(),
    }
}

/// The conversion of a scalar value; times and dates change their units.
fn between<L>(expr: Expr<L>, scalar: Scalar) -> Expr<L> {
    match (expr.scalar, scalar) {
        (Scalar::Date(..) | Scalar::Time(_), Scalar::Date(..) | Scalar::Time(_)) => recounted(expr, scalar),
        _ => converted(expr, scalar),
    }
}

/// What a conversion function converts: `INT_TO_REAL` from `INT` to `REAL`, `TO_REAL` from anything to `REAL`.
#[must_use]
pub fn named(name: &str) -> Option<(Option<Scalar>, Scalar)> {
    let upper = name.to_ascii_uppercase();
    if let Some(to) = upper.strip_prefix("TO_") {
        return Some((None, types::elementary(to)?));
    }
    let (from, to) = upper.split_once("_TO_")?;
    let to = types::elementary(to)?;
    if from == "ANY" || from == "ANY_NUM" || from == "ANY_INT" {
        return Some((None, to));
    }
    Some((Some(types::elementary(from)?), to))
}

/// A conversion that is called by name.
///
/// # Errors
/// If the operand is not of the type that the function takes, or nothing converts these types.
pub fn explicit<L: Clone>(
    from: Option<Scalar>,
    to: Scalar,
    operand: Operand<L>,
    place: Option<Place>,
) -> Result<Operand<L>, TypeError> {
    let expr = match (from, &operand) {
        (None, Operand::Integer(value, _)) if types::is_whole(to) => constant(to, to.bits(*value), place),
        (None, _) => operand.settled()?.0,
        (Some(from), Operand::Typed(expr, _)) if close(expr.scalar, from) => expr.clone(),
        (Some(from), _) => assigned(operand, &Type::Scalar(from))?.expr,
    };
    let mut expr = of_kind(expr, to, place)?;
    expr.place = place;
    Ok(Operand::of(expr))
}

/// Whether a conversion function takes the value as it is: `WORD_TO_…` an `UINT`, `DINT_TO_…` an `INT`.
fn close(given: Scalar, taken: Scalar) -> bool {
    given == taken || (types::is_whole(given) && types::is_whole(taken) && !loses_whole(given, taken))
}

fn of_kind<L: Clone>(expr: Expr<L>, to: Scalar, place: Option<Place>) -> Result<Expr<L>, TypeError> {
    use DateKind::{Date, DateAndTime, TimeOfDay};
    let number = |scalar: Scalar| types::is_whole(scalar) || matches!(scalar, Scalar::Real(_) | Scalar::Bool);
    Ok(match (expr.scalar, to) {
        (from, to) if number(from) && number(to) => converted(expr, to),
        (Scalar::Time(_), Scalar::Time(_)) => recounted(expr, to),
        (Scalar::Date(k, _), Scalar::Date(l, _)) if k == l => recounted(expr, to),
        (Scalar::Time(_), Scalar::Date(TimeOfDay, _)) | (Scalar::Date(TimeOfDay, _), Scalar::Time(_)) => {
            recounted(expr, to)
        }
        (Scalar::Date(DateAndTime, _), Scalar::Date(Date, _)) => recounted(midnight(expr), to),
        (Scalar::Date(Date, _), Scalar::Date(DateAndTime, _)) => recounted(expr, to),
        (Scalar::Date(DateAndTime, _), Scalar::Date(TimeOfDay, _)) => recounted(since_midnight(expr), to),
        // Any other time or date as the count of its unit, and back.
        (Scalar::Time(_) | Scalar::Date(..), to) if number(to) => converted(count(expr), to),
        (from, Scalar::Time(_) | Scalar::Date(..)) if number(from) => {
            let whole = Scalar::Int { signed: false, width: to.width() };
            reinterpreted(converted(expr, whole), to)
        }
        (Scalar::Ref, to) if types::is_whole(to) => converted(reinterpreted(expr, UDINT), to),
        (from, to) => {
            let message = format!("nothing converts `{}` to `{}`", types::name(from), types::name(to));
            return Err(TypeError::new(place, message));
        }
    })
}

/// Seconds, or nanoseconds, in a day.
const fn day(scalar: Scalar) -> u64 {
    if scalar.width() == 64 { 86_400 * NANOS } else { 86_400 }
}

/// The midnight before a moment.
fn midnight<L: Clone>(moment: Expr<L>) -> Expr<L> {
    let Scalar::Date(_, width) = moment.scalar else { return moment };
    let place = moment.place;
    let number = count(moment);
    let whole = number.scalar;
    let day = day(whole);
    let rest = scale(Op::Mod, number.clone(), day);
    let start = apply(Op::Sub, whole, vec![number, rest], place);
    reinterpreted(start, Scalar::Date(DateKind::Date, width))
}

/// The time of day of a moment.
fn since_midnight<L: Clone>(moment: Expr<L>) -> Expr<L> {
    let Scalar::Date(_, width) = moment.scalar else { return moment };
    let number = count(moment);
    let day = day(number.scalar);
    let rest = scale(Op::Mod, number, day);
    let rest = if width == 64 { rest } else { scale(Op::Mul, rest, 1000) };
    reinterpreted(rest, Scalar::Date(DateKind::TimeOfDay, width))
}

/// A date and a time of day as one moment.
///
/// # Errors
/// If they are none.
pub fn moment<L: Clone>(date: Operand<L>, time: Operand<L>, place: Option<Place>) -> Result<Operand<L>, TypeError> {
    let date = assigned(date, &Type::Scalar(Scalar::Date(DateKind::Date, 32)))?.expr;
    let time = assigned(time, &Type::Scalar(Scalar::Date(DateKind::TimeOfDay, 32)))?.expr;
    let seconds = scale(Op::Div, count(time), 1000);
    let sum = apply(Op::Add, UDINT, vec![count(date), seconds], place);
    Ok(Operand::of(reinterpreted(sum, Scalar::Date(DateKind::DateAndTime, 32))))
}

/// `TRUNC`: toward zero, into `to`.
///
/// # Errors
/// If the operand is not numeric.
pub fn truncated<L: Clone>(operand: Operand<L>, to: Scalar, place: Option<Place>) -> Result<Operand<L>, TypeError> {
    let real = match operand.scalar() {
        Some(scalar @ Scalar::Real(_)) => scalar,
        Some(scalar) if types::is_whole(scalar) => types::LREAL,
        None => types::LREAL,
        Some(_) => {
            return Err(TypeError::new(place, format!("`{}` where a `REAL` is needed", operand.type_name())));
        }
    };
    let expr = fitted(operand, real)?;
    Ok(Operand::of(apply(Op::Trunc, to, vec![expr], place)))
}

/// The duration of a `TIME` literal or constant, or of an integer number of milliseconds.
#[must_use]
pub fn milliseconds<L>(expr: &Expr<L>) -> Option<u64> {
    match (&expr.kind, expr.scalar) {
        (ExprKind::Const(bits), TIME) => Some(*bits),
        (ExprKind::Const(bits), Scalar::Time(_)) => Some(bits / 1_000_000),
        _ => None,
    }
}
