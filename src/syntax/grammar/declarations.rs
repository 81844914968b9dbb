//! Declarations: `function_decl`, `fb_decl`, `prog_decl`, `class_decl`, `interface_decl`, `method_decl`,
//! `namespace_decl`, `data_type_decl`; and the vendors' `PROPERTY` and `ACTION`.
//!
//! A soft keyword begins a declaration only where a name follows it, because no statement has two names in a row.

use super::super::kind::{NodeKind, TokenKind};
use super::super::parser::{Marker, Parser};
use super::super::set::TokenSet;
use super::names::{any_name, bump_name, keyword_may_be_name, name, nth_is_name, path};
use super::{
    DECLARATION_ENDS, STATEMENT_ENDS, VAR_KEYWORDS, configuration, error_token, events, il, sfc, siemens, statements,
    types, variables,
};

/// Any number of declarations, sections of variables, and bodies.
pub(super) fn file(p: &mut Parser<'_>) {
    while !p.at(TokenKind::Eof) {
        let before = p.position();
        item(p);
        if p.position() == before {
            p.error(format!("unexpected {}", p.current().describe()));
            error_token(p);
        }
    }
}

fn item(p: &mut Parser<'_>) {
    if opt_declaration(p) || variables::opt_section(p) || opt_stray_end(p) {
        return;
    }
    body(p);
}

/// A closing keyword that closes nothing.
fn opt_stray_end(p: &mut Parser<'_>) -> bool {
    let stray = p.at_any(DECLARATION_ENDS) && !p.is_open(p.current());
    if stray {
        p.error(format!("{} closes nothing", p.current().describe()));
        error_token(p);
        p.eat(TokenKind::Semicolon);
    }
    stray
}

/// What kind of declaration the current token begins.
pub(super) fn declaration_at(p: &Parser<'_>) -> Option<NodeKind> {
    let kind = match p.current() {
        TokenKind::FunctionBlock => NodeKind::FunctionBlock,
        TokenKind::Function => NodeKind::Function,
        TokenKind::Program => NodeKind::Program,
        TokenKind::Type => NodeKind::TypeBlock,
        TokenKind::OrganizationBlock => NodeKind::OrganizationBlock,
        TokenKind::DataBlock => NodeKind::DataBlock,
        TokenKind::Class => NodeKind::Class,
        TokenKind::Interface => NodeKind::Interface,
        TokenKind::Method => NodeKind::Method,
        TokenKind::Property | TokenKind::PropertyGet | TokenKind::PropertySet => NodeKind::Property,
        TokenKind::Action | TokenKind::Algorithm => NodeKind::Action,
        TokenKind::Actions => NodeKind::Actions,
        TokenKind::Transition if sfc::transition_follows(p) => return Some(NodeKind::Transition),
        TokenKind::Transition => NodeKind::Transition,
        TokenKind::Namespace => NodeKind::Namespace,
        TokenKind::Using => NodeKind::Using,
        TokenKind::Configuration => NodeKind::Configuration,
        TokenKind::Resource => NodeKind::Resource,
        _ => return None,
    };
    if p.current().is_hard_keyword() {
        let used_as_name = matches!(
            p.nth(1),
            TokenKind::Assign | TokenKind::Dot | TokenKind::Caret | TokenKind::LBracket | TokenKind::Equal
        );
        return (!used_as_name).then_some(kind);
    }
    // `method REF= x`, `step S= x`: the second name belongs to an operator.
    (nth_is_name(p, 1) && p.nth(2) != TokenKind::Equal).then_some(kind)
}

/// Whether the current token ends a body: a section of variables, a declaration, or what closes one.
pub(super) fn at_boundary(p: &Parser<'_>) -> bool {
    let kind = p.current();
    if kind == TokenKind::Eof || events::at_section(p) {
        return true;
    }
    if !kind.is_keyword() {
        return false;
    }
    if p.at_any(VAR_KEYWORDS) || DECLARATION_ENDS.contains(kind) || declaration_at(p).is_some() {
        return true;
    }
    accessor_at(p) || siemens::at_section(p)
}

