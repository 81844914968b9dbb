//! Takes off a comment what only draws.

use std::ops::Range;

use super::{Token, line_break};
use crate::docs::mapped::{Mapped, trim};
use crate::text::{FileId, Fragment, Span};

/// Cleans the text of `tokens`, and says whether it is one decorated line.
pub(super) fn clean(fragment: &Fragment, file: FileId, tokens: &[Token]) -> (Mapped, bool) {
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
        let line = trim(text, rows[i].clone());
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
    (head.len() < end).then(|| trim(line, head.len()..end)).filter(|kept| !kept.is_empty())
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
