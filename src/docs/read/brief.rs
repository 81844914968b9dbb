//! The brief: a comment's first line.
//!
//! Where an empty line ends it, the first line is the brief. Where the first paragraph has several
//! lines, its first sentence is, or the lines up to a break that wrapping does not explain; without
//! either the whole paragraph is. What is left of the paragraph opens the detail. A heading that
//! opens a comment is its brief, unless it only repeats the name.

use super::super::mapped::Mapped;
use super::super::prose::{Block, Inline};

/// Words before a full stop that ends no sentence.
const ABBREVIATIONS: [&str; 22] = [
    "e.g", "i.e", "eg", "ie", "z.b", "d.h", "bzw", "ca", "approx", "resp", "no", "nr", "vs", "incl", "max", "min",
    "fig", "cf", "dr", "usw", "ggf", "evtl",
];

/// Whether the first paragraph of `text` is one line.
pub(super) fn is_one_line(text: &Mapped) -> bool {
    let mut lines = text.as_str().lines().map(str::trim).skip_while(|line| line.is_empty());
    lines.next();
    lines.next().is_none_or(str::is_empty)
}

/// Takes the brief off `blocks`, the documentation of `name`; `one_line` if the first paragraph is a line.
pub(super) fn take(blocks: &mut Vec<Block>, name: &str, one_line: bool) -> Vec<Inline> {
    if let Some(Block::Heading(_, title)) = blocks.first() {
        let repeats = fold(&Inline::plain(title)) == fold(name);
        if repeats {
            blocks.remove(0);
        } else if let Block::Heading(_, title) = blocks.remove(0) {
            return title;
        }
        return take_sentence(blocks);
    }
    if one_line { take_paragraph(blocks) } else { take_sentence(blocks) }
}

/// Takes the first paragraph.
pub(super) fn take_paragraph(blocks: &mut Vec<Block>) -> Vec<Inline> {
    match blocks.first_mut() {
        Some(Block::Paragraph(content)) => {
            let content = std::mem::take(content);
            blocks.remove(0);
            content
        }
        _ => Vec::new(),
    }
}

fn take_sentence(blocks: &mut Vec<Block>) -> Vec<Inline> {
    let Some(Block::Paragraph(content)) = blocks.first_mut() else { return Vec::new() };
    let (brief, rest) = split(std::mem::take(content));
    if rest.is_empty() {
        blocks.remove(0);
    } else {
        *content = rest;
    }
    brief
}

/// Cuts a paragraph behind its first sentence or at its first break.
fn split(content: Vec<Inline>) -> (Vec<Inline>, Vec<Inline>) {
    let mut brief = Vec::new();
    let mut inlines = content.into_iter();
    while let Some(inline) = inlines.next() {
        match inline {
            Inline::Break => return (brief, inlines.collect()),
            Inline::Text(text) => {
                let next = inlines.as_slice().first();
                if let Some(end) = sentence_end(&text, next) {
                    let rest = text[end..].trim_start().to_owned();
                    brief.push(Inline::Text(text[..end].to_owned()));
                    let rest = (!rest.is_empty()).then_some(Inline::Text(rest));
                    let after = rest.into_iter().chain(inlines).skip_while(|inline| matches!(inline, Inline::Break));
                    return (brief, after.collect());
                }
                brief.push(Inline::Text(text));
            }
            other => brief.push(other),
        }
    }
    (brief, Vec::new())
}

/// Where the first sentence of `text`, which `next` follows, ends.
fn sentence_end(text: &str, next: Option<&Inline>) -> Option<usize> {
    text.char_indices().filter(|(_, c)| matches!(c, '.' | '!' | '?')).map(|(at, _)| at + 1).find(|end| {
        let after = &text[*end..];
        let ends_here = after.is_empty() && matches!(next, Some(Inline::Break));
        let goes_on = after.trim_start().starts_with(char::is_lowercase);
        let spaced = after.starts_with(char::is_whitespace) && !goes_on;
        let word = text[..*end - 1].rsplit([' ', '(', '\t']).next().unwrap_or("").to_lowercase();
        let numbered = word.chars().all(|c| c.is_ascii_digit()) && !text[..*end - 1].trim_end().contains(' ');
        (ends_here || spaced) && !ABBREVIATIONS.contains(&word.as_str()) && !numbered
    })
}

fn fold(text: &str) -> String {
    text.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}
