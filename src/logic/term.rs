//! Bit-vector terms with sharing: a [`Pool`] makes each distinct term once, so that a term is a number and equal terms
//! are equal numbers.
//!
//! A width is 1 to 64 bits; a truth value is a bit-vector of width 1. The operators are those of BTOR2 (Niemetz et al.,
//! *Btor2, BtorMC and Boolector 3.0*, CAV 2018) with its totals: `x / 0` is all ones, `x mod 0` is `x`, signed division
//! truncates toward zero; and those of IEEE 754 binary32 and binary64 on the bits of the numbers, rounding to nearest, ties
//! to even.

use super::hash::FastMap;

/// A term of a [`Pool`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Term(pub u32);

/// A variable of a [`Pool`], by its number in the order of making.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Var(pub u32);

/// An operator over bit-vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Op {
    /// Bitwise complement.
    Not,
    /// Two's complement negation.
    Neg,
    /// Bitwise and.
    And,
    /// Bitwise or.
    Or,
    /// Bitwise exclusive or.
    Xor,
    /// Sum modulo 2^w.
    Add,
    /// Difference modulo 2^w.
    Sub,
    /// Product modulo 2^w.
    Mul,
    /// Unsigned quotient.
    Udiv,
    /// Signed quotient, toward zero.
    Sdiv,
    /// Unsigned remainder.
    Urem,
    /// Signed remainder, with the sign of the dividend.
    Srem,
    /// Shift left by the second operand, of the same width; zeros come in, also where it is w or more.
    Shl,
    /// Shift right, zeros come in.
    Lshr,
    /// Shift right, the sign comes in.
    Ashr,
    /// Equality; width 1.
    Eq,
    /// Unsigned less; width 1.
    Ult,
    /// Unsigned less or equal; width 1.
    Ule,
    /// Signed less; width 1.
    Slt,
    /// Signed less or equal; width 1.
    Sle,
    /// If-then-else: the first operand has width 1.
    Ite,
    /// The first operand in the high bits, the second in the low ones; at most 64 together.
    Concat,
    /// The bits `low ..= high`.
    Extract {
        /// Highest bit.
        high: u32,
        /// Lowest bit.
        low: u32,
    },
    /// Zeros in front, up to the width given.
    ZeroExtend(u32),
    /// The sign in front, up to the width given.
    SignExtend(u32),
    /// IEEE 754 sum; the width of the operands, 32 or 64, says the format. Every NaN result is the canonical quiet one.
    FloatAdd,
    /// IEEE 754 difference.
    FloatSub,
    /// IEEE 754 product.
    FloatMul,
    /// IEEE 754 quotient.
    FloatDiv,
    /// IEEE 754 square root.
    FloatSqrt,
    /// IEEE 754 equality: NaN equals nothing, the zeros are equal; width 1.
    FloatEq,
    /// IEEE 754 less; width 1.
    FloatLt,
    /// IEEE 754 less or equal; width 1.
    FloatLe,
    /// To the nearest number of the other format, 32 or 64 bits.
    FloatToFloat(u32),
    /// Signed integer to a float of so many bits, to nearest.
    SignedToFloat(u32),
    /// Unsigned integer to a float of so many bits, to nearest.
    UnsignedToFloat(u32),
    /// To the nearest integer, ties to even, as a signed integer of so many bits; NaN gives 0, outside values saturate.
    FloatToSigned(u32),
    /// The same, as an unsigned integer.
    FloatToUnsigned(u32),
    /// Toward zero, as a signed integer of so many bits; NaN gives 0, outside values saturate.
    FloatTruncate(u32),
}

/// What a term is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Node {
    /// A constant; bits above the width are zero.
    Const(u64),
    /// A variable.
    Var(Var),
    /// An operator with one to three operands; unused places repeat the first.
    Apply(Op, [Term; 3]),
}

/// The terms, each made once.
#[derive(Clone, Debug, Default)]
pub struct Pool {
    nodes: Vec<(Node, u32)>,
    index: FastMap<(Node, u32), Term>,
    variables: Vec<(Term, String)>,
}

/// The bits below `width`.
#[must_use]
pub const fn mask(width: u32) -> u64 {
    if width >= 64 { u64::MAX } else { (1 << width) - 1 }
}

impl Op {
    /// How many operands it takes.
    #[must_use]
    pub const fn arity(self) -> usize {
        match self {
            Self::Not
            | Self::Neg
            | Self::Extract { .. }
            | Self::ZeroExtend(_)
            | Self::SignExtend(_)
            | Self::FloatSqrt
            | Self::FloatToFloat(_)
            | Self::SignedToFloat(_)
            | Self::UnsignedToFloat(_)
            | Self::FloatToSigned(_)
            | Self::FloatToUnsigned(_)
            | Self::FloatTruncate(_) => 1,
            Self::Ite => 3,
            _ => 2,
        }
    }
}

impl Pool {
    /// The constant `value`, cut to `width` bits.
    pub fn constant(&mut self, width: u32, value: u64) -> Term {
        self.intern(Node::Const(value & mask(width)), width)
    }

    /// A truth value.
    pub fn truth(&mut self, value: bool) -> Term {
        self.constant(1, u64::from(value))
    }

    /// A new variable; names need not be unique, variables are.
    pub fn variable(&mut self, width: u32, name: impl Into<String>) -> Term {
        let var = Var(u32::try_from(self.variables.len()).expect("fewer than 2^32 variables"));
        let term = self.intern(Node::Var(var), width);
        self.variables.push((term, name.into()));
        term
    }

    /// The operator applied, exactly as said; [`Pool::apply`](super::term::Pool) and its kin fold what is constant.
    pub(super) fn intern(&mut self, node: Node, width: u32) -> Term {
        if let Some(term) = self.index.get(&(node, width)) {
            return *term;
        }
        let term = Term(u32::try_from(self.nodes.len()).expect("fewer than 2^32 terms"));
        self.nodes.push((node, width));
        self.index.insert((node, width), term);
        term
    }

    /// What the term is.
    #[must_use]
    pub fn node(&self, term: Term) -> Node {
        self.nodes[term.0 as usize].0
    }

    /// Its width.
    #[must_use]
    pub fn width(&self, term: Term) -> u32 {
        self.nodes[term.0 as usize].1
    }

    /// The value of a constant.
    #[must_use]
    pub fn value(&self, term: Term) -> Option<u64> {
        match self.node(term) {
            Node::Const(value) => Some(value),
            _ => None,
        }
    }

    /// Every constant, with its width.
    pub fn constants(&self) -> impl Iterator<Item = (u32, u64)> + '_ {
        self.nodes.iter().filter_map(|(node, width)| match node {
            Node::Const(value) => Some((*width, *value)),
            _ => None,
        })
    }

    /// The name of a variable.
    #[must_use]
    pub fn name(&self, var: Var) -> &str {
        &self.variables[var.0 as usize].1
    }

    /// The term of a variable.
    #[must_use]
    pub fn term_of(&self, var: Var) -> Term {
        self.variables[var.0 as usize].0
    }

    /// How many variables there are.
    #[must_use]
    pub fn variables(&self) -> usize {
        self.variables.len()
    }

    /// How many terms there are; operands come before what they are operands of.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }
}
