//! The language of cells: lexer, Pratt parser, tree, and the way back to text.

pub mod ast;
mod chunk;
mod expression;
mod lexer;
pub(in crate::table) mod literal;
pub mod print;

use std::collections::BTreeSet;

use super::piece::Piece;
use crate::text::Span;
use ast::Constraint;

pub use literal::time_text;

/// What a parser of cells has to know about the table around them.
#[derive(Clone, Debug, Default)]
pub struct Context {
    /// Whether names may carry a program run (`old|>X`, `old::X`).
    pub relational: bool,
    /// Names that the table declares, in upper case; they win over the short spellings `T` and `F`.
    pub declared: BTreeSet<String>,
    /// How many arguments the column has; with more than one, a cell names a predicate over them.
    pub arguments: usize,
}

/// What is wrong with a cell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CellError {
    /// Where, in the file.
    pub span: Span,
    /// What, in one line.
    pub message: String,
    /// What would help.
    pub help: Option<String>,
    /// Whether the cell asks for the future.
    pub future: bool,
}

impl CellError {
    fn new(span: Span, message: impl Into<String>) -> Self {
        Self { span, message: message.into(), help: None, future: false }
    }

    fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

/// Reads one cell. The text must not be blank: a blank cell repeats the one above and is no constraint of its own.
///
/// # Errors
/// The first thing that is wrong with it.
pub fn parse(piece: &Piece<'_>, context: &Context) -> Result<Constraint, CellError> {
    chunk::cell(piece, context)
}

/// Reads an expression that stands alone, such as the argument of a projection.
///
/// # Errors
/// The first thing that is wrong with it.
pub fn parse_expression(piece: &Piece<'_>, context: &Context) -> Result<ast::Expr, CellError> {
    let mut parser = expression::Parser::new(piece, context)?;
    let expr = parser.expression()?;
    parser.end()?;
    Ok(expr)
}

/// Reads expressions between commas.
///
/// # Errors
/// The first thing that is wrong with them.
pub fn parse_expressions(piece: &Piece<'_>, context: &Context) -> Result<Vec<ast::Expr>, CellError> {
    let mut parser = expression::Parser::new(piece, context)?;
    let mut out = vec![parser.expression()?];
    while parser.eat(&lexer::Token::Comma) {
        out.push(parser.expression()?);
    }
    parser.end()?;
    Ok(out)
}
