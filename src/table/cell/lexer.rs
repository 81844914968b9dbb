//! The words of a cell: ASCII and Unicode spellings of the same operator give the same token.

use super::CellError;
use super::ast::{BinaryOp, Literal, LiteralValue};
use super::literal::{self, Prefix};
use crate::table::piece::Piece;
use crate::text::Span;

/// A word of a cell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Token {
    /// A name; the run in front of it in a relational table.
    Name(Option<String>, String),
    Literal(Literal),
    EnumValue(String, String),
    Binary(BinaryOp),
    Minus,
    Plus,
    /// `–` or `—`, which stands for anything, or for minus.
    Dash,
    Not,
    Star,
    Slash,
    Comma,
    Dot,
    Open,
    Close,
    OpenBracket,
    CloseBracket,
    Infinity,
    Trigger,
    Guard,
    Arrow,
    Assign,
    If,
    Fi,
    End,
}

/// A token and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Lexeme {
    pub(super) token: Token,
    /// The span in the file.
    pub(super) span: Span,
}

pub(super) struct Lexer<'a> {
    piece: &'a Piece<'a>,
    relational: bool,
    at: usize,
}

/// All words of `piece`, closed by [`Token::End`].
pub(super) fn lex(piece: &Piece<'_>, relational: bool) -> Result<Vec<Lexeme>, CellError> {
    let mut lexer = Lexer { piece, relational, at: 0 };
    let mut out = Vec::new();
    loop {
        lexer.skip_space();
        let start = lexer.at;
        let token = lexer.token()?;
        let end = token == Token::End;
        out.push(Lexeme { token, span: piece.span(Span::from(start..lexer.at)) });
        if end {
            return Ok(out);
        }
    }
}

static SYMBOLS: [(&str, Token); 44] = [
    ("<=", Token::Binary(BinaryOp::Le)),
    ("=<", Token::Binary(BinaryOp::Le)),
    (">=", Token::Binary(BinaryOp::Ge)),
    ("<>", Token::Binary(BinaryOp::Ne)),
    ("!=", Token::Binary(BinaryOp::Ne)),
    ("==", Token::Binary(BinaryOp::Eq)),
    (":=", Token::Assign),
    ("::", Token::Guard),
    ("->", Token::Arrow),
    ("**", Token::Binary(BinaryOp::Power)),
    ("&&", Token::Binary(BinaryOp::And)),
    ("||", Token::Binary(BinaryOp::Or)),
    ("≤", Token::Binary(BinaryOp::Le)),
    ("⩽", Token::Binary(BinaryOp::Le)),
    ("≥", Token::Binary(BinaryOp::Ge)),
    ("⩾", Token::Binary(BinaryOp::Ge)),
    ("≠", Token::Binary(BinaryOp::Ne)),
    ("∧", Token::Binary(BinaryOp::And)),
    ("∨", Token::Binary(BinaryOp::Or)),
    ("⊕", Token::Binary(BinaryOp::Xor)),
    ("→", Token::Arrow),
    ("¬", Token::Not),
    ("∞", Token::Infinity),
    ("√", Token::Trigger),
    ("−", Token::Minus),
    ("–", Token::Dash),
    ("—", Token::Dash),
    ("×", Token::Star),
    ("<", Token::Binary(BinaryOp::Lt)),
    (">", Token::Binary(BinaryOp::Gt)),
    ("=", Token::Binary(BinaryOp::Eq)),
    ("&", Token::Binary(BinaryOp::And)),
    ("|", Token::Binary(BinaryOp::Or)),
    ("!", Token::Not),
    ("^", Token::Trigger),
    ("+", Token::Plus),
    ("-", Token::Minus),
    ("*", Token::Star),
    ("/", Token::Slash),
    ("%", Token::Binary(BinaryOp::Mod)),
    (",", Token::Comma),
    (".", Token::Dot),
    ("(", Token::Open),
    (")", Token::Close),
];

const fn is_start(c: char) -> bool {
    c == '_' || c.is_ascii_alphabetic()
}

fn is_word_start(c: char) -> bool {
    is_start(c) || (!c.is_ascii() && c.is_alphabetic())
}

fn is_word(c: char) -> bool {
    is_word_start(c) || c.is_ascii_digit() || c == '$'
}

