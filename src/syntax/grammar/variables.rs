//! Sections of variables: `input_decls`, `output_decls`, `in_out_decls`, `var_decls`, `retain_var_decls`,
//! `loc_var_decls`, `temp_var_decls`, `external_var_decls`, `global_var_decls`, `access_decls`, `config_init`.
//!
//! All of them have one shape here; what may stand in which is for later rooms to say.

use super::super::kind::{NodeKind, TokenKind};
use super::super::parser::Parser;
use super::super::set::TokenSet;
use super::declarations::declaration_at;
use super::names::{any_name, bump_name, is_name, keyword_may_be_name};
use super::{DECLARATION_ENDS, VAR_KEYWORDS, initializers, skip_while, types};

const SECTION_MODIFIERS: TokenSet = TokenSet::new(&[
    TokenKind::Constant,
    TokenKind::Retain,
    TokenKind::NonRetain,
    TokenKind::Persistent,
    TokenKind::Public,
    TokenKind::Private,
    TokenKind::Protected,
    TokenKind::Internal,
]);

/// `VAR … END_VAR` or a relative of it.
pub(super) fn opt_section(p: &mut Parser<'_>) -> bool {
    if !p.at_any(VAR_KEYWORDS) {
        return false;
    }
    let marker = p.start();
    let section = p.current();
    p.bump();
    while p.at_any(SECTION_MODIFIERS) && !declares(p, 1) {
        p.bump();
    }
    // Siemens: `VAR DB_SPECIFIC`.
    if p.nth_is_word(0, "DB_SPECIFIC") {
        p.bump();
    }
    // What a section of access paths declares looks different; `VAR_ACCESS` counts as open while it is read.
    p.within(section, |p| p.within(TokenKind::EndVar, |p| variables(p, NodeKind::VarDecl)));
    if p.eat(TokenKind::EndVar) {
        p.eat(TokenKind::Semicolon);
    } else {
        p.missing_end(marker, TokenKind::EndVar);
    }
    p.complete(marker, NodeKind::VarSection);
    true
}

/// Whether what stands `n` tokens on shows that the token before it is a declared name.
fn declares(p: &Parser<'_>, n: u32) -> bool {
    matches!(p.nth(n), TokenKind::Colon | TokenKind::Comma | TokenKind::At)
        || (p.nth(n) == TokenKind::Dot && !p.nth_begins_line(n))
}

/// Declarations up to something that cannot be one.
pub(super) fn variables(p: &mut Parser<'_>, kind: NodeKind) {
    while !at_end(p) {
        if p.eat(TokenKind::Semicolon) {
            continue;
        }
        if at_declared_name(p) {
            variable(p, kind);
        } else {
            p.expected("the name of a variable");
            recover(p, true);
        }
    }
}

/// Whether the section must have ended: something is closed that is open, or something else begins.
fn at_end(p: &Parser<'_>) -> bool {
    match p.current() {
        TokenKind::Eof => true,
        kind if !kind.is_keyword() => false,
        kind if DECLARATION_ENDS.contains(kind) => p.is_open(kind),
        kind => VAR_KEYWORDS.contains(kind) || (!declares(p, 1) && declaration_at(p).is_some()),
    }
}

fn at_declared_name(p: &Parser<'_>) -> bool {
    if p.at(TokenKind::At) && p.nth(1) == TokenKind::Address {
        return true;
    }
    let n = u32::from(p.at(TokenKind::Hash));
    is_name(p.nth(n)) || (keyword_may_be_name(p.nth(n)) && declares(p, n + 1))
}

/// `a, b AT %I* : T := x;`
fn variable(p: &mut Parser<'_>, kind: NodeKind) {
    let marker = p.start();
    names(p);
    if p.eat(TokenKind::Colon) {
        opt_location(p);
        opt_access_path(p);
        types::type_spec(p, types::Context::Variable);
        suffixes(p);
    } else {
        p.expected("`:` and a type");
        if types::at_type(p) && !p.begins_line() {
            types::type_spec(p, types::Context::Variable);
            suffixes(p);
        }
    }
    end(p);
    p.complete(marker, kind);
}

