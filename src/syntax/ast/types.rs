//! Types.

use super::{Argument, AstNode, Expression, Name, Path, Range, VarDecl, ast_nodes, child, children, pragmas_before};
use crate::syntax::kind::{NodeKind, TokenKind};
use crate::syntax::tree::{Node, Token};

ast_nodes! {
    /// A type by its name; elementary types as well.
    NamedType = NamedType;
    /// `ARRAY[…] OF …`.
    ArrayType = ArrayType;
    /// `STRING`, `STRING[80]`, `WSTRING(N)`.
    StringType = StringType;
    /// `INT(0..10)`.
    SubrangeType = SubrangeType;
    /// `(A, B := 2) UINT`.
    EnumType = EnumType;
    /// One value of it.
    EnumValue = EnumValue;
    /// `STRUCT … END_STRUCT` or `UNION … END_UNION`.
    StructType = StructType | UnionType;
}

/// Any type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Type<'t> {
    /// By its name.
    Named(NamedType<'t>),
    /// An array.
    Array(ArrayType<'t>),
    /// `POINTER TO`; the node is that of the whole type.
    Pointer(Node<'t>),
    /// `REFERENCE TO` or `REF_TO`; the node is that of the whole type.
    Reference(Node<'t>),
    /// A string.
    String(StringType<'t>),
    /// A range of a type.
    Subrange(SubrangeType<'t>),
    /// An enumeration.
    Enum(EnumType<'t>),
    /// A structure or a union.
    Struct(StructType<'t>),
}

impl<'t> Type<'t> {
    /// The type that `node` is.
    #[must_use]
    pub fn cast(node: Node<'t>) -> Option<Self> {
        Some(match node.kind() {
            NodeKind::NamedType => Self::Named(NamedType(node)),
            NodeKind::ArrayType => Self::Array(ArrayType(node)),
            NodeKind::PointerType => Self::Pointer(node),
            NodeKind::ReferenceType => Self::Reference(node),
            NodeKind::StringType => Self::String(StringType(node)),
            NodeKind::SubrangeType => Self::Subrange(SubrangeType(node)),
            NodeKind::EnumType => Self::Enum(EnumType(node)),
            NodeKind::StructType | NodeKind::UnionType => Self::Struct(StructType(node)),
            _ => return None,
        })
    }

    /// Whether a node of `kind` is a type.
    #[must_use]
    pub const fn is(kind: NodeKind) -> bool {
        (kind as u8) >= NodeKind::NamedType as u8
            && (kind as u8) <= NodeKind::UnionType as u8
            && !matches!(kind, NodeKind::EnumValue)
    }

    /// Its node.
    #[must_use]
    pub fn node(self) -> Node<'t> {
        match self {
            Self::Named(it) => it.0,
            Self::Array(it) => it.0,
            Self::Pointer(node) | Self::Reference(node) => node,
            Self::String(it) => it.0,
            Self::Subrange(it) => it.0,
            Self::Enum(it) => it.0,
            Self::Struct(it) => it.0,
        }
    }

    /// What a pointer or a reference points to, and what an array is made of.
    #[must_use]
    pub fn target(self) -> Option<Type<'t>> {
        match self {
            Self::Pointer(node) | Self::Reference(node) => node.children().find_map(Self::cast),
            Self::Array(array) => array.element(),
            _ => None,
        }
    }

    /// The arguments of the constructor of the named type, perhaps the element of arrays.
    pub fn constructor_arguments(self) -> impl Iterator<Item = Argument<'t>> + use<'t> {
        let mut inner = self;
        while let Self::Array(array) = inner
            && let Some(element) = array.element()
        {
            inner = element;
        }
        let list = match inner {
            Self::Named(named) => named.0.child(NodeKind::ArgumentList),
            _ => None,
        };
        list.into_iter().flat_map(children)
    }
}

impl<'t> NamedType<'t> {
    /// The name.
    #[must_use]
    pub fn path(self) -> Option<Path<'t>> {
        child(self.0)
    }

    /// The list of constructors' arguments, one for each element: `ARRAY[1..2] OF FB[(a := 1), (a := 2)]`.
    #[must_use]
    pub fn element_constructors(self) -> Option<Expression<'t>> {
        self.0.children().find_map(Expression::cast)
    }
}

/// One dimension of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension<'t> {
    /// `a..b`.
    Range(Range<'t>),
    /// `*`: of any size.
    Open,
    /// A single expression: a subrange type by its name, or a size.
    Expression(Expression<'t>),
}

impl<'t> ArrayType<'t> {
    /// Its dimensions.
    pub fn dimensions(self) -> impl Iterator<Item = Dimension<'t>> {
        self.0.children().filter_map(|child| match child.kind() {
            NodeKind::OpenDimension => Some(Dimension::Open),
            NodeKind::Range => Range::cast(child).map(Dimension::Range),
            _ => Expression::cast(child).map(Dimension::Expression),
        })
    }

    /// The type of its elements.
    #[must_use]
    pub fn element(self) -> Option<Type<'t>> {
        self.0.children().find_map(Type::cast)
    }
}

impl<'t> StringType<'t> {
    /// Whether it is a `WSTRING`.
    #[must_use]
    pub fn is_wide(self) -> bool {
        self.0.has_token(TokenKind::WStringType)
    }

    /// Its length, if it is given.
    #[must_use]
    pub fn length(self) -> Option<Expression<'t>> {
        self.0.children().find_map(Expression::cast)
    }
}

impl<'t> SubrangeType<'t> {
    /// The type.
    #[must_use]
    pub fn base(self) -> Option<NamedType<'t>> {
        child(self.0)
    }

    /// The range of it.
    #[must_use]
    pub fn range(self) -> Option<Range<'t>> {
        child(self.0)
    }
}

impl<'t> EnumType<'t> {
    /// Its values.
    pub fn values(self) -> impl Iterator<Item = EnumValue<'t>> {
        children(self.0)
    }

    /// The type of its values, which may stand before or behind them.
    #[must_use]
    pub fn base(self) -> Option<NamedType<'t>> {
        child(self.0)
    }
}

impl<'t> EnumValue<'t> {
    /// Its name.
    #[must_use]
    pub fn name(self) -> Option<Name<'t>> {
        child(self.0)
    }

    /// Its value, if it is given.
    #[must_use]
    pub fn value(self) -> Option<Expression<'t>> {
        self.0.children().find_map(Expression::cast)
    }

    /// The pragmas right before it.
    #[must_use]
    pub fn pragmas(self) -> Vec<Token<'t>> {
        pragmas_before(self.0)
    }
}

impl<'t> StructType<'t> {
    /// Whether it is a `UNION`.
    #[must_use]
    pub fn is_union(self) -> bool {
        self.0.kind() == NodeKind::UnionType
    }

    /// Its fields.
    pub fn fields(self) -> impl Iterator<Item = VarDecl<'t>> {
        children(self.0)
    }
}
