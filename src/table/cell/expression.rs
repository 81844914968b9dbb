//! Expressions of Structured Text by precedence climbing (Pratt, "Top down operator precedence", POPL 1973), with the
//! operators and their order from IEC 61131-3, table 71.

use super::ast::{Arg, BinaryOp, Expr, ExprKind, Literal, LiteralValue, Path, Step, UnaryOp};
use super::lexer::{Lexeme, Token, lex};
use super::{CellError, Context};
use crate::table::piece::Piece;
use crate::text::Span;

/// Deeper nesting than this is refused, so that no input overflows the stack.
const MAX_DEPTH: u32 = 64;

/// More operators in one cell are refused: a row of them makes a tree as deep as it is long.
const MAX_OPERATORS: u32 = 1000;

/// Binds tighter than every operator between two operands.
const UNARY: u8 = 10;

/// A cursor over the words of a cell.
pub(super) struct Parser<'a> {
    pub(super) context: &'a Context,
    tokens: Vec<Lexeme>,
    at: usize,
    depth: u32,
    operators: u32,
    /// Whether a comparison may leave out its left side, which is then the column's own variable.
    pub(super) partial: bool,
}

type Result<T> = std::result::Result<T, CellError>;

impl<'a> Parser<'a> {
    pub(super) fn new(piece: &Piece<'_>, context: &'a Context) -> Result<Self> {
        Ok(Self { context, tokens: lex(piece, context.relational)?, at: 0, depth: 0, operators: 0, partial: false })
    }

    fn lexeme(&self) -> &Lexeme {
        &self.tokens[self.at.min(self.tokens.len() - 1)]
    }

    pub(super) fn peek(&self) -> &Token {
        &self.lexeme().token
    }

    pub(super) fn peek_at(&self, ahead: usize) -> &Token {
        self.tokens.get(self.at + ahead).map_or(&Token::End, |lexeme| &lexeme.token)
    }

    pub(super) fn span(&self) -> Span {
        self.lexeme().span
    }

    /// The span of the word before the cursor.
    pub(super) fn last_span(&self) -> Span {
        self.tokens[self.at.saturating_sub(1).min(self.tokens.len() - 1)].span
    }

    pub(super) fn bump(&mut self) {
        self.at += 1;
    }

    pub(super) fn eat(&mut self, token: &Token) -> bool {
        let found = self.peek() == token;
        self.at += usize::from(found);
        found
    }

    pub(super) fn expect(&mut self, token: &Token, what: &str) -> Result<()> {
        if self.eat(token) { Ok(()) } else { Err(self.unexpected(what)) }
    }

    /// An error at the cursor: something else was expected.
    pub(super) fn unexpected(&self, what: &str) -> CellError {
        let message = match self.peek() {
            Token::End => format!("{what} is missing at the end"),
            _ => format!("{what} was expected here"),
        };
        CellError::new(self.span(), message)
    }

    pub(super) fn end(&self) -> Result<()> {
        match self.peek() {
            Token::End => Ok(()),
            _ => Err(CellError::new(self.span(), "nothing was expected here any more")
                .help("an operator or a comma may be missing in front of it")),
        }
    }

    /// Runs `parse` one level deeper.
    pub(super) fn nested<T>(&mut self, parse: impl FnOnce(&mut Self) -> Result<T>) -> Result<T> {
        if self.depth >= MAX_DEPTH {
            return Err(CellError::new(self.span(), "this is nested too deeply"));
        }
        self.depth += 1;
        let result = parse(self);
        self.depth -= 1;
        result
    }

    fn count_operator(&mut self) -> Result<()> {
        self.operators += 1;
        let few = self.operators <= MAX_OPERATORS;
        few.then_some(()).ok_or_else(|| CellError::new(self.span(), "this has too many operators"))
    }

    /// A whole expression.
    pub(super) fn expression(&mut self) -> Result<Expr> {
        self.binary(0)
    }

    /// An expression whose operators bind at least as tightly as `minimum`.
    pub(super) fn binary(&mut self, minimum: u8) -> Result<Expr> {
        self.nested(|parser| {
            let mut left = parser.operand()?;
            while let Some(op) = parser.infix() {
                let precedence = op.precedence();
                if precedence < minimum {
                    break;
                }
                parser.count_operator()?;
                parser.bump();
                // Implication groups to the right, all others to the left.
                let right = parser.binary(if op == BinaryOp::Implies { precedence } else { precedence + 1 })?;
                let span = left.span.cover(right.span);
                left = Expr { kind: ExprKind::Binary(op, Box::new(left), Box::new(right)), span };
            }
            Ok(left)
        })
    }

