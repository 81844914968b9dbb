//! From comment tokens to clean chunks of text.
//!
//! The library hands over runs of comment tokens that stand together. A run is cut into chunks:
//! line comments of one mark without an empty line between them are one chunk, and so are
//! one-line blocks on neighbouring lines; any other block comment is a chunk of its own. Code that
//! was commented out above or below prose is cut off it, line by line.
//!
//! Cleaning takes off what only draws: delimiters and marks, gutters (` * `) and the right side of
//! boxes, separator lines (each leaves an empty line), the decoration of headings
//! (`--- Inputs ---`), the indentation that all lines share. No letter and no digit is ever lost.

mod clean;

use super::judge;
use super::mapped::Mapped;
use crate::library::{Catalogue, Comment, Placement};
use crate::text::{Place, Span};

/// What a comment opens with, where that marks documentation in some convention.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Marker {
    /// `//`
    Line,
    /// `///`
    Slashes,
    /// `//!`, `(*!`, `/*!`
    Bang,
    /// `(*`, `/*`
    Block,
    /// `(**`, `/**`
    Stars,
    /// `(*~`
    Tilde,
    /// No delimiter: the container keeps it.
    None,
}

impl Marker {
    /// Whether it says that the comment is documentation.
    pub(super) const fn is_marked(self) -> bool {
        matches!(self, Self::Slashes | Self::Bang | Self::Stars | Self::Tilde | Self::None)
    }
}

/// A chunk of comment, cleaned.
#[derive(Clone, Debug)]
pub(super) struct Chunk {
    /// Where it stands, seen from what it may document.
    pub(super) placement: Placement,
    /// What it opens with.
    pub(super) marker: Marker,
    /// Its place in the file, with delimiters.
    pub(super) place: Place,
    /// What it says.
    pub(super) text: Mapped,
    /// Whether an empty line, or nothing at all, follows.
    pub(super) set_apart: bool,
    /// Whether a chunk stands before it in the same run with an empty line between.
    pub(super) gap_before: bool,
    /// Whether a statement follows, and no section, declaration or end.
    pub(super) before_statement: bool,
    /// Whether it is one decorated line, such as `--- Inputs ---`.
    pub(super) decorated: bool,
    /// Whether it is one line of code after another.
    pub(super) code: bool,
}

/// One comment token.
#[derive(Clone, Copy)]
struct Token {
    marker: Marker,
    outer: Span,
    inner: Span,
    line: bool,
    code: bool,
}

/// The chunks of a run of comments.
pub(super) fn chunks(catalogue: &Catalogue, comment: &Comment) -> Vec<Chunk> {
    let source = &catalogue.sources[comment.fragment.0 as usize];
    let text = &*source.fragment.text;
    let tokens: Vec<Token> = comment.spans.iter().filter_map(|span| token(text, *span, comment.placement)).collect();
    let mut out: Vec<Chunk> = Vec::new();
    for group in group(text, &tokens) {
        for part in split_code(text, group) {
            let (Some(first), Some(last)) = (part.first(), part.last()) else { continue };
            let before = out.last().map_or(Span::at(0), |_| previous_gap(&tokens, first));
            out.push(Chunk {
                placement: comment.placement,
                marker: first.marker,
                place: catalogue.place(comment.fragment, first.outer.cover(last.outer)),
                set_apart: is_set_apart(text, last.outer.end),
                before_statement: is_statement(text.get(last.outer.end as usize..).unwrap_or("")),
                gap_before: !out.is_empty() && line_breaks(before.of(text)) > 1,
                decorated: false,
                code: part.iter().all(|token| token.code),
                text: Mapped::new(source.file),
            });
            if let Some(chunk) = out.last_mut() {
                (chunk.text, chunk.decorated) = clean::clean(&source.fragment, source.file, part);
            }
        }
    }
    out
}

