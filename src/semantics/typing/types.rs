//! Types beyond scalars, elementary types by their names, and which type holds two.

use std::fmt;
use std::sync::Arc;

use crate::library::ItemId;
use crate::semantics::scalar::{DateKind, Scalar};

/// `BOOL`.
pub const BOOL: Scalar = Scalar::Bool;
/// `INT`.
pub const INT: Scalar = Scalar::Int { signed: true, width: 16 };
/// `DINT`.
pub const DINT: Scalar = Scalar::Int { signed: true, width: 32 };
/// `LINT`.
pub const LINT: Scalar = Scalar::Int { signed: true, width: 64 };
/// `UDINT`.
pub const UDINT: Scalar = Scalar::Int { signed: false, width: 32 };
/// `ULINT`.
pub const ULINT: Scalar = Scalar::Int { signed: false, width: 64 };
/// `REAL`.
pub const REAL: Scalar = Scalar::Real(32);
/// `LREAL`.
pub const LREAL: Scalar = Scalar::Real(64);
/// `TIME`.
pub const TIME: Scalar = Scalar::Time(32);
/// `LTIME`.
pub const LTIME: Scalar = Scalar::Time(64);

/// The type of a variable or a value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Type {
    /// An elementary type.
    Scalar(Scalar),
    /// An enumeration; without an item where it is declared with its variable.
    Enumeration {
        /// The item.
        item: Option<ItemId>,
        /// Its name.
        name: Arc<str>,
        /// The type of its values.
        base: Scalar,
    },
    /// A range of an integer type.
    Subrange {
        /// The integer type.
        base: Scalar,
        /// The least number.
        low: i128,
        /// The greatest.
        high: i128,
    },
    /// `STRING(capacity)` or `WSTRING(capacity)`.
    Text {
        /// How many characters it holds.
        capacity: u32,
        /// Whether it is a `WSTRING`.
        wide: bool,
    },
    /// An array.
    Array(Arc<Array>),
    /// A structure or a union, by the number that its owner gave it.
    Structure {
        /// The number.
        id: u32,
        /// Its name; `STRUCT` for one without.
        name: Arc<str>,
    },
    /// An instance of a function block or a class.
    Instance {
        /// The block.
        item: ItemId,
        /// Its name.
        name: Arc<str>,
    },
    /// A variable of an interface: a reference to any block that implements it.
    Interface {
        /// The interface.
        item: ItemId,
        /// Its name.
        name: Arc<str>,
    },
    /// `POINTER TO`, `REF_TO`, or `REFERENCE TO`.
    Reference {
        /// What it refers to.
        target: Arc<Type>,
        /// Whether it is followed without `^`: `REFERENCE TO`.
        implicit: bool,
    },
    /// What `NULL` is, and an address of unknown type.
    Null,
}

/// An array type.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Array {
    /// The lowest index and the number of elements of each dimension.
    pub dimensions: Vec<(i64, u32)>,
    /// The type of the elements.
    pub element: Type,
}

impl Type {
    /// The scalar that a value of this type is, if it is one.
    #[must_use]
    pub const fn scalar(&self) -> Option<Scalar> {
        match self {
            Self::Scalar(scalar) => Some(*scalar),
            Self::Enumeration { base, .. } | Self::Subrange { base, .. } => Some(*base),
            Self::Interface { .. } | Self::Reference { .. } | Self::Null => Some(Scalar::Ref),
            Self::Text { .. } | Self::Array(_) | Self::Structure { .. } | Self::Instance { .. } => None,
        }
    }

    /// The numbers that it may hold, where it is a subrange.
    #[must_use]
    pub const fn range(&self) -> Option<(i128, i128)> {
        match self {
            Self::Subrange { low, high, .. } => Some((*low, *high)),
            _ => None,
        }
    }
}

impl fmt::Display for Type {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scalar(scalar) => f.write_str(name(*scalar)),
            Self::Enumeration { name, .. }
            | Self::Structure { name, .. }
            | Self::Instance { name, .. }
            | Self::Interface { name, .. } => f.write_str(name),
            Self::Subrange { base, low, high } => write!(f, "{} ({low}..{high})", name(*base)),
            Self::Text { capacity, wide } => write!(f, "{}({capacity})", if *wide { "WSTRING" } else { "STRING" }),
            Self::Array(array) => {
                let last = |(low, count): &(i64, u32)| low.saturating_add(i64::from(*count)).saturating_sub(1);
                let bounds: Vec<String> =
                    array.dimensions.iter().map(|both| format!("{}..{}", both.0, last(both))).collect();
                write!(f, "ARRAY[{}] OF {}", bounds.join(", "), array.element)
            }
            Self::Reference { target, implicit } => {
                write!(f, "{} TO {target}", if *implicit { "REFERENCE" } else { "POINTER" })
            }
            Self::Null => f.write_str("NULL"),
        }
    }
}

const fn int(signed: bool, width: u32) -> Scalar {
    Scalar::Int { signed, width }
}

