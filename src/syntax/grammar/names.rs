//! Names: `identifier`, and names with dots (`namespace_h_name`, `symbolic_variable`).
//!
//! A soft keyword is a name wherever it is not the keyword. A hard one is a name behind a dot, and before what
//! only follows a name (`Type : INT;`, `f(Type := 3)`): people write such names where their compiler lets them.

use super::super::kind::{NodeKind, TokenKind};
use super::super::parser::{Done, Parser};

/// Whether a token of `kind` can be a name as such.
pub(super) const fn is_name(kind: TokenKind) -> bool {
    matches!(kind, TokenKind::Ident | TokenKind::QuotedName | TokenKind::WString) || kind.is_soft_keyword()
}

/// Whether a keyword can be a name where what follows it shows that it is one.
pub(super) const fn keyword_may_be_name(kind: TokenKind) -> bool {
    kind.is_keyword() && !super::VAR_KEYWORDS.contains(kind) && !super::DECLARATION_ENDS.contains(kind)
}

/// Whether a name begins `n` tokens on: a name, or `#` and a name.
pub(super) fn nth_is_name(p: &Parser<'_>, n: u32) -> bool {
    is_name(p.nth(n)) || (p.nth(n) == TokenKind::Hash && is_name(p.nth(n + 1)))
}

/// Takes the current token as a name.
pub(super) fn bump_name(p: &mut Parser<'_>) {
    p.eat(TokenKind::Hash);
    let kind = if p.at(TokenKind::WString) { TokenKind::QuotedName } else { TokenKind::Ident };
    p.bump_as(kind);
}

/// A name where something is declared.
pub(super) fn name(p: &mut Parser<'_>) -> bool {
    let found = nth_is_name(p, 0);
    if found {
        any_name(p);
    } else {
        p.expected("a name");
    }
    found
}

/// The current token as a declared name, whatever it looks like.
pub(super) fn any_name(p: &mut Parser<'_>) {
    let marker = p.start();
    bump_name(p);
    p.complete(marker, NodeKind::Name);
}

/// `a.b.c`, as the name of a type, an interface or a namespace.
pub(super) fn opt_path(p: &mut Parser<'_>) -> Option<Done> {
    if !nth_is_name(p, 0) {
        return None;
    }
    let marker = p.start();
    bump_name(p);
    while p.at(TokenKind::Dot) && (is_name(p.nth(1)) || p.nth(1).is_keyword()) {
        p.bump();
        bump_name(p);
    }
    Some(p.complete(marker, NodeKind::Path))
}

/// The same, or an error.
pub(super) fn path(p: &mut Parser<'_>) {
    if opt_path(p).is_none() {
        p.expected("a name");
    }
}
