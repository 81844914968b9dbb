//! What a cell says: a list of constraints, each of which keeps apart what users confuse, a *value* that the column's
//! variable equals and a *condition* that stands for itself.
//!
//! Every span is a span of the user's file.

use crate::text::Span;

/// A whole cell: all of its parts must hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Constraint {
    /// The parts between the commas.
    pub chunks: Vec<Chunk>,
}

/// One part of a cell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chunk {
    /// What it says.
    pub kind: ChunkKind,
    /// Where it stands in the file.
    pub span: Span,
}

/// The forms that a part of a cell takes; `v` is the column's own variable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ChunkKind {
    /// `-`: anything.
    Any,
    /// `e`: `v = e`.
    Value(Expr),
    /// `> e`: `v > e`, and `= e`: `v = e`.
    Compare(BinaryOp, Expr),
    /// `[a, b]`, `(a, b)` and their mixtures.
    Interval(Box<Interval>),
    /// A comparison, or AND/OR of comparisons, as it stands.
    Condition(Expr),
    /// `√c`: `c` in the row's first cycle, then anything.
    Trigger(Box<Chunk>),
    /// `if :: g -> c … fi`: the first arm whose guard holds; none holds: not satisfied.
    Guarded(Vec<Arm>),
    /// A predicate over all arguments of a column that has several: `leq`, or a function of the table.
    Predicate(Predicate),
}

/// An arm of a guarded command at the top of a cell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Arm {
    /// The guard.
    pub guard: Expr,
    /// What holds then.
    pub then: Chunk,
}

/// An interval; an end left out is open to infinity.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interval {
    /// The lower end.
    pub low: Option<Expr>,
    /// Whether the lower end itself is inside.
    pub low_closed: bool,
    /// The upper end.
    pub high: Option<Expr>,
    /// Whether the upper end itself is inside.
    pub high_closed: bool,
}

/// What a cell of a column with several arguments may name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Predicate {
    /// A comparison of the two arguments.
    Compare(BinaryOp),
    /// A function of the table, applied to the arguments.
    Function(String),
}

/// An expression of Structured Text, with the past added.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expr {
    /// What it is.
    pub kind: ExprKind,
    /// Where it stands in the file.
    pub span: Span,
}

/// The forms of an expression.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ExprKind {
    /// The column's own variable, where the cell leaves it out (`>= 1 AND <= 5`).
    Own,
    /// A literal.
    Literal(Literal),
    /// `Colour#GREEN`: a value of the named type.
    EnumValue {
        /// The type.
        ty: String,
        /// The value.
        name: String,
    },
    /// A variable, a member, an element, a global variable of the table, or an enum value.
    Name(Path),
    /// `X[-n]`: the value `n` cycles ago.
    Past(Path, u32),
    /// An operator before its operand.
    Unary(UnaryOp, Box<Expr>),
    /// An operator between its operands.
    Binary(BinaryOp, Box<Expr>, Box<Expr>),
    /// A call of a function.
    Call {
        /// Its name.
        name: String,
        /// Its arguments.
        args: Vec<Arg>,
    },
    /// `if :: g -> e … fi` inside an expression.
    Guarded(Vec<(Expr, Expr)>),
}

/// An argument of a call.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Arg {
    /// The formal name, in `IN := e`.
    pub name: Option<String>,
    /// The value.
    pub value: Expr,
}

/// The way to a variable: a name, members and elements of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Path {
    /// The program run, in a relational table.
    pub run: Option<String>,
    /// The first name.
    pub name: String,
    /// What follows it.
    pub steps: Vec<Step>,
}

impl Path {
    /// A plain name.
    #[must_use]
    pub fn plain(name: impl Into<String>) -> Self {
        Self { run: None, name: name.into(), steps: Vec::new() }
    }

    /// Whether it is one name and nothing else.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.run.is_none() && self.steps.is_empty()
    }
}

/// One step into a variable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// `.member`, or `.3` for a bit.
    Member(String),
    /// `[i, j]`.
    Index(Vec<Expr>),
}

/// A literal with its text as it was written.
#[derive(Clone, Debug, Eq)]
pub struct Literal {
    /// Its value.
    pub value: LiteralValue,
    /// Its text.
    pub text: String,
}

/// Two literals are the same if their values are, however they were written.
impl PartialEq for Literal {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

/// The value of a literal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LiteralValue {
    /// `TRUE`, `FALSE`, `T`, `F`.
    Bool(bool),
    /// A whole number, and the type in front of it (`INT#3`), in upper case.
    Int(i128, Option<String>),
    /// A real number in its canonical digits, and the type in front of it.
    Real(String, Option<String>),
    /// A duration in nanoseconds; `true` for `LTIME`.
    Time(i128, bool),
    /// A string without its quotes; `true` for a wide one.
    Text(String, bool),
    /// A date or a time of day: the prefix in upper case, and what follows `#`.
    Date(String, String),
}

