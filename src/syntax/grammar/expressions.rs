//! Expressions: `expression`, `xor_expr`, `and_expr`, `compare_expr`, `equ_expr`, `add_expr`, `term`, `power_expr`,
//! `unary_expr`, `primary_expr`, `variable`, `func_call`, `param_assign`.
//!
//! Binary operators are read by precedence climbing (Pratt), with the ranks of the standard's table of operators;
//! all of them associate to the left, `**` too. Negation and `NOT` bind more tightly than `**`, as the table has it.

use super::super::kind::{NodeKind, TokenKind};
use super::super::parser::{Done, Marker, Parser};
use super::super::set::TokenSet;
use super::initializers;
use super::names::{bump_name, is_name};

/// An expression, or an error where none begins.
pub(super) fn expression(p: &mut Parser<'_>) -> Option<Done> {
    binary(p, 0)
}

/// An expression, or `a..b`.
pub(super) fn range_or_expression(p: &mut Parser<'_>) -> Option<Done> {
    let first = expression(p)?;
    if !p.at(TokenKind::DotDot) {
        return Some(first);
    }
    let range = p.precede(first);
    p.bump();
    let height = expression(p).map_or(0, Done::height).max(first.height());
    Some(p.finish(range, NodeKind::Range, height))
}

/// What is assigned: an expression, or another assignment (`a := b := c`).
pub(super) fn assigned_value(p: &mut Parser<'_>) -> Option<Done> {
    let first = expression(p)?;
    if opt_assignment_operator(p) { assignment(p, first) } else { Some(first) }
}

/// The rest of `target := value`, from behind the operator on.
fn assignment(p: &mut Parser<'_>, target: Done) -> Option<Done> {
    let marker = p.precede(target);
    let value = p.deeper(assigned_value).flatten();
    let height = value.map_or(0, Done::height).max(target.height());
    Some(p.finish(marker, NodeKind::AssignExpression, height))
}

/// `:=`, `?=`, `+=`, …; `REF=`, `S=`, `R=`, which are two tokens.
pub(super) fn opt_assignment_operator(p: &mut Parser<'_>) -> bool {
    let length = match p.current() {
        TokenKind::Assign
        | TokenKind::TryAssign
        | TokenKind::PlusAssign
        | TokenKind::MinusAssign
        | TokenKind::StarAssign
        | TokenKind::SlashAssign => 1,
        TokenKind::Ref | TokenKind::S | TokenKind::R if p.nth(1) == TokenKind::Equal && p.nth_is_joined(0) => 2,
        _ => 0,
    };
    for _ in 0..length {
        p.bump();
    }
    length > 0
}

/// How tightly a binary operator binds; `None` for what is none.
const fn rank(kind: TokenKind) -> Option<u8> {
    let rank = match kind {
        TokenKind::Or | TokenKind::OrElse => 1,
        TokenKind::Xor => 2,
        TokenKind::And | TokenKind::Ampersand | TokenKind::AndThen => 3,
        TokenKind::Equal | TokenKind::NotEqual => 4,
        TokenKind::Less | TokenKind::LessEqual | TokenKind::Greater | TokenKind::GreaterEqual => 5,
        TokenKind::Plus | TokenKind::Minus => 6,
        TokenKind::Star | TokenKind::Slash | TokenKind::Mod => 7,
        TokenKind::Power => 8,
        _ => return None,
    };
    Some(rank)
}

fn binary(p: &mut Parser<'_>, above: u8) -> Option<Done> {
    let mut left = unary(p)?;
    while let Some(rank) = rank(p.current()) {
        if rank <= above {
            break;
        }
        if !p.may_grow(left.height()) {
            p.too_deep();
            break;
        }
        let marker = p.precede(left);
        if matches!(p.nth_text(0), "==" | "!=") {
            p.foreign_operator();
        }
        p.bump();
        let right = binary(p, rank);
        let height = right.map_or(0, Done::height).max(left.height());
        left = p.finish(marker, NodeKind::BinaryExpression, height);
        right?;
    }
    Some(left)
}

/// `-a`, `+a`, `NOT a`, and what they stand before.
pub(super) fn unary(p: &mut Parser<'_>) -> Option<Done> {
    if !matches!(p.current(), TokenKind::Minus | TokenKind::Plus | TokenKind::Not | TokenKind::Ampersand) {
        return postfix(p);
    }
    let marker = p.start();
    p.bump();
    let operand = p.deeper(unary).flatten()?;
    Some(p.finish(marker, NodeKind::UnaryExpression, operand.height()))
}