/// The elementary types that are scalars, each by its first name.
const ELEMENTARY: [(&str, Scalar); 47] = [
    ("BOOL", Scalar::Bool),
    ("BIT", Scalar::Bool),
    ("BYTE", Scalar::Bits(8)),
    ("WORD", Scalar::Bits(16)),
    ("DWORD", Scalar::Bits(32)),
    ("LWORD", Scalar::Bits(64)),
    ("CHAR", Scalar::Bits(8)),
    ("WCHAR", Scalar::Bits(16)),
    ("SINT", int(true, 8)),
    ("INT", INT),
    ("DINT", DINT),
    ("LINT", LINT),
    ("USINT", int(false, 8)),
    ("UINT", int(false, 16)),
    ("UDINT", UDINT),
    ("ULINT", ULINT),
    ("REAL", REAL),
    ("LREAL", LREAL),
    ("TIME", TIME),
    ("LTIME", LTIME),
    ("DATE", Scalar::Date(DateKind::Date, 32)),
    ("D", Scalar::Date(DateKind::Date, 32)),
    ("LDATE", Scalar::Date(DateKind::Date, 64)),
    ("TIME_OF_DAY", Scalar::Date(DateKind::TimeOfDay, 32)),
    ("TOD", Scalar::Date(DateKind::TimeOfDay, 32)),
    ("LTIME_OF_DAY", Scalar::Date(DateKind::TimeOfDay, 64)),
    ("LTOD", Scalar::Date(DateKind::TimeOfDay, 64)),
    ("DATE_AND_TIME", Scalar::Date(DateKind::DateAndTime, 32)),
    ("DT", Scalar::Date(DateKind::DateAndTime, 32)),
    ("LDATE_AND_TIME", Scalar::Date(DateKind::DateAndTime, 64)),
    ("LDT", Scalar::Date(DateKind::DateAndTime, 64)),
    ("__UXINT", ULINT),
    ("__XINT", LINT),
    ("__XWORD", Scalar::Bits(64)),
    ("UXINT", ULINT),
    ("XINT", LINT),
    ("XWORD", Scalar::Bits(64)),
    ("T", TIME),
    ("LT", LTIME),
    ("LD", Scalar::Date(DateKind::Date, 64)),
    ("LDATE_TIME", Scalar::Date(DateKind::DateAndTime, 64)),
    ("DATE_TIME", Scalar::Date(DateKind::DateAndTime, 32)),
    ("ULWORD", Scalar::Bits(64)),
    ("PBOOL", Scalar::Ref),
    ("PVOID", Scalar::Ref),
    ("HRESULT", DINT),
    ("PWORD", Scalar::Ref),
];

/// The elementary type called `name`, in any letter case, where it is a scalar.
#[must_use]
pub fn elementary(name: &str) -> Option<Scalar> {
    ELEMENTARY.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|(_, scalar)| *scalar)
}

/// The name of an elementary type.
#[must_use]
pub fn name(scalar: Scalar) -> &'static str {
    if scalar == Scalar::Ref {
        return "POINTER";
    }
    ELEMENTARY.iter().find(|(_, known)| *known == scalar).map_or("an integer", |(name, _)| name)
}

/// Whether `scalar` is an integer or a string of bits: what is added and compared as a number.
#[must_use]
pub const fn is_whole(scalar: Scalar) -> bool {
    matches!(scalar, Scalar::Int { .. } | Scalar::Bits(_))
}

/// Whether the number fits the integer or bit string type.
#[must_use]
pub const fn holds(scalar: Scalar, value: i128) -> bool {
    let width = scalar.width();
    if scalar.is_signed() {
        let half = 1_i128 << (width - 1);
        -half <= value && value < half
    } else {
        0 <= value && value < 1_i128 << width
    }
}

/// The smallest integer type of at least `width` bits that holds `value`: signed where that is asked for or needed, and
/// unsigned where no signed one holds it.
#[must_use]
pub fn smallest(value: i128, signed: bool, width: u32) -> Option<Scalar> {
    let widths = || [8, 16, 32, 64].into_iter().filter(|w| *w >= width);
    let signed = signed || value < 0;
    let first = widths().map(|width| int(signed, width)).find(|scalar| holds(*scalar, value));
    first.or_else(|| widths().map(|width| int(false, width)).find(|scalar| holds(*scalar, value)))
}

/// The smallest type that holds the values of two numeric types; of `LINT` and `ULINT`, `LINT`.
#[must_use]
pub fn common(a: Scalar, b: Scalar) -> Option<Scalar> {
    match (a, b) {
        (Scalar::Real(x), Scalar::Real(y)) => Some(Scalar::Real(x.max(y))),
        (real @ Scalar::Real(_), other) | (other, real @ Scalar::Real(_)) => is_whole(other).then_some(real),
        (Scalar::Bits(x), Scalar::Bits(y)) => Some(Scalar::Bits(x.max(y))),
        _ if is_whole(a) && is_whole(b) => Some(common_integer(a, b)),
        _ => None,
    }
}

fn common_integer(a: Scalar, b: Scalar) -> Scalar {
    if a.is_signed() == b.is_signed() {
        return int(a.is_signed(), a.width().max(b.width()));
    }
    let (signed, unsigned) = if a.is_signed() { (a, b) } else { (b, a) };
    if signed.width() > unsigned.width() { signed } else { int(true, (unsigned.width() * 2).min(64)) }
}