    /// The operator at the cursor, if one between two operands stands there.
    fn infix(&self) -> Option<BinaryOp> {
        match self.peek() {
            Token::Binary(op) => Some(*op),
            Token::Plus => Some(BinaryOp::Add),
            Token::Minus | Token::Dash => Some(BinaryOp::Sub),
            Token::Star => Some(BinaryOp::Mul),
            Token::Slash => Some(BinaryOp::Div),
            Token::Arrow => Some(BinaryOp::Implies),
            _ => None,
        }
    }

    fn operand(&mut self) -> Result<Expr> {
        let start = self.span();
        let op = match self.peek() {
            Token::Minus | Token::Dash => Some(UnaryOp::Minus),
            Token::Plus => Some(UnaryOp::Plus),
            Token::Not => Some(UnaryOp::Not),
            _ => None,
        };
        if let Some(op) = op {
            self.bump();
            let inner = self.nested(Self::operand)?;
            let span = start.cover(inner.span);
            return Ok(Expr { kind: ExprKind::Unary(op, Box::new(inner)), span });
        }
        if self.partial
            && let Token::Binary(op) = *self.peek()
            && op.is_comparison()
        {
            self.bump();
            let right = self.binary(op.precedence() + 1)?;
            let own = Box::new(Expr { kind: ExprKind::Own, span: Span::at(start.start) });
            let span = start.cover(right.span);
            return Ok(Expr { kind: ExprKind::Binary(op, own, Box::new(right)), span });
        }
        self.primary()
    }

    fn primary(&mut self) -> Result<Expr> {
        let start = self.span();
        let kind = match self.peek().clone() {
            Token::Literal(literal) => {
                self.bump();
                ExprKind::Literal(literal)
            }
            Token::EnumValue(ty, name) => {
                self.bump();
                ExprKind::EnumValue { ty, name }
            }
            Token::Name(run, name) => {
                self.bump();
                self.named(run, name)?
            }
            Token::Open => {
                self.bump();
                let inner = self.expression()?;
                self.expect(&Token::Close, "`)`")?;
                return Ok(Expr { span: start.cover(self.last_span()), ..inner });
            }
            Token::If => return self.nested(Self::guarded),
            _ => return Err(self.unexpected("a value")),
        };
        Ok(Expr { kind, span: start.cover(self.last_span()) })
    }

    /// What a name begins: a call, a path, a value of the past.
    fn named(&mut self, run: Option<String>, name: String) -> Result<ExprKind> {
        if run.is_none() && *self.peek() == Token::Open {
            self.bump();
            let args = self.arguments()?;
            return Ok(ExprKind::Call { name, args });
        }
        if run.is_none() && self.steps_follow().is_none() && !self.context.declared.contains(&name.to_ascii_uppercase())
        {
            let value = match name.as_str() {
                "T" | "t" => Some(true),
                "F" | "f" => Some(false),
                _ => None,
            };
            if let Some(value) = value {
                return Ok(ExprKind::Literal(Literal { value: LiteralValue::Bool(value), text: name }));
            }
        }
        self.path(Path { run, name, steps: Vec::new() })
    }

    fn steps_follow(&self) -> Option<()> {
        matches!(self.peek(), Token::Dot | Token::OpenBracket).then_some(())
    }

    fn path(&mut self, mut path: Path) -> Result<ExprKind> {
        loop {
            if self.eat(&Token::Dot) {
                path.steps.push(Step::Member(self.member()?));
            } else if *self.peek() == Token::OpenBracket {
                let open = self.span();
                if let Some(sign) = self.shift() {
                    return self.past(path, sign, open);
                }
                self.bump();
                let mut indices = vec![self.expression()?];
                while self.eat(&Token::Comma) {
                    indices.push(self.expression()?);
                }
                self.expect(&Token::CloseBracket, "`]`")?;
                path.steps.push(Step::Index(indices));
            } else {
                return Ok(ExprKind::Name(path));
            }
        }
    }

    fn member(&mut self) -> Result<String> {
        let name = match self.peek() {
            Token::Name(None, name) => name.clone(),
            Token::Literal(Literal { value: LiteralValue::Int(bit, None), .. }) => bit.to_string(),
            _ => return Err(self.unexpected("a member's name")),
        };
        self.bump();
        Ok(name)
    }

