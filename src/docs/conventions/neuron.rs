//! `{description := "…"; comment := '…'}`: the pragmas of Neuron Power Engineer and logi.CAD.

use crate::library::Pragma;
use crate::text::{Place, Span};

/// The texts of a pragma's `description` and `comment`, unescaped, and where they stand.
pub(in crate::docs) fn description(pragma: &Pragma) -> Vec<(String, Place)> {
    let mut out = Vec::new();
    for key in ["description", "comment"] {
        if let Some((start, end)) = string(&pragma.text, key) {
            let base = pragma.place.span.start;
            let offset = |at: usize| base + u32::try_from(at).unwrap_or(0);
            let span = Span::new(offset(start), offset(end).min(pragma.place.span.end));
            out.push((unescape(&pragma.text[start..end]), Place::new(pragma.place.file, span)));
        }
    }
    out.retain(|(text, _)| !text.trim().is_empty());
    out
}

/// Where the string behind `key :=` begins and ends, without its quotes.
fn string(text: &str, key: &str) -> Option<(usize, usize)> {
    let lower = text.to_ascii_lowercase();
    let at = lower.match_indices(key).map(|(at, _)| at).find(|at| {
        let before = text[..*at].trim_end();
        before.ends_with(['{', ';', ','])
    })?;
    let rest = text[at + key.len()..].trim_start().strip_prefix(":=")?.trim_start();
    let quote = rest.chars().next().filter(|c| matches!(c, '"' | '\''))?;
    let start = text.len() - rest.len() + 1;
    let mut escaped = false;
    for (i, c) in text[start..].char_indices() {
        match c {
            _ if escaped => escaped = false,
            '$' => escaped = true,
            c if c == quote => return Some((start, start + i)),
            _ => {}
        }
    }
    None
}

/// `$'`, `$N` and their kind.
fn unescape(text: &str) -> String {
    let mut out = String::new();
    let mut chars = text.chars();
    while let Some(c) = chars.next() {
        if c != '$' {
            out.push(c);
            continue;
        }
        match chars.next() {
            Some('N' | 'n' | 'L' | 'l' | 'R' | 'r' | 'P' | 'p') => out.push('\n'),
            Some('T' | 't') => out.push('\t'),
            Some(other) => out.push(other),
            None => out.push('$'),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::FileId;

    #[test]
    fn a_description_is_found_among_other_data() {
        let text = r#"{ unit := "bar"; description := "the $"high$" side$Nof it"; }"#.to_owned();
        let pragma = Pragma { place: Place::new(FileId(0), Span::new(10, 200)), text };
        let found = description(&pragma);
        assert_eq!(found[0].0, "the \"high\" side\nof it");
        let at = pragma.text.find("the ").unwrap();
        assert_eq!(found[0].1.span.start as usize, 10 + at);
        let other = Pragma { text: "{attribute 'description' := 'x'}".to_owned(), ..pragma };
        assert!(description(&other).is_empty());
    }
}