/// `symbolic_variable`: a primary with fields, indices, `^` and calls behind it.
pub(super) fn variable(p: &mut Parser<'_>) -> Option<Done> {
    postfix(p)
}

fn postfix(p: &mut Parser<'_>) -> Option<Done> {
    let mut done = primary(p)?;
    if p.kind_of(done) == NodeKind::Literal {
        return Some(done);
    }
    while matches!(p.current(), TokenKind::Dot | TokenKind::Caret | TokenKind::LBracket | TokenKind::LParen) {
        if !p.may_grow(done.height()) {
            p.too_deep();
            break;
        }
        let marker = p.precede(done);
        done = match p.current() {
            TokenKind::Dot => field(p, marker, done),
            TokenKind::Caret => {
                p.bump();
                p.finish(marker, NodeKind::DerefExpression, done.height())
            }
            TokenKind::LBracket => index(p, marker, done),
            _ => {
                let height = argument_list(p).height().max(done.height());
                p.finish(marker, NodeKind::CallExpression, height)
            }
        };
    }
    Some(done)
}

/// `.name`, `.3`, `.%X3`, `.Type#Value`.
fn field(p: &mut Parser<'_>, marker: Marker, base: Done) -> Done {
    p.bump();
    let kind = match p.current() {
        TokenKind::Integer | TokenKind::Real | TokenKind::Address => {
            p.bump();
            NodeKind::BitExpression
        }
        TokenKind::TypePrefix => {
            p.bump();
            if is_name(p.current()) {
                bump_name(p);
            }
            NodeKind::EnumLiteral
        }
        // A keyword on the next line begins a statement; the field's name is still missing.
        kind if is_name(kind) || kind == TokenKind::Hash || (kind.is_keyword() && !p.begins_line()) => {
            bump_name(p);
            NodeKind::FieldExpression
        }
        _ => {
            p.expected("the name of a field");
            NodeKind::FieldExpression
        }
    };
    p.finish(marker, kind, base.height())
}

fn index(p: &mut Parser<'_>, marker: Marker, base: Done) -> Done {
    let mut height = base.height();
    p.bump();
    while let Some(done) = p.deeper(range_or_expression).flatten() {
        height = height.max(done.height());
        if !p.eat(TokenKind::Comma) {
            break;
        }
    }
    p.expect(TokenKind::RBracket);
    p.finish(marker, NodeKind::IndexExpression, height)
}

const LITERALS: TokenSet = TokenSet::new(&[
    TokenKind::Integer,
    TokenKind::Based,
    TokenKind::Real,
    TokenKind::String,
    TokenKind::Duration,
    TokenKind::Date,
    TokenKind::TimeOfDay,
    TokenKind::DateAndTime,
    TokenKind::True,
    TokenKind::False,
]);

/// Hard keywords that people use as names where their compiler lets them.
const DARING_NAMES: TokenSet = TokenSet::new(&[
    TokenKind::Type,
    TokenKind::Program,
    TokenKind::Function,
    TokenKind::Struct,
    TokenKind::To,
    TokenKind::By,
    TokenKind::Of,
    TokenKind::Do,
    TokenKind::Exit,
]);

/// Whether a hard keyword stands here as a name: what follows it only follows names.
pub(super) fn at_daring_name(p: &Parser<'_>) -> bool {
    p.at_any(DARING_NAMES)
        && matches!(p.nth(1), TokenKind::Assign | TokenKind::Dot | TokenKind::LBracket | TokenKind::Caret)
}

fn primary(p: &mut Parser<'_>) -> Option<Done> {
    match p.current() {
        TokenKind::WString => Some(string_or_name(p)),
        kind if LITERALS.contains(kind) => Some(token(p, NodeKind::Literal)),
        TokenKind::Null if p.nth(1) != TokenKind::Dot => Some(token(p, NodeKind::Literal)),
        TokenKind::TypePrefix if at_pointer(p) => Some(pointer(p)),
        TokenKind::TypePrefix => Some(typed(p)),
        TokenKind::Address => Some(address(p)),
        TokenKind::This => Some(token(p, NodeKind::ThisExpression)),
        TokenKind::Super => Some(token(p, NodeKind::SuperExpression)),
        TokenKind::LParen => p.deeper(|p| parens(p, false)).flatten(),
        TokenKind::LBracket => p.deeper(initializers::array),
        TokenKind::Hash if is_name(p.nth(1)) || p.nth(1).is_keyword() => Some(name(p)),
        TokenKind::Dot if is_name(p.nth(1)) => Some(global_name(p)),
        kind if is_name(kind) && rank(kind).is_none() => Some(name(p)),
        _ if at_daring_name(p) => Some(name(p)),
        _ => {
            p.expected("an expression");
            None
        }
    }
}

