//! Values of cells: what a variable holds in one cycle, and the arithmetic of IEC 61131-3 on it.

use std::cmp::Ordering;

use crate::table::cell::ast::BinaryOp;

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A Boolean.
    Bool(bool),
    /// A whole number, with its type unless it is a bare literal.
    Int(i128, Option<IntType>),
    /// A real number.
    Real(f64),
    /// A duration in nanoseconds.
    Time(i128),
    /// A string.
    Text(String),
    /// A value of an enum, by its name.
    Enum(String),
}

/// The width of a whole number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct IntType {
    /// Its bits: 8, 16, 32 or 64.
    pub bits: u8,
    /// Whether it has a sign.
    pub signed: bool,
}

impl IntType {
    /// The type of that name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let (bits, signed) = match name.to_ascii_uppercase().as_str() {
            "SINT" => (8, true),
            "INT" => (16, true),
            "DINT" => (32, true),
            "LINT" => (64, true),
            "USINT" | "BYTE" => (8, false),
            "UINT" | "WORD" => (16, false),
            "UDINT" | "DWORD" => (32, false),
            "ULINT" | "LWORD" => (64, false),
            _ => return None,
        };
        Some(Self { bits, signed })
    }

    /// `value` as it is kept in this type: the excess bits are lost.
    #[must_use]
    pub const fn wrap(self, value: i128) -> i128 {
        let range = 1_i128 << self.bits;
        let low = value.rem_euclid(range);
        if self.signed && low >= range / 2 { low - range } else { low }
    }

    /// The type of a result over both.
    fn join(self, other: Self) -> Self {
        match self.bits.cmp(&other.bits) {
            Ordering::Less => other,
            Ordering::Greater => self,
            Ordering::Equal => Self { bits: self.bits, signed: self.signed || other.signed },
        }
    }
}

/// Why an expression has no value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoValue(pub String);

type Result<T> = std::result::Result<T, NoValue>;

fn no_value<T>(message: impl Into<String>) -> Result<T> {
    Err(NoValue(message.into()))
}

impl Value {
    /// A bare number.
    #[must_use]
    pub const fn int(value: i128) -> Self {
        Self::Int(value, None)
    }

    /// The Boolean that it is; 0 and 1 count as one.
    ///
    /// # Errors
    /// Where it is none.
    pub fn truth(&self) -> Result<bool> {
        match self {
            Self::Bool(value) => Ok(*value),
            Self::Int(value @ (0 | 1), _) => Ok(*value == 1),
            _ => no_value(format!("{self:?} is no Boolean")),
        }
    }

    fn real(&self) -> Option<f64> {
        match self {
            #[allow(clippy::cast_precision_loss, reason = "IEC converts whole numbers to REAL the same way")]
            Self::Int(value, _) => Some(*value as f64),
            Self::Real(value) => Some(*value),
            _ => None,
        }
    }

    /// Whether both are the same; a Boolean and a number compare as 0 and 1, names without regard to case.
    ///
    /// # Errors
    /// Where they cannot be compared.
    pub fn same(&self, other: &Self) -> Result<bool> {
        match (self, other) {
            (Self::Bool(_), _) | (_, Self::Bool(_)) => Ok(self.truth()? == other.truth()?),
            (Self::Enum(a), Self::Enum(b)) => Ok(a.eq_ignore_ascii_case(b)),
            (Self::Text(a), Self::Text(b)) => Ok(a == b),
            _ => Ok(self.order(other)? == Some(Ordering::Equal)),
        }
    }

    /// How they are ordered; `None` for a real number that is none.
    ///
    /// # Errors
    /// Where they cannot be compared.
    pub fn order(&self, other: &Self) -> Result<Option<Ordering>> {
        match (self, other) {
            (Self::Int(a, _), Self::Int(b, _)) | (Self::Time(a), Self::Time(b)) => Ok(Some(a.cmp(b))),
            (Self::Text(a), Self::Text(b)) => Ok(Some(a.cmp(b))),
            (Self::Bool(a), Self::Bool(b)) => Ok(Some(a.cmp(b))),
            _ => match (self.real(), other.real()) {
                (Some(a), Some(b)) => Ok(a.partial_cmp(&b)),
                _ => no_value(format!("{self:?} and {other:?} cannot be compared")),
            },
        }
    }