fn opt_declaration(p: &mut Parser<'_>) -> bool {
    let Some(kind) = declaration_at(p) else { return false };
    if p.deeper(|p| declaration(p, kind)).is_none() {
        error_token(p);
    }
    true
}

fn declaration(p: &mut Parser<'_>, kind: NodeKind) {
    match kind {
        NodeKind::TypeBlock => types::type_block(p),
        NodeKind::Namespace => namespace(p),
        NodeKind::Using => using(p),
        NodeKind::Configuration => configuration::configuration(p),
        NodeKind::Resource => configuration::resource(p),
        NodeKind::Property => property(p),
        NodeKind::Transition => sfc::transition(p),
        NodeKind::Actions => actions(p),
        kind => pou(p, kind),
    }
}

const fn end_of(kind: NodeKind) -> TokenKind {
    match kind {
        NodeKind::Function => TokenKind::EndFunction,
        NodeKind::Program => TokenKind::EndProgram,
        NodeKind::Class => TokenKind::EndClass,
        NodeKind::Interface => TokenKind::EndInterface,
        NodeKind::OrganizationBlock => TokenKind::EndOrganizationBlock,
        NodeKind::DataBlock => TokenKind::EndDataBlock,
        NodeKind::Method => TokenKind::EndMethod,
        NodeKind::Action => TokenKind::EndAction,
        _ => TokenKind::EndFunctionBlock,
    }
}

/// A header, sections of variables, members and bodies, and the keyword that closes them.
fn pou(p: &mut Parser<'_>, kind: NodeKind) {
    let marker = p.start();
    let end = if p.at(TokenKind::Algorithm) { TokenKind::EndAlgorithm } else { end_of(kind) };
    p.bump();
    if kind == NodeKind::Action {
        action_name(p);
        algorithm_language(p);
        p.eat(TokenKind::Colon);
    } else {
        header(p);
    }
    p.within(end, |p| members(p, kind, end));
    close(p, marker, end);
    p.complete(marker, kind);
}

/// Takes the closing keyword, or says that it is missing.
pub(super) fn close(p: &mut Parser<'_>, marker: Marker, end: TokenKind) {
    if p.eat(end) {
        p.eat(TokenKind::Semicolon);
    } else if p.needs_end {
        p.missing_end(marker, end);
    }
}

/// Modifiers, the name, what it extends and implements, and the type of its result.
fn header(p: &mut Parser<'_>) {
    modifiers(p);
    declared_name(p);
    clauses(p);
    if p.eat(TokenKind::Colon) && (types::at_type(p) || !p.begins_line()) {
        types::type_spec(p, types::Context::Result);
    }
    clauses(p);
    p.eat(TokenKind::Semicolon);
}

/// The name of a POU; libraries of operators declare even `AND`.
fn declared_name(p: &mut Parser<'_>) {
    if keyword_may_be_name(p.current()) && p.nth(1) == TokenKind::Colon {
        any_name(p);
    } else {
        name(p);
    }
}

/// `IN ST` in the header of an algorithm.
fn algorithm_language(p: &mut Parser<'_>) {
    if p.nth_is_word(0, "IN") && nth_is_name(p, 1) && !p.begins_line() {
        p.bump();
        p.bump();
    }
}

/// The name of an action; one that stands apart from its POU may be `Pou.Action`.
fn action_name(p: &mut Parser<'_>) {
    if p.nth(1) != TokenKind::Dot {
        return declared_name(p);
    }
    let marker = p.start();
    bump_name(p);
    while p.at(TokenKind::Dot) && nth_is_name(p, 1) {
        p.bump();
        bump_name(p);
    }
    p.complete(marker, NodeKind::Name);
}

