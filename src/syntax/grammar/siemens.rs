//! What only Siemens writes: lines of properties in a block's header, `BEGIN`, `CONST`, and a data block's structure.

use super::super::kind::{NodeKind, TokenKind};
use super::super::parser::Parser;
use super::names::{any_name, is_name};
use super::{DECLARATION_ENDS, VAR_KEYWORDS, declarations, expressions, skip_while, types};

/// `TITLE = …`, `VERSION : 0.1`, `KNOW_HOW_PROTECT`, `NON_RETAIN`, and the type of a data block.
pub(super) fn block_properties(p: &mut Parser<'_>) {
    loop {
        match p.current() {
            TokenKind::Title | TokenKind::Version | TokenKind::Author | TokenKind::Family | TokenKind::NameProperty
                if matches!(p.nth(1), TokenKind::Equal | TokenKind::Colon) && p.begins_line() =>
            {
                property_line(p);
            }
            TokenKind::KnowHowProtect => property_line(p),
            TokenKind::Retain | TokenKind::NonRetain if p.begins_line() => p.bump(),
            _ => return,
        }
    }
}

/// Everything to the end of the line.
fn property_line(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    while !p.at(TokenKind::Eof) && !p.begins_line() {
        p.bump();
    }
    p.complete(marker, NodeKind::BlockProperty);
}

/// Whether `BEGIN`, `CONST` or `LABEL` stands here as a keyword.
pub(super) fn at_section(p: &Parser<'_>) -> bool {
    let keyword = matches!(p.current(), TokenKind::Begin | TokenKind::Const | TokenKind::Label);
    let used_as_name = matches!(
        p.nth(1),
        TokenKind::Assign
            | TokenKind::Dot
            | TokenKind::LParen
            | TokenKind::LBracket
            | TokenKind::Caret
            | TokenKind::Colon
            | TokenKind::Semicolon
    );
    let operator = p.nth(2) == TokenKind::Equal && p.nth_is_joined(1);
    keyword && !used_as_name && !operator && p.begins_line()
}

/// `BEGIN`; `CONST … END_CONST`; `LABEL … END_LABEL`; a data block's `STRUCT … END_STRUCT;` or `"Type"`.
pub(super) fn opt_section(p: &mut Parser<'_>) -> bool {
    if p.at(TokenKind::Struct) || (p.at(TokenKind::WString) && p.is_open(TokenKind::EndDataBlock)) {
        let alone = p.at(TokenKind::Struct) || p.nth_begins_line(1);
        if alone && p.is_open(TokenKind::EndDataBlock) {
            types::type_spec(p, types::Context::Result);
            p.eat(TokenKind::Semicolon);
            return true;
        }
    }
    if !at_section(p) {
        return false;
    }
    match p.current() {
        TokenKind::Const => constants(p),
        TokenKind::Label => labels(p),
        _ => p.bump(),
    }
    true
}

/// `CONST a := 1; END_CONST`.
fn constants(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    while is_name(p.current()) && !p.at(TokenKind::EndConst) {
        let constant = p.start();
        any_name(p);
        if p.expect(TokenKind::Assign) {
            expressions::expression(p);
        }
        if !p.at(TokenKind::Semicolon) {
            skip_while(p, |p| !p.at(TokenKind::Semicolon) && !p.at_any(DECLARATION_ENDS) && !p.at_any(VAR_KEYWORDS));
        }
        declarations::semicolon(p);
        p.complete(constant, NodeKind::VarDecl);
    }
    if !p.eat(TokenKind::EndConst) {
        p.missing_end(marker, TokenKind::EndConst);
    }
    p.complete(marker, NodeKind::VarSection);
}

/// `LABEL a, b; END_LABEL`.
fn labels(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    while !p.at(TokenKind::Eof) && !p.at_any(DECLARATION_ENDS) && !p.at_any(VAR_KEYWORDS) {
        p.bump();
    }
    p.eat(TokenKind::EndLabel);
    p.complete(marker, NodeKind::BlockProperty);
}
