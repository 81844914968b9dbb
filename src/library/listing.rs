//! Tokens of a listing: what each one is, and what each name means.
//!
//! Names are resolved along the tokens of a body: a name alone in the scope of the item (its
//! variables and members, those of its bases, globals, top-level names), a name behind a dot in what
//! stands before it, the name of a formal parameter in what is called.

use std::collections::HashMap;

use super::elementary::is_elementary;
use super::names::{Found, Names, Scope, fold, lineage};
use super::{Catalogue, Excerpt, ItemId};
use crate::syntax::{Token, TokenKind, Tree};
use crate::text::Span;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// A word of the language.
    Keyword,
    /// An elementary type.
    Type,
    /// A comment.
    Comment,
    /// A pragma.
    Pragma,
    /// A string.
    String,
    /// A number, duration, date or direct address.
    Number,
    /// An operator.
    Operator,
    /// A name that means something here.
    Name,
}

/// A token that is not plain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ListedToken {
    /// Its range, from the beginning of the excerpt.
    pub span: Span,
    /// What it is.
    pub class: Class,
    /// What it names.
    pub target: Option<Found>,
}

/// The tokens of `excerpt`, which belongs to `item`.
#[must_use]
pub fn tokens(catalogue: &Catalogue, names: &Names, item: ItemId, excerpt: Excerpt) -> Vec<ListedToken> {
    let Some(tree) = catalogue.sources[excerpt.fragment.0 as usize].tree.as_deref() else { return Vec::new() };
    let mut resolver = Resolver::new(catalogue, names, item);
    let mut listed = Vec::new();
    for token in inside(tree, excerpt.span) {
        let target = resolver.step(token);
        if let Some(class) = class(token, target.is_some()) {
            let span = token.span();
            let span = Span::new(span.start - excerpt.span.start, span.end - excerpt.span.start);
            listed.push(ListedToken { span, class, target });
        }
    }
    listed
}

fn inside(tree: &Tree, span: Span) -> impl Iterator<Item = Token<'_>> {
    let first = tree.token_at(span.start).map_or(0, Token::index);
    let rest = (first..).map_while(|index| tree.token(index));
    rest.take_while(move |token| token.span().end <= span.end).filter(move |token| span.contains(token.span()))
}

fn class(token: Token<'_>, linked: bool) -> Option<Class> {
    Some(match token.kind() {
        TokenKind::LineComment | TokenKind::BlockComment => Class::Comment,
        TokenKind::Pragma => Class::Pragma,
        TokenKind::String | TokenKind::WString => Class::String,
        TokenKind::Ident | TokenKind::QuotedName if linked => Class::Name,
        TokenKind::Ident if is_elementary(token.text()) => Class::Type,
        TokenKind::StringType | TokenKind::WStringType => Class::Type,
        TokenKind::True | TokenKind::False | TokenKind::Null => Class::Number,
        TokenKind::TypePrefix | TokenKind::Address => Class::Number,
        kind if kind.is_literal() => Class::Number,
        kind if kind.is_keyword() => Class::Keyword,
        kind if is_operator(kind) => Class::Operator,
        _ => return None,
    })
}

const fn is_operator(kind: TokenKind) -> bool {
    let kind = kind as u8;
    kind >= TokenKind::Caret as u8 && kind <= TokenKind::Ampersand as u8
}

/// Where a walk along the tokens stands.
struct Resolver<'a> {
    catalogue: &'a Catalogue,
    names: &'a Names,
    item: ItemId,
    own: HashMap<String, Found>,
    /// What the name or path before this token means.
    last: Option<Found>,
    /// Whether a dot stands before this token.
    dotted: bool,
    /// What is called or indexed at each open bracket, and whether the next name may be a parameter's.
    open: Vec<(Option<Found>, bool)>,
}

impl<'a> Resolver<'a> {
    fn new(catalogue: &'a Catalogue, names: &'a Names, item: ItemId) -> Self {
        let own = own_names(catalogue, item);
        Self { catalogue, names, item, own, last: None, dotted: false, open: Vec::new() }
    }

