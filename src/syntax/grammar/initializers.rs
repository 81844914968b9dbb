//! Initial values: `array_init`, `struct_init`, `constant_expr`.
//!
//! The old lists without brackets (`1, 2, 5(0)`) are read as well; a list of one element without a repetition is
//! just an expression.

use super::super::kind::{NodeKind, TokenKind};
use super::super::parser::{Done, Parser};
use super::expressions;

/// What follows `:=` in a declaration.
pub(super) fn initial_value(p: &mut Parser<'_>) {
    let Some(first) = element(p) else { return };
    if !p.at(TokenKind::Comma) && p.kind_of(first) != NodeKind::RepeatInitializer {
        return;
    }
    let list = p.precede(first);
    while p.eat(TokenKind::Comma) {
        if element(p).is_none() {
            break;
        }
    }
    p.complete(list, NodeKind::ArrayInitializer);
}

/// `[1, 2, 3(0)]`.
pub(super) fn array(p: &mut Parser<'_>) -> Done {
    let marker = p.start();
    p.bump();
    let mut height = 0;
    while !matches!(p.current(), TokenKind::RBracket | TokenKind::Semicolon | TokenKind::Eof) {
        let Some(done) = element(p) else { break };
        height = height.max(done.height());
        if !p.eat(TokenKind::Comma) {
            break;
        }
    }
    p.expect(TokenKind::RBracket);
    p.finish(marker, NodeKind::ArrayInitializer, height)
}

/// One element of a list: a value, a repetition, or a structure.
fn element(p: &mut Parser<'_>) -> Option<Done> {
    let done = expressions::expression_or_structure(p)?;
    if !p.at(TokenKind::LParen) {
        return Some(done);
    }
    // `3(0)`, `N(0)` was read as a call already; only a literal comes here.
    let repeat = p.precede(done);
    p.bump();
    let mut height = done.height();
    while !matches!(p.current(), TokenKind::RParen | TokenKind::Semicolon | TokenKind::Eof) {
        let Some(Some(inner)) = p.deeper(element) else { break };
        height = height.max(inner.height());
        if !p.eat(TokenKind::Comma) {
            break;
        }
    }
    p.expect(TokenKind::RParen);
    Some(p.finish(repeat, NodeKind::RepeatInitializer, height))
}
