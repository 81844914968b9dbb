//! From text to tokens, without loss: the tokens one after the other are the text.
//!
//! Logos finds what a regular expression can find. Comments, pragmas, strings and the literals of time are
//! scanned by hand from their first characters on, because whether comments nest is an option, and because a
//! broken one must not cost the rest of the text: a string stops at the end of its line, and so does a pragma
//! that is never closed.
//!
//! Whether `(* … *)` nests is guessed where the option leaves it open: it nests unless that would leave a
//! comment open to the end of the text; where it makes a difference, a finding says so. After [`GUESSES`] wrong guesses the rest of the text is taken flat, which
//! keeps the time linear.

use logos::Logos;

use super::codes;
use super::keyword::keyword;
use super::kind::TokenKind;
use super::scan::{find, line_length, nested_length, pragma_has_strings, quoted_pragma_length, time_literal};
use super::{Options, SyntaxError};
use crate::diagnostic::Code;
use crate::text::Span;

/// How often a scan to the end of the text may fail before the simpler reading is taken for good.
const GUESSES: u8 = 4;

/// The tokens of a text: their kinds, and the offsets at which they begin.
#[derive(Debug, Default)]
pub(super) struct Tokens {
    pub(super) kinds: Vec<TokenKind>,
    pub(super) starts: Vec<u32>,
    pub(super) errors: Vec<SyntaxError>,
}

#[derive(Logos, Clone, Copy, Debug, PartialEq, Eq)]
enum Raw {
    #[regex("[ \t\x0B\x0C\x1A\u{85}\u{A0}\u{2000}-\u{200F}\u{2028}\u{2029}\u{202F}\u{3000}\u{FEFF}]+")]
    Blank,
    #[regex("\r\n|\n|\r")]
    Newline,
    #[regex(
        "[A-Za-z_\u{AA}\u{B5}\u{BA}\u{C0}-\u{1FFF}\u{2C00}-\u{2FFF}\u{3005}-\u{D7FF}\u{F900}-\u{FAFF}\u{10000}-\u{EFFFF}][$0-9A-Za-z_\u{AA}\u{B5}\u{BA}\u{C0}-\u{1FFF}\u{2C00}-\u{2FFF}\u{3005}-\u{D7FF}\u{F900}-\u{FAFF}\u{10000}-\u{EFFFF}]*"
    )]
    Word,
    #[regex("[0-9][0-9_]*")]
    Integer,
    #[regex("[0-9]+#[0-9A-Fa-f_]+")]
    Based,
    #[regex(r"[0-9][0-9_]*\.[0-9][0-9_]*([eE][+\-]?[0-9]+)?")]
    #[regex("[0-9][0-9_]*[eE][+\\-]?[0-9]+")]
    Real,
    #[regex(r"%[A-Za-z]*(\*|[0-9]+(\.[A-Za-z]*[0-9]+)*)?")]
    Address,
    #[regex("//[^\r\n]*", allow_greedy = true)]
    LineComment,
    #[token("(*")]
    OpenRound,
    #[token("/*")]
    OpenSlash,
    #[token("{")]
    OpenPragma,
    #[token("'")]
    Quote,
    #[token("\"")]
    DoubleQuote,
    #[token("(")]
    LParen,
    #[token(")")]
    RParen,
    #[token("[")]
    LBracket,
    #[token("]")]
    RBracket,
    #[token(",")]
    Comma,
    #[token(";")]
    Semicolon,
    #[token(":")]
    Colon,
    #[token(".")]
    Dot,
    #[token("..")]
    DotDot,
    #[token("^")]
    Caret,
    #[token("#")]
    Hash,
    #[token("?")]
    Question,
    #[token(":=")]
    Assign,
    #[token("=>")]
    Arrow,
    #[token("?=")]
    TryAssign,
    #[token("+=")]
    PlusAssign,
    #[token("-=")]
    MinusAssign,
    #[token("*=")]
    StarAssign,
    #[token("/=")]
    SlashAssign,
    #[token("=")]
    #[token("==")]
    Equal,
    #[token("<>")]
    #[token("!=")]
    NotEqual,
    #[token("<")]
    Less,
    #[token("<=")]
    LessEqual,
    #[token(">")]
    Greater,
    #[token(">=")]
    GreaterEqual,
    #[token("+")]
    Plus,
    #[token("-")]
    Minus,
    #[token("*")]
    Star,
    #[token("**")]
    Power,
    #[token("/")]
    Slash,
    #[token("&")]
    Ampersand,
}

