//! What a declaration declares, by its first words: enough for a container that does not say.

use crate::text::{ObjectKind, Span};

/// What the first words of a declaration say.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Leading {
    /// The kind of object that such a declaration belongs to.
    pub(super) kind: ObjectKind,
    /// The name, where one follows.
    pub(super) name: Option<(String, Span)>,
}

/// What `text` declares; `None` where it begins with no word that opens a declaration.
pub(super) fn leading(text: &str) -> Option<Leading> {
    let mut at = skip_trivia(text, 0);
    let word = word_at(text, at);
    let kind = match word.to_ascii_uppercase().as_str() {
        "FUNCTION_BLOCK" | "FUNCTION" | "PROGRAM" | "CLASS" | "ORGANIZATION_BLOCK" => ObjectKind::Pou,
        "INTERFACE" => ObjectKind::Interface,
        "METHOD" => ObjectKind::Method,
        "PROPERTY" => ObjectKind::Property,
        "ACTION" => ObjectKind::Action,
        "TRANSITION" => ObjectKind::Transition,
        "TYPE" => ObjectKind::DataType,
        "VAR_GLOBAL" | "VAR_CONFIG" | "VAR_ACCESS" => {
            return Some(Leading { kind: ObjectKind::GlobalVariables, name: None });
        }
        _ => return None,
    };
    at += word.len();
    loop {
        at = skip_trivia(text, at);
        let word = word_at(text, at);
        let modifier = matches!(
            word.to_ascii_uppercase().as_str(),
            "PUBLIC" | "PRIVATE" | "PROTECTED" | "INTERNAL" | "ABSTRACT" | "FINAL" | "OVERRIDE"
        );
        // A modifier can also be the name, if nothing else follows.
        let next = skip_trivia(text, at + word.len());
        if modifier && !word_at(text, next).is_empty() {
            at = next;
            continue;
        }
        let name = (!word.is_empty()).then(|| (word.trim_matches('"').to_owned(), Span::from(at..at + word.len())));
        return Some(Leading { kind, name });
    }
}

/// The place behind white space, comments and pragmas from `at` on.
pub(super) fn skip_trivia(text: &str, mut at: usize) -> usize {
    // Comments nest until one does not close so; then none of the text does.
    let mut nests = true;
    loop {
        let rest = &text[at..];
        let trimmed = rest.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{FEFF}');
        at = text.len() - trimmed.len();
        let length = match trimmed.as_bytes() {
            [b'/', b'/', ..] => trimmed.find('\n').unwrap_or(trimmed.len()),
            [b'(', b'*', ..] => {
                let nested = if nests { block(trimmed) } else { None };
                nests = nested.is_some();
                nested.unwrap_or_else(|| trimmed.find("*)").map_or(trimmed.len(), |end| end + 2))
            }
            [b'/', b'*', ..] => trimmed.find("*/").map_or(trimmed.len(), |end| end + 2),
            [b'{', ..] => trimmed.find('}').map_or(trimmed.len(), |end| end + 1),
            _ => return at,
        };
        at += length;
    }
}

/// The length of the comment at the start of `text`, if it closes as comments that nest do.
fn block(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let (mut depth, mut at) = (0_u32, 0);
    while at + 1 < bytes.len() {
        match (bytes[at], bytes[at + 1]) {
            (b'(', b'*') => {
                depth += 1;
                at += 2;
            }
            (b'*', b')') => {
                depth = depth.saturating_sub(1);
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

/// The word, or the name in `"…"`, at `at`; empty if there is none.
pub(super) fn word_at(text: &str, at: usize) -> &str {
    let rest = &text[at..];
    if let Some(quoted) = rest.strip_prefix('"') {
        return quoted.find('"').map_or("", |end| &rest[..end + 2]);
    }
    let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len());
    &rest[..end]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Option<(ObjectKind, Option<String>)> {
        leading(text).map(|leading| (leading.kind, leading.name.map(|name| name.0)))
    }

    #[test]
    fn comments_pragmas_and_modifiers_come_before_the_name() {
        let text =
            "(* FUNCTION (* nested *) x *) // PROGRAM\n{attribute 'a'} FUNCTION_BLOCK ABSTRACT FINAL FB_A EXTENDS B";
        assert_eq!(read(text), Some((ObjectKind::Pou, Some("FB_A".to_owned()))));
        assert_eq!(read("METHOD final"), Some((ObjectKind::Method, Some("final".to_owned()))));
        assert_eq!(read("FUNCTION \"My block\" : Int"), Some((ObjectKind::Pou, Some("My block".to_owned()))));
        assert_eq!(read("VAR_GLOBAL a"), Some((ObjectKind::GlobalVariables, None)));
        assert_eq!(read("x := 1;"), None);
        assert_eq!(read(""), None);
    }

    #[test]
    fn a_comment_that_does_not_nest_ends_at_its_first_end() {
        assert_eq!(read("(* a (* b *) TYPE t : INT; END_TYPE"), Some((ObjectKind::DataType, Some("t".to_owned()))));
    }
}
