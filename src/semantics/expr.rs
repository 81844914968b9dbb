//! Typed expressions: no name, no overload and no implicit conversion is left in them. What they read is a leaf of the
//! user's own: a place in memory for a body, a column or a global variable for a cell.
//!
//! An expression has no side effect. It may *fault*: divide by zero, or read outside of an array; a fault counts only
//! where the part is evaluated, and `AND_THEN`, `OR_ELSE` and [`ExprKind::If`] evaluate one branch.

use super::scalar::Scalar;
use crate::text::Place;

/// An expression over leaves of type `L`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expr<L> {
    /// What it is.
    pub kind: ExprKind<L>,
    /// The type of its value.
    pub scalar: Scalar,
    /// Where it stands, for the message of a fault.
    pub place: Option<Place>,
}

/// The forms of an expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ExprKind<L> {
    /// A constant, as bits.
    Const(u64),
    /// The value of a leaf.
    Read(L),
    /// The address of a leaf, as [`Scalar::Ref`].
    Address(L),
    /// An operator that evaluates all its operands.
    Apply(Op, Vec<Expr<L>>),
    /// `AND_THEN`: the second one only where the first holds.
    AndThen(Box<Expr<L>>, Box<Expr<L>>),
    /// `OR_ELSE`: the second one only where the first does not hold.
    OrElse(Box<Expr<L>>, Box<Expr<L>>),
    /// The second where the first holds, the third where it does not; only one of them is evaluated.
    If(Box<Expr<L>>, Box<Expr<L>>, Box<Expr<L>>),
}

impl<L> Expr<L> {
    /// Calls `visit` with every leaf, from left to right.
    pub fn leaves(&self, visit: &mut dyn FnMut(&L)) {
        match &self.kind {
            ExprKind::Const(_) => {}
            ExprKind::Read(leaf) | ExprKind::Address(leaf) => visit(leaf),
            ExprKind::Apply(_, operands) => operands.iter().for_each(|operand| operand.leaves(visit)),
            ExprKind::AndThen(first, second) | ExprKind::OrElse(first, second) => {
                first.leaves(visit);
                second.leaves(visit);
            }
            ExprKind::If(condition, then, otherwise) => {
                condition.leaves(visit);
                then.leaves(visit);
                otherwise.leaves(visit);
            }
        }
    }
}

/// An operator. Unless it says otherwise, its operands and its result have the type of the expression, and it wraps around.
/// A `REAL` result that is not a number has the bits `16#7FC0_0000` (`LREAL`: `16#7FF8_0000_0000_0000`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Op {
    /// Negation: two's complement, or of the sign of a `REAL`.
    Neg,
    /// Bitwise complement; logical for `BOOL`.
    Not,
    /// Sum.
    Add,
    /// Difference.
    Sub,
    /// Product.
    Mul,
    /// Quotient, toward zero. Zero as an integer divisor is a fault; `REAL` divides by IEEE 754.
    Div,
    /// Remainder, with the sign of the dividend. Zero as a divisor is a fault.
    Mod,
    /// Bitwise and.
    And,
    /// Bitwise or.
    Or,
    /// Bitwise exclusive or.
    Xor,
    /// Equality of two operands of one type; the result is `BOOL`.
    Eq,
    /// Less, by the type of the operands; the result is `BOOL`.
    Lt,
    /// Less or equal; the result is `BOOL`.
    Le,
    /// Shift left; the second operand is an integer of any type, read as unsigned: the width or more gives zero.
    Shl,
    /// Shift right; zeros come in, for signed types too where `arithmetic` is not said.
    Shr,
    /// Shift right, the sign comes in.
    Sar,
    /// Rotate left; the second operand is reduced modulo the width.
    Rol,
    /// Rotate right.
    Ror,
    /// Absolute value.
    Abs,
    /// Square root, `REAL` only.
    Sqrt,
    /// Largest integer toward zero, `REAL` to integer: `TRUNC`.
    Trunc,
    /// Conversion from the operand's type to that of the expression: integers and bit strings by sign or zero extension and
    /// cutting, to `BOOL` by comparing with zero, to integers from `REAL` by rounding to nearest (ties to even, outside values
    /// saturate, NaN gives 0), `TIME` as the count of its unit, `TIME` ↔ `LTIME` by the factor 1,000,000.
    Convert,
    /// The bits as they are, between types of one width.
    Reinterpret,
    /// The second operand if the first, a `BOOL`, holds, else the third: all are evaluated (`SEL` with its data swapped).
    Select,
    /// The bit with the number of the second operand, an integer constant in range; the result is `BOOL`.
    Bit,
    /// `REAL` functions that only the interpreter calculates; a prover says that they are not supported.
    Real(RealFunction),
}

/// A function over `REAL` and `LREAL` beyond the four operations, calculated as the host's mathematical library does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RealFunction {
    /// `SIN`
    Sin,
    /// `COS`
    Cos,
    /// `TAN`
    Tan,
    /// `ASIN`
    Asin,
    /// `ACOS`
    Acos,
    /// `ATAN`
    Atan,
    /// `ATAN2`
    Atan2,
    /// `EXP`
    Exp,
    /// `LN`
    Ln,
    /// `LOG`
    Log,
    /// `EXPT` and `**`
    Power,
}

/// What goes wrong while an expression or a statement is evaluated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Fault {
    /// An integer was divided by zero.
    DivisionByZero,
    /// An index is outside of its array.
    IndexOutOfBounds,
    /// A value is outside of its subrange.
    SubrangeViolation,
    /// A loop did not end within the limit.
    LoopLimit,
    /// A reference that refers to nothing was followed.
    NullReference,
}
