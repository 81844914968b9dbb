//! Sections of variables, and what they declare.

use super::{Expression, Name, Type, ast_nodes, children, pragmas_before};
use crate::syntax::ast::Argument;
use crate::syntax::kind::{NodeKind, TokenKind};
use crate::syntax::tree::Token;

ast_nodes! {
    /// `VAR … END_VAR` or a relative of it.
    VarSection = VarSection;
    /// `a, b AT %I* : T := x;`, in a section, a structure or a union.
    VarDecl = VarDecl | Field;
}

/// Which section it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SectionKind {
    /// `VAR`.
    Local,
    /// `VAR_INPUT`.
    Input,
    /// `VAR_OUTPUT`.
    Output,
    /// `VAR_IN_OUT`.
    InOut,
    /// `VAR_TEMP`.
    Temp,
    /// `VAR_STAT`.
    Static,
    /// `VAR_INST`.
    Instance,
    /// `VAR_EXTERNAL`.
    External,
    /// `VAR_GLOBAL`.
    Global,
    /// `VAR_CONFIG`.
    Config,
    /// `VAR_ACCESS`.
    Access,
    /// `VAR_GENERIC`.
    Generic,
    /// `CONST … END_CONST` (Siemens): constants without a type.
    Constants,
}

/// A word behind the section's keyword.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Qualifier {
    /// `CONSTANT`.
    Constant,
    /// `RETAIN`.
    Retain,
    /// `NON_RETAIN`.
    NonRetain,
    /// `PERSISTENT`.
    Persistent,
    /// `PUBLIC`.
    Public,
    /// `PRIVATE`.
    Private,
    /// `PROTECTED`.
    Protected,
    /// `INTERNAL`.
    Internal,
}

impl<'t> VarSection<'t> {
    /// Which section it is.
    #[must_use]
    pub fn kind(self) -> SectionKind {
        let keyword = self.0.own_tokens().next().map_or(TokenKind::Var, Token::kind);
        match keyword {
            TokenKind::VarInput => SectionKind::Input,
            TokenKind::VarOutput => SectionKind::Output,
            TokenKind::VarInOut => SectionKind::InOut,
            TokenKind::VarTemp => SectionKind::Temp,
            TokenKind::VarStat => SectionKind::Static,
            TokenKind::VarInst => SectionKind::Instance,
            TokenKind::VarExternal => SectionKind::External,
            TokenKind::VarGlobal => SectionKind::Global,
            TokenKind::VarConfig => SectionKind::Config,
            TokenKind::VarAccess => SectionKind::Access,
            TokenKind::VarGeneric => SectionKind::Generic,
            TokenKind::Const => SectionKind::Constants,
            _ => SectionKind::Local,
        }
    }

    /// The words behind its keyword.
    pub fn qualifiers(self) -> impl Iterator<Item = Qualifier> {
        self.0.own_tokens().filter_map(|token| {
            Some(match token.kind() {
                TokenKind::Constant => Qualifier::Constant,
                TokenKind::Retain => Qualifier::Retain,
                TokenKind::NonRetain => Qualifier::NonRetain,
                TokenKind::Persistent => Qualifier::Persistent,
                TokenKind::Public => Qualifier::Public,
                TokenKind::Private => Qualifier::Private,
                TokenKind::Protected => Qualifier::Protected,
                TokenKind::Internal => Qualifier::Internal,
                _ => return None,
            })
        })
    }

    /// Whether `qualifier` stands behind its keyword.
    #[must_use]
    pub fn has(self, qualifier: Qualifier) -> bool {
        self.qualifiers().any(|found| found == qualifier)
    }

    /// Whether what it declares cannot change.
    #[must_use]
    pub fn is_constant(self) -> bool {
        self.kind() == SectionKind::Constants || self.has(Qualifier::Constant)
    }

    /// Its declarations.
    pub fn variables(self) -> impl Iterator<Item = VarDecl<'t>> {
        children(self.0)
    }

    /// The pragmas right before it.
    #[must_use]
    pub fn pragmas(self) -> Vec<Token<'t>> {
        pragmas_before(self.0)
    }
}

impl<'t> VarDecl<'t> {
    /// The names that it declares.
    pub fn names(self) -> impl Iterator<Item = Name<'t>> {
        children(self.0)
    }

    /// The address behind `AT`, as written; with several names, the first one's that has one.
    #[must_use]
    pub fn address(self) -> Option<Token<'t>> {
        let location = self.0.child(NodeKind::Location)?;
        location.own_token(TokenKind::Address)
    }

    /// The address of the `n`th name.
    #[must_use]
    pub fn address_of(self, n: usize) -> Option<Token<'t>> {
        let mut names = 0;
        for child in self.0.children() {
            match child.kind() {
                NodeKind::Name => names += 1,
                NodeKind::Location if names == n + 1 => return child.own_token(TokenKind::Address),
                _ => {}
            }
        }
        None
    }

    /// The variable that stands behind `AT` in place of an address (Siemens), or that `VAR_ACCESS` gives access to.
    #[must_use]
    pub fn overlaid(self) -> Option<Expression<'t>> {
        self.0.child(NodeKind::Location)?.children().find_map(Expression::cast)
    }

    /// Its type.
    #[must_use]
    pub fn type_(self) -> Option<Type<'t>> {
        self.0.children().find_map(Type::cast)
    }

    /// Its initial value.
    #[must_use]
    pub fn initial(self) -> Option<Expression<'t>> {
        self.0.children().filter_map(Expression::cast).last()
    }

    /// The arguments of its type's constructor: `fb : FB_X(1, name := 'x');`. In an array, those of its elements.
    pub fn constructor_arguments(self) -> impl Iterator<Item = Argument<'t>> {
        self.type_().into_iter().flat_map(Type::constructor_arguments)
    }

    /// Whether it only rises: `R_EDGE`.
    #[must_use]
    pub fn has_rising_edge(self) -> bool {
        self.0.has_token(TokenKind::REdge)
    }

    /// Whether it only falls: `F_EDGE`.
    #[must_use]
    pub fn has_falling_edge(self) -> bool {
        self.0.has_token(TokenKind::FEdge)
    }

    /// Whether `REF=` stands before the initial value.
    #[must_use]
    pub fn is_reference_assignment(self) -> bool {
        self.0.has_token(TokenKind::Ref)
    }

    /// The pragmas right before it.
    #[must_use]
    pub fn pragmas(self) -> Vec<Token<'t>> {
        pragmas_before(self.0)
    }
}
