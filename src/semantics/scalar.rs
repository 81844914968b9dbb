//! The scalar types: what one slot of a machine's memory holds, as bits in a `u64`.

/// A scalar type. A value is its bits, those above the width zero; signed integers are in two's complement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Scalar {
    /// `BOOL`: one bit.
    Bool,
    /// `BYTE`, `WORD`, `DWORD`, `LWORD`, `CHAR`, `WCHAR`: 8, 16, 32 or 64 bits.
    Bits(u32),
    /// `SINT` … `LINT`, `USINT` … `ULINT`, and enumerations over them.
    Int {
        /// Whether it has a sign.
        signed: bool,
        /// 8, 16, 32 or 64 bits.
        width: u32,
    },
    /// `REAL` (32 bits) and `LREAL` (64 bits): IEEE 754.
    Real(u32),
    /// `REAL` and `LREAL` in a fixed-point reading: a signed number that counts 10^-digits. No text declares it; see
    /// [`super::fixed`].
    Fixed {
        /// Decimal digits behind the point, at most 9.
        digits: u32,
        /// Bits, at most 32.
        width: u32,
    },
    /// `TIME` (32 bits, unsigned milliseconds) and `LTIME` (64 bits, unsigned nanoseconds), as CODESYS and TwinCAT have them.
    Time(u32),
    /// `DATE`, `DATE_AND_TIME` (seconds since 1970-01-01) and `TIME_OF_DAY` (milliseconds since midnight): 32 bits; their
    /// long forms (nanoseconds): 64 bits.
    Date(DateKind, u32),
    /// The address of a slot, plus one; zero is the null reference. 32 bits.
    Ref,
}

/// Which of the date types.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DateKind {
    /// `DATE`, `LDATE`.
    Date,
    /// `TIME_OF_DAY`, `LTOD`.
    TimeOfDay,
    /// `DATE_AND_TIME`, `LDT`.
    DateAndTime,
}

impl Scalar {
    /// Its width in bits: 1 to 64.
    #[must_use]
    pub const fn width(self) -> u32 {
        match self {
            Self::Bool => 1,
            Self::Bits(width) | Self::Real(width) | Self::Time(width) | Self::Date(_, width) => width,
            Self::Int { width, .. } | Self::Fixed { width, .. } => width,
            Self::Ref => 32,
        }
    }

    /// Whether it is compared and divided as a signed integer.
    #[must_use]
    pub const fn is_signed(self) -> bool {
        matches!(self, Self::Int { signed: true, .. } | Self::Fixed { .. })
    }

    /// The bits of `value` as a number: signed where the type is.
    #[must_use]
    pub const fn number(self, value: u64) -> i128 {
        let width = self.width();
        if self.is_signed() && width < 128 {
            let shift = 64 - width;
            (((value << shift) as i64) >> shift) as i128
        } else {
            value as i128
        }
    }

    /// The number's bits, cut to the width.
    #[must_use]
    pub const fn bits(self, number: i128) -> u64 {
        let width = self.width();
        let low = number as u64;
        if width >= 64 { low } else { low & ((1 << width) - 1) }
    }
}