/// Splits `text`, which is shorter than 4 GiB, into tokens.
pub(super) fn lex(text: &str, options: &Options) -> Tokens {
    let mut scanner = Scanner {
        lexer: Raw::lexer(text),
        nested: options.nested_comments,
        guesses: GUESSES,
        guess_told: false,
        pragma_guesses: GUESSES,
        no_more_braces: false,
        errors: Vec::new(),
    };
    let mut tokens = Tokens::default();
    let estimate = text.len() / 4;
    tokens.kinds.reserve(estimate);
    tokens.starts.reserve(estimate);
    while let Some(raw) = scanner.lexer.next() {
        let start = offset(scanner.lexer.span().start);
        let kind = raw.map_or(TokenKind::Unknown, |raw| scanner.kind(raw));
        tokens.kinds.push(kind);
        tokens.starts.push(start);
    }
    tokens.errors = scanner.errors;
    tokens
}

struct Scanner<'a> {
    lexer: logos::Lexer<'a, Raw>,
    nested: Option<bool>,
    guess_told: bool,
    guesses: u8,
    pragma_guesses: u8,
    no_more_braces: bool,
    errors: Vec<SyntaxError>,
}

impl Scanner<'_> {
    fn kind(&mut self, raw: Raw) -> TokenKind {
        match raw {
            Raw::Blank => TokenKind::Blank,
            Raw::Newline => TokenKind::Newline,
            Raw::Word => self.word(),
            Raw::LineComment => TokenKind::LineComment,
            Raw::OpenRound => self.round_comment(),
            Raw::OpenSlash => self.slash_comment(),
            Raw::OpenPragma => self.pragma(),
            Raw::Quote => self.string(b'\'', TokenKind::String),
            Raw::DoubleQuote => self.string(b'"', TokenKind::WString),
            Raw::Integer => TokenKind::Integer,
            Raw::Based => TokenKind::Based,
            Raw::Real => TokenKind::Real,
            Raw::Address => TokenKind::Address,
            other => punctuation(other),
        }
    }

    /// A name, a keyword, or what a name and `#` begin.
    fn word(&mut self) -> TokenKind {
        let word = self.lexer.slice();
        let known = keyword(word);
        let rest = self.lexer.remainder().as_bytes();
        if rest.first() != Some(&b'#') || known.is_some_and(TokenKind::is_hard_keyword) {
            return known.unwrap_or(TokenKind::Ident);
        }
        let Some(next) = rest.get(1) else {
            return known.unwrap_or(TokenKind::Ident);
        };
        if (next.is_ascii_digit() || matches!(next, b'+' | b'-'))
            && let Some((kind, length)) = time_literal(word, &rest[1..])
        {
            self.lexer.bump(1 + length);
            return kind;
        }
        let is_value = next.is_ascii_alphanumeric() || matches!(next, b'_' | b'+' | b'-' | b'\'' | b'"' | 0x80..);
        if is_value {
            self.lexer.bump(1);
            return TokenKind::TypePrefix;
        }
        known.unwrap_or(TokenKind::Ident)
    }

    fn round_comment(&mut self) -> TokenKind {
        let rest = self.lexer.remainder().as_bytes();
        let flat = || find(rest, b"*)").map(|at| at + 2);
        let length = match self.nested {
            Some(true) => nested_length(rest),
            None if self.guesses > 0 => {
                let (nested, flat) = (nested_length(rest), flat());
                self.guesses -= u8::from(nested.is_none());
                self.tell_guess(nested, flat);
                nested.or(flat)
            }
            _ => flat(),
        };
        self.comment(length, "`*)`")
    }

    /// Says, once a text, that it makes a difference whether comments nest.
    fn tell_guess(&mut self, nested: Option<usize>, flat: Option<usize>) {
        if self.guess_told || nested == flat {
            return;
        }
        self.guess_told = true;
        let how = if nested.is_some() {
            "was read as nesting"
        } else {
            "was read as not nesting, as it would not end otherwise"
        };
        self.errors.push(SyntaxError {
            span: Span::from(self.lexer.span()),
            message: format!("the comment holds `(*` and {how}"),
            help: None,
            code: &codes::COMMENT_NESTING_GUESSED,
        });
    }

    fn slash_comment(&mut self) -> TokenKind {
        let length = find(self.lexer.remainder().as_bytes(), b"*/").map(|at| at + 2);
        self.comment(length, "`*/`")
    }

    fn comment(&mut self, length: Option<usize>, close: &str) -> TokenKind {
        if length.is_none() {
            self.error(&codes::UNTERMINATED_COMMENT, format!("comment without {close}"), close);
        }
        self.lexer.bump(length.unwrap_or(self.lexer.remainder().len()));
        TokenKind::BlockComment
    }

    fn pragma(&mut self) -> TokenKind {
        let rest = self.lexer.remainder().as_bytes();
        let mut length = None;
        if !self.no_more_braces {
            if self.pragma_guesses > 0 && pragma_has_strings(rest) {
                length = quoted_pragma_length(rest);
                if length.is_none() {
                    self.pragma_guesses -= 1;
                }
            }
            length = length.or_else(|| find(rest, b"}").map(|at| at + 1));
            self.no_more_braces = length.is_none();
        }
        if length.is_none() {
            self.error(&codes::UNTERMINATED_COMMENT, "pragma without `}`".to_owned(), "`}`");
        }
        self.lexer.bump(length.unwrap_or_else(|| line_length(rest)));
        TokenKind::Pragma
    }

    fn string(&mut self, quote: u8, kind: TokenKind) -> TokenKind {
        let rest = self.lexer.remainder().as_bytes();
        let mut at = 0;
        while let Some(byte) = rest.get(at) {
            match byte {
                b'\r' | b'\n' => break,
                // An escaped line break does not lengthen the string.
                b'$' if rest.get(at + 1).is_some_and(|next| !matches!(next, b'\r' | b'\n')) => at += 2,
                byte if *byte == quote => {
                    self.lexer.bump(at + 1);
                    return kind;
                }
                _ => at += 1,
            }
        }
        // `$` may have stepped into a character of several bytes.
        while !self.lexer.remainder().is_char_boundary(at) {
            at += 1;
        }
        let close = if quote == b'"' { "`\"`" } else { "`'`" };
        self.error(&codes::UNTERMINATED_STRING, "string without its closing quote".to_owned(), close);
        self.lexer.bump(at);
        kind
    }

    fn error(&mut self, code: &'static Code, message: String, expected: &str) {
        let span = Span::from(self.lexer.span());
        let help = Some(format!("write {expected} where it ends"));
        self.errors.push(SyntaxError { span, message, help, code });
    }
}