fn token(p: &mut Parser<'_>, kind: NodeKind) -> Done {
    let marker = p.start();
    p.bump();
    p.complete(marker, kind)
}

fn name(p: &mut Parser<'_>) -> Done {
    let marker = p.start();
    bump_name(p);
    p.complete(marker, NodeKind::NameExpression)
}

/// `.x`: a global variable that a local one hides (CODESYS V2.3).
fn global_name(p: &mut Parser<'_>) -> Done {
    let marker = p.start();
    p.bump();
    bump_name(p);
    p.complete(marker, NodeKind::NameExpression)
}

/// Text in double quotes: a name where a name's continuation follows, or where the dialect says so.
fn string_or_name(p: &mut Parser<'_>) -> Done {
    let continues = matches!(p.nth(1), TokenKind::Dot | TokenKind::LParen | TokenKind::LBracket | TokenKind::Assign);
    if !p.options.quoted_names && !continues && !peripheral_follows(p) {
        return token(p, NodeKind::Literal);
    }
    let marker = p.start();
    bump_name(p);
    opt_peripheral(p);
    p.complete(marker, NodeKind::NameExpression)
}

fn address(p: &mut Parser<'_>) -> Done {
    let marker = p.start();
    p.bump();
    opt_peripheral(p);
    p.complete(marker, NodeKind::AddressExpression)
}

/// Whether `:P` follows without a blank: the module itself, not the process image (Siemens).
pub(super) fn peripheral_follows(p: &Parser<'_>) -> bool {
    p.nth(1) == TokenKind::Colon && p.nth_is_joined(0) && p.nth_is_joined(1) && p.nth_is_word(2, "P")
}

/// `:P` behind what was just taken.
fn opt_peripheral(p: &mut Parser<'_>) {
    if p.at(TokenKind::Colon) && p.nth_is_joined(0) && p.nth_is_word(1, "P") {
        p.bump();
        p.bump();
    }
}

/// Whether `P#` stands here and an address behind it, and not a value of a type `P` (Siemens).
fn at_pointer(p: &Parser<'_>) -> bool {
    p.nth_is_word(0, "P#")
        && (matches!(p.nth(1), TokenKind::Real | TokenKind::Integer | TokenKind::WString | TokenKind::Address)
            || matches!(p.nth(2), TokenKind::Dot | TokenKind::Real))
}

/// `P#M10.0`, `P#DB1.DBX0.0 BYTE 10`, `P#E 0.0 WORD 4`: a place in memory, and how much of it.
fn pointer(p: &mut Parser<'_>) -> Done {
    let marker = p.start();
    p.bump_as(TokenKind::Address);
    let mut joined = true;
    while joined && !p.at(TokenKind::Eof) {
        joined = p.nth_is_joined(0)
            && matches!(
                p.nth(1),
                TokenKind::Dot | TokenKind::Real | TokenKind::Integer | TokenKind::Ident | TokenKind::WString
            );
        p.bump();
    }
    p.eat(TokenKind::Real);
    if is_name(p.current()) && p.nth(1) == TokenKind::Integer && !p.begins_line() {
        p.bump();
        p.bump();
    }
    p.complete(marker, NodeKind::AddressExpression)
}

/// `INT#-5`, `WORD#16#FF`, `STRING#'x'`, `Colour#Red`.
fn typed(p: &mut Parser<'_>) -> Done {
    let marker = p.start();
    p.bump();
    if matches!(p.current(), TokenKind::Plus | TokenKind::Minus) {
        p.bump();
    }
    if LITERALS.contains(p.current()) || p.at(TokenKind::WString) {
        p.bump();
        return p.complete(marker, NodeKind::Literal);
    }
    if is_name(p.current()) || p.current().is_keyword() {
        bump_name(p);
    } else {
        p.expected("a literal or a value");
    }
    p.complete(marker, NodeKind::EnumLiteral)
}

/// An initial value: like an expression, but `(a := 1)` is a structure.
pub(super) fn expression_or_structure(p: &mut Parser<'_>) -> Option<Done> {
    if p.at(TokenKind::LParen) && names_an_argument(p, 1) {
        return p.deeper(|p| parens(p, true)).flatten();
    }
    expression(p)
}

