//! Literals, ranges and initial values.

use super::expressions::operand;
use super::{Argument, Expression, ast_nodes, children, name_text, own_name};
use crate::syntax::kind::TokenKind;
use crate::syntax::tree::Token;
use crate::text::Span;

ast_nodes! {
    /// `1`, `INT#1`, `TRUE`, `'text'`, `T#1s`.
    Literal = Literal;
    /// `T#V`.
    EnumLiteral = EnumLiteral;
    /// `a..b`.
    Range = Range;
    /// `[…]` or `(a := …)`.
    Initializer = ArrayInitializer | StructInitializer;
    /// `3(0)`.
    RepeatInitializer = RepeatInitializer;
}

impl<'t> Literal<'t> {
    /// The type before `#`, where it is no literal of time: `INT` in `INT#5`.
    #[must_use]
    pub fn type_prefix(self) -> Option<&'t str> {
        self.0.own_token(TokenKind::TypePrefix).map(|token| token.text().trim_end_matches('#'))
    }

    /// Whether a minus stands behind the type: `INT#-5`.
    #[must_use]
    pub fn is_negative(self) -> bool {
        self.0.has_token(TokenKind::Minus)
    }

    /// The token of the value; its kind says what sort of literal it is.
    #[must_use]
    pub fn value(self) -> Option<Token<'t>> {
        self.0.own_tokens().last()
    }
}

impl<'t> EnumLiteral<'t> {
    /// The enumeration's name, without a namespace.
    #[must_use]
    pub fn type_name(self) -> &'t str {
        self.0.own_token(TokenKind::TypePrefix).map_or("", |token| token.text().trim_end_matches('#'))
    }

    /// The namespace before it.
    #[must_use]
    pub fn qualifier(self) -> Option<Expression<'t>> {
        operand(self.0, 0)
    }

    /// The value's name.
    #[must_use]
    pub fn value(self) -> &'t str {
        own_name(self.0).map_or("", name_text)
    }

    /// Where the value's name stands.
    #[must_use]
    pub fn value_span(self) -> Span {
        own_name(self.0).map_or(Span::at(self.0.span().end), Token::span)
    }
}

impl<'t> Range<'t> {
    /// The lower end.
    #[must_use]
    pub fn low(self) -> Option<Expression<'t>> {
        operand(self.0, 0)
    }

    /// The upper end.
    #[must_use]
    pub fn high(self) -> Option<Expression<'t>> {
        operand(self.0, 1)
    }
}

impl<'t> Initializer<'t> {
    /// The elements of an array's initial value; values of a structure's that have no name.
    pub fn elements(self) -> impl Iterator<Item = Expression<'t>> {
        self.0.children().filter_map(Expression::cast)
    }

    /// The fields of a structure's initial value.
    pub fn fields(self) -> impl Iterator<Item = Argument<'t>> {
        children(self.0)
    }
}

impl<'t> RepeatInitializer<'t> {
    /// How often.
    #[must_use]
    pub fn count(self) -> Option<Expression<'t>> {
        operand(self.0, 0)
    }

    /// What is repeated; nothing for `3()`.
    pub fn values(self) -> impl Iterator<Item = Expression<'t>> {
        self.0.children().filter_map(Expression::cast).skip(1)
    }
}
