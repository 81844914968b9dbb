//! Types: `data_type_decl`, `simple_type_decl`, `subrange_type_decl`, `enum_type_decl`, `array_type_decl`,
//! `struct_type_decl`, `str_type_decl`, `ref_type_decl`; and the vendors' `UNION`, `POINTER TO`, `REFERENCE TO`.

use super::super::kind::{NodeKind, TokenKind};
use super::super::parser::{Marker, Parser};
use super::declarations::{declaration_at, modifiers};
use super::names::{any_name, is_name, keyword_may_be_name, name, nth_is_name, opt_path, path};
use super::{DECLARATION_ENDS, VAR_KEYWORDS, error_token, expressions, initializers, siemens, skip_while, variables};

/// Where a type stands: it decides what parentheses behind a name mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Context {
    /// In `TYPE`: values of an enumeration, or a range.
    Declaration,
    /// Of a variable: the arguments of a constructor, unless the type is elementary.
    Variable,
    /// Of a function's result.
    Result,
}

/// `TYPE … END_TYPE`.
pub(super) fn type_block(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    p.within(TokenKind::EndType, type_declarations);
    close_type(p, marker);
    p.complete(marker, NodeKind::TypeBlock);
}

fn close_type(p: &mut Parser<'_>, marker: Marker) {
    if p.eat(TokenKind::EndType) {
        p.eat(TokenKind::Semicolon);
    } else {
        p.missing_end(marker, TokenKind::EndType);
    }
}

fn type_declarations(p: &mut Parser<'_>) {
    while !at_end(p) {
        if p.eat(TokenKind::Semicolon) {
            continue;
        }
        if nth_is_name(p, 0)
            || p.at(TokenKind::Colon)
            || (keyword_may_be_name(p.current()) && p.nth(1) == TokenKind::Colon)
        {
            type_declaration(p);
        } else {
            p.expected("the name of a type");
            recover(p);
        }
    }
}

/// Whether the block must have ended: something is closed that is open, or something else begins.
fn at_end(p: &Parser<'_>) -> bool {
    match p.current() {
        TokenKind::Eof => true,
        kind if !kind.is_keyword() => false,
        kind if DECLARATION_ENDS.contains(kind) => p.is_open(kind),
        kind => VAR_KEYWORDS.contains(kind) || (p.nth(1) != TokenKind::Colon && declaration_at(p).is_some()),
    }
}

/// `name EXTENDS base : type := value;`
fn type_declaration(p: &mut Parser<'_>) {
    let marker = p.start();
    modifiers(p);
    if p.at(TokenKind::Colon) {
        p.expected("the name of a type");
    } else {
        any_name(p);
    }
    if p.at(TokenKind::Extends) {
        let extends = p.start();
        p.bump();
        path(p);
        while p.eat(TokenKind::Comma) {
            path(p);
        }
        p.complete(extends, NodeKind::ExtendsClause);
    }
    siemens::block_properties(p);
    // Siemens writes no colon before a structure.
    if !p.eat(TokenKind::Colon) && !p.at(TokenKind::Struct) {
        p.expected("`:` and a type");
    }
    if at_type(p) {
        type_spec(p, Context::Declaration);
    } else {
        p.expected("a type");
    }
    if p.eat(TokenKind::Assign) {
        initializers::initial_value(p);
    }
    end(p);
    p.complete(marker, NodeKind::TypeDecl);
}

/// The `;`, which may be left out behind `END_STRUCT`.
fn end(p: &mut Parser<'_>) {
    if p.eat(TokenKind::Semicolon) || matches!(p.previous(), TokenKind::EndStruct | TokenKind::EndUnion) {
        return;
    }
    if at_end(p) || (p.begins_line() && nth_is_name(p, 0) && p.nth(1) == TokenKind::Colon) {
        return p.missing_semicolon();
    }
    p.expected("`;`");
    recover(p);
}

