//! The parts of a cell: which of its forms each one takes.

use super::ast::{Arm, BinaryOp, Chunk, ChunkKind, Constraint, Expr, ExprKind, Interval, Predicate};
use super::expression::Parser;
use super::lexer::Token;
use super::{CellError, Context};
use crate::table::piece::Piece;
use crate::text::Span;

type Result<T> = std::result::Result<T, CellError>;

pub(super) fn cell(piece: &Piece<'_>, context: &Context) -> Result<Constraint> {
    let mut parser = Parser::new(piece, context)?;
    let mut chunks = vec![chunk(&mut parser)?];
    while parser.eat(&Token::Comma) {
        chunks.push(chunk(&mut parser)?);
    }
    parser.end()?;
    if context.arguments > 1 {
        chunks.iter_mut().try_for_each(predicate)?;
    }
    Ok(Constraint { chunks })
}

fn chunk(parser: &mut Parser<'_>) -> Result<Chunk> {
    let start = parser.span();
    let kind = kind(parser)?;
    Ok(Chunk { kind, span: start.cover(parser.last_span()) })
}

/// Whether the cursor stands before the end of a part.
fn ends(token: &Token) -> bool {
    matches!(token, Token::Comma | Token::End | Token::Guard | Token::Fi)
}

fn kind(parser: &mut Parser<'_>) -> Result<ChunkKind> {
    if let Some(inner) = short_trigger(parser) {
        return Ok(inner);
    }
    match parser.peek().clone() {
        Token::Dash | Token::Minus if ends(parser.peek_at(1)) => {
            parser.bump();
            Ok(ChunkKind::Any)
        }
        Token::Trigger => {
            parser.bump();
            let inner = parser.nested(chunk)?;
            if inner.is_trigger() {
                return Err(CellError::new(inner.span, "a trigger of a trigger means nothing"));
            }
            Ok(ChunkKind::Trigger(Box::new(inner)))
        }
        Token::If => guarded(parser),
        Token::Open | Token::OpenBracket if parser.interval_follows() => interval(parser),
        Token::OpenBracket => Err(CellError::new(parser.span(), "an interval has two ends")
            .help("write `[1, 5]`, or `[7, ∞]` where a side is open")),
        Token::Binary(op) if op.is_comparison() && !parser.partial_follows() => {
            parser.bump();
            Ok(ChunkKind::Compare(op, parser.expression()?))
        }
        _ => {
            parser.partial = parser.partial_follows();
            let expr = parser.expression();
            parser.partial = false;
            let expr = expr?;
            Ok(if expr.is_condition() { ChunkKind::Condition(expr) } else { ChunkKind::Value(expr) })
        }
    }
}

/// `vT`, `vFALSE`: how the papers' trigger looks where the sign is missing on the keyboard.
fn short_trigger(parser: &mut Parser<'_>) -> Option<ChunkKind> {
    let Token::Name(None, name) = parser.peek() else { return None };
    let value = match name.as_str() {
        "vT" | "vTRUE" => true,
        "vF" | "vFALSE" => false,
        _ => return None,
    };
    if !ends(parser.peek_at(1)) || parser.context.declared.contains(&name.to_ascii_uppercase()) {
        return None;
    }
    let text = name[1..].to_owned();
    let span = parser.span();
    parser.bump();
    let literal = super::ast::Literal { value: super::ast::LiteralValue::Bool(value), text };
    let inner = Expr { kind: ExprKind::Literal(literal), span: Span::new(span.start + 1, span.end) };
    let inner = Chunk { span: inner.span, kind: ChunkKind::Value(inner) };
    Some(ChunkKind::Trigger(Box::new(inner)))
}

fn guarded(parser: &mut Parser<'_>) -> Result<ChunkKind> {
    parser.bump();
    let mut arms = Vec::new();
    while parser.eat(&Token::Guard) {
        let guard = parser.guard()?;
        let then = parser.nested(chunk)?;
        if then.is_trigger() {
            return Err(CellError::new(then.span, "a trigger may not stand inside `if … fi`"));
        }
        arms.push(Arm { guard, then });
    }
    if arms.is_empty() {
        return Err(parser.unexpected("`::`"));
    }
    parser.expect(&Token::Fi, "`::` or `fi`")?;
    if ends(parser.peek()) {
        return Ok(ChunkKind::Guarded(arms));
    }
    Err(CellError::new(parser.span(), "`if … fi` is a whole part of the cell here")
        .help("put parentheses round `if … fi` to use it inside an expression"))
}

fn interval(parser: &mut Parser<'_>) -> Result<ChunkKind> {
    let low_closed = *parser.peek() == Token::OpenBracket;
    parser.bump();
    let low = interval_end(parser)?;
    parser.expect(&Token::Comma, "`,`")?;
    let high = interval_end(parser)?;
    let high_closed = *parser.peek() == Token::CloseBracket;
    if !high_closed && *parser.peek() != Token::Close {
        return Err(parser.unexpected("`]` or `)`"));
    }
    parser.bump();
    Ok(ChunkKind::Interval(Box::new(Interval { low, low_closed, high, high_closed })))
}

/// One end of an interval; `None` where it is open to infinity.
fn interval_end(parser: &mut Parser<'_>) -> Result<Option<Expr>> {
    let signed = matches!(parser.peek(), Token::Minus | Token::Dash | Token::Plus);
    let infinite = *parser.peek_at(usize::from(signed)) == Token::Infinity;
    if infinite {
        (0..=usize::from(signed)).for_each(|_| parser.bump());
        return Ok(None);
    }
    let closes = matches!(parser.peek_at(1), Token::Comma | Token::CloseBracket | Token::Close);
    if closes && matches!(parser.peek(), Token::Minus | Token::Dash | Token::Star) {
        parser.bump();
        return Ok(None);
    }
    parser.expression().map(Some)
}

/// In a column with several arguments: the part names a predicate over them.
fn predicate(chunk: &mut Chunk) -> Result<()> {
    let error = |span| {
        CellError::new(span, "a cell of a column with several arguments names a predicate")
            .help("`-`, `eq`, `neq`, `lt`, `leq`, `gt`, `geq`, or a function of the table")
    };
    let name = match &chunk.kind {
        ChunkKind::Any => return Ok(()),
        ChunkKind::Trigger(inner) => {
            let mut inner = inner.as_ref().clone();
            predicate(&mut inner)?;
            chunk.kind = ChunkKind::Trigger(Box::new(inner));
            return Ok(());
        }
        ChunkKind::Value(Expr { kind: ExprKind::Name(path), .. }) if path.is_plain() => path.name.clone(),
        _ => return Err(error(chunk.span)),
    };
    chunk.kind = ChunkKind::Predicate(named_predicate(&name));
    Ok(())
}

fn named_predicate(name: &str) -> Predicate {
    match name {
        "leq" => Predicate::Compare(BinaryOp::Le),
        "geq" => Predicate::Compare(BinaryOp::Ge),
        "eq" => Predicate::Compare(BinaryOp::Eq),
        "neq" => Predicate::Compare(BinaryOp::Ne),
        "gt" => Predicate::Compare(BinaryOp::Gt),
        "lt" => Predicate::Compare(BinaryOp::Lt),
        _ => Predicate::Function(name.to_owned()),
    }
}
