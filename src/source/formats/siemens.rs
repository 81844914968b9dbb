//! Siemens: SCL sources (`.scl .udt .db`), documents (`.s7dcl`), STL sources (`.awl`).
//!
//! SCL is text as it stands. STL and documents in a graphical language have bodies that are no Structured Text: there each
//! block is an object of its own, its declaration is read, and its body is kept.

use super::keyword::leading;
use super::plain::whole_text;
use super::{Claim, Format, Input, Unwrapped, note_if_empty};
use crate::text::{Body, Fragment, Language, Object, ObjectKind, Span, Vendor};

/// Siemens sources.
#[derive(Debug)]
pub(super) struct Siemens;

impl Format for Siemens {
    fn name(&self) -> &'static str {
        "Siemens"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["scl", "udt", "db", "s7dcl", "awl"]
    }

    fn claims(&self, input: &Input<'_>) -> Claim {
        // A `.db` may be anything; one of Siemens begins with a data block.
        let is_source = !input.path.to_ascii_lowercase().ends_with(".db") || input.head().contains("DATA_BLOCK");
        if is_source { Claim::Likely } else { Claim::No }
    }

    fn unwrap(&self, input: &Input<'_>) -> Unwrapped {
        let text = &**input.text;
        let network = |word: &str| lines(text).any(|line| first_word(line.of(text)) == word);
        let stl = input.path.to_ascii_lowercase().ends_with(".awl");
        let objects = if stl || network("NETWORK") { blocks(text) } else { vec![whole_text(input)] };
        let notes = note_if_empty(&objects, "block").into_iter().collect();
        Unwrapped { objects, vendor: Vendor::Siemens, notes, ..Unwrapped::default() }
    }
}

/// The lines of `text`, with their line ends.
fn lines(text: &str) -> impl Iterator<Item = Span> {
    text.split_inclusive('\n').scan(0, |at, line| {
        let start = *at;
        *at += line.len();
        Some(Span::from(start..*at))
    })
}

fn first_word(line: &str) -> String {
    let line = line.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{FEFF}');
    line.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>().to_ascii_uppercase()
}

/// Each block of `text` as an object.
fn blocks(text: &str) -> Vec<Object> {
    let mut objects = Vec::new();
    // What stands before a block's first line (comments, pragmas) belongs to it.
    let (mut start, mut body, mut open) = (0, None, None);
    for line in lines(text) {
        let word = first_word(line.of(text));
        match word.as_str() {
            "FUNCTION_BLOCK" | "FUNCTION" | "ORGANIZATION_BLOCK" | "DATA_BLOCK" | "TYPE" if open.is_none() => {
                open = Some(format!("END_{word}"));
            }
            "BEGIN" | "NETWORK" if open.is_some() && body.is_none() => body = Some(line.start),
            end if open.as_deref() == Some(end) => {
                objects.push(block(text, start, body, line.end, end));
                (start, body, open) = (line.end, None, None);
            }
            _ => {}
        }
    }
    if let Some(end) = open {
        objects.push(block(text, start, body, Span::from(0..text.len()).end, &end));
    }
    objects
}

fn block(text: &str, start: u32, body: Option<u32>, end: u32, keyword: &str) -> Object {
    // Data blocks and types have no code: what follows `BEGIN` is values.
    let body = body.filter(|_| keyword != "END_DATA_BLOCK" && keyword != "END_TYPE");
    let declaration = Span::new(start, body.unwrap_or(end));
    let (kind, name) = leading(declaration.of(text)).map_or((ObjectKind::Text, None), |found| (found.kind, found.name));
    let (name, span) = name.map_or((None, Span::at(start)), |(name, span)| (Some(name), span.shifted(start)));
    let mut object = Object::new(kind, name, span);
    object.declaration = Some(Fragment::verbatim(declaration.of(text), start));
    if let Some(body) = body {
        let language = if text.contains("RUNG") { Language::Ld } else { Language::Unknown };
        object.body = Body::Other(language, Fragment::verbatim(Span::new(body, end).of(text), body));
    }
    object
}
