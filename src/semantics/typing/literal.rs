//! Literals to values (IEC 61131-3:2013, 6.3).

use super::moment;
use super::types::{self, BOOL};
use super::{Operand, Type, constant};
use crate::semantics::scalar::{DateKind, Scalar};
use crate::syntax::TokenKind;
use crate::syntax::ast::Literal;
use crate::text::Place;

/// What a literal means.
#[derive(Clone, Debug, PartialEq)]
pub enum Constant {
    /// An integer without a type.
    Integer(i128),
    /// A number with a point and without a type: as `LREAL` and as `REAL`.
    Real(f64, f32),
    /// A value of a type.
    Typed(Scalar, u64),
    /// Characters, as codes, and whether they are wide.
    Text(Vec<u16>, bool),
    /// `NULL`.
    Null,
}

impl Constant {
    /// As an operand; `None` for characters.
    #[must_use]
    pub fn operand<L>(self, place: Option<Place>) -> Option<Operand<L>> {
        Some(match self {
            Self::Integer(value) => Operand::Integer(value, place),
            Self::Real(double, single) => Operand::Real(double, single, place),
            Self::Typed(scalar, bits) => Operand::Typed(constant(scalar, bits, place), Type::Scalar(scalar)),
            Self::Null => Operand::Typed(constant(Scalar::Ref, 0, place), Type::Null),
            Self::Text(..) => return None,
        })
    }
}

/// What a literal of the tree means.
///
/// # Errors
/// Why it means nothing.
pub fn of(literal: Literal<'_>) -> Result<Constant, String> {
    let token = literal.value().ok_or("a literal without a value")?;
    parse(literal.type_prefix(), literal.is_negative(), token.kind(), token.text())
}

/// What a literal means: its type before `#`, whether a minus stands behind that, and its token.
///
/// # Errors
/// Why it means nothing.
pub fn parse(prefix: Option<&str>, negative: bool, kind: TokenKind, text: &str) -> Result<Constant, String> {
    let signed = |value: i128| if negative { -value } else { value };
    let value = match kind {
        TokenKind::Integer => Constant::Integer(signed(integer(text, 10)?)),
        TokenKind::Based => Constant::Integer(signed(based(text)?)),
        TokenKind::Real => real(text, negative)?,
        TokenKind::True => Constant::Typed(BOOL, 1),
        TokenKind::False => Constant::Typed(BOOL, 0),
        TokenKind::Null => Constant::Null,
        TokenKind::String => Constant::Text(characters(text, '\'')?, false),
        TokenKind::WString => Constant::Text(characters(text, '"')?, true),
        TokenKind::Duration => moment::duration(text)?,
        TokenKind::Date => moment::date(text)?,
        TokenKind::TimeOfDay => moment::time_of_day(text)?,
        TokenKind::DateAndTime => moment::date_and_time(text)?,
        _ => return Err(format!("`{text}` is no literal")),
    };
    match prefix {
        Some(prefix) => typed(prefix, value, text),
        None => Ok(value),
    }
}

fn typed(prefix: &str, value: Constant, text: &str) -> Result<Constant, String> {
    let upper = prefix.to_ascii_uppercase();
    if let ("STRING" | "WSTRING", Constant::Text(codes, _)) = (upper.as_str(), &value) {
        return Ok(Constant::Text(codes.clone(), upper == "WSTRING"));
    }
    let scalar = types::elementary(prefix).ok_or_else(|| format!("`{prefix}` is no type that a literal can have"))?;
    let no = || format!("`{prefix}#{text}`: the value does not fit the type");
    let bits = match (value, scalar) {
        (Constant::Integer(value), Scalar::Real(32)) => u64::from((value as f32).to_bits()),
        (Constant::Integer(value), Scalar::Real(_)) => (value as f64).to_bits(),
        (Constant::Integer(value @ (0 | 1)), Scalar::Bool) => u64::from(value == 1),
        // Based literals are written for their bits: `INT#16#FFFF` is -1.
        (Constant::Integer(value), _)
            if types::is_whole(scalar) && text.contains('#') && value >> scalar.width() == 0 =>
        {
            scalar.bits(value)
        }
        (Constant::Integer(value), _) if types::is_whole(scalar) && types::holds(scalar, value) => scalar.bits(value),
        (Constant::Real(_, single), Scalar::Real(32)) => u64::from(single.to_bits()),
        (Constant::Real(double, _), Scalar::Real(_)) => double.to_bits(),
        (Constant::Typed(from, bits), _) if from == scalar => bits,
        (Constant::Text(codes, _), Scalar::Bits(_)) if codes.len() == 1 => u64::from(codes[0]),
        _ => return Err(no()),
    };
    Ok(Constant::Typed(scalar, bits))
}

fn integer(digits: &str, base: u32) -> Result<i128, String> {
    let plain: String = digits.chars().filter(|c| *c != '_').collect();
    i128::from_str_radix(&plain, base).map_err(|_| format!("`{digits}` is no number, or too large"))
}

fn based(text: &str) -> Result<i128, String> {
    let (base, digits) = text.split_once('#').ok_or_else(|| format!("`{text}` is no number"))?;
    match base.parse() {
        Ok(base @ 2..=36) => integer(digits, base),
        _ => Err(format!("`{base}` is no base of a number")),
    }
}

fn real(text: &str, negative: bool) -> Result<Constant, String> {
    let plain: String = text.chars().filter(|c| *c != '_').collect();
    let wrong = |_| format!("`{text}` is no number");
    let (double, single) = (plain.parse::<f64>().map_err(wrong)?, plain.parse::<f32>().map_err(wrong)?);
    Ok(if negative { Constant::Real(-double, -single) } else { Constant::Real(double, single) })
}

/// The character codes of a string in its quotes, with `$` escapes (table 6) taken out.
fn characters(text: &str, quote: char) -> Result<Vec<u16>, String> {
    let inner = text.strip_prefix(quote).unwrap_or(text);
    let inner = inner.strip_suffix(quote).unwrap_or(inner);
    let digits = if quote == '"' { 4 } else { 2 };
    let mut codes = Vec::new();
    let mut rest = inner.chars();
    while let Some(c) = rest.next() {
        if c != '$' {
            codes.push(u16::try_from(u32::from(c)).unwrap_or(0xFFFD));
            continue;
        }
        let escape = rest.clone().next().ok_or("`$` at the end of a string")?;
        let simple = match escape.to_ascii_uppercase() {
            '$' | '\'' | '"' => Some(u32::from(escape)),
            'L' | 'N' => Some(10),
            'P' => Some(12),
            'R' => Some(13),
            'T' => Some(9),
            _ => None,
        };
        if let Some(code) = simple {
            rest.next();
            codes.push(u16::try_from(code).unwrap_or(0xFFFD));
            continue;
        }
        let hex: String = rest.clone().take(digits).collect();
        let code = u16::from_str_radix(&hex, 16).ok().filter(|_| hex.len() == digits);
        let code = code.ok_or_else(|| format!("`${hex}` is no character"))?;
        codes.push(code);
        rest = rest.as_str()[hex.len()..].chars();
    }
    Ok(codes)
}

/// The moments' types, for literals of `moment`.
pub(super) const fn date_type(kind: DateKind, long: bool) -> Scalar {
    Scalar::Date(kind, if long { 64 } else { 32 })
}
