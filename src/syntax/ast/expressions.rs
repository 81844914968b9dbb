//! Expressions.

use super::{
    AstNode, EnumLiteral, Initializer, Literal, Name, RepeatInitializer, ast_nodes, child, children, is_expression,
    name_text, own_name,
};
use crate::syntax::kind::{NodeKind, TokenKind};
use crate::syntax::tree::{Node, Token};
use crate::text::Span;

ast_nodes! {
    /// A variable, function or value by its name.
    NameExpression = NameExpression;
    /// `a.b`.
    FieldExpression = FieldExpression;
    /// `a.3`, `a.%X3`.
    BitExpression = BitExpression;
    /// `a[i, j]`.
    IndexExpression = IndexExpression;
    /// `f(…)`.
    CallExpression = CallExpression;
    /// One argument of a call, or one field of a structure's initial value.
    Argument = Argument;
    /// `-a`, `NOT a`.
    UnaryExpression = UnaryExpression;
    /// `a + b`.
    BinaryExpression = BinaryExpression;
    /// `a := b` as an expression.
    AssignExpression = AssignExpression;
}

/// Any expression; initial values are expressions too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Expression<'t> {
    /// `a`.
    Name(NameExpression<'t>),
    /// `a.b`.
    Field(FieldExpression<'t>),
    /// `a.3`.
    Bit(BitExpression<'t>),
    /// `a[i]`.
    Index(IndexExpression<'t>),
    /// `a^`; the node is that of the whole expression.
    Deref(Node<'t>),
    /// `f(…)`.
    Call(CallExpression<'t>),
    /// `-a`.
    Unary(UnaryExpression<'t>),
    /// `a + b`.
    Binary(BinaryExpression<'t>),
    /// `(a)`; the node is that of the whole expression.
    Paren(Node<'t>),
    /// `a := b`.
    Assign(AssignExpression<'t>),
    /// A literal.
    Literal(Literal<'t>),
    /// `T#V`.
    EnumLiteral(EnumLiteral<'t>),
    /// `%IX0.0`; the token is the address.
    Address(Token<'t>, Node<'t>),
    /// `THIS`.
    This(Node<'t>),
    /// `SUPER`.
    Super(Node<'t>),
    /// `[1, 2]`.
    Array(Initializer<'t>),
    /// `(a := 1)`.
    Struct(Initializer<'t>),
    /// `3(0)`, in an array's initial value.
    Repeat(RepeatInitializer<'t>),
}

impl<'t> Expression<'t> {
    /// The expression that `node` is.
    #[must_use]
    pub fn cast(node: Node<'t>) -> Option<Self> {
        if !is_expression(node.kind()) {
            return None;
        }
        Some(match node.kind() {
            NodeKind::NameExpression => Self::Name(NameExpression(node)),
            NodeKind::FieldExpression => Self::Field(FieldExpression(node)),
            NodeKind::BitExpression => Self::Bit(BitExpression(node)),
            NodeKind::IndexExpression => Self::Index(IndexExpression(node)),
            NodeKind::DerefExpression => Self::Deref(node),
            NodeKind::CallExpression => Self::Call(CallExpression(node)),
            NodeKind::UnaryExpression => Self::Unary(UnaryExpression(node)),
            NodeKind::BinaryExpression => Self::Binary(BinaryExpression(node)),
            NodeKind::ParenExpression => Self::Paren(node),
            NodeKind::AssignExpression => Self::Assign(AssignExpression(node)),
            NodeKind::Literal => Self::Literal(Literal::cast(node)?),
            NodeKind::EnumLiteral => Self::EnumLiteral(EnumLiteral::cast(node)?),
            NodeKind::AddressExpression => Self::Address(node.own_token(TokenKind::Address)?, node),
            NodeKind::ThisExpression => Self::This(node),
            NodeKind::SuperExpression => Self::Super(node),
            NodeKind::ArrayInitializer => Self::Array(Initializer::cast(node)?),
            NodeKind::StructInitializer => Self::Struct(Initializer::cast(node)?),
            NodeKind::RepeatInitializer => Self::Repeat(RepeatInitializer::cast(node)?),
            _ => return None,
        })
    }

    /// Its node.
    #[must_use]
    pub fn node(self) -> Node<'t> {
        match self {
            Self::Name(it) => it.0,
            Self::Field(it) => it.0,
            Self::Bit(it) => it.0,
            Self::Index(it) => it.0,
            Self::Call(it) => it.0,
            Self::Unary(it) => it.0,
            Self::Binary(it) => it.0,
            Self::Assign(it) => it.0,
            Self::Literal(it) => it.node(),
            Self::EnumLiteral(it) => it.node(),
            Self::Array(it) | Self::Struct(it) => it.node(),
            Self::Repeat(it) => it.node(),
            Self::Deref(node) | Self::Paren(node) | Self::Address(_, node) | Self::This(node) | Self::Super(node) => {
                node
            }
        }
    }

    /// Its span.
    #[must_use]
    pub fn span(self) -> Span {
        self.node().span()
    }

    /// What stands in `(a)` or before `^`.
    #[must_use]
    pub fn inner(self) -> Option<Self> {
        match self {
            Self::Paren(node) | Self::Deref(node) => operand(node, 0),
            _ => None,
        }
    }

    /// Without the parentheses around it.
    #[must_use]
    pub fn unwrapped(self) -> Self {
        let mut expression = self;
        while let Self::Paren(node) = expression
            && let Some(inner) = operand(node, 0)
        {
            expression = inner;
        }
        expression
    }
}

/// The `n`th expression among the children of `node`.
pub(super) fn operand<'t>(node: Node<'t>, n: usize) -> Option<Expression<'t>> {
    node.children().filter_map(Expression::cast).nth(n)
}

/// The first own token of `node` that is no bracket.
fn operator(node: Node<'_>) -> Option<Token<'_>> {
    node.own_tokens().next()
}

impl<'t> NameExpression<'t> {
    /// The name without `#` and quotes.
    #[must_use]
    pub fn text(self) -> &'t str {
        own_name(self.0).map_or("", name_text)
    }

    /// Whether `:P` stands behind it: the module itself, not the process image (Siemens).
    #[must_use]
    pub fn is_peripheral(self) -> bool {
        self.0.has_token(TokenKind::Colon)
    }

    /// Whether `#` stands before it: a local variable (Siemens).
    #[must_use]
    pub fn is_local(self) -> bool {
        self.0.has_token(TokenKind::Hash)
    }

    /// Whether `.` stands before it: a global variable (CODESYS V2.3).
    #[must_use]
    pub fn is_global(self) -> bool {
        self.0.has_token(TokenKind::Dot)
    }
}

impl<'t> FieldExpression<'t> {
    /// What stands before the dot.
    #[must_use]
    pub fn base(self) -> Option<Expression<'t>> {
        operand(self.0, 0)
    }

    /// The field's name; empty where it is missing.
    #[must_use]
    pub fn field(self) -> &'t str {
        own_name(self.0).map_or("", name_text)
    }

    /// Where the field's name stands.
    #[must_use]
    pub fn field_span(self) -> Span {
        own_name(self.0).map_or(Span::at(self.0.span().end), Token::span)
    }
}

impl<'t> BitExpression<'t> {
    /// What stands before the dot.
    #[must_use]
    pub fn base(self) -> Option<Expression<'t>> {
        operand(self.0, 0)
    }

    /// What stands behind the dot: `3`, `%X3`, `%B1`.
    #[must_use]
    pub fn selector(self) -> Option<Token<'t>> {
        self.0.own_tokens().find(|token| token.kind() != TokenKind::Dot)
    }
}

impl<'t> IndexExpression<'t> {
    /// What stands before the bracket.
    #[must_use]
    pub fn base(self) -> Option<Expression<'t>> {
        operand(self.0, 0)
    }

    /// The indices.
    pub fn indices(self) -> impl Iterator<Item = Expression<'t>> {
        self.0.children().filter_map(Expression::cast).skip(1)
    }
}

impl<'t> CallExpression<'t> {
    /// What is called.
    #[must_use]
    pub fn callee(self) -> Option<Expression<'t>> {
        operand(self.0, 0)
    }

    /// The arguments.
    pub fn arguments(self) -> impl Iterator<Item = Argument<'t>> {
        self.0.children().filter(|child| child.kind() == NodeKind::ArgumentList).flat_map(children)
    }
}

/// How an argument is passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ArgumentKind {
    /// By its position.
    Positional,
    /// `a := x`.
    Input,
    /// `a => x`.
    Output,
    /// `NOT a => x`.
    NegatedOutput,
}

impl<'t> Argument<'t> {
    /// How it is passed.
    #[must_use]
    pub fn kind(self) -> ArgumentKind {
        if self.0.has_token(TokenKind::Arrow) {
            return if self.0.has_token(TokenKind::Not) { ArgumentKind::NegatedOutput } else { ArgumentKind::Output };
        }
        if self.0.has_token(TokenKind::Assign) { ArgumentKind::Input } else { ArgumentKind::Positional }
    }

    /// The parameter's name.
    #[must_use]
    pub fn name(self) -> Option<Name<'t>> {
        child(self.0)
    }

    /// The value, or the variable that takes the output; it may be left out.
    #[must_use]
    pub fn value(self) -> Option<Expression<'t>> {
        operand(self.0, 0)
    }
}

/// An operator with one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum UnaryOperator {
    /// `-`.
    Negate,
    /// `+`.
    Plus,
    /// `NOT`.
    Not,
    /// `&`, the address of something (in some dialects).
    Address,
}

impl<'t> UnaryExpression<'t> {
    /// The operator.
    #[must_use]
    pub fn operator(self) -> Option<UnaryOperator> {
        Some(match operator(self.0)?.kind() {
            TokenKind::Minus => UnaryOperator::Negate,
            TokenKind::Plus => UnaryOperator::Plus,
            TokenKind::Not => UnaryOperator::Not,
            TokenKind::Ampersand => UnaryOperator::Address,
            _ => return None,
        })
    }

    /// The operand.
    #[must_use]
    pub fn operand(self) -> Option<Expression<'t>> {
        operand(self.0, 0)
    }
}

