//! Members that are no POUs: properties and their accessors, transitions, actions apart from their POU.

use super::declarations::{header_span, header_type, modifiers};
use super::{Body, Expression, Modifier, Name, Pou, Type, VarSection, ast_nodes, child, children, pragmas_before};
use crate::syntax::kind::{NodeKind, TokenKind};
use crate::syntax::tree::Token;
use crate::text::Span;

ast_nodes! {
    /// A property.
    Property = Property;
    /// The `GET` or `SET` of a property.
    Accessor = Accessor;
    /// `ACTIONS pou … END_ACTIONS`.
    Actions = Actions;
    /// A transition: of a chart, or one that is declared by its name.
    Transition = Transition;
}

impl<'t> Property<'t> {
    /// Its name.
    #[must_use]
    pub fn name(self) -> Option<Name<'t>> {
        child(self.0)
    }

    /// The words before its name.
    pub fn modifiers(self) -> impl Iterator<Item = Modifier> {
        modifiers(self.0)
    }

    /// Its type.
    #[must_use]
    pub fn type_(self) -> Option<Type<'t>> {
        header_type(self.0)
    }

    /// From its first word to the end of its type.
    #[must_use]
    pub fn header_span(self) -> Span {
        header_span(self.0)
    }

    /// Its accessors.
    pub fn accessors(self) -> impl Iterator<Item = Accessor<'t>> {
        children(self.0)
    }

    /// Whether it is a `PROPERTY_GET` or a `PROPERTY_SET`, whose body stands in itself.
    #[must_use]
    pub fn is_accessor(self) -> bool {
        self.0.has_token(TokenKind::PropertyGet) || self.0.has_token(TokenKind::PropertySet)
    }

    /// Whether it can be read, as far as its text says.
    #[must_use]
    pub fn has_get(self) -> bool {
        self.0.has_token(TokenKind::PropertyGet) || self.accessors().any(Accessor::is_get)
    }

    /// Whether it can be written, as far as its text says.
    #[must_use]
    pub fn has_set(self) -> bool {
        self.0.has_token(TokenKind::PropertySet) || self.accessors().any(|accessor| !accessor.is_get())
    }

    /// Its own sections of variables.
    pub fn var_sections(self) -> impl Iterator<Item = VarSection<'t>> {
        children(self.0)
    }

    /// Its own body.
    #[must_use]
    pub fn body(self) -> Option<Body<'t>> {
        child(self.0)
    }

    /// The pragmas right before it.
    #[must_use]
    pub fn pragmas(self) -> Vec<Token<'t>> {
        pragmas_before(self.0)
    }
}

impl<'t> Accessor<'t> {
    /// Whether it is the `GET`.
    #[must_use]
    pub fn is_get(self) -> bool {
        self.0.has_token(TokenKind::Get)
    }

    /// The words behind it.
    pub fn modifiers(self) -> impl Iterator<Item = Modifier> {
        modifiers(self.0)
    }

    /// Its sections of variables.
    pub fn var_sections(self) -> impl Iterator<Item = VarSection<'t>> {
        children(self.0)
    }

    /// Its body.
    #[must_use]
    pub fn body(self) -> Option<Body<'t>> {
        child(self.0)
    }
}

impl<'t> Actions<'t> {
    /// The name of the POU that they belong to; without one, it is the POU before.
    #[must_use]
    pub fn pou(self) -> Option<Name<'t>> {
        child(self.0)
    }

    /// The actions.
    pub fn actions(self) -> impl Iterator<Item = Pou<'t>> {
        children(self.0)
    }
}

impl<'t> Transition<'t> {
    /// Its name, which a chart's transition seldom has.
    #[must_use]
    pub fn name(self) -> Option<Name<'t>> {
        child(self.0)
    }

    /// The steps that it comes from.
    pub fn from(self) -> impl Iterator<Item = Name<'t>> {
        self.steps(0)
    }

    /// The steps that it goes to.
    pub fn to(self) -> impl Iterator<Item = Name<'t>> {
        self.steps(1)
    }

    fn steps(self, n: usize) -> impl Iterator<Item = Name<'t>> {
        let lists = self.0.children().filter(|child| child.kind() == NodeKind::StepNames);
        lists.skip(n).take(1).flat_map(children)
    }

    /// Its priority.
    #[must_use]
    pub fn priority(self) -> Option<Expression<'t>> {
        let list = self.0.child(NodeKind::ArgumentList)?;
        let argument = list.child(NodeKind::Argument)?;
        argument.children().find_map(Expression::cast)
    }

    /// Its condition, where it is an expression.
    #[must_use]
    pub fn condition(self) -> Option<Expression<'t>> {
        self.0.children().find_map(Expression::cast)
    }

    /// Its condition, where it is a body.
    #[must_use]
    pub fn body(self) -> Option<Body<'t>> {
        child(self.0)
    }
}