    /// The result of an operator that is no connective.
    ///
    /// # Errors
    /// Where it has none.
    pub fn binary(op: BinaryOp, left: &Self, right: &Self) -> Result<Self> {
        use BinaryOp::{Eq, Ge, Gt, Le, Lt, Ne};
        let holds = |wanted: &[Ordering]| -> Result<Self> {
            Ok(Self::Bool(left.order(right)?.is_some_and(|order| wanted.contains(&order))))
        };
        match op {
            Eq => Ok(Self::Bool(left.same(right)?)),
            Ne => Ok(Self::Bool(!left.same(right)?)),
            Lt => holds(&[Ordering::Less]),
            Le => holds(&[Ordering::Less, Ordering::Equal]),
            Gt => holds(&[Ordering::Greater]),
            Ge => holds(&[Ordering::Greater, Ordering::Equal]),
            BinaryOp::And | BinaryOp::Or | BinaryOp::Xor | BinaryOp::Implies => bitwise(op, left, right),
            _ => arithmetic(op, left, right),
        }
    }

    /// The negative of a number.
    ///
    /// # Errors
    /// Where it is none.
    pub fn negated(&self) -> Result<Self> {
        match self {
            Self::Int(value, ty) => Ok(whole(-value, *ty)),
            Self::Real(value) => Ok(Self::Real(-value)),
            Self::Time(value) => Ok(Self::Time(-value)),
            _ => no_value(format!("{self:?} has no negative")),
        }
    }

    /// `NOT`: of a Boolean, or of every bit of a number.
    ///
    /// # Errors
    /// Where it is neither.
    pub fn inverted(&self) -> Result<Self> {
        match self {
            Self::Int(value, Some(ty)) => Ok(whole(!value, Some(*ty))),
            _ => Ok(Self::Bool(!self.truth()?)),
        }
    }
}

fn whole(value: i128, ty: Option<IntType>) -> Value {
    Value::Int(ty.map_or(value, |ty| ty.wrap(value)), ty)
}

fn joined(left: Option<IntType>, right: Option<IntType>) -> Option<IntType> {
    match (left, right) {
        (Some(left), Some(right)) => Some(left.join(right)),
        (left, right) => left.or(right),
    }
}

fn bitwise(op: BinaryOp, left: &Value, right: &Value) -> Result<Value> {
    if let (Value::Int(a, ta), Value::Int(b, tb)) = (left, right)
        && (ta.is_some() || tb.is_some())
        && op != BinaryOp::Implies
    {
        let value = match op {
            BinaryOp::And => a & b,
            BinaryOp::Or => a | b,
            _ => a ^ b,
        };
        return Ok(whole(value, joined(*ta, *tb)));
    }
    let (a, b) = (left.truth()?, right.truth()?);
    Ok(Value::Bool(match op {
        BinaryOp::And => a && b,
        BinaryOp::Or => a || b,
        BinaryOp::Xor => a != b,
        _ => !a || b,
    }))
}

fn arithmetic(op: BinaryOp, left: &Value, right: &Value) -> Result<Value> {
    match (left, right) {
        (Value::Int(a, ta), Value::Int(b, tb)) => {
            let value = whole_arithmetic(op, *a, *b)?;
            Ok(whole(value, joined(*ta, *tb)))
        }
        (Value::Time(a), Value::Time(b)) if matches!(op, BinaryOp::Add | BinaryOp::Sub) => {
            whole_arithmetic(op, *a, *b).map(Value::Time)
        }
        (Value::Time(a), Value::Int(b, _)) if matches!(op, BinaryOp::Mul | BinaryOp::Div) => {
            whole_arithmetic(op, *a, *b).map(Value::Time)
        }
        (Value::Int(a, _), Value::Time(b)) if op == BinaryOp::Mul => whole_arithmetic(op, *a, *b).map(Value::Time),
        _ => match (left.real(), right.real()) {
            (Some(a), Some(b)) => real_arithmetic(op, a, b).map(Value::Real),
            _ => no_value(format!("no arithmetic on {left:?} and {right:?}")),
        },
    }
}

/// Division and remainder cut towards zero; a division by zero has no value.
fn whole_arithmetic(op: BinaryOp, a: i128, b: i128) -> Result<i128> {
    let result = match op {
        BinaryOp::Add => a.checked_add(b),
        BinaryOp::Sub => a.checked_sub(b),
        BinaryOp::Mul => a.checked_mul(b),
        BinaryOp::Div => a.checked_div(b),
        BinaryOp::Mod => a.checked_rem(b),
        _ => u32::try_from(b).ok().and_then(|b| a.checked_pow(b)),
    };
    result.map_or_else(|| no_value(format!("{a} and {b} give no number here")), Ok)
}

fn real_arithmetic(op: BinaryOp, a: f64, b: f64) -> Result<f64> {
    match op {
        BinaryOp::Add => Ok(a + b),
        BinaryOp::Sub => Ok(a - b),
        BinaryOp::Mul => Ok(a * b),
        BinaryOp::Div if b == 0.0 => no_value("division by zero"),
        BinaryOp::Div => Ok(a / b),
        BinaryOp::Power => Ok(a.powf(b)),
        _ => no_value("a real number has no remainder"),
    }
}
