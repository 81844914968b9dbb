//! Character data: CDATA sections as they stand, entities as the characters they stand for.

use super::scan::{Scanner, Token};
use crate::source::fragment::FragmentBuilder;
use crate::text::Span;

/// Adds what `span` of `text` says, in which no element stands, to `out`.
pub(super) fn character_data(text: &str, span: Span, out: &mut FragmentBuilder) {
    for token in Scanner::new(text, span) {
        match token {
            Token::Text(span) => decoded(text, span, out),
            Token::Cdata(_, inner) => {
                out.verbatim(text, inner);
            }
            Token::Open { .. } | Token::Close { .. } | Token::Other(_) => {}
        }
    }
}

/// Adds the characters of `span`, with the entities of XML replaced, to `out`.
pub(super) fn decoded(text: &str, span: Span, out: &mut FragmentBuilder) {
    let mut at = span.start;
    for (found, _) in span.of(text).match_indices('&') {
        let and = span.start + super::scan::index(found);
        let Some((character, length)) = reference(Span::new(and, span.end).of(text)) else { continue };
        let end = and + super::scan::index(length);
        out.verbatim(text, Span::new(at, and));
        out.standing_for(character.encode_utf8(&mut [0; 4]), Span::new(and, end));
        at = end;
    }
    out.verbatim(text, Span::new(at, span.end));
}

/// The character that the reference at the start of `text` stands for, and the reference's length.
pub(super) fn reference(text: &str) -> Option<(char, usize)> {
    let body = text.strip_prefix('&')?;
    // The longest reference is `&#x10FFFF;`; zeros may lead, but nobody writes many.
    let end = body.bytes().take(16).position(|byte| byte == b';')?;
    let name = &body[..end];
    let character = match name {
        "lt" => '<',
        "gt" => '>',
        "amp" => '&',
        "quot" => '"',
        "apos" => '\'',
        _ => number(name.strip_prefix('#')?)?,
    };
    Some((character, end + 2))
}

fn number(digits: &str) -> Option<char> {
    let (digits, radix) = digits.strip_prefix('x').map_or((digits, 10), |hex| (hex, 16));
    if !digits.starts_with(|c: char| c.is_digit(radix)) {
        return None;
    }
    u32::from_str_radix(digits, radix).ok().and_then(char::from_u32)
}