fn punctuation(raw: Raw) -> TokenKind {
    match raw {
        Raw::LParen => TokenKind::LParen,
        Raw::RParen => TokenKind::RParen,
        Raw::LBracket => TokenKind::LBracket,
        Raw::RBracket => TokenKind::RBracket,
        Raw::Comma => TokenKind::Comma,
        Raw::Semicolon => TokenKind::Semicolon,
        Raw::Colon => TokenKind::Colon,
        Raw::Dot => TokenKind::Dot,
        Raw::DotDot => TokenKind::DotDot,
        Raw::Caret => TokenKind::Caret,
        Raw::Hash => TokenKind::Hash,
        Raw::Question => TokenKind::Question,
        Raw::Assign => TokenKind::Assign,
        Raw::Arrow => TokenKind::Arrow,
        Raw::TryAssign => TokenKind::TryAssign,
        Raw::PlusAssign => TokenKind::PlusAssign,
        Raw::MinusAssign => TokenKind::MinusAssign,
        Raw::StarAssign => TokenKind::StarAssign,
        Raw::SlashAssign => TokenKind::SlashAssign,
        Raw::Equal => TokenKind::Equal,
        Raw::NotEqual => TokenKind::NotEqual,
        Raw::Less => TokenKind::Less,
        Raw::LessEqual => TokenKind::LessEqual,
        Raw::Greater => TokenKind::Greater,
        Raw::GreaterEqual => TokenKind::GreaterEqual,
        Raw::Plus => TokenKind::Plus,
        Raw::Minus => TokenKind::Minus,
        Raw::Star => TokenKind::Star,
        Raw::Power => TokenKind::Power,
        Raw::Slash => TokenKind::Slash,
        Raw::Ampersand => TokenKind::Ampersand,
        _ => TokenKind::Unknown,
    }
}

fn offset(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}
