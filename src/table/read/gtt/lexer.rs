//! The words of a `.gtt` file. Cells and durations are found by their extent and read by the room's own parsers, so a
//! coarse cut is enough here.

use std::ops::Range;

/// What a word is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// A name or a keyword.
    Word,
    /// A name with its run: `old|>X`, `0::c`.
    Qualified,
    Number,
    Text,
    /// `\word`
    Command,
    /// `::`
    Guard,
    /// Any other character.
    Sign(char),
    End,
}

/// A word and where it stands in the piece.
#[derive(Clone, Debug)]
pub(super) struct Token {
    pub(super) kind: Kind,
    pub(super) range: Range<usize>,
}

/// A `//` comment: where it stands, and how many words stand in front of it.
pub(super) struct Comment {
    pub(super) range: Range<usize>,
    pub(super) after: usize,
}

/// All words of `text`, closed by [`Kind::End`], and its line comments.
pub(super) fn lex(text: &str) -> (Vec<Token>, Vec<Comment>) {
    let mut tokens = Vec::new();
    let mut comments = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        if let Some(len) = space(rest) {
            if rest.starts_with("//") {
                comments.push(Comment { range: at..at + len, after: tokens.len() });
            }
            at += len;
            continue;
        }
        let (kind, len) = token(rest);
        tokens.push(Token { kind, range: at..at + len });
        at += len;
    }
    tokens.push(Token { kind: Kind::End, range: text.len()..text.len() });
    (tokens, comments)
}

/// The length of the white space or comment at the beginning.
fn space(rest: &str) -> Option<usize> {
    if rest.starts_with("//") {
        return Some(rest.find(['\n', '\r']).unwrap_or(rest.len()));
    }
    if let Some(inner) = rest.strip_prefix("/*") {
        return Some(inner.find("*/").map_or(rest.len(), |end| end + 4));
    }
    let len = rest.len() - rest.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}').len();
    (len > 0).then_some(len)
}

fn word_len(rest: &str) -> usize {
    rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == '$')).unwrap_or(rest.len())
}

fn token(rest: &str) -> (Kind, usize) {
    let first = rest.chars().next().unwrap_or(' ');
    if first == '`' {
        let len = rest[1..].find('`').map_or(rest.len(), |end| end + 2);
        return (Kind::Word, len);
    }
    if first == '"' {
        let len = rest[1..].find('"').map_or(rest.len(), |end| end + 2);
        return (Kind::Text, len);
    }
    if first == '\'' {
        let line = rest.find('\n').unwrap_or(rest.len());
        let len = rest[1..line].find('\'').map_or(1, |end| end + 2);
        return (if len > 1 { Kind::Text } else { Kind::Sign(first) }, len);
    }
    if first == '\\' {
        return (Kind::Command, 1 + word_len(&rest[1..]));
    }
    if first.is_alphanumeric() || first == '_' {
        return name_or_number(rest, first);
    }
    if rest.starts_with("::") {
        return (Kind::Guard, 2);
    }
    (Kind::Sign(first), first.len_utf8())
}

fn name_or_number(rest: &str, first: char) -> (Kind, usize) {
    let number = first.is_ascii_digit();
    let len = if number { rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len()) } else { word_len(rest) };
    let after = &rest[len..];
    for mark in ["|>", "·", "::"] {
        if let Some(name) = after.strip_prefix(mark)
            && name.starts_with(|c: char| c.is_alphabetic() || c == '_')
        {
            return (Kind::Qualified, len + mark.len() + word_len(name));
        }
    }
    (if number { Kind::Number } else { Kind::Word }, len)
}
