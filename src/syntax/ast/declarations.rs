//! Files, POUs, namespaces, blocks of types.

use super::{
    Actions, AstNode, Body, Configuration, Name, Path, Property, Resource, Transition, Type, VarDecl, VarSection,
    ast_nodes, child, children, pragmas_before,
};
use crate::syntax::ast::Expression;
use crate::syntax::kind::{NodeKind, TokenKind};
use crate::syntax::tree::{Node, Token, Tree};
use crate::text::Span;

ast_nodes! {
    /// A whole text.
    SourceFile = SourceFile;
    /// A program organisation unit, or a member that has a header, variables and a body like one.
    Pou = FunctionBlock | Function | Program | Class | Interface | OrganizationBlock | DataBlock | Method | Action;
    /// `NAMESPACE … END_NAMESPACE`.
    Namespace = Namespace;
    /// `USING a, b.c;`.
    Using = Using;
    /// `TYPE … END_TYPE`.
    TypeBlock = TypeBlock;
    /// One type in it.
    TypeDecl = TypeDecl;
}

/// Anything that stands in a file or in a namespace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Declaration<'t> {
    /// A POU, or a member of one that stands alone (as XML containers keep them).
    Pou(Pou<'t>),
    /// A property that stands alone.
    Property(Property<'t>),
    /// Actions of a POU, apart from it.
    Actions(Actions<'t>),
    /// A transition that stands alone.
    Transition(Transition<'t>),
    /// A block of types.
    Types(TypeBlock<'t>),
    /// A section of variables that stands bare: global variables, or those of a `.var` file.
    Variables(VarSection<'t>),
    /// A namespace.
    Namespace(Namespace<'t>),
    /// `USING`.
    Using(Using<'t>),
    /// A configuration.
    Configuration(Configuration<'t>),
    /// A resource that stands alone.
    Resource(Resource<'t>),
    /// Statements that stand bare.
    Body(Body<'t>),
}

impl<'t> Declaration<'t> {
    /// The declaration that `node` is.
    #[must_use]
    pub fn cast(node: Node<'t>) -> Option<Self> {
        Some(match node.kind() {
            NodeKind::Property => Self::Property(Property::cast(node)?),
            NodeKind::Actions => Self::Actions(Actions::cast(node)?),
            NodeKind::Transition => Self::Transition(Transition::cast(node)?),
            NodeKind::TypeBlock => Self::Types(TypeBlock(node)),
            NodeKind::VarSection => Self::Variables(VarSection::cast(node)?),
            NodeKind::Namespace => Self::Namespace(Namespace(node)),
            NodeKind::Using => Self::Using(Using(node)),
            NodeKind::Configuration => Self::Configuration(Configuration::cast(node)?),
            NodeKind::Resource => Self::Resource(Resource::cast(node)?),
            NodeKind::Body => Self::Body(Body::cast(node)?),
            _ => Self::Pou(Pou::cast(node)?),
        })
    }

    /// Its node.
    #[must_use]
    pub fn node(self) -> Node<'t> {
        match self {
            Self::Pou(it) => it.node(),
            Self::Property(it) => it.node(),
            Self::Actions(it) => it.node(),
            Self::Transition(it) => it.node(),
            Self::Types(it) => it.node(),
            Self::Variables(it) => it.node(),
            Self::Namespace(it) => it.node(),
            Self::Using(it) => it.node(),
            Self::Configuration(it) => it.node(),
            Self::Resource(it) => it.node(),
            Self::Body(it) => it.node(),
        }
    }
}

impl<'t> SourceFile<'t> {
    /// The file that `tree` is.
    #[must_use]
    pub const fn of(tree: &'t Tree) -> Self {
        Self(tree.root())
    }

    /// What stands in it, in order.
    pub fn declarations(self) -> impl Iterator<Item = Declaration<'t>> {
        self.0.children().filter_map(Declaration::cast)
    }

    /// Its body, where it was parsed as one, or where statements stand bare.
    #[must_use]
    pub fn body(self) -> Option<Body<'t>> {
        child(self.0)
    }

    /// Its expression, where it was parsed as one.
    #[must_use]
    pub fn expression(self) -> Option<Expression<'t>> {
        self.0.children().find_map(Expression::cast)
    }
}

/// What a [`Pou`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PouKind {
    /// `FUNCTION_BLOCK`.
    FunctionBlock,
    /// `FUNCTION`.
    Function,
    /// `PROGRAM`.
    Program,
    /// `CLASS`.
    Class,
    /// `INTERFACE`.
    Interface,
    /// `ORGANIZATION_BLOCK`.
    OrganizationBlock,
    /// `DATA_BLOCK`.
    DataBlock,
    /// `METHOD`.
    Method,
    /// `ACTION`.
    Action,
}

/// A word before a name: who may use it, and how it may be inherited.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Modifier {
    /// `PUBLIC`.
    Public,
    /// `PRIVATE`.
    Private,
    /// `PROTECTED`.
    Protected,
    /// `INTERNAL`.
    Internal,
    /// `ABSTRACT`.
    Abstract,
    /// `FINAL`.
    Final,
    /// `OVERRIDE`.
    Override,
}

impl Modifier {
    /// The modifier that `kind` is.
    #[must_use]
    pub const fn of(kind: TokenKind) -> Option<Self> {
        Some(match kind {
            TokenKind::Public => Self::Public,
            TokenKind::Private => Self::Private,
            TokenKind::Protected => Self::Protected,
            TokenKind::Internal => Self::Internal,
            TokenKind::Abstract => Self::Abstract,
            TokenKind::Final => Self::Final,
            TokenKind::Override => Self::Override,
            _ => return None,
        })
    }
}

pub(super) fn modifiers<'t>(node: Node<'t>) -> impl Iterator<Item = Modifier> + use<'t> {
    node.own_tokens().filter_map(|token| Modifier::of(token.kind()))
}

/// The paths in the clause of `kind`.
fn clause<'t>(node: Node<'t>, kind: NodeKind) -> impl Iterator<Item = Path<'t>> + use<'t> {
    node.children().filter(move |child| child.kind() == kind).flat_map(children)
}

/// The type of a header, which stands before any section.
pub(super) fn header_type<'t>(node: Node<'t>) -> Option<Type<'t>> {
    node.children().find_map(Type::cast)
}