/// An operator with two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum BinaryOperator {
    /// `OR`.
    Or,
    /// `OR_ELSE`: the right side is evaluated only if the left one is false.
    OrElse,
    /// `XOR`.
    Xor,
    /// `AND` or `&`.
    And,
    /// `AND_THEN`: the right side is evaluated only if the left one is true.
    AndThen,
    /// `=`.
    Equal,
    /// `<>`.
    NotEqual,
    /// `<`.
    Less,
    /// `<=`.
    LessEqual,
    /// `>`.
    Greater,
    /// `>=`.
    GreaterEqual,
    /// `+`.
    Add,
    /// `-`.
    Subtract,
    /// `*`.
    Multiply,
    /// `/`.
    Divide,
    /// `MOD`.
    Modulo,
    /// `**`.
    Power,
}

impl<'t> BinaryExpression<'t> {
    /// The operator.
    #[must_use]
    pub fn operator(self) -> Option<BinaryOperator> {
        Some(match self.operator_token()?.kind() {
            TokenKind::Or => BinaryOperator::Or,
            TokenKind::OrElse => BinaryOperator::OrElse,
            TokenKind::Xor => BinaryOperator::Xor,
            TokenKind::And | TokenKind::Ampersand => BinaryOperator::And,
            TokenKind::AndThen => BinaryOperator::AndThen,
            TokenKind::Equal => BinaryOperator::Equal,
            TokenKind::NotEqual => BinaryOperator::NotEqual,
            TokenKind::Less => BinaryOperator::Less,
            TokenKind::LessEqual => BinaryOperator::LessEqual,
            TokenKind::Greater => BinaryOperator::Greater,
            TokenKind::GreaterEqual => BinaryOperator::GreaterEqual,
            TokenKind::Plus => BinaryOperator::Add,
            TokenKind::Minus => BinaryOperator::Subtract,
            TokenKind::Star => BinaryOperator::Multiply,
            TokenKind::Slash => BinaryOperator::Divide,
            TokenKind::Mod => BinaryOperator::Modulo,
            TokenKind::Power => BinaryOperator::Power,
            _ => return None,
        })
    }

    /// The operator as it stands in the text.
    #[must_use]
    pub fn operator_token(self) -> Option<Token<'t>> {
        operator(self.0)
    }

    /// The left side.
    #[must_use]
    pub fn left(self) -> Option<Expression<'t>> {
        operand(self.0, 0)
    }

    /// The right side.
    #[must_use]
    pub fn right(self) -> Option<Expression<'t>> {
        operand(self.0, 1)
    }
}

impl<'t> AssignExpression<'t> {
    /// What is assigned to.
    #[must_use]
    pub fn target(self) -> Option<Expression<'t>> {
        operand(self.0, 0)
    }

    /// The operator.
    #[must_use]
    pub fn operator(self) -> Option<super::AssignOperator> {
        super::AssignOperator::of(self.0)
    }

    /// What is assigned.
    #[must_use]
    pub fn value(self) -> Option<Expression<'t>> {
        operand(self.0, 1)
    }
}
