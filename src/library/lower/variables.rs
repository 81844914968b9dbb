//! Sections of variables, fields and values.

use super::{Lowering, comments};
use crate::library::{FragmentId, Pragma, Section, TypeUse, Variable};
use crate::syntax::ast::{AstNode, EnumType, EnumValue, Qualifier, SectionKind, StructType, Type, VarDecl, VarSection};
use crate::syntax::{Node, NodeKind, Token, TokenKind};

/// The text of a node without comments and pragmas, blanks folded.
pub(super) fn plain(node: Node<'_>) -> String {
    let mut out = String::new();
    for token in node.tokens() {
        match token.kind() {
            kind if kind.is_trivia() => {
                if !out.is_empty() && !out.ends_with(' ') {
                    out.push(' ');
                }
            }
            _ => out.push_str(token.text()),
        }
    }
    out.truncate(out.trim_end().len());
    out
}

impl Section {
    /// The section that variables of a `VAR…` block of this kind stand in.
    #[must_use]
    pub const fn of(kind: SectionKind) -> Self {
        match kind {
            SectionKind::Local | SectionKind::Constants => Self::Var,
            SectionKind::Input | SectionKind::Generic => Self::Input,
            SectionKind::Output => Self::Output,
            SectionKind::InOut => Self::InOut,
            SectionKind::Temp => Self::Temp,
            SectionKind::Static => Self::Stat,
            SectionKind::Instance => Self::Inst,
            SectionKind::External => Self::External,
            SectionKind::Global => Self::Global,
            SectionKind::Config => Self::Config,
            SectionKind::Access => Self::AccessPath,
        }
    }
}

impl Lowering<'_> {
    /// The variables of a section.
    pub(super) fn section(&self, fragment: FragmentId, from: VarSection<'_>) -> Vec<Variable> {
        let mut variables = Vec::new();
        for declaration in from.variables() {
            let first = variables.len();
            self.declaration(fragment, declaration, Section::of(from.kind()), "", &mut variables);
            for variable in &mut variables[first..] {
                variable.constant = from.is_constant();
                variable.retain = from.has(Qualifier::Retain);
                variable.persistent = from.has(Qualifier::Persistent);
            }
        }
        variables
    }

    /// The variables that one declaration declares; those of a structure inside it with dotted names.
    fn declaration(
        &self,
        fragment: FragmentId,
        declaration: VarDecl<'_>,
        section: Section,
        prefix: &str,
        out: &mut Vec<Variable>,
    ) {
        let comments = comments::of_variable(declaration.node(), fragment);
        let pragmas = self.pragmas(fragment, &declaration.pragmas());
        let edge = match (declaration.has_rising_edge(), declaration.has_falling_edge()) {
            (true, _) => Some("r_edge"),
            (_, true) => Some("f_edge"),
            _ => None,
        };
        for (n, name) in declaration.names().enumerate() {
            let address = declaration.address_of(n).or_else(|| declaration.address());
            out.push(Variable {
                name: format!("{prefix}{}", name.text()),
                place: self.place(fragment, name.span()),
                section,
                constant: false,
                retain: false,
                persistent: false,
                edge,
                type_: declaration.type_().map(|type_| self.type_use(fragment, type_)),
                initial: initial(declaration),
                address: address.map(|token| token.text().to_owned()),
                pragmas: pragmas.clone(),
                comments: comments.clone(),
            });
            if let Some(Type::Struct(inner)) = declaration.type_() {
                let prefix = format!("{prefix}{}.", name.text());
                for field in inner.fields() {
                    self.declaration(fragment, field, section, &prefix, out);
                }
            }
        }
    }

    /// The fields of a structure or union.
    pub(super) fn fields(&self, fragment: FragmentId, from: StructType<'_>) -> Vec<Variable> {
        let mut variables = Vec::new();
        for field in from.fields() {
            self.declaration(fragment, field, Section::Field, "", &mut variables);
        }
        variables
    }

    /// The values of an enumeration.
    pub(super) fn values(&self, fragment: FragmentId, from: EnumType<'_>) -> Vec<Variable> {
        from.values().filter_map(|value| self.value(fragment, value)).collect()
    }

    fn value(&self, fragment: FragmentId, value: EnumValue<'_>) -> Option<Variable> {
        let name = value.name()?;
        Some(Variable {
            name: name.text().to_owned(),
            place: self.place(fragment, name.span()),
            section: Section::Value,
            constant: false,
            retain: false,
            persistent: false,
            edge: None,
            type_: None,
            initial: value.value().map(|value| plain(value.node())),
            address: None,
            pragmas: self.pragmas(fragment, &value.pragmas()),
            comments: comments::of_variable(value.node(), fragment),
        })
    }

    /// A type as written; the arguments of a constructor are no part of it, nor are the insides of a structure.
    pub(super) fn type_use(&self, fragment: FragmentId, type_: Type<'_>) -> TypeUse {
        let text = match type_ {
            Type::Named(named) => named.path().map_or_else(|| plain(type_.node()), |path| path.text()),
            Type::Struct(inner) => if inner.is_union() { "UNION" } else { "STRUCT" }.to_owned(),
            _ => plain(type_.node()),
        };
        TypeUse::new(&text, Some(self.place(fragment, type_.node().span())))
    }

    /// Pragmas with their places.
    pub(super) fn pragmas(&self, fragment: FragmentId, tokens: &[Token<'_>]) -> Vec<Pragma> {
        let pragma = |token: &Token<'_>| Pragma {
            text: token.text().split_whitespace().collect::<Vec<_>>().join(" "),
            place: self.place(fragment, token.span()),
        };
        tokens.iter().map(pragma).collect()
    }
}

/// The initial value as written, or the arguments of the constructor.
fn initial(declaration: VarDecl<'_>) -> Option<String> {
    if let Some(value) = declaration.initial() {
        return Some(plain(value.node()));
    }
    let list = declaration.type_()?.node().child(NodeKind::ArgumentList)?;
    Some(plain(list))
}

/// The last own token of `kind` in a node.
pub(super) fn own_token(node: Node<'_>, kind: TokenKind) -> Option<Token<'_>> {
    node.own_tokens().filter(|token| token.kind() == kind).last()
}
