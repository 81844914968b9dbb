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

use std::ops::Range;

use super::judge;
use super::mapped::Mapped;
use crate::library::{Catalogue, Comment, Placement};
use crate::text::{FileId, Fragment, Place, Span};

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
                (chunk.text, chunk.decorated) = clean(&source.fragment, source.file, part);
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
        let after_trailing = |len: usize| if outer[len..].starts_with("< ") { len + 1 } else { len };
        return match rest.as_bytes() {
            [b'/', b'/', ..] => (Marker::Line, 2, NONE),
            [b'/', ..] => (Marker::Slashes, after_trailing(3), NONE),
            [b'!', ..] => (Marker::Bang, after_trailing(3), NONE),
            _ => (Marker::Line, 2, NONE),
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
    let announced = group[..body_end].last().is_some_and(|token| token.inner.of(text).trim_end().ends_with(':'));
    let tail = if has_code(&group[body_end..]) && !announced { body_end } else { group.len() };
    [&group[..lead], &group[lead..tail], &group[tail..]].into_iter().filter(|part| !part.is_empty()).collect()
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

/// The spans of the lines in `span`, without line breaks.
fn lines(text: &str, span: Span) -> Vec<Range<usize>> {
    let mut out = Vec::new();
    let base = span.start as usize;
    let part = span.of(text);
    let mut start = 0;
    let mut i = 0;
    while i < part.len() {
        let width = line_break(part, i);
        if width > 0 {
            out.push(base + start..base + i);
            start = i + width;
        }
        i += width.max(1);
    }
    out.push(base + start..base + part.len());
    out
}

/// Cleans the text of `tokens`, and says whether it is one decorated line.
fn clean(fragment: &Fragment, file: FileId, tokens: &[Token]) -> (Mapped, bool) {
    let text = &*fragment.text;
    let mut rows: Vec<Range<usize>> = Vec::new();
    let mut first_hangs = false;
    for token in tokens {
        let mut part = lines(text, token.inner);
        if token.line {
            // A line comment's token may end in its line break, which begins no further line.
            part.truncate(1);
        }
        first_hangs |= !token.line && rows.is_empty();
        rows.append(&mut part);
    }
    gutter(text, &mut rows, first_hangs);
    let decorated = undecorate(text, &mut rows);
    dedent(text, &mut rows, first_hangs && tokens.len() == 1);
    (join(fragment, file, text, &rows), decorated)
}

/// Takes off a gutter that all lines share, and the right side of a box.
fn gutter(text: &str, rows: &mut [Range<usize>], first_hangs: bool) {
    let inner: Vec<usize> = (usize::from(first_hangs)..rows.len())
        .filter(|i| text[rows[*i].clone()].chars().any(|c| !c.is_whitespace()))
        .collect();
    let opens = |row: &Range<usize>| text[row.clone()].trim_start().chars().next();
    let Some(mark) = inner.first().and_then(|i| opens(&rows[*i])) else { return };
    let alone = inner.len() < 2 && !first_hangs;
    if !"*|│║┃#;".contains(mark) || alone || !inner.iter().all(|i| opens(&rows[*i]) == Some(mark)) {
        return;
    }
    let closes = |row: &Range<usize>| text[row.clone()].trim_end().ends_with(mark);
    let words = |row: &Range<usize>| text[row.clone()].contains(char::is_alphanumeric);
    let boxed = inner.iter().filter(|i| words(&rows[**i])).all(|i| closes(&rows[*i]));
    // Lines that open and close with a bar are a table unless something is drawn around them.
    if mark == '|' && (!boxed || !has_frame(text, rows)) || mark == '#' && !boxed {
        return;
    }
    for i in inner {
        let row = &mut rows[i];
        let part = &text[row.clone()];
        row.start += part.len() - part.trim_start().len() + mark.len_utf8();
        if boxed {
            let part = text[row.clone()].trim_end();
            let kept = part.strip_suffix(mark).unwrap_or(part).len();
            row.end = row.start + kept;
        }
    }
}

fn has_frame(text: &str, rows: &[Range<usize>]) -> bool {
    let drawn = |row: &Range<usize>| is_separator(text[row.clone()].trim()) && !text[row.clone()].contains('|');
    rows.first().is_some_and(drawn) || rows.last().is_some_and(drawn)
}

/// Whether a line without white space around it only draws.
fn is_separator(line: &str) -> bool {
    const DRAWN: &str = "-=*#_+/\\<>─━═│║┌┐└┘├┤┬┴┼╔╗╚╝╠╣╦╩╬";
    let mut count = 0;
    for c in line.chars() {
        match c {
            ' ' | '\t' => {}
            c if DRAWN.contains(c) => count += 1,
            _ => return false,
        }
    }
    count >= 3
}

/// Empties separator lines and takes the decoration off headings; says whether one such is all.
fn undecorate(text: &str, rows: &mut [Range<usize>]) -> bool {
    let mut decorated = false;
    let mut others = false;
    for i in 0..rows.len() {
        let line = super::mapped::trim(text, rows[i].clone());
        let part = &text[line.clone()];
        if is_separator(part) {
            if !underlines(text, rows, i) {
                rows[i] = rows[i].start..rows[i].start;
            }
        } else if let Some(kept) = undecorated(part) {
            rows[i] = line.start + kept.start..line.start + kept.end;
            decorated = true;
        } else {
            others |= !part.is_empty();
        }
    }
    decorated && !others
}

/// Whether row `i` underlines the title above it, as Markdown and reStructuredText do.
fn underlines(text: &str, rows: &[Range<usize>], i: usize) -> bool {
    let line = text[rows[i].clone()].trim();
    let Some(mark) = line.chars().next().filter(|c| "=-".contains(*c)) else { return false };
    let above = i.checked_sub(1).map_or("", |above| text[rows[above].clone()].trim());
    let before = i.checked_sub(2).map_or("", |before| text[rows[before].clone()].trim());
    let below = rows.get(i + 1).map_or("", |below| text[below.clone()].trim());
    let width = above.chars().count();
    let fits = (width..=width + 2).contains(&line.chars().count());
    line.chars().all(|c| c == mark) && width > 0 && fits && before.is_empty() && (below.is_empty() || mark == '=')
}

/// The text between the decoration of a heading: `=== Title ===`, `---- Title`.
fn undecorated(line: &str) -> Option<Range<usize>> {
    const MARKS: [char; 6] = ['-', '=', '*', '#', '_', '~'];
    let drawn = |part: &str| part.chars().count() >= 3 && MARKS.iter().any(|mark| part.chars().all(|c| c == *mark));
    let head = line.split_whitespace().next().filter(|part| drawn(part)).map_or("", |part| part);
    let tail = line.split_whitespace().next_back().filter(|part| drawn(part)).map_or("", |part| part);
    // `### Title` is a heading in Markdown, and `~~~` a fence.
    if head.starts_with('~') || head.is_empty() || head.starts_with('#') && tail.is_empty() {
        return None;
    }
    let end = line.len() - tail.len();
    (head.len() < end).then(|| super::mapped::trim(line, head.len()..end)).filter(|kept| !kept.is_empty())
}

/// Takes off the indentation that all lines share.
fn dedent(text: &str, rows: &mut [Range<usize>], first_hangs: bool) {
    let skip = usize::from(first_hangs);
    let blank = |row: &Range<usize>| text[row.clone()].trim().is_empty();
    let indents: Vec<&str> = rows
        .iter()
        .skip(skip)
        .filter(|row| !blank(row))
        .map(|row| {
            let part = &text[row.clone()];
            &part[..part.len() - part.trim_start().len()]
        })
        .collect();
    let shared = indents.iter().copied().reduce(common_prefix).map_or(0, str::len);
    for (i, row) in rows.iter_mut().enumerate() {
        let part = &text[row.clone()];
        let space = part.len() - part.trim_start().len();
        let cut = if i < skip { space } else { shared.min(space) };
        let kept = part.trim_end().len();
        *row = row.start + cut.min(kept)..row.start + kept;
    }
}

fn common_prefix<'a>(a: &'a str, b: &'a str) -> &'a str {
    let len: usize = a.chars().zip(b.chars()).take_while(|(x, y)| x == y).map(|(x, _)| x.len_utf8()).sum();
    &a[..len]
}

/// The rows as text, without empty lines around them.
fn join(fragment: &Fragment, file: FileId, text: &str, rows: &[Range<usize>]) -> Mapped {
    let filled = |row: &Range<usize>| !text[row.clone()].trim().is_empty();
    let first = rows.iter().position(filled).unwrap_or(rows.len());
    let last = rows.iter().rposition(filled).map_or(first, |last| last + 1);
    let mut out = Mapped::new(file);
    for (i, row) in rows[first..last].iter().enumerate() {
        if i > 0 {
            out.add("\n");
        }
        out.push_fragment(fragment, Span::from(row.clone()));
    }
    out
}