    /// What `token` names.
    fn step(&mut self, token: Token<'_>) -> Option<Found> {
        let kind = token.kind();
        if kind.is_trivia() {
            return None;
        }
        match kind {
            TokenKind::Ident | TokenKind::QuotedName => {
                let name = token.text().trim_matches('"');
                let found = self.name(name, token);
                self.last = found;
                self.dotted = false;
                self.parameter_done();
                return found;
            }
            TokenKind::This => self.last = Some(Found::Item(self.owner())),
            TokenKind::Super => self.last = super::names::bases(self.catalogue, self.owner()).next().map(Found::Item),
            TokenKind::Dot => {
                self.dotted = true;
                return None;
            }
            TokenKind::Caret => return None,
            TokenKind::LParen | TokenKind::LBracket => {
                let call = kind == TokenKind::LParen;
                self.open.push((self.last.take(), call));
            }
            TokenKind::RParen | TokenKind::RBracket => {
                self.last = self.open.pop().and_then(|(before, _)| before);
            }
            TokenKind::Comma => {
                self.last = None;
                if let Some((called, expects)) = self.open.last_mut() {
                    *expects = called.is_some();
                }
            }
            _ => {
                self.last = None;
                self.parameter_done();
            }
        }
        self.dotted = false;
        None
    }

    fn parameter_done(&mut self) {
        if let Some((_, expects)) = self.open.last_mut() {
            *expects = false;
        }
    }

    fn name(&self, name: &str, token: Token<'_>) -> Option<Found> {
        if self.dotted {
            return self.member(self.last?, name);
        }
        if let Some((Some(called), true)) = self.open.last()
            && is_parameter(token)
        {
            return self.parameter(*called, name);
        }
        if let Some(found) = self.own.get(&fold(name)) {
            return Some(*found);
        }
        let item = self.catalogue.item(self.item);
        let scope = Scope { library: item.library, namespace: &item.namespace };
        let top = self.names.top(self.catalogue, name, scope).map(Found::Item);
        top.or_else(|| self.names.global(self.catalogue, name, scope))
    }

    /// The formal parameter `name` of what is called: of a method or function itself, of the type of an instance.
    fn parameter(&self, called: Found, name: &str) -> Option<Found> {
        match called {
            Found::Item(id) => self.names.member(self.catalogue, id, name),
            Found::Variable(..) => self.member(called, name),
        }
    }

    /// What `name` behind a dot means: a member of an item, or of the type of a variable, property or result.
    fn member(&self, of: Found, name: &str) -> Option<Found> {
        let owner = match of {
            Found::Item(id) => match self.catalogue.item(id).type_.as_ref() {
                Some(type_) if self.catalogue.item(id).kind.is_member() => type_.item()?,
                _ => id,
            },
            Found::Variable(id, index) => self.names.type_of(self.catalogue, id, index)?,
        };
        self.names.member(self.catalogue, owner, name)
    }

    fn owner(&self) -> ItemId {
        self.catalogue.top(self.item)
    }
}

/// Whether `:=` or `=>` follows.
fn is_parameter(token: Token<'_>) -> bool {
    let after = std::iter::successors(token.next(), |next| next.next());
    after
        .into_iter()
        .find(|next| !next.kind().is_trivia())
        .is_some_and(|next| matches!(next.kind(), TokenKind::Assign | TokenKind::Arrow))
}

/// The names of an item's own variables and members, of its owners' and of their bases'; inner ones hide outer ones.
fn own_names(catalogue: &Catalogue, item: ItemId) -> HashMap<String, Found> {
    let mut own = HashMap::new();
    let mut at = Some(item);
    while let Some(id) = at {
        for owner in lineage(catalogue, id) {
            let from = catalogue.item(owner);
            for (i, variable) in from.variables.iter().enumerate() {
                own.entry(fold(&variable.name)).or_insert(Found::Variable(owner, i));
            }
            for child in &from.children {
                own.entry(fold(&catalogue.item(*child).name)).or_insert(Found::Item(*child));
            }
        }
        at = catalogue.item(id).parent;
    }
    own
}