    /// The sign of a shift in time at the cursor: `[-n]` or `[+n]`.
    fn shift(&self) -> Option<UnaryOp> {
        let sign = match self.peek_at(1) {
            Token::Minus | Token::Dash => UnaryOp::Minus,
            Token::Plus => UnaryOp::Plus,
            _ => return None,
        };
        let number = matches!(self.peek_at(2), Token::Literal(Literal { value: LiteralValue::Int(..), .. }));
        (number && *self.peek_at(3) == Token::CloseBracket).then_some(sign)
    }

    fn past(&mut self, path: Path, sign: UnaryOp, open: Span) -> Result<ExprKind> {
        self.at += 2;
        let Token::Literal(Literal { value: LiteralValue::Int(count, _), .. }) = *self.peek() else {
            return Err(self.unexpected("a number of cycles"));
        };
        let number = self.span();
        self.at += 2;
        if sign == UnaryOp::Plus && count != 0 {
            let name = &path.name;
            let mut error =
                CellError::new(open.cover(self.last_span()), format!("`{name}[+{count}]` asks for the future")).help(
                    format!(
                        "bind a global variable where the value is known later: `g` here, and `g` in the cell of `{name}` {count} cycle(s) further on"
                    ),
                );
            error.future = true;
            return Err(error);
        }
        match u32::try_from(count) {
            Ok(count) if count <= 10_000 => Ok(ExprKind::Past(path, count)),
            _ => Err(CellError::new(number, "no more than 10000 cycles of the past are kept")),
        }
    }

    fn arguments(&mut self) -> Result<Vec<Arg>> {
        let mut args = Vec::new();
        if self.eat(&Token::Close) {
            return Ok(args);
        }
        loop {
            let name = match (self.peek().clone(), self.peek_at(1)) {
                (Token::Name(None, name), Token::Assign) => {
                    self.at += 2;
                    Some(name)
                }
                _ => None,
            };
            args.push(Arg { name, value: self.expression()? });
            if !self.eat(&Token::Comma) {
                self.expect(&Token::Close, "`,` or `)`")?;
                return Ok(args);
            }
        }
    }

    /// `if :: g -> e … fi` inside an expression.
    fn guarded(&mut self) -> Result<Expr> {
        let start = self.span();
        self.bump();
        let mut arms = Vec::new();
        while self.eat(&Token::Guard) {
            let guard = self.guard()?;
            arms.push((guard, self.expression()?));
        }
        if arms.is_empty() {
            return Err(self.unexpected("`::`"));
        }
        self.expect(&Token::Fi, "`::` or `fi`")?;
        Ok(Expr { kind: ExprKind::Guarded(arms), span: start.cover(self.last_span()) })
    }

    /// A guard and the arrow behind it.
    pub(super) fn guard(&mut self) -> Result<Expr> {
        let guard = self.binary(BinaryOp::Implies.precedence() + 1)?;
        self.expect(&Token::Arrow, "`->`")?;
        Ok(guard)
    }

    /// Whether an AND or OR at the level of the cursor is followed by a comparison without a left side.
    pub(super) fn partial_follows(&self) -> bool {
        let mut depth = 0_u32;
        for pair in self.tokens[self.at.min(self.tokens.len())..].windows(2) {
            match &pair[0].token {
                Token::Open if matches!(&pair[1].token, Token::Binary(op) if op.is_comparison()) => return true,
                Token::Open | Token::OpenBracket => depth += 1,
                Token::Close | Token::CloseBracket => depth = depth.saturating_sub(1),
                Token::Comma | Token::Guard | Token::Fi if depth == 0 => return false,
                Token::Binary(BinaryOp::And | BinaryOp::Or) if matches!(&pair[1].token, Token::Binary(op) if op.is_comparison()) =>
                {
                    return true;
                }
                _ => {}
            }
        }
        false
    }

    /// Whether a bracket at the cursor opens an interval: a comma before its partner, and nothing but the end of the part behind.
    pub(super) fn interval_follows(&self) -> bool {
        let mut depth = 0_u32;
        let mut comma = false;
        for i in 0.. {
            match self.peek_at(i) {
                Token::Open | Token::OpenBracket => depth += 1,
                Token::Close | Token::CloseBracket => {
                    depth = depth.saturating_sub(1);
                    if depth == 0 {
                        let behind = self.peek_at(i + 1);
                        return comma && matches!(behind, Token::Comma | Token::End | Token::Guard | Token::Fi);
                    }
                }
                Token::Comma if depth == 1 => comma = true,
                Token::End => return false,
                _ => {}
            }
        }
        false
    }
}

/// Precedence of a sign and of NOT, for the printer.
pub(super) const fn unary_precedence() -> u8 {
    UNARY
}