impl Lexer<'_> {
    fn rest(&self) -> &str {
        self.piece.text.get(self.at..).unwrap_or("")
    }

    fn error(&self, start: usize, message: impl Into<String>) -> CellError {
        CellError::new(self.piece.span(Span::from(start..self.at.max(start + 1).min(self.piece.text.len()))), message)
    }

    /// White space, and comments of any of the languages that tables stand in.
    fn skip_space(&mut self) {
        loop {
            let rest = self.rest();
            let trimmed = rest.trim_start();
            self.at += rest.len() - trimmed.len();
            let rest = self.rest();
            let skip = if rest.starts_with("//") {
                rest.find('\n').unwrap_or(rest.len())
            } else if rest.starts_with("/*") {
                rest.find("*/").map_or(rest.len(), |i| i + 2)
            } else if rest.starts_with("(*") {
                rest.find("*)").map_or(rest.len(), |i| i + 2)
            } else {
                return;
            };
            self.at += skip;
        }
    }

    fn token(&mut self) -> Result<Token, CellError> {
        let Some(first) = self.rest().chars().next() else { return Ok(Token::End) };
        match first {
            '[' => self.one(Token::OpenBracket),
            ']' => self.one(Token::CloseBracket),
            '\'' | '"' => self.string(first),
            '`' => self.quoted_name(),
            c if c.is_ascii_digit() => self.number(),
            c if is_word_start(c) => self.word(),
            _ => self.symbol(first),
        }
    }

    fn one(&mut self, token: Token) -> Result<Token, CellError> {
        self.at += 1;
        Ok(token)
    }

    fn symbol(&mut self, first: char) -> Result<Token, CellError> {
        let rest = self.rest();
        if rest.starts_with("=>") {
            return Err(self.error(self.at, "`=>` is read as two things; write `>=` or `->`"));
        }
        if let Some((text, token)) = SYMBOLS.iter().find(|(text, _)| rest.starts_with(text)) {
            self.at += text.len();
            return Ok(token.clone());
        }
        let start = self.at;
        self.at += first.len_utf8();
        Err(self.error(start, format!("`{first}` has no meaning in a cell")))
    }

    fn take(&mut self, accept: impl Fn(char) -> bool) -> String {
        let rest = self.rest();
        let len = rest.find(|c| !accept(c)).unwrap_or(rest.len());
        let text = rest.get(..len).unwrap_or("").to_owned();
        self.at += len;
        text
    }

    fn string(&mut self, quote: char) -> Result<Token, CellError> {
        let start = self.at;
        let Some(len) = self.rest()[1..].find(quote) else {
            self.at = self.piece.text.len();
            return Err(self.error(start, "this string has no end"));
        };
        let text = self.rest().get(1..=len).unwrap_or("").to_owned();
        self.at += len + 2;
        let value = LiteralValue::Text(text, quote == '"');
        Ok(self.literal(start, value))
    }

    fn literal(&self, start: usize, value: LiteralValue) -> Token {
        let text = self.piece.text.get(start..self.at).unwrap_or("").to_owned();
        Token::Literal(Literal { value, text })
    }

    fn quoted_name(&mut self) -> Result<Token, CellError> {
        let start = self.at;
        self.at += 1;
        let name = self.take(is_word);
        if !self.rest().starts_with('`') || name.is_empty() {
            return Err(self.error(start, "this name in backticks has no end"));
        }
        self.at += 1;
        Ok(Token::Name(None, name))
    }

    fn number(&mut self) -> Result<Token, CellError> {
        let start = self.at;
        let digits = self.take(|c| c.is_ascii_digit() || c == '_');
        if self.relational
            && let Some(name) = self.qualified()
        {
            return Ok(Token::Name(Some(digits), name));
        }
        self.number_after(start, None)
    }

    /// The rest of a number whose first digits are taken; it begins at `start`, its own digits at `self.at` or before.
    fn number_after(&mut self, start: usize, ty: Option<(String, usize)>) -> Result<Token, CellError> {
        let digits_at = ty.as_ref().map_or(start, |(_, at)| *at);
        if self.rest().starts_with('#') {
            self.at += 1;
            self.take(|c| c.is_ascii_alphanumeric() || c == '_');
        } else {
            self.fraction();
        }
        let text = self.piece.text.get(digits_at..self.at).unwrap_or("").to_owned();
        match literal::number(&text, ty.map(|(name, _)| name)) {
            Ok(value) => Ok(self.literal(start, value)),
            Err(message) => Err(self.error(start, message)),
        }
    }

    fn fraction(&mut self) {
        let digit_at = |text: &str, i: usize| text.as_bytes().get(i).is_some_and(u8::is_ascii_digit);
        if self.rest().starts_with('.') && digit_at(self.rest(), 1) {
            self.at += 1;
            self.take(|c| c.is_ascii_digit() || c == '_');
        }
        let rest = self.rest();
        if rest.starts_with(['e', 'E']) {
            let sign = usize::from(rest[1..].starts_with(['+', '-']));
            if digit_at(rest, 1 + sign) {
                self.at += 1 + sign;
                self.take(|c| c.is_ascii_digit());
            }
        }
    }

    /// `|>name`, `·name` or `::name` straight behind a run.
    fn qualified(&mut self) -> Option<String> {
        let rest = self.rest();
        let mark = ["|>", "·", "::"].into_iter().find(|mark| rest.starts_with(mark))?;
        let after = rest.get(mark.len()..)?;
        if !after.starts_with(is_word_start) {
            return None;
        }
        self.at += mark.len();
        Some(self.take(is_word))
    }

    fn word(&mut self) -> Result<Token, CellError> {
        let start = self.at;
        let word = self.take(is_word);
        if self.rest().starts_with('#') {
            self.at += 1;
            return self.typed(start, &word);
        }
        let keyword = keyword(&word);
        if self.relational
            && keyword.is_none()
            && let Some(name) = self.qualified()
        {
            return Ok(Token::Name(Some(word), name));
        }
        Ok(keyword.map_or_else(|| Token::Name(None, word.clone()), |keyword| self.keyword(start, keyword)))
    }

    fn keyword(&self, start: usize, keyword: Keyword) -> Token {
        match keyword {
            Keyword::Token(token) => token,
            Keyword::Bool(value) => self.literal(start, LiteralValue::Bool(value)),
        }
    }

    /// What follows `word#`.
    fn typed(&mut self, start: usize, word: &str) -> Result<Token, CellError> {
        let upper = word.to_ascii_uppercase();
        match literal::prefix(word) {
            Prefix::Enum => {
                let name = self.take(is_word);
                if name.is_empty() {
                    return Err(self.error(start, format!("a value of `{word}` is missing after `#`")));
                }
                Ok(Token::EnumValue(word.to_owned(), name))
            }
            Prefix::Bool => {
                let value = self.take(is_word).to_ascii_uppercase();
                match value.as_str() {
                    "TRUE" | "1" => Ok(self.literal(start, LiteralValue::Bool(true))),
                    "FALSE" | "0" => Ok(self.literal(start, LiteralValue::Bool(false))),
                    _ => Err(self.error(start, "a Boolean is `TRUE` or `FALSE`")),
                }
            }
            Prefix::Integer | Prefix::Real => self.typed_number(start, upper),
            Prefix::Time { long } => {
                let negative = self.rest().starts_with('-');
                self.at += usize::from(negative);
                let text = self.take(|c| is_word(c) || c == '.');
                match literal::time(&text) {
                    Some(nanos) => {
                        let nanos = if negative { -nanos } else { nanos };
                        Ok(self.literal(start, LiteralValue::Time(nanos, long)))
                    }
                    None => Err(self.error(start, format!("`{text}` is no time"))),
                }
            }
            Prefix::Date => {
                let text = self.take(|c| c.is_ascii_alphanumeric() || "-:._".contains(c));
                Ok(self.literal(start, LiteralValue::Date(upper, text)))
            }
        }
    }

    fn typed_number(&mut self, start: usize, ty: String) -> Result<Token, CellError> {
        let negative = self.rest().starts_with('-');
        self.at += usize::from(negative);
        let digits_at = self.at;
        if self.take(|c| c.is_ascii_digit() || c == '_').is_empty() {
            return Err(self.error(start, format!("a number is missing after `{ty}#`")));
        }
        let token = self.number_after(start, Some((ty, digits_at)))?;
        Ok(if negative { negated(token) } else { token })
    }
}

fn negated(token: Token) -> Token {
    match token {
        Token::Literal(Literal { value: LiteralValue::Int(value, ty), text }) => {
            Token::Literal(Literal { value: LiteralValue::Int(-value, ty), text })
        }
        Token::Literal(Literal { value: LiteralValue::Real(value, ty), text }) => {
            Token::Literal(Literal { value: LiteralValue::Real(format!("-{value}"), ty), text })
        }
        other => other,
    }
}

enum Keyword {
    Token(Token),
    Bool(bool),
}

fn keyword(word: &str) -> Option<Keyword> {
    let token = match word.to_ascii_uppercase().as_str() {
        "AND" | "AND_THEN" => Token::Binary(BinaryOp::And),
        "OR" | "OR_ELSE" => Token::Binary(BinaryOp::Or),
        "XOR" => Token::Binary(BinaryOp::Xor),
        "MOD" => Token::Binary(BinaryOp::Mod),
        "NOT" => Token::Not,
        "IF" => Token::If,
        "FI" => Token::Fi,
        "TRUE" => return Some(Keyword::Bool(true)),
        "FALSE" => return Some(Keyword::Bool(false)),
        _ => return None,
    };
    Some(Keyword::Token(token))
}