/// The end of a header: where its first section, member or body begins, or the closing keyword.
pub(super) fn header_span(node: Node<'_>) -> Span {
    let is_part = |kind: NodeKind| {
        matches!(kind, NodeKind::Name | NodeKind::ExtendsClause | NodeKind::ImplementsClause) || Type::is(kind)
    };
    let last = node.children().take_while(|child| is_part(child.kind())).last();
    let start = node.span().start;
    Span::new(start, last.map_or(node.span().end, |last| last.span().end))
}

impl<'t> Pou<'t> {
    /// What it is.
    #[must_use]
    pub fn kind(self) -> PouKind {
        match self.0.kind() {
            NodeKind::Function => PouKind::Function,
            NodeKind::Program => PouKind::Program,
            NodeKind::Class => PouKind::Class,
            NodeKind::Interface => PouKind::Interface,
            NodeKind::OrganizationBlock => PouKind::OrganizationBlock,
            NodeKind::DataBlock => PouKind::DataBlock,
            NodeKind::Method => PouKind::Method,
            NodeKind::Action => PouKind::Action,
            _ => PouKind::FunctionBlock,
        }
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> Option<Name<'t>> {
        child(self.0)
    }

    /// The words before its name.
    pub fn modifiers(self) -> impl Iterator<Item = Modifier> {
        modifiers(self.0)
    }

