//! The heading of a pipe table: `@gtt NAME (attribute, attribute …)`.
//!
//! Attributes: `cycle 10ms`, `strict`, `weak`, `const NAME = 5` (or a time), `global NAME : TYPE with CELL`,
//! `for BLOCK`, `runs A B`, `concrete`, `option KEY = VALUE`. They may go on over several lines.

use super::build::{Builder, word};
use crate::diagnostic::Finding;
use crate::table::cell::literal;
use crate::table::codes;
use crate::table::model::{CycleTime, Quantity, TimeConstant, Word};
use crate::table::piece::Piece;
use crate::text::near::nearest;

const KEYWORDS: [&str; 9] = ["cycle", "strict", "weak", "concrete", "const", "global", "for", "runs", "option"];

/// Reads the attributes of a heading, without the parentheses round them.
pub(super) fn attributes(builder: &mut Builder<'_>, piece: &Piece<'_>) {
    for attribute in split(piece) {
        one(builder, &attribute.trimmed());
    }
}

/// The parts between commas; a part that no keyword begins belongs to the constraint in front of it.
fn split<'a>(piece: &Piece<'a>) -> Vec<Piece<'a>> {
    let mut cuts = vec![0];
    let mut depth = 0_i32;
    for (at, c) in piece.text.char_indices() {
        match c {
            '[' | '(' => depth += 1,
            ']' | ')' => depth -= 1,
            ',' if depth <= 0 && begins_attribute(&piece.text[at + 1..], &piece.text[cuts[cuts.len() - 1]..at]) => {
                cuts.push(at + 1);
            }
            _ => {}
        }
    }
    cuts.push(piece.text.len() + 1);
    cuts.windows(2).map(|cut| piece.part(cut[0]..(cut[1] - 1).max(cut[0]))).collect()
}

fn begins_attribute(rest: &str, before: &str) -> bool {
    let in_constraint = first_word(before.trim_start()).eq_ignore_ascii_case("global");
    let next = first_word(rest.trim_start());
    !in_constraint || KEYWORDS.iter().any(|keyword| next.eq_ignore_ascii_case(keyword))
}

fn first_word(text: &str) -> &str {
    text.split(|c: char| c.is_whitespace() || c == '=' || c == ':').next().unwrap_or("")
}

fn one(builder: &mut Builder<'_>, piece: &Piece<'_>) {
    let key = first_word(piece.text);
    let rest = piece.part(key.len()..piece.text.len()).trimmed();
    match key.to_ascii_lowercase().as_str() {
        "" => {}
        "cycle" => cycle(builder, &after_sign(&rest)),
        "strict" if rest.text.is_empty() => builder.table.options.strict = true,
        "weak" if rest.text.is_empty() => builder.table.options.strict = false,
        "concrete" if rest.text.is_empty() => builder.table.options.concrete = true,
        "const" => constant(builder, &rest),
        "global" => global(builder, &rest),
        "for" => builder.table.unit = Some(word(&rest)),
        "runs" => builder.table.runs = words(&rest),
        "option" => option(builder, &rest),
        _ => unknown(builder, piece, key),
    }
}

fn unknown(builder: &mut Builder<'_>, piece: &Piece<'_>, key: &str) {
    let near = nearest(key, KEYWORDS.into_iter());
    let finding = Finding::new(
        &codes::TABLE_SYNTAX,
        piece.whole(),
        format!("a heading has no attribute `{}`", piece.text.trim()),
    );
    builder.report(match near {
        Some(near) => finding.help(format!("`{near}` is one")),
        None => finding,
    });
}

/// Without a `=` or `:` at the beginning.
fn after_sign<'a>(piece: &Piece<'a>) -> Piece<'a> {
    let skip = usize::from(piece.text.starts_with(['=', ':']));
    piece.part(skip..piece.text.len()).trimmed()
}

fn words(piece: &Piece<'_>) -> Vec<Word> {
    let mut out = Vec::new();
    let mut start = None;
    for (at, c) in piece.text.char_indices().chain(std::iter::once((piece.text.len(), ' '))) {
        let inside = !c.is_whitespace() && c != ',';
        match (inside, start) {
            (true, None) => start = Some(at),
            (false, Some(begin)) => {
                out.push(word(&piece.part(begin..at)));
                start = None;
            }
            _ => {}
        }
    }
    out
}

