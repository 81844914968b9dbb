//! Nodes with types: thin handles that know what is in them.
//!
//! A handle is a [`Node`] whose kind was checked; it is `Copy` and holds nothing else. Every accessor may find
//! nothing, because any part of a construct may be missing in the text.

mod body;
mod configurations;
mod declarations;
mod expressions;
mod members;
mod statements;
mod types;
mod values;
mod variables;

pub use body::{ActionAssociation, Body, BodyItem, Instruction, InstructionList, Step};
pub use configurations::{Configuration, ProgramConfiguration, Resource, Task};
pub use declarations::{
    DataBlockType, Declaration, Modifier, Namespace, Pou, PouKind, SourceFile, TypeBlock, TypeDecl, Using,
};
pub use expressions::{
    Argument, ArgumentKind, AssignExpression, BinaryExpression, BinaryOperator, BitExpression, CallExpression,
    Expression, FieldExpression, IndexExpression, NameExpression, UnaryExpression, UnaryOperator,
};
pub use members::{Accessor, Actions, Property, Transition};
pub use statements::{
    AssignOperator, AssignStatement, CaseBranch, CaseStatement, CatchClause, ForStatement, IfBranch, IfStatement,
    LoopStatement, Statement, StatementList, TryStatement,
};
pub use types::{ArrayType, Dimension, EnumType, EnumValue, NamedType, StringType, StructType, SubrangeType, Type};
pub use values::{EnumLiteral, Initializer, Literal, Range, RepeatInitializer};
pub use variables::{Qualifier, SectionKind, VarDecl, VarSection};

use super::kind::{NodeKind, TokenKind};
use super::tree::{Node, Token};
use crate::text::Span;

/// A handle on a node of a known kind.
pub trait AstNode<'t>: Copy {
    /// The handle, if `node` is of its kind.
    fn cast(node: Node<'t>) -> Option<Self>;

    /// The node.
    fn node(self) -> Node<'t>;

    /// The node's span.
    fn span(self) -> Span {
        self.node().span()
    }
}

/// The children of `node` that are an `N`.
fn children<'t, N: AstNode<'t>>(node: Node<'t>) -> impl Iterator<Item = N> + use<'t, N> {
    node.children().filter_map(N::cast)
}

/// The first child of `node` that is an `N`.
fn child<'t, N: AstNode<'t>>(node: Node<'t>) -> Option<N> {
    node.children().find_map(N::cast)
}

/// Declares handles, each for the kinds of node that follow its name.
macro_rules! ast_nodes {
    ($($(#[doc = $doc:literal])+ $name:ident = $($kind:ident)|+;)*) => {
        $(
            $(#[doc = $doc])+
            #[derive(Clone, Copy, Debug, PartialEq, Eq)]
            pub struct $name<'t>($crate::syntax::tree::Node<'t>);

            impl<'t> $crate::syntax::ast::AstNode<'t> for $name<'t> {
                fn cast(node: $crate::syntax::tree::Node<'t>) -> Option<Self> {
                    matches!(node.kind(), $($crate::syntax::kind::NodeKind::$kind)|+).then_some(Self(node))
                }

                fn node(self) -> $crate::syntax::tree::Node<'t> {
                    self.0
                }
            }
        )*
    };
}
use ast_nodes;

ast_nodes! {
    /// A name where it is declared, or the name of an argument.
    Name = Name;
    /// A name with dots, as the name of a type, an interface or a namespace.
    Path = Path;
}

impl<'t> Name<'t> {
    /// The name as written, without quotes and `#`; for a name with dots (in `VAR_CONFIG`), all of it.
    #[must_use]
    pub fn text(self) -> &'t str {
        let mut tokens = self.0.own_tokens().filter(|token| token.kind() != TokenKind::Hash);
        match (tokens.next(), tokens.next()) {
            (Some(only), None) => name_text(only),
            _ => self.0.text(),
        }
    }
}

impl<'t> Path<'t> {
    /// Its parts, each without quotes.
    pub fn segments(self) -> impl Iterator<Item = Segment<'t>> {
        let names = self.0.own_tokens().filter(|token| !matches!(token.kind(), TokenKind::Dot | TokenKind::Hash));
        names.map(|token| Segment { text: name_text(token), span: token.span() })
    }

    /// Its last part.
    #[must_use]
    pub fn last(self) -> Option<Segment<'t>> {
        self.segments().last()
    }

    /// The parts with dots between them, and no blanks.
    #[must_use]
    pub fn text(self) -> String {
        let parts: Vec<&str> = self.segments().map(|segment| segment.text).collect();
        parts.join(".")
    }
}

/// One part of a [`Path`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Segment<'t> {
    /// As written, without quotes.
    pub text: &'t str,
    /// Where.
    pub span: Span,
}

/// The text of a name's token, without quotes.
#[must_use]
pub fn name_text(token: Token<'_>) -> &str {
    let text = token.text();
    match token.kind() {
        TokenKind::QuotedName => text.trim_matches('"'),
        _ => text,
    }
}

/// The first name among the own tokens of `node`.
fn own_name(node: Node<'_>) -> Option<Token<'_>> {
    node.own_tokens().find(|token| matches!(token.kind(), TokenKind::Ident | TokenKind::QuotedName))
}

/// The pragmas right before `node`, in the order of the text, comments and blanks between them skipped.
///
/// A pragma behind the end of something else on its line belongs to that and is not given here.
#[must_use]
pub fn pragmas_before(node: Node<'_>) -> Vec<Token<'_>> {
    let first = node.first_token();
    let start = node.tree().trivia_before(first).last().map_or(first, Token::index);
    let run = || node.tree().trivia_after(start).take_while(|token| token.index() < first);
    let before = start.checked_sub(1).and_then(|index| node.tree().token(index)).map(Token::kind);
    let ends = |kind: TokenKind| kind == TokenKind::Semicolon || kind == TokenKind::Comma || kind.is_end();
    let mut mine = !before.is_some_and(ends) || !run().any(|token| token.kind() == TokenKind::Newline);
    let mut pragmas = Vec::new();
    for token in run() {
        mine |= token.kind() == TokenKind::Newline;
        if mine && token.kind() == TokenKind::Pragma {
            pragmas.push(token);
        }
    }
    pragmas
}

/// What is inside the braces of a pragma: `attribute 'hide'`.
#[must_use]
pub fn pragma_text<'t>(pragma: Token<'t>) -> &'t str {
    let text = pragma.text();
    text.strip_prefix('{').unwrap_or(text).trim_end_matches('}').trim()
}

/// Whether `kind` is that of an expression or of an initial value.
const fn is_expression(kind: NodeKind) -> bool {
    (kind as u8) >= NodeKind::NameExpression as u8
        && (kind as u8) <= NodeKind::RepeatInitializer as u8
        && !matches!(kind, NodeKind::ArgumentList | NodeKind::Argument)
}