    /// What it extends.
    pub fn extends(self) -> impl Iterator<Item = Path<'t>> {
        clause(self.0, NodeKind::ExtendsClause)
    }

    /// What it implements.
    pub fn implements(self) -> impl Iterator<Item = Path<'t>> {
        clause(self.0, NodeKind::ImplementsClause)
    }

    /// The type of its result.
    #[must_use]
    pub fn return_type(self) -> Option<Type<'t>> {
        match self.0.kind() {
            NodeKind::DataBlock => None,
            _ => header_type(self.0),
        }
    }

    /// The structure or the type of a data block.
    #[must_use]
    pub fn data_block_type(self) -> Option<DataBlockType<'t>> {
        let found = (self.0.kind() == NodeKind::DataBlock).then(|| header_type(self.0)).flatten()?;
        Some(DataBlockType(found))
    }

    /// From the first word to the end of the name, the clauses and the result's type.
    #[must_use]
    pub fn header_span(self) -> Span {
        header_span(self.0)
    }

    /// Its sections of variables.
    pub fn var_sections(self) -> impl Iterator<Item = VarSection<'t>> {
        children(self.0)
    }

    /// Its body; where members interrupt it, its first part.
    #[must_use]
    pub fn body(self) -> Option<Body<'t>> {
        child(self.0)
    }

    /// All parts of its body.
    pub fn bodies(self) -> impl Iterator<Item = Body<'t>> {
        children(self.0)
    }

    /// Its methods.
    pub fn methods(self) -> impl Iterator<Item = Pou<'t>> {
        children::<Pou<'t>>(self.0).filter(|pou| pou.kind() == PouKind::Method)
    }

    /// Its actions, those among the steps of its body too.
    pub fn actions(self) -> impl Iterator<Item = Pou<'t>> {
        let inner = self.bodies().flat_map(|body| children::<Pou<'t>>(body.node()));
        children::<Pou<'t>>(self.0).chain(inner).filter(|pou| pou.kind() == PouKind::Action)
    }

    /// Its properties.
    pub fn properties(self) -> impl Iterator<Item = Property<'t>> {
        children(self.0)
    }

    /// Its transitions that are declared by their names.
    pub fn transitions(self) -> impl Iterator<Item = Transition<'t>> {
        children(self.0)
    }

    /// The pragmas right before it.
    #[must_use]
    pub fn pragmas(self) -> Vec<Token<'t>> {
        pragmas_before(self.0)
    }
}

/// What a data block holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DataBlockType<'t>(pub Type<'t>);

impl<'t> Namespace<'t> {
    /// Its name, which may have dots.
    #[must_use]
    pub fn path(self) -> Option<Path<'t>> {
        child(self.0)
    }

    /// The words before its name.
    pub fn modifiers(self) -> impl Iterator<Item = Modifier> {
        modifiers(self.0)
    }

    /// What stands in it, in order.
    pub fn declarations(self) -> impl Iterator<Item = Declaration<'t>> {
        self.0.children().filter_map(Declaration::cast)
    }
}

impl<'t> Using<'t> {
    /// The namespaces.
    pub fn paths(self) -> impl Iterator<Item = Path<'t>> {
        children(self.0)
    }
}

impl<'t> TypeBlock<'t> {
    /// The types.
    pub fn types(self) -> impl Iterator<Item = TypeDecl<'t>> {
        children(self.0)
    }

    /// The pragmas right before the block.
    #[must_use]
    pub fn pragmas(self) -> Vec<Token<'t>> {
        pragmas_before(self.0)
    }
}

impl<'t> TypeDecl<'t> {
    /// Its name.
    #[must_use]
    pub fn name(self) -> Option<Name<'t>> {
        child(self.0)
    }

    /// The words before its name.
    pub fn modifiers(self) -> impl Iterator<Item = Modifier> {
        modifiers(self.0)
    }

    /// The structure that it extends.
    pub fn extends(self) -> impl Iterator<Item = Path<'t>> {
        clause(self.0, NodeKind::ExtendsClause)
    }

    /// What it is.
    #[must_use]
    pub fn type_(self) -> Option<Type<'t>> {
        self.0.children().find_map(Type::cast)
    }

    /// The initial value of its variables.
    #[must_use]
    pub fn initial(self) -> Option<Expression<'t>> {
        self.0.children().find_map(Expression::cast)
    }

    /// The pragmas right before it.
    #[must_use]
    pub fn pragmas(self) -> Vec<Token<'t>> {
        pragmas_before(self.0)
    }
}

/// For a lone declaration in a container: its variables, wherever they stand.
impl<'t> SourceFile<'t> {
    /// All variables of bare sections.
    pub fn variables(self) -> impl Iterator<Item = VarDecl<'t>> {
        children::<VarSection<'t>>(self.0).flat_map(VarSection::variables)
    }
}