/// Whether a name and `:=` or `=>` stand `n` tokens on.
fn names_an_argument(p: &Parser<'_>, n: u32) -> bool {
    let named = is_name(p.nth(n)) || p.nth(n).is_keyword();
    named && matches!(p.nth(n + 1), TokenKind::Assign | TokenKind::Arrow)
}

/// `(a)`, `(a := b)` as an expression, or `(a := 1, b := 2)`.
fn parens(p: &mut Parser<'_>, structure: bool) -> Option<Done> {
    let marker = p.start();
    let named = names_an_argument(p, 1);
    p.bump();
    if !named {
        let inner = assigned_value(p);
        if inner.is_some() && p.at(TokenKind::Comma) {
            return Some(positional_structure(p, marker, inner));
        }
        close(p);
        return Some(p.finish(marker, NodeKind::ParenExpression, inner.map_or(0, Done::height)));
    }
    let target = name(p);
    p.bump();
    let value = value_of_argument(p);
    let height = value.map_or(0, Done::height).max(target.height());
    let first = p.precede(target);
    if !structure && p.at(TokenKind::RParen) {
        let inner = p.finish(first, NodeKind::AssignExpression, height);
        p.bump();
        return Some(p.finish(marker, NodeKind::ParenExpression, inner.height()));
    }
    p.change_kind(target, NodeKind::Name);
    let argument = p.finish(first, NodeKind::Argument, height);
    let mut height = argument.height();
    while p.eat(TokenKind::Comma) {
        if p.at(TokenKind::RParen) {
            break;
        }
        height = height.max(opt_argument(p).map_or(0, Done::height));
    }
    close(p);
    Some(p.finish(marker, NodeKind::StructInitializer, height))
}

/// `(1, 2)`: a list in parentheses.
fn positional_structure(p: &mut Parser<'_>, marker: Marker, first: Option<Done>) -> Done {
    let mut height = first.map_or(0, Done::height);
    while p.eat(TokenKind::Comma) {
        height = height.max(opt_argument(p).map_or(0, Done::height));
    }
    close(p);
    p.finish(marker, NodeKind::StructInitializer, height)
}

/// Takes `)`, after what does not belong before it.
fn close(p: &mut Parser<'_>) {
    if p.eat(TokenKind::RParen) {
        return;
    }
    p.expected("`)`");
    super::statements::skip_in_statement(p, &[TokenKind::RParen]);
    p.eat(TokenKind::RParen);
}

/// `(a, b := 1, c => d)`.
pub(super) fn argument_list(p: &mut Parser<'_>) -> Done {
    let marker = p.start();
    p.bump();
    let mut height = 0;
    while !matches!(p.current(), TokenKind::RParen | TokenKind::Eof) {
        let before = p.position();
        height = height.max(opt_argument(p).map_or(0, Done::height));
        if p.eat(TokenKind::Comma) {
            continue;
        }
        if !p.at(TokenKind::RParen) {
            p.expected("`,` or `)`");
            super::statements::skip_in_statement(p, &[TokenKind::RParen, TokenKind::Comma]);
            if !p.eat(TokenKind::Comma) || p.position() == before {
                break;
            }
        }
    }
    p.eat(TokenKind::RParen);
    p.finish(marker, NodeKind::ArgumentList, height)
}

/// `x`, `a := x`, `a :=`, `b => y`, `NOT b => y`; an empty argument before a comma, which keeps its position.
fn opt_argument(p: &mut Parser<'_>) -> Option<Done> {
    let marker = p.start();
    if p.at(TokenKind::Comma) {
        return Some(p.finish(marker, NodeKind::Argument, 0));
    }
    let negated = p.at(TokenKind::Not) && p.nth(2) == TokenKind::Arrow;
    if negated {
        p.bump();
    }
    let n = u32::from(p.at(TokenKind::Hash));
    let value = if negated || names_an_argument(p, n) {
        let name = p.start();
        bump_name(p);
        p.complete(name, NodeKind::Name);
        p.bump();
        value_of_argument(p)
    } else {
        p.deeper(assigned_value).flatten()
    };
    Some(p.finish(marker, NodeKind::Argument, value.map_or(1, Done::height)))
}

/// What follows `:=` or `=>`: often nothing.
fn value_of_argument(p: &mut Parser<'_>) -> Option<Done> {
    if matches!(p.current(), TokenKind::Comma | TokenKind::RParen) {
        return None;
    }
    let value = p.deeper(expression_or_structure).flatten()?;
    if opt_assignment_operator(p) { assignment(p, value) } else { Some(value) }
}
