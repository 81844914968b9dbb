//! From operators over typed operands to typed expressions: overloads are resolved and implicit conversions made explicit.
//! Bodies of blocks and cells of tables are both typed here, so that `a + b` means the same in both.
//!
//! *Widths* (IEC 61131-3:2013, 6.6.1.6 and figure 11; CODESYS and TwinCAT, "type conversion"): both operands are widened to
//! the smallest type that holds the values of both, and the result wraps around at that type. A literal without a type takes
//! the type of its partner where it fits. What is assigned is converted to the type of its target; where that may lose
//! something, [`convert::Converted::lossy`] says so, as the vendors' compilers warn and go on.

pub mod binary;
mod clock;
pub mod convert;
pub mod functions;
pub mod literal;
pub mod moment;
pub mod types;

use super::eval;
use super::expr::{Expr, ExprKind, Op};
use super::scalar::Scalar;
use crate::text::Place;

pub use types::{Array, Type};

/// What an operator works on.
#[derive(Clone, Debug, PartialEq)]
pub enum Operand<L> {
    /// A value of a type.
    Typed(Expr<L>, Type),
    /// An integer literal without a type, or a sum of such.
    Integer(i128, Option<Place>),
    /// A literal with a point and without a type, or a sum of such: as `LREAL` and as `REAL`, each rounded once.
    Real(f64, f32, Option<Place>),
}

impl<L> Operand<L> {
    /// The operand of a scalar type.
    #[must_use]
    pub const fn of(expr: Expr<L>) -> Self {
        let scalar = expr.scalar;
        Self::Typed(expr, Type::Scalar(scalar))
    }

    /// Where it stands.
    #[must_use]
    pub const fn place(&self) -> Option<Place> {
        match self {
            Self::Typed(expr, _) => expr.place,
            Self::Integer(_, place) | Self::Real(_, _, place) => *place,
        }
    }

    /// The same with another place.
    #[must_use]
    pub fn at(mut self, at: Option<Place>) -> Self {
        match &mut self {
            Self::Typed(expr, _) => expr.place = at,
            Self::Integer(_, place) | Self::Real(_, _, place) => *place = at,
        }
        self
    }

    /// The scalar type, where it has one.
    #[must_use]
    pub fn scalar(&self) -> Option<Scalar> {
        match self {
            Self::Typed(_, type_) => type_.scalar(),
            Self::Integer(..) | Self::Real(..) => None,
        }
    }

    /// How a message calls its type.
    #[must_use]
    pub fn type_name(&self) -> String {
        match self {
            Self::Typed(_, type_) => type_.to_string(),
            Self::Integer(..) => "ANY_INT".to_owned(),
            Self::Real(..) => "ANY_REAL".to_owned(),
        }
    }

    /// The constant number that it is, if it is an integer one.
    #[must_use]
    pub const fn number(&self) -> Option<i128> {
        match self {
            Self::Integer(value, _) => Some(*value),
            Self::Typed(Expr { kind: ExprKind::Const(bits), scalar, .. }, _) if !matches!(scalar, Scalar::Real(_)) => {
                Some(scalar.number(*bits))
            }
            _ => None,
        }
    }

    /// As an expression of a type of its own: a literal without a type becomes the smallest of `INT`, `DINT` and `LINT` that
    /// holds it, or an `LREAL`.
    ///
    /// # Errors
    /// If the number is too large for any type.
    pub fn settled(self) -> Result<(Expr<L>, Type), TypeError> {
        match self {
            Self::Typed(expr, type_) => Ok((expr, type_)),
            Self::Integer(value, place) => {
                let scalar = types::smallest(value, true, 16).ok_or_else(|| too_large(value, place))?;
                Ok((constant(scalar, scalar.bits(value), place), Type::Scalar(scalar)))
            }
            Self::Real(double, _, place) => {
                Ok((constant(types::LREAL, double.to_bits(), place), Type::Scalar(types::LREAL)))
            }
        }
    }
}

/// Why something has no type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TypeError {
    /// What is wrong, in one line.
    pub message: String,
    /// What would fit.
    pub help: Option<String>,
    /// Where.
    pub place: Option<Place>,
}

impl TypeError {
    /// An error at `place`.
    pub fn new(place: Option<Place>, message: impl Into<String>) -> Self {
        Self { message: message.into(), help: None, place }
    }

    /// With what would fit.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

pub(crate) fn too_large(value: i128, place: Option<Place>) -> TypeError {
    TypeError::new(place, format!("`{value}` is too large for any integer type"))
}

/// A constant.
#[must_use]
pub const fn constant<L>(scalar: Scalar, bits: u64, place: Option<Place>) -> Expr<L> {
    Expr { kind: ExprKind::Const(bits), scalar, place }
}

/// An operator on its operands; of constants, its result, unless that is a fault.
#[must_use]
pub fn apply<L>(op: Op, scalar: Scalar, operands: Vec<Expr<L>>, place: Option<Place>) -> Expr<L> {
    let known = |operand: &Expr<L>| match operand.kind {
        ExprKind::Const(bits) => Some((operand.scalar, bits)),
        _ => None,
    };
    let values: Option<Vec<(Scalar, u64)>> = operands.iter().map(known).collect();
    // What the host's library calculates is left to the run, so that a prover sees where it comes from.
    let folds = !matches!(op, Op::Real(_));
    match values.filter(|_| folds).and_then(|values| eval::apply(op, scalar, &values).ok()) {
        Some(bits) => constant(scalar, bits, place),
        None => Expr { kind: ExprKind::Apply(op, operands), scalar, place },
    }
}

/// `expr` as a value of `scalar`, by [`Op::Convert`].
#[must_use]
pub fn converted<L>(expr: Expr<L>, scalar: Scalar) -> Expr<L> {
    if expr.scalar == scalar {
        return expr;
    }
    let place = expr.place;
    apply(Op::Convert, scalar, vec![expr], place)
}

/// The bits of `expr` as a value of `scalar`, which is as wide.
#[must_use]
pub fn reinterpreted<L>(expr: Expr<L>, scalar: Scalar) -> Expr<L> {
    if expr.scalar == scalar {
        return expr;
    }
    let place = expr.place;
    apply(Op::Reinterpret, scalar, vec![expr], place)
}

#[cfg(test)]
mod tests;
