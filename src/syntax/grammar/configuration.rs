//! Configurations: `config_decl`, `resource_decl`, `task_config`, `prog_config`.

use super::super::kind::{NodeKind, TokenKind};
use super::super::parser::Parser;
use super::declarations::{close, semicolon};
use super::names::{any_name, name, nth_is_name, path};
use super::{DECLARATION_ENDS, error_token, expressions, skip_while, types, variables};

/// `CONFIGURATION … END_CONFIGURATION`.
pub(super) fn configuration(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    name(p);
    parts(p, TokenKind::EndConfiguration);
    close(p, marker, TokenKind::EndConfiguration);
    p.complete(marker, NodeKind::Configuration);
}

/// `RESOURCE r ON cpu … END_RESOURCE`.
pub(super) fn resource(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    name(p);
    if p.eat(TokenKind::On) {
        path(p);
    }
    parts(p, TokenKind::EndResource);
    close(p, marker, TokenKind::EndResource);
    p.complete(marker, NodeKind::Resource);
}

fn parts(p: &mut Parser<'_>, end: TokenKind) {
    p.within(end, |p| {
        while !p.at(TokenKind::Eof) && !p.at_any(DECLARATION_ENDS) {
            match p.current() {
                TokenKind::Semicolon => p.bump(),
                TokenKind::Resource if end == TokenKind::EndConfiguration => resource(p),
                TokenKind::Task => task(p),
                TokenKind::Program => program(p),
                _ if variables::opt_section(p) => {}
                _ => {
                    p.expected("a resource, a task, a program or variables");
                    let before = p.position();
                    skip_to_part(p);
                    if p.position() == before {
                        error_token(p);
                    }
                }
            }
        }
    });
}

fn skip_to_part(p: &mut Parser<'_>) {
    skip_while(p, |p| {
        let part = matches!(p.current(), TokenKind::Resource | TokenKind::Task | TokenKind::Program)
            && p.begins_line()
            && nth_is_name(p, 1);
        !p.at(TokenKind::Semicolon) && !p.at_any(DECLARATION_ENDS) && !p.at_any(super::VAR_KEYWORDS) && !part
    });
}

/// `TASK t(INTERVAL := T#10ms, PRIORITY := 1);`
fn task(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    name(p);
    if p.at(TokenKind::LParen) {
        expressions::argument_list(p);
    }
    semicolon(p);
    p.complete(marker, NodeKind::Task);
}

/// `PROGRAM p WITH t : P(a := b);`
fn program(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    while matches!(p.current(), TokenKind::Retain | TokenKind::NonRetain) && nth_is_name(p, 1) {
        p.bump();
    }
    name(p);
    if p.eat(TokenKind::With) {
        if nth_is_name(p, 0) {
            any_name(p);
        } else {
            p.expected("the name of a task");
        }
    }
    if p.expect(TokenKind::Colon) {
        types::type_spec(p, types::Context::Variable);
    }
    semicolon(p);
    p.complete(marker, NodeKind::ProgramConfiguration);
}