/// Skips to behind the next `;`, or to where a declaration begins: on a new line, or, where nothing has been read
/// of one yet, anywhere.
fn recover(p: &mut Parser<'_>) {
    let start = p.position();
    let stuck = matches!(p.previous(), TokenKind::Type | TokenKind::Semicolon);
    skip_while(p, |p| {
        let begins = p.position() > start && nth_is_name(p, 0) && p.nth(1) == TokenKind::Colon;
        !p.at(TokenKind::Semicolon) && !at_end(p) && !(begins && (stuck || p.begins_line()))
    });
    if !p.eat(TokenKind::Semicolon) && p.position() == start && !at_end(p) {
        error_token(p);
    }
}

/// Whether a type begins here.
pub(super) fn at_type(p: &Parser<'_>) -> bool {
    nth_is_name(p, 0) || matches!(p.current(), TokenKind::Array | TokenKind::Struct | TokenKind::LParen)
}

/// Any type.
pub(super) fn type_spec(p: &mut Parser<'_>, context: Context) {
    if p.deeper(|p| spec(p, context)).is_none() {
        skip_while(p, |p| !p.at(TokenKind::Semicolon) && !p.at_any(DECLARATION_ENDS));
    }
}

fn spec(p: &mut Parser<'_>, context: Context) {
    match p.current() {
        TokenKind::Array | TokenKind::Vector => array(p, context),
        TokenKind::Pointer | TokenKind::Reference if p.nth(1) == TokenKind::To => {
            let kind = if p.at(TokenKind::Pointer) { NodeKind::PointerType } else { NodeKind::ReferenceType };
            let marker = p.start();
            p.bump();
            p.bump();
            type_spec(p, context);
            p.complete(marker, kind);
        }
        TokenKind::RefTo => {
            let marker = p.start();
            p.bump();
            type_spec(p, context);
            p.complete(marker, NodeKind::ReferenceType);
        }
        TokenKind::StringType | TokenKind::WStringType => string(p),
        TokenKind::Struct => fields(p, TokenKind::EndStruct, NodeKind::StructType),
        TokenKind::Union => fields(p, TokenKind::EndUnion, NodeKind::UnionType),
        TokenKind::LParen => enumeration(p),
        _ if nth_is_name(p, 0) => named(p, context),
        _ => p.expected("a type"),
    }
}

/// `ARRAY[1..3, 0..n] OF T`.
fn array(p: &mut Parser<'_>, context: Context) {
    let marker = p.start();
    p.bump();
    if p.expect(TokenKind::LBracket) {
        while !matches!(p.current(), TokenKind::RBracket | TokenKind::Of | TokenKind::Semicolon | TokenKind::Eof) {
            let before = p.position();
            dimension(p);
            if !p.eat(TokenKind::Comma) && !p.at(TokenKind::RBracket) {
                p.expected("`,` or `]`");
                if p.position() == before {
                    break;
                }
            }
        }
        p.expect(TokenKind::RBracket);
    }
    if !p.at(TokenKind::Of) {
        p.expected(TokenKind::Of.describe());
        skip_while(p, |p| {
            !matches!(p.current(), TokenKind::Of | TokenKind::Semicolon) && !p.begins_line() && !at_end(p)
        });
    }
    p.eat(TokenKind::Of);
    type_spec(p, context);
    p.complete(marker, NodeKind::ArrayType);
}

fn dimension(p: &mut Parser<'_>) {
    if p.at(TokenKind::Star) {
        let marker = p.start();
        p.bump();
        p.complete(marker, NodeKind::OpenDimension);
    } else {
        expressions::range_or_expression(p);
    }
}

/// `STRING`, `STRING[80]`, `STRING(N)`.
fn string(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    let close = match p.current() {
        TokenKind::LParen => TokenKind::RParen,
        TokenKind::LBracket => TokenKind::RBracket,
        _ => {
            p.complete(marker, NodeKind::StringType);
            return;
        }
    };
    p.bump();
    expressions::expression(p);
    p.expect(close);
    p.complete(marker, NodeKind::StringType);
}

