//! Types as written, and the names in them.
//!
//! `ARRAY[0..GVL.MAX] OF POINTER TO Plant.FB_Axis` names `GVL.MAX`, which is a constant, and
//! `Plant.FB_Axis`, which is the type. Names inside brackets and parentheses are constants; the last
//! one outside of them is the type that a variable has in the end.

use super::elementary::is_elementary;
use super::names::{Found, Names, Scope};
use super::{Catalogue, Target, TypeUse};
use crate::text::{Place, Span};

/// A path of names in a type's text.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Path<'a> {
    parts: Vec<&'a str>,
    span: Span,
    constant: bool,
}

impl TypeUse {
    /// The type whose source text is `text`, at `place`; its names are still to be resolved.
    #[must_use]
    pub fn new(text: &str, place: Option<Place>) -> Self {
        let text = fold_blanks(text);
        let names = paths(&text).iter().map(|path| (path.span, Target::External)).collect();
        Self { text, place, names }
    }

    /// The item that a variable of this type has in the end, behind arrays and pointers.
    #[must_use]
    pub fn item(&self) -> Option<super::ItemId> {
        self.names.iter().rev().find_map(|(_, target)| match target {
            Target::Item(id) => Some(*id),
            Target::Elementary | Target::External => None,
        })
    }

    /// Gives every name its meaning in `scope`.
    pub(super) fn resolve(&mut self, catalogue: &Catalogue, names: &Names, scope: Scope<'_>) {
        let resolved = paths(&self.text).iter().filter_map(|path| resolve(path, catalogue, names, scope)).collect();
        self.names = resolved;
    }
}

/// What a path means; nothing for a constant that this tree does not have.
fn resolve(path: &Path<'_>, catalogue: &Catalogue, names: &Names, scope: Scope<'_>) -> Option<(Span, Target)> {
    if is_elementary(&path.parts.join(".")) {
        return (!path.constant).then_some((path.span, Target::Elementary));
    }
    match names.path(catalogue, &path.parts, scope) {
        Some(Found::Item(id) | Found::Variable(id, _)) => Some((path.span, Target::Item(id))),
        None if path.constant => None,
        None => Some((path.span, Target::External)),
    }
}

fn fold_blanks(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The paths in `text`, in order. Numbers, strings and typed literals are none.
fn paths(text: &str) -> Vec<Path<'_>> {
    let bytes = text.as_bytes();
    let mut found: Vec<Path<'_>> = Vec::new();
    let mut depth = 0_usize;
    let mut at = 0;
    while at < bytes.len() {
        match bytes[at] {
            b'[' | b'(' => depth += 1,
            b']' | b')' => depth = depth.saturating_sub(1),
            b'\'' => at = skip(bytes, at, b'\''),
            b'"' => {
                let end = skip(bytes, at, b'"');
                found.push(path(text, at + 1, end, depth > 0));
                at = end;
            }
            b'0'..=b'9' => {
                at = word_end(bytes, at, |c| c.is_ascii_alphanumeric() || matches!(c, b'_' | b'#'));
                continue;
            }
            c if is_name(c) => {
                let end = word_end(bytes, at, |c| is_name(c) || c.is_ascii_digit() || c == b'.');
                let end = at + text[at..end].trim_end_matches('.').len();
                if bytes.get(end) != Some(&b'#') {
                    found.push(path(text, at, end, depth > 0));
                }
                at = end.max(at + 1);
                continue;
            }
            _ => {}
        }
        at += 1;
    }
    found
}

fn path(text: &str, start: usize, end: usize, constant: bool) -> Path<'_> {
    Path { parts: text[start..end].split('.').collect(), span: Span::from(start..end), constant }
}

const fn is_name(c: u8) -> bool {
    c.is_ascii_alphabetic() || c == b'_' || c >= 0x80
}

fn word_end(bytes: &[u8], at: usize, part: impl Fn(u8) -> bool) -> usize {
    bytes[at..].iter().position(|c| !part(*c)).map_or(bytes.len(), |n| at + n)
}

/// The offset of the quote that closes the one at `at`, or the end.
fn skip(bytes: &[u8], at: usize, quote: u8) -> usize {
    bytes[at + 1..].iter().position(|c| *c == quote).map_or(bytes.len(), |n| at + 1 + n)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> Vec<(String, bool)> {
        paths(text).into_iter().map(|path| (path.parts.join("."), path.constant)).collect()
    }

    #[test]
    fn constants_and_types_are_told_apart() {
        let seen = names("ARRAY[0..GVL.MAX, 1..N] OF POINTER TO Plant.FB_Axis");
        let expected = [("ARRAY", false), ("GVL.MAX", true), ("N", true), ("OF", false), ("POINTER", false)];
        let expected = expected.into_iter().chain([("TO", false), ("Plant.FB_Axis", false)]);
        assert_eq!(seen, expected.map(|(name, constant)| (name.to_owned(), constant)).collect::<Vec<_>>());
    }

    #[test]
    fn literals_are_no_names() {
        assert_eq!(names("INT (16#FF..INT#10)"), [("INT".to_owned(), false)]);
        assert_eq!(names("STRING('a b')"), [("STRING".to_owned(), false)]);
        assert_eq!(names("\"My Type\""), [("My Type".to_owned(), false)]);
    }

    #[test]
    fn a_quote_that_nothing_closes_reaches_to_the_end() {
        assert_eq!(names("\""), [(String::new(), false)]);
        assert_eq!(names("\"Maß"), [("Maß".to_owned(), false)]);
        assert_eq!(names("INT 'ß"), [("INT".to_owned(), false)]);
    }
}