/// An operator before its operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnaryOp {
    /// `-`
    Minus,
    /// `+`
    Plus,
    /// `NOT`
    Not,
}

/// An operator between its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BinaryOp {
    /// `→`: the right one holds wherever the left one does.
    Implies,
    /// `OR`
    Or,
    /// `XOR`
    Xor,
    /// `AND`
    And,
    /// `=`
    Eq,
    /// `<>`
    Ne,
    /// `<`
    Lt,
    /// `<=`
    Le,
    /// `>`
    Gt,
    /// `>=`
    Ge,
    /// `+`
    Add,
    /// `-`
    Sub,
    /// `*`
    Mul,
    /// `/`
    Div,
    /// `MOD`
    Mod,
    /// `**`
    Power,
}

impl BinaryOp {
    /// How tightly it binds, by the table of IEC 61131-3; a higher number binds tighter.
    #[must_use]
    pub const fn precedence(self) -> u8 {
        match self {
            Self::Implies => 1,
            Self::Or => 2,
            Self::Xor => 3,
            Self::And => 4,
            Self::Eq | Self::Ne => 5,
            Self::Lt | Self::Le | Self::Gt | Self::Ge => 6,
            Self::Add | Self::Sub => 7,
            Self::Mul | Self::Div | Self::Mod => 8,
            Self::Power => 9,
        }
    }

    /// Whether it compares.
    #[must_use]
    pub const fn is_comparison(self) -> bool {
        matches!(self, Self::Eq | Self::Ne | Self::Lt | Self::Le | Self::Gt | Self::Ge)
    }
}

impl Expr {
    /// Whether the cell that consists of this expression is a condition: a comparison, or AND/OR of comparisons.
    #[must_use]
    pub fn is_condition(&self) -> bool {
        match &self.kind {
            ExprKind::Binary(op, ..) if op.is_comparison() => true,
            ExprKind::Binary(BinaryOp::And | BinaryOp::Or, left, right) => left.is_condition() && right.is_condition(),
            _ => false,
        }
    }

    /// Calls `visit` with this expression and everything below it, outermost first.
    pub fn walk<'e>(&'e self, visit: &mut dyn FnMut(&'e Expr)) {
        visit(self);
        match &self.kind {
            ExprKind::Own | ExprKind::Literal(_) | ExprKind::EnumValue { .. } => {}
            ExprKind::Name(path) | ExprKind::Past(path, _) => path.walk(visit),
            ExprKind::Unary(_, inner) => inner.walk(visit),
            ExprKind::Binary(_, left, right) => {
                left.walk(visit);
                right.walk(visit);
            }
            ExprKind::Call { args, .. } => args.iter().for_each(|arg| arg.value.walk(visit)),
            ExprKind::Guarded(arms) => arms.iter().for_each(|(guard, then)| {
                guard.walk(visit);
                then.walk(visit);
            }),
        }
    }
}

impl Path {
    fn walk<'e>(&'e self, visit: &mut dyn FnMut(&'e Expr)) {
        for step in &self.steps {
            if let Step::Index(indices) = step {
                indices.iter().for_each(|index| index.walk(visit));
            }
        }
    }
}

impl Chunk {
    /// Calls `visit` with every expression of this part, outermost first.
    pub fn walk<'e>(&'e self, visit: &mut dyn FnMut(&'e Expr)) {
        match &self.kind {
            ChunkKind::Any | ChunkKind::Predicate(_) => {}
            ChunkKind::Value(expr) | ChunkKind::Compare(_, expr) | ChunkKind::Condition(expr) => expr.walk(visit),
            ChunkKind::Interval(interval) => {
                interval.low.iter().chain(&interval.high).for_each(|end| end.walk(visit));
            }
            ChunkKind::Trigger(inner) => inner.walk(visit),
            ChunkKind::Guarded(arms) => arms.iter().for_each(|arm| {
                arm.guard.walk(visit);
                arm.then.walk(visit);
            }),
        }
    }

    /// Whether it is a trigger.
    #[must_use]
    pub const fn is_trigger(&self) -> bool {
        matches!(self.kind, ChunkKind::Trigger(_))
    }
}

impl Constraint {
    /// Calls `visit` with every expression of the cell, outermost first.
    pub fn walk<'e>(&'e self, visit: &mut dyn FnMut(&'e Expr)) {
        self.chunks.iter().for_each(|chunk| chunk.walk(visit));
    }

    /// Whether it admits everything as it stands.
    #[must_use]
    pub fn is_any(&self) -> bool {
        self.chunks.iter().all(|chunk| chunk.kind == ChunkKind::Any)
    }

    /// Whether a part of it is a trigger.
    #[must_use]
    pub fn has_trigger(&self) -> bool {
        self.chunks.iter().any(Chunk::is_trigger)
    }
}