/// `STRUCT … END_STRUCT`.
fn fields(p: &mut Parser<'_>, end: TokenKind, kind: NodeKind) {
    let marker = p.start();
    p.bump();
    if p.at(TokenKind::Overlap) && p.nth(1) != TokenKind::Colon {
        p.bump();
    }
    p.eat(TokenKind::Semicolon);
    p.within(end, |p| variables::variables(p, NodeKind::Field));
    if !p.eat(end) {
        p.missing_end(marker, end);
    }
    p.complete(marker, kind);
}

/// `(A, B := 2) UINT`.
fn enumeration(p: &mut Parser<'_>) {
    let marker = p.start();
    enum_values(p);
    // The next declaration's name is no base, even where the semicolon is missing.
    if is_name(p.current()) && !matches!(p.nth(1), TokenKind::Colon | TokenKind::Comma) {
        named_only(p);
    }
    p.complete(marker, NodeKind::EnumType);
}

fn enum_values(p: &mut Parser<'_>) {
    p.bump();
    while !matches!(p.current(), TokenKind::RParen | TokenKind::Semicolon | TokenKind::Eof) && !at_end(p) {
        enum_value(p);
        if p.eat(TokenKind::Comma) || p.at(TokenKind::RParen) {
            continue;
        }
        p.expected("`,` or `)`");
        let start = p.position();
        skip_while(p, |p| {
            let next = p.position() > start && p.begins_line() && is_name(p.current());
            !matches!(p.current(), TokenKind::Comma | TokenKind::RParen | TokenKind::Semicolon) && !next && !at_end(p)
        });
        if !p.eat(TokenKind::Comma) && p.position() == start && !is_name(p.current()) {
            break;
        }
    }
    p.expect(TokenKind::RParen);
}

fn enum_value(p: &mut Parser<'_>) {
    let marker = p.start();
    if is_name(p.current()) || p.current().is_keyword() {
        any_name(p);
    } else {
        name(p);
    }
    if p.eat(TokenKind::Assign) || p.eat(TokenKind::Equal) {
        expressions::expression(p);
    }
    p.complete(marker, NodeKind::EnumValue);
}

/// A type that is named, and nothing more.
fn named_only(p: &mut Parser<'_>) {
    let marker = p.start();
    opt_path(p);
    p.complete(marker, NodeKind::NamedType);
}

/// A named type, with what may follow it: a range, values, or the arguments of its constructor.
fn named(p: &mut Parser<'_>, context: Context) {
    let marker = p.start();
    let elementary = is_integer(p.nth_text(0)) && p.nth(1) == TokenKind::LParen;
    opt_path(p);
    let parens = p.at(TokenKind::LParen);
    if parens && context == Context::Variable && !elementary {
        expressions::argument_list(p);
    } else if p.at(TokenKind::LBracket) && context == Context::Variable {
        initializers::initial_value(p);
    }
    p.complete(marker, NodeKind::NamedType);
    if !p.at(TokenKind::LParen) || !parens {
        return;
    }
    let values = is_name(p.nth(1)) && matches!(p.nth(2), TokenKind::Comma | TokenKind::RParen | TokenKind::Assign);
    if values {
        enum_values(p);
        p.complete(marker, NodeKind::EnumType);
    } else {
        p.bump();
        expressions::range_or_expression(p);
        p.expect(TokenKind::RParen);
        p.complete(marker, NodeKind::SubrangeType);
    }
}

fn is_integer(word: &str) -> bool {
    const INTEGERS: [&str; 12] =
        ["SINT", "INT", "DINT", "LINT", "USINT", "UINT", "UDINT", "ULINT", "BYTE", "WORD", "DWORD", "LWORD"];
    INTEGERS.iter().any(|integer| integer.eq_ignore_ascii_case(word))
}