const MODIFIERS: TokenSet = TokenSet::new(&[
    TokenKind::Public,
    TokenKind::Private,
    TokenKind::Protected,
    TokenKind::Internal,
    TokenKind::Abstract,
    TokenKind::Final,
    TokenKind::Override,
]);

/// `PUBLIC`, `ABSTRACT` and the like, before the name; the last word before the name's end is the name.
pub(super) fn modifiers(p: &mut Parser<'_>) {
    let no_name = TokenSet::new(&[TokenKind::Extends, TokenKind::Implements]);
    while p.at_any(MODIFIERS) && nth_is_name(p, 1) && !no_name.contains(p.nth(1)) && !p.nth_begins_line(1) {
        p.bump();
    }
}

fn clauses(p: &mut Parser<'_>) {
    loop {
        let kind = match p.current() {
            TokenKind::Extends => NodeKind::ExtendsClause,
            TokenKind::Implements => NodeKind::ImplementsClause,
            _ => return,
        };
        let marker = p.start();
        p.bump();
        path(p);
        while p.eat(TokenKind::Comma) {
            path(p);
        }
        p.complete(marker, kind);
    }
}

/// Whether a declaration of `kind` may stand inside one of `outer`.
fn is_member(outer: NodeKind, kind: NodeKind) -> bool {
    let member = matches!(kind, NodeKind::Method | NodeKind::Property | NodeKind::Action | NodeKind::Transition);
    match outer {
        NodeKind::FunctionBlock | NodeKind::Program | NodeKind::Class | NodeKind::Interface => member,
        NodeKind::Function => matches!(kind, NodeKind::Action | NodeKind::Transition),
        _ => false,
    }
}

fn members(p: &mut Parser<'_>, kind: NodeKind, end: TokenKind) {
    siemens::block_properties(p);
    p.eat(TokenKind::Colon);
    while !p.at(TokenKind::Eof) && !p.at(end) {
        let before = p.position();
        member(p, kind, end);
        if p.position() == before {
            break;
        }
    }
}

/// One part of a declaration; takes nothing where the declaration has ended.
fn member(p: &mut Parser<'_>, kind: NodeKind, end: TokenKind) {
    if variables::opt_section(p) || siemens::opt_section(p) || events::opt_section(p) {
        return;
    }
    if let Some(inner) = declaration_at(p) {
        if is_member(kind, inner) {
            opt_declaration(p);
        } else if inner == NodeKind::Using {
            using(p);
        }
        return;
    }
    if p.at_any(DECLARATION_ENDS) {
        // One that closes an outer declaration ends this one too; one that closes nothing is skipped.
        if p.current() != end {
            opt_stray_end(p);
        }
        return;
    }
    body(p);
}

/// `ACTIONS pou … END_ACTIONS`: the actions of a POU that was declared before.
fn actions(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    if !p.at(TokenKind::Action) || !nth_is_name(p, 1) {
        name(p);
    }
    p.within(TokenKind::EndActions, |p| while declaration_at(p) == Some(NodeKind::Action) && opt_declaration(p) {});
    close(p, marker, TokenKind::EndActions);
    p.complete(marker, NodeKind::Actions);
}

/// Statements, steps or instructions.
pub(super) fn body(p: &mut Parser<'_>) {
    let marker = p.start();
    let before = p.position();
    body_elements(p);
    if p.position() > before {
        p.complete(marker, NodeKind::Body);
    }
}

/// What a body holds, up to where it ends.
pub(super) fn body_elements(p: &mut Parser<'_>) {
    if il::at_instruction(p) {
        return il::instruction_list(p, false);
    }
    let mut chart = false;
    while !at_end_of_body(p, chart) {
        let before = p.position();
        if p.at_any(STATEMENT_ENDS) {
            p.error(format!("{} closes nothing", p.current().describe()));
            error_token(p);
            p.eat(TokenKind::Semicolon);
        } else if sfc::at_step(p) {
            sfc::step(p);
            chart = true;
        } else if chart && p.at(TokenKind::Action) {
            opt_declaration(p);
        } else if p.at(TokenKind::Transition) && sfc::transition_follows(p) {
            sfc::transition(p);
            chart = true;
        } else {
            statements::statement(p);
        }
        if p.position() == before {
            p.error("expected a statement");
            error_token(p);
        }
    }
}

