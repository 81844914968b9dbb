//! Instruction List: `instruction_list`, `il_instruction`, `il_simple_operation`, `il_expr`, `il_fb_call`,
//! `il_formal_func_call`, `il_jump_operation`.
//!
//! A line is an instruction. The operator is a word (with its modifiers `N`, `C`); the operand is an expression
//! without infix operators, because the next line may begin with `AND`.

use super::super::kind::{NodeKind, TokenKind};
use super::super::parser::Parser;
use super::declarations::at_boundary;
use super::expressions;
use super::names::{any_name, is_name};
use super::{error_token, skip_while};

/// Whether the body that begins here is a list of instructions: its first line (after a label) has an operator
/// and an operand, which no statement begins with.
pub(super) fn at_instruction(p: &Parser<'_>) -> bool {
    let n = if is_name(p.current()) && p.nth(1) == TokenKind::Colon { 2 } else { 0 };
    match p.nth(n) {
        TokenKind::And | TokenKind::Or | TokenKind::Xor | TokenKind::Mod => true,
        kind if is_name(kind) && is_operator(p.nth_text(n)) => {
            let operand = p.nth(n + 1);
            let begins_operand = is_name(operand)
                || operand.is_literal()
                || matches!(operand, TokenKind::TypePrefix | TokenKind::Address);
            begins_operand && !p.nth_begins_line(n + 1) && p.nth(n + 2) != TokenKind::Equal
        }
        _ => false,
    }
}

fn is_operator(word: &str) -> bool {
    const OPERATORS: [&str; 36] = [
        "LD", "LDN", "ST", "STN", "S", "R", "S1", "R1", "CLK", "CU", "CD", "PV", "IN", "PT", "ANDN", "ORN", "XORN",
        "ADD", "SUB", "MUL", "DIV", "GT", "GE", "EQ", "NE", "LE", "LT", "JMP", "JMPC", "JMPCN", "CAL", "CALC", "CALCN",
        "RET", "RETC", "RETCN",
    ];
    OPERATORS.iter().any(|operator| operator.eq_ignore_ascii_case(word))
}

/// Whether `word` may open a parenthesis that holds instructions.
fn opens_list(word: &str) -> bool {
    const OPENERS: [&str; 18] = [
        "AND", "ANDN", "&", "&N", "OR", "ORN", "XOR", "XORN", "ADD", "SUB", "MUL", "DIV", "MOD", "GT", "GE", "EQ",
        "NE", "LE",
    ];
    OPENERS.iter().any(|opener| opener.eq_ignore_ascii_case(word)) || word.eq_ignore_ascii_case("LT")
}

/// Instructions up to the end of the body; `to_end` says that only the text's end is one.
pub(super) fn instruction_list(p: &mut Parser<'_>, to_end: bool) {
    let marker = p.start();
    loop {
        if p.at(TokenKind::Eof) || (!to_end && at_boundary(p)) {
            break;
        }
        let before = p.position();
        instruction(p);
        if p.position() == before {
            p.expected("an instruction");
            error_token(p);
        }
    }
    p.complete(marker, NodeKind::InstructionList);
}

/// One line: `label: OP operand, operand`.
fn instruction(p: &mut Parser<'_>) {
    if p.eat(TokenKind::Semicolon) {
        return;
    }
    let marker = p.start();
    if is_name(p.current()) && p.nth(1) == TokenKind::Colon {
        any_name(p);
        p.bump();
        if p.begins_line() {
            p.complete(marker, NodeKind::Instruction);
            return;
        }
    }
    let opens = opens_list(p.nth_text(0));
    if operator(p) {
        operands(p, opens);
    }
    end_of_line(p);
    p.complete(marker, NodeKind::Instruction);
}

/// `AND`, `LDN`, or the name of a function or method.
fn operator(p: &mut Parser<'_>) -> bool {
    match p.current() {
        TokenKind::And | TokenKind::Or | TokenKind::Xor | TokenKind::Mod | TokenKind::Not | TokenKind::Ampersand => {
            p.bump_as(TokenKind::Ident);
        }
        kind if is_name(kind) => {
            p.bump_as(TokenKind::Ident);
            while p.at(TokenKind::Dot) && (is_name(p.nth(1)) || p.nth(1).is_keyword()) {
                p.bump();
                p.bump_as(TokenKind::Ident);
            }
        }
        _ => return false,
    }
    true
}

fn operands(p: &mut Parser<'_>, opens: bool) {
    if p.at(TokenKind::LParen) && !p.begins_line() {
        if opens {
            nested(p);
        } else {
            expressions::argument_list(p);
        }
        return;
    }
    while !p.begins_line() && !p.at(TokenKind::Semicolon) && !p.at(TokenKind::Eof) {
        if expressions::unary(p).is_none() || !p.eat(TokenKind::Comma) {
            break;
        }
    }
}

/// `( operand`, instructions, `)`.
fn nested(p: &mut Parser<'_>) {
    p.bump();
    if !p.begins_line() && !p.at(TokenKind::RParen) {
        expressions::unary(p);
    }
    let deep = p.deeper(|p| {
        while !matches!(p.current(), TokenKind::RParen | TokenKind::Eof) && !at_boundary(p) {
            let before = p.position();
            instruction(p);
            if p.position() == before {
                break;
            }
        }
    });
    if deep.is_none() {
        skip_while(p, |p| !at_boundary(p));
    }
    p.expect(TokenKind::RParen);
}

/// Nothing but `;` may follow on the line.
fn end_of_line(p: &mut Parser<'_>) {
    p.eat(TokenKind::Semicolon);
    if !p.begins_line() && !matches!(p.current(), TokenKind::Eof | TokenKind::RParen) && !at_boundary(p) {
        p.expected("the end of the line");
        skip_while(p, |p| !p.begins_line() && !at_boundary(p));
    }
}