/// The value of a time constant or of the cycle time.
pub(super) fn quantity(text: &str) -> Option<Quantity> {
    let text = text.trim();
    if let Ok(count) = text.parse::<i128>() {
        return (count >= 0).then_some(Quantity::Cycles(count));
    }
    let bare = text.split_once('#').map_or(text, |(_, rest)| rest);
    literal::time(bare).map(Quantity::Nanos)
}

fn cycle(builder: &mut Builder<'_>, piece: &Piece<'_>) {
    match quantity(piece.text) {
        Some(Quantity::Nanos(nanos)) if nanos > 0 => {
            builder.table.options.cycle = Some(CycleTime { nanos, place: Some(piece.whole()) });
        }
        _ => {
            let message = format!("`{}` is no cycle time", piece.text);
            let finding = Finding::new(&codes::TABLE_SYNTAX, piece.whole(), message);
            builder.report(finding.help("write a time above zero, as in `cycle 10ms`"));
        }
    }
}

fn constant(builder: &mut Builder<'_>, piece: &Piece<'_>) {
    let Some(at) = piece.text.find(['=', ':']) else {
        builder.wrong(&codes::TABLE_SYNTAX, piece.whole(), "a time constant is written `const NAME = 5`");
        return;
    };
    let name = word(&piece.part(0..at).trimmed());
    let sign = piece.text[at..].len() - piece.text[at..].trim_start_matches([':', '=']).len();
    let value = piece.part(at + sign..piece.text.len()).trimmed();
    add_constant(builder, name, &value);
}

/// Adds a time constant to the table.
pub(super) fn add_constant(builder: &mut Builder<'_>, name: Word, value: &Piece<'_>) {
    if name.text.is_empty() || !name.text.chars().all(|c| c.is_alphanumeric() || c == '_') {
        builder.wrong(&codes::TABLE_SYNTAX, name.place, format!("`{}` is no name", name.text));
        return;
    }
    match quantity(value.text) {
        Some(quantity) => {
            builder.table.constants.push(TimeConstant { name: name.text, value: quantity, place: name.place });
        }
        None => {
            let message = format!("`{}` is neither a number of cycles nor a time", value.text);
            builder.wrong(&codes::TABLE_SYNTAX, value.whole(), message);
        }
    }
}

fn global(builder: &mut Builder<'_>, piece: &Piece<'_>) {
    let with = find_word(piece.text, "with");
    let head = piece.part(0..with.unwrap_or(piece.text.len()));
    let (name, ty) = match head.text.find(':') {
        Some(at) => (head.part(0..at).trimmed(), Some(head.part(at + 1..head.text.len()).trimmed())),
        None => (head.trimmed(), None),
    };
    if name.text.is_empty() || !name.text.chars().all(|c| c.is_alphanumeric() || c == '_') {
        let message = "a global variable is written `global NAME : TYPE with CELL`";
        builder.wrong(&codes::TABLE_SYNTAX, piece.whole(), message);
        return;
    }
    let constraint = with.map(|at| piece.part(at + 4..piece.text.len()));
    builder.global(word(&name), ty.as_ref().map(word), constraint.as_ref());
}

/// Where `wanted` stands in `text` as a word of its own.
pub(super) fn find_word(text: &str, wanted: &str) -> Option<usize> {
    text.match_indices(wanted).map(|(at, _)| at).find(|at| {
        let before = text[..*at].chars().next_back().is_none_or(char::is_whitespace);
        let after = text[at + wanted.len()..].chars().next().is_none_or(char::is_whitespace);
        before && after
    })
}

fn option(builder: &mut Builder<'_>, piece: &Piece<'_>) {
    match piece.text.find('=') {
        Some(at) => {
            let key = word(&piece.part(0..at).trimmed());
            let value = word(&piece.part(at + 1..piece.text.len()).trimmed());
            builder.table.options.entries.push((key, value));
        }
        None => builder.wrong(&codes::TABLE_SYNTAX, piece.whole(), "an option is written `option KEY = VALUE`"),
    }
}