fn previous_gap(tokens: &[Token], token: &Token) -> Span {
    let before = tokens.iter().take_while(|other| other.outer.start < token.outer.start).last();
    before.map_or(Span::at(token.outer.start), |other| Span::new(other.outer.end, token.outer.start))
}

/// Reads the delimiters of the comment at `span`; `None` for a span that is not in `text`.
fn token(text: &str, span: Span, placement: Placement) -> Option<Token> {
    let outer = text.get(span.range())?;
    let (marker, open, close) = delimiters(outer, placement);
    let close = close.iter().find(|close| outer.len() >= open + close.len() && outer.ends_with(**close));
    let mut inner = open..outer.len() - close.map_or(0, |close| close.len());
    if matches!(marker, Marker::Block | Marker::Stars) && !outer.starts_with("//") {
        // The stars of a box stand next to its delimiters.
        let part = &outer[inner.clone()];
        let kept = part.trim_end_matches('*').trim_start_matches('*');
        let lead = part.trim_end_matches('*').len() - kept.len();
        inner = inner.start + lead..inner.start + lead + kept.len();
    }
    let inner = Span::from(span.start as usize + inner.start..span.start as usize + inner.end);
    let line = matches!(marker, Marker::Line | Marker::Slashes) || outer.starts_with("//");
    let code = matches!(marker, Marker::Line | Marker::Block) && line && judge::is_code_line(inner.of(text));
    Some(Token { marker, outer: span, inner, line, code })
}

/// The marker, the length of the opening delimiter, and the closing ones that may follow.
fn delimiters(outer: &str, placement: Placement) -> (Marker, usize, &'static [&'static str]) {
    const NONE: &[&str] = &[];
    if let Some(rest) = outer.strip_prefix("//") {
        // Doxygen writes `//<` behind a declaration.
        let after_trailing = |len: usize| if outer[len..].starts_with("< ") { len + 1 } else { len };
        return match rest.as_bytes() {
            [b'/', b'/', ..] => (Marker::Line, 2, NONE),
            [b'/', ..] => (Marker::Slashes, after_trailing(3), NONE),
            [b'!', ..] => (Marker::Bang, after_trailing(3), NONE),
            _ => (Marker::Line, after_trailing(2), NONE),
        };
    }
    for (open, tilde) in [("(*", "~*)"), ("/*", "~*/")] {
        let Some(rest) = outer.strip_prefix(open) else { continue };
        let closes: &[&str] = if open == "(*" { &["*)"] } else { &["*/"] };
        return match rest.as_bytes() {
            [b'*', b'*' | b')' | b'/', ..] | [b'*'] => (Marker::Block, 2, closes),
            [b'*', ..] => (Marker::Stars, 3, closes),
            [b'!', ..] => (Marker::Bang, 3, closes),
            [b'~', ..] if outer.ends_with(tilde) => (Marker::Tilde, 3, if open == "(*" { &["~*)"] } else { &["~*/"] }),
            [b'~', ..] => (Marker::Tilde, 3, closes),
            _ => (Marker::Block, 2, closes),
        };
    }
    (if placement == Placement::Container { Marker::None } else { Marker::Line }, 0, NONE)
}

/// Cuts tokens into groups that are one chunk each.
fn group<'a>(text: &str, tokens: &'a [Token]) -> Vec<&'a [Token]> {
    let mut out = Vec::new();
    let mut start = 0;
    for i in 1..=tokens.len() {
        if i == tokens.len() || !belongs(text, &tokens[i - 1], &tokens[i]) {
            out.push(&tokens[start..i]);
            start = i;
        }
    }
    out.retain(|group| !group.is_empty());
    out
}

fn belongs(text: &str, before: &Token, after: &Token) -> bool {
    let gap = Span::new(before.outer.end, after.outer.start).of(text);
    // The token of a line comment may or may not hold its line break.
    let breaks = line_breaks(gap) + line_breaks(before.outer.of(text)).min(usize::from(before.line));
    let data = |token: &Token| judge::is_directive(token.inner.of(text));
    let one_line = |token: &Token| token.line || !token.inner.of(text).contains('\n');
    let alike = before.marker == after.marker && before.line == after.line;
    alike && breaks <= 1 && one_line(before) && one_line(after) && !data(before) && !data(after)
}

