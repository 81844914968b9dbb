//! The fixed-point reading: `REAL` and `LREAL` as signed numbers that count 10^-digits, for proofs. A program or a table is read
//! so by changing the types and constants of its expressions; everything behind that sees integers of another kind, so interpreter, transition
//! system and table mean the same. What calculates in reals alone in the text (constant expressions, initial values) is calculated in
//! IEEE 754 and then rounded to the nearest number that there is.

use super::expr::{Expr, ExprKind};
use super::scalar::Scalar;

/// A fixed-point reading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reading {
    digits: u32,
    width: u32,
}

impl Reading {
    /// The reading with so many decimal digits behind the point, in so many bits.
    ///
    /// # Errors
    /// Where there are more than 9 digits, or fewer than 8 or more than 32 bits, or one would not fit.
    pub fn new(digits: u32, width: u32) -> Result<Self, String> {
        if digits > 9 || !(8..=32).contains(&width) || 10i64.pow(digits) >= 1 << (width - 1) {
            return Err(format!(
                "{digits} digits in {width} bits: there are at most 9 digits, 8 to 32 bits, and 1.0 must fit"
            ));
        }
        Ok(Self { digits, width })
    }

    /// As `DIGITS,WIDTH`.
    ///
    /// # Errors
    /// As for [`Reading::new`].
    pub fn parse(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.trim().parse::<u32>().ok();
        let both = text.split_once(',').and_then(|(digits, width)| Some((number(digits)?, number(width)?)));
        let (digits, width) = both.ok_or_else(|| format!("`{text}` is not DIGITS,WIDTH, such as 3,32"))?;
        Self::new(digits, width)
    }

    /// As [`Reading::parse`] reads it.
    #[must_use]
    pub fn written(self) -> String {
        format!("{},{}", self.digits, self.width)
    }

    /// The assumption that a verdict then carries.
    #[must_use]
    pub fn assumption(self) -> String {
        let Self { digits, width } = self;
        format!("`REAL` and `LREAL` are read in fixed point: {digits} decimal digits in {width} bits, not IEEE 754")
    }

    /// The type in this reading.
    #[must_use]
    pub const fn scalar(self, scalar: Scalar) -> Scalar {
        match scalar {
            Scalar::Real(_) => Scalar::Fixed { digits: self.digits, width: self.width },
            other => other,
        }
    }

    /// A value of the type `scalar` in this reading: the nearest one that there is; a NaN counts as zero.
    #[must_use]
    pub fn value(self, scalar: Scalar, bits: u64) -> u64 {
        let number = match scalar {
            Scalar::Real(32) => f64::from(f32::from_bits(u32::try_from(bits & 0xFFFF_FFFF).unwrap_or(0))),
            Scalar::Real(_) => f64::from_bits(bits),
            _ => return bits,
        };
        let scaled = (number * 10f64.powi(i32::try_from(self.digits).unwrap_or(0))).round();
        let largest = (1i128 << (self.width - 1)) - 1;
        self.scalar(scalar).bits((scaled as i128).clamp(-largest - 1, largest))
    }

    /// Reads an expression so; `leaf` sees each of its leaves.
    pub fn read<L>(self, expr: &mut Expr<L>, leaf: &mut dyn FnMut(&mut L)) {
        match &mut expr.kind {
            ExprKind::Const(bits) => *bits = self.value(expr.scalar, *bits),
            ExprKind::Read(found) | ExprKind::Address(found) => leaf(found),
            ExprKind::Apply(_, operands) => operands.iter_mut().for_each(|operand| self.read(operand, leaf)),
            ExprKind::AndThen(a, b) | ExprKind::OrElse(a, b) => {
                self.read(a, leaf);
                self.read(b, leaf);
            }
            ExprKind::If(a, b, c) => [a, b, c].into_iter().for_each(|part| self.read(part, leaf)),
        }
        expr.scalar = self.scalar(expr.scalar);
    }
}

/// A value of a fixed-point type as text: `-0.050`.
#[must_use]
pub fn literal(digits: u32, number: i128) -> String {
    let one = 10u128.pow(digits.min(9));
    let sign = if number < 0 { "-" } else { "" };
    let (whole, rest) = (number.unsigned_abs() / one, number.unsigned_abs() % one);
    match digits {
        0 => format!("{sign}{whole}.0"),
        _ => format!("{sign}{whole}.{rest:0width$}", width = digits as usize),
    }
}

/// The number that such a text means, as far as there are digits for it.
#[must_use]
pub fn parse(digits: u32, width: u32, text: &str) -> Option<u64> {
    let number: f64 = text.trim().replace('_', "").parse().ok()?;
    Some(Reading { digits, width }.value(Scalar::Real(64), number.to_bits()))
}
