//! What the lexer scans by hand: how long a comment, a pragma or a literal of time is.
//!
//! Every function looks at the bytes behind what the lexer has matched already.

use super::kind::TokenKind;

/// The literal that `prefix#` and `value` (which begins behind the `#`) make, with the length of its value.
pub(super) fn time_literal(prefix: &str, value: &[u8]) -> Option<(TokenKind, usize)> {
    const PREFIXES: [(&str, TokenKind); 21] = [
        ("T", TokenKind::Duration),
        ("TIME", TokenKind::Duration),
        ("LT", TokenKind::Duration),
        ("LTIME", TokenKind::Duration),
        ("S5T", TokenKind::Duration),
        ("S5TIME", TokenKind::Duration),
        ("D", TokenKind::Date),
        ("DATE", TokenKind::Date),
        ("LD", TokenKind::Date),
        ("LDATE", TokenKind::Date),
        ("TOD", TokenKind::TimeOfDay),
        ("TIME_OF_DAY", TokenKind::TimeOfDay),
        ("LTOD", TokenKind::TimeOfDay),
        ("LTIME_OF_DAY", TokenKind::TimeOfDay),
        ("DT", TokenKind::DateAndTime),
        ("DATE_AND_TIME", TokenKind::DateAndTime),
        ("DATE_TIME", TokenKind::DateAndTime),
        ("LDT", TokenKind::DateAndTime),
        ("LDATE_AND_TIME", TokenKind::DateAndTime),
        ("LDATE_TIME", TokenKind::DateAndTime),
        ("DTL", TokenKind::DateAndTime),
    ];
    let (_, kind) = PREFIXES.iter().find(|(text, _)| text.eq_ignore_ascii_case(prefix))?;
    let digit_follows = |at: usize| value.get(at + 1).is_some_and(u8::is_ascii_digit);
    let mut at = usize::from(matches!(value.first(), Some(b'+' | b'-')));
    while let Some(byte) = value.get(at) {
        let belongs = match byte {
            b'0'..=b'9' | b'_' => true,
            b'.' => digit_follows(at),
            b'-' | b':' => *kind != TokenKind::Duration && digit_follows(at),
            byte => *kind == TokenKind::Duration && byte.is_ascii_alphabetic(),
        };
        if !belongs {
            break;
        }
        at += 1;
    }
    Some((*kind, at))
}

/// The length of a comment that nests, from behind its `(*` to behind its `*)`.
pub(super) fn nested_length(rest: &[u8]) -> Option<usize> {
    let mut depth = 1_u32;
    let mut at = 0;
    while at + 1 < rest.len() {
        match (rest[at], rest[at + 1]) {
            (b'(', b'*') => {
                depth = depth.saturating_add(1);
                at += 2;
            }
            (b'*', b')') => {
                depth -= 1;
                at += 2;
                if depth == 0 {
                    return Some(at);
                }
            }
            _ => at += 1,
        }
    }
    None
}

/// Whether quotes in a pragma delimit strings: they do not in the free text of a region.
pub(super) fn pragma_has_strings(rest: &[u8]) -> bool {
    let word = rest.trim_ascii_start();
    let begins = |prefix: &[u8]| word.len() >= prefix.len() && word[..prefix.len()].eq_ignore_ascii_case(prefix);
    !(begins(b"region") || begins(b"endregion") || begins(b"*"))
}

/// The length of a pragma up to the first `}` outside its strings.
pub(super) fn quoted_pragma_length(rest: &[u8]) -> Option<usize> {
    let mut at = 0;
    while let Some(byte) = rest.get(at) {
        match byte {
            b'}' => return Some(at + 1),
            b'\'' | b'"' => {
                let line = &rest[at + 1..];
                let close = line.iter().position(|b| b == byte || matches!(b, b'\r' | b'\n'));
                match close {
                    Some(close) if line[close] == *byte => at += close + 2,
                    _ => at += 1,
                }
            }
            _ => at += 1,
        }
    }
    None
}

pub(super) fn line_length(rest: &[u8]) -> usize {
    rest.iter().position(|byte| matches!(byte, b'\r' | b'\n')).unwrap_or(rest.len())
}

pub(super) fn find(text: &[u8], needle: &[u8]) -> Option<usize> {
    text.windows(needle.len()).position(|window| window == needle)
}