/// Cuts code that was commented out off the prose after or before it.
fn split_code<'a>(text: &str, group: &'a [Token]) -> Vec<&'a [Token]> {
    let blank = |token: &Token| token.inner.of(text).trim().is_empty();
    let lead = group.iter().take_while(|token| token.code || blank(token)).count();
    let tail = group.iter().rev().take_while(|token| token.code || blank(token)).count();
    let has_code = |part: &[Token]| part.iter().any(|token| token.code);
    if lead == group.len() {
        return vec![group];
    }
    let lead = if has_code(&group[..lead]) { lead } else { 0 };
    let body_end = group.len() - tail;
    let announced = group[..body_end].last().is_some_and(|token| announces_code(token.inner.of(text).trim()));
    let tail = if has_code(&group[body_end..]) && !announced { body_end } else { group.len() };
    [&group[..lead], &group[lead..tail], &group[tail..]].into_iter().filter(|part| !part.is_empty()).collect()
}

/// Whether code below `line` is meant to be read.
fn announces_code(line: &str) -> bool {
    const TAGS: [&str; 5] = ["@example", "@code", "\\example", "\\code", "```"];
    line.ends_with(':') || TAGS.iter().any(|tag| line.starts_with(tag))
}

/// The bytes of the line break at `at`; 0 if there is none. Some files hold `\r\r\n`, which is one.
fn line_break(text: &str, at: usize) -> usize {
    let rest = &text.as_bytes()[at..];
    let returns = rest.iter().take_while(|byte| **byte == b'\r').count();
    if rest.get(returns) == Some(&b'\n') { returns + 1 } else { returns.min(1) }
}

fn line_breaks(text: &str) -> usize {
    let mut count = 0;
    let mut at = 0;
    while at < text.len() {
        let width = line_break(text, at);
        count += usize::from(width > 0);
        at += width.max(1);
    }
    count
}

/// Whether an empty line or nothing follows the comment that ends at `end`.
fn is_set_apart(text: &str, end: u32) -> bool {
    let Some(rest) = text.get(end as usize..) else { return true };
    let space = &rest[..rest.len() - rest.trim_start().len()];
    let own = text[..end as usize].ends_with(['\n', '\r']);
    space.len() == rest.len() || line_breaks(space) + usize::from(own) > 1
}

/// Whether the text after a comment goes on with a statement.
fn is_statement(rest: &str) -> bool {
    const DECLARING: [&str; 18] = [
        "METHOD",
        "PROPERTY",
        "ACTION",
        "TRANSITION",
        "PUBLIC",
        "PRIVATE",
        "PROTECTED",
        "INTERNAL",
        "STRUCT",
        "UNION",
        "FUNCTION",
        "FUNCTION_BLOCK",
        "PROGRAM",
        "INTERFACE",
        "CLASS",
        "TYPE",
        "STEP",
        "INITIAL_STEP",
    ];
    let rest = skip_trivia(rest);
    let len = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
    let word = rest[..len].to_ascii_uppercase();
    let declares = word.starts_with("VAR") || word.starts_with("END_") || DECLARING.contains(&word.as_str());
    !rest.is_empty() && !declares && !rest.starts_with(['(', ';', ':'])
}

/// What follows blanks, comments and pragmas.
fn skip_trivia(mut rest: &str) -> &str {
    loop {
        rest = rest.trim_start();
        let close = [("(*", "*)"), ("/*", "*/"), ("//", "\n"), ("{", "}")];
        let Some((open, close)) = close.into_iter().find(|(open, _)| rest.starts_with(open)) else { return rest };
        let body = &rest[open.len()..];
        rest = body.find(close).map_or("", |end| &body[end + close.len()..]);
    }
}