fn names(p: &mut Parser<'_>) {
    loop {
        // A variable may have an address and no name.
        if !(p.at(TokenKind::At) && p.nth(1) == TokenKind::Address) {
            declared_name(p);
        }
        opt_location(p);
        if !p.eat(TokenKind::Comma) {
            return;
        }
        if !at_declared_name(p) {
            return p.expected("a name");
        }
    }
}

/// A name; in `VAR_CONFIG` one with dots and indices (`station.fb.x[1]`).
fn declared_name(p: &mut Parser<'_>) {
    if p.nth(1) != TokenKind::Dot && p.nth(1) != TokenKind::LBracket {
        return any_name(p);
    }
    let marker = p.start();
    bump_name(p);
    loop {
        match p.current() {
            TokenKind::Dot if is_name(p.nth(1)) || p.nth(1).is_keyword() => {
                p.bump();
                bump_name(p);
            }
            TokenKind::LBracket => {
                while !matches!(p.current(), TokenKind::RBracket | TokenKind::Semicolon | TokenKind::Eof) {
                    p.bump();
                }
                p.eat(TokenKind::RBracket);
            }
            _ => break,
        }
    }
    p.complete(marker, NodeKind::Name);
}

/// `AT %IX0.0`.
fn opt_location(p: &mut Parser<'_>) {
    if !p.at(TokenKind::At) {
        return;
    }
    let marker = p.start();
    p.bump();
    if !p.eat(TokenKind::Address) {
        if is_name(p.current()) {
            super::expressions::variable(p);
        } else {
            p.expected("an address");
        }
    }
    p.complete(marker, NodeKind::Location);
}

/// What a name in `VAR_ACCESS` gives access to, up to the colon before its type: `station.%IX1.1 :`.
fn opt_access_path(p: &mut Parser<'_>) {
    if !p.is_open(TokenKind::VarAccess) {
        return;
    }
    let marker = p.start();
    super::expressions::variable(p);
    p.complete(marker, NodeKind::Location);
    p.expect(TokenKind::Colon);
}

/// What follows the type: edges, the initial value, the access of `VAR_ACCESS`.
fn suffixes(p: &mut Parser<'_>) {
    const FLAGS: TokenSet = TokenSet::new(&[
        TokenKind::REdge,
        TokenKind::FEdge,
        TokenKind::ReadOnly,
        TokenKind::ReadWrite,
        TokenKind::Retain,
        TokenKind::NonRetain,
    ]);
    loop {
        match p.current() {
            TokenKind::Assign | TokenKind::Equal => {
                p.bump();
                initializers::initial_value(p);
            }
            TokenKind::Ref if p.nth(1) == TokenKind::Equal => {
                p.bump();
                p.bump();
                initializers::initial_value(p);
            }
            TokenKind::At => opt_location(p),
            kind if FLAGS.contains(kind) && !declares(p, 1) => p.bump(),
            _ => return,
        }
    }
}

/// The `;`. Where the next declaration or the section's end follows, its lack costs nothing.
fn end(p: &mut Parser<'_>) {
    if p.eat(TokenKind::Semicolon) || matches!(p.previous(), TokenKind::EndStruct | TokenKind::EndUnion) {
        return;
    }
    if at_end(p) || (p.begins_line() && at_declared_name(p) && declares(p, 1)) {
        return p.missing_semicolon();
    }
    p.expected("`;`");
    recover(p, false);
}

/// Skips to behind the next `;`, or to where a declaration begins: on a new line, or, where nothing has been read
/// of one yet (it is `stuck`), anywhere.
fn recover(p: &mut Parser<'_>, stuck: bool) {
    let start = p.position();
    skip_while(p, |p| {
        let moved = p.position() > start;
        let begins = (moved || !stuck) && at_declared_name(p) && declares(p, 1);
        let next = begins && (stuck || p.begins_line());
        (stuck && !moved) || !(next || p.at(TokenKind::Semicolon) || at_end(p))
    });
    p.eat(TokenKind::Semicolon);
}