fn at_end_of_body(p: &Parser<'_>, chart: bool) -> bool {
    if !at_boundary(p) {
        return false;
    }
    match p.current() {
        TokenKind::Transition => !sfc::transition_follows(p),
        TokenKind::Action => !chart,
        _ => true,
    }
}

fn namespace(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    modifiers(p);
    path(p);
    p.eat(TokenKind::Semicolon);
    p.within(TokenKind::EndNamespace, |p| {
        while !p.at(TokenKind::Eof) && !p.at(TokenKind::EndNamespace) {
            let before = p.position();
            item(p);
            if p.position() == before {
                break;
            }
        }
    });
    close(p, marker, TokenKind::EndNamespace);
    p.complete(marker, NodeKind::Namespace);
}

fn using(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    path(p);
    while p.eat(TokenKind::Comma) {
        path(p);
    }
    semicolon(p);
    p.complete(marker, NodeKind::Using);
}

/// Takes `;`, or says that it is missing.
pub(super) fn semicolon(p: &mut Parser<'_>) {
    if !p.eat(TokenKind::Semicolon) {
        p.missing_semicolon();
    }
}

fn accessor_at(p: &Parser<'_>) -> bool {
    let keyword = matches!(p.current(), TokenKind::Get | TokenKind::Set);
    let used_as_name = matches!(
        p.nth(1),
        TokenKind::Assign
            | TokenKind::Dot
            | TokenKind::LParen
            | TokenKind::Caret
            | TokenKind::LBracket
            | TokenKind::Equal
            | TokenKind::Comma
    );
    keyword && !used_as_name && p.is_open(TokenKind::EndProperty)
}

/// A property: its header, and its accessors.
fn property(p: &mut Parser<'_>) {
    let marker = p.start();
    let end = match p.current() {
        TokenKind::PropertyGet => TokenKind::EndPropertyGet,
        TokenKind::PropertySet => TokenKind::EndPropertySet,
        _ => TokenKind::EndProperty,
    };
    p.bump();
    header(p);
    p.within(TokenKind::EndProperty, |p| p.within(end, |p| property_parts(p, end)));
    if end != TokenKind::EndProperty && p.at(TokenKind::EndProperty) {
        p.bump();
        p.eat(TokenKind::Semicolon);
    } else {
        close(p, marker, end);
    }
    p.complete(marker, NodeKind::Property);
}

fn property_parts(p: &mut Parser<'_>, end: TokenKind) {
    while !p.at(TokenKind::Eof) && !p.at(end) && !p.at(TokenKind::EndProperty) {
        let before = p.position();
        if accessor_at(p) {
            accessor(p);
        } else {
            member(p, NodeKind::Property, end);
        }
        if p.position() == before {
            break;
        }
    }
}

fn accessor(p: &mut Parser<'_>) {
    let marker = p.start();
    let end = if p.at(TokenKind::Get) { TokenKind::EndGet } else { TokenKind::EndSet };
    p.bump();
    while p.at_any(MODIFIERS) {
        p.bump();
    }
    // An interface's property only says that the accessor is there.
    p.eat(TokenKind::Semicolon);
    p.within(end, |p| {
        while !p.at(TokenKind::Eof) && !p.at(end) && !p.at(TokenKind::EndProperty) && !accessor_at(p) {
            let before = p.position();
            member(p, NodeKind::Accessor, end);
            if p.position() == before {
                break;
            }
        }
    });
    if p.eat(end) {
        p.eat(TokenKind::Semicolon);
    }
    p.complete(marker, NodeKind::Accessor);
}
