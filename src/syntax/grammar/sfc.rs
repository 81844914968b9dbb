//! Charts in text: `step`, `initial_step`, `action_association`, `transition`.

use super::super::kind::{NodeKind, TokenKind};
use super::super::parser::Parser;
use super::declarations::{body, close, semicolon};
use super::expressions::expression;
use super::names::{any_name, is_name, name};
use super::{DECLARATION_ENDS, expressions, skip_while};

/// Whether a step begins here: `STEP` or `INITIAL_STEP` and a name.
pub(super) fn at_step(p: &Parser<'_>) -> bool {
    matches!(p.current(), TokenKind::Step | TokenKind::InitialStep) && is_name(p.nth(1)) && p.nth(2) != TokenKind::Equal
}

/// Whether a transition between steps begins here, and not one that is declared by its name.
pub(super) fn transition_follows(p: &Parser<'_>) -> bool {
    let priority = |n| p.nth(n) == TokenKind::LParen && p.nth(n + 1) == TokenKind::Priority;
    let from = |n| p.nth(n) == TokenKind::From && (is_name(p.nth(n + 1)) || p.nth(n + 1) == TokenKind::LParen);
    from(1) || priority(1) || (is_name(p.nth(1)) && (from(2) || priority(2)))
}

/// `STEP s: Motor(N); Lamp(L, T#5s); END_STEP`.
pub(super) fn step(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    any_name(p);
    p.expect(TokenKind::Colon);
    p.within(TokenKind::EndStep, |p| {
        while !p.at(TokenKind::Eof) && !p.at_any(DECLARATION_ENDS) {
            if p.eat(TokenKind::Semicolon) {
                continue;
            }
            if !is_name(p.current()) || at_step(p) || (p.at(TokenKind::Transition) && transition_follows(p)) {
                break;
            }
            association(p);
        }
    });
    close(p, marker, TokenKind::EndStep);
    p.complete(marker, NodeKind::Step);
}

/// `Motor(N);`, `Lamp(L, T#5s, done);`, `Motor;`, and `Axis.Home(N);` for an action of an instance.
fn association(p: &mut Parser<'_>) {
    let marker = p.start();
    any_name(p);
    while p.at(TokenKind::Dot) && is_name(p.nth(1)) {
        p.bump();
        any_name(p);
    }
    if p.eat(TokenKind::LParen) {
        if is_name(p.current()) {
            p.bump_as(TokenKind::Ident);
        }
        while p.eat(TokenKind::Comma) {
            expression(p);
        }
        if !p.eat(TokenKind::RParen) {
            p.expected("`)`");
            skip_while(p, |p| {
                !matches!(p.current(), TokenKind::RParen | TokenKind::Semicolon) && !p.at_any(DECLARATION_ENDS)
            });
            p.eat(TokenKind::RParen);
        }
    }
    semicolon(p);
    p.complete(marker, NodeKind::ActionAssociation);
}

/// `TRANSITION t (PRIORITY := 1) FROM a TO (b, c) := condition; END_TRANSITION`; also one that is only declared.
pub(super) fn transition(p: &mut Parser<'_>) {
    let marker = p.start();
    p.bump();
    if is_name(p.current()) && !(p.at(TokenKind::From) && transition_begins(p)) {
        any_name(p);
    }
    priority(p);
    if p.eat(TokenKind::From) {
        step_names(p);
        p.expect(TokenKind::To);
        step_names(p);
        priority(p);
    }
    p.within(TokenKind::EndTransition, |p| {
        if p.eat(TokenKind::Assign) {
            expression(p);
            if !p.at(TokenKind::Semicolon) && !p.at(TokenKind::EndTransition) {
                p.expected("`;`");
                skip_while(p, |p| !p.at(TokenKind::Semicolon) && !p.at_any(DECLARATION_ENDS));
            }
            p.eat(TokenKind::Semicolon);
        } else {
            p.eat(TokenKind::Colon);
            body(p);
        }
    });
    close(p, marker, TokenKind::EndTransition);
    p.complete(marker, NodeKind::Transition);
}

fn transition_begins(p: &Parser<'_>) -> bool {
    is_name(p.nth(1)) || p.nth(1) == TokenKind::LParen
}

fn priority(p: &mut Parser<'_>) {
    if p.at(TokenKind::LParen) && p.nth(1) == TokenKind::Priority {
        expressions::argument_list(p);
    }
}

/// `a`, or `(a, b)`.
fn step_names(p: &mut Parser<'_>) {
    let marker = p.start();
    if p.eat(TokenKind::LParen) {
        while name(p) && p.eat(TokenKind::Comma) {}
        p.expect(TokenKind::RParen);
    } else {
        name(p);
    }
    p.complete(marker, NodeKind::StepNames);
}
