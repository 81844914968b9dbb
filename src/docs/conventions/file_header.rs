//! Headers of `Key: value` lines, as generators and company templates write them.
//!
//! The value of `Description` is the documentation, with the lines that go on with it; author and
//! version become tags, all else facts. Sentences such as `Data types of library X` speak of the
//! file and are dropped.

use std::ops::Range;

use super::draft::Draft;
use super::tag_names::Slot;
use crate::docs::mapped::{Mapped, trim};

const KEYS: [&str; 32] = [
    "author",
    "authors",
    "autor",
    "company",
    "copyright",
    "created",
    "created by",
    "creation date",
    "customer",
    "date",
    "datum",
    "description",
    "beschreibung",
    "file",
    "filename",
    "function",
    "function block",
    "last change",
    "last modified",
    "library",
    "modified",
    "name",
    "package",
    "plc",
    "program",
    "project",
    "projekt",
    "purpose",
    "title",
    "type",
    "version",
    "zweck",
];

/// What generated headers say of their file: `Data types of library X`, `Implementation of program Y`.
const BOILERPLATE: [&str; 6] =
    [" of library ", "-library;", " of program ", " of package ", " of task ", "for test set "];

/// Whether `text` opens with at least two such lines.
pub(super) fn is_used(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let has_key = |line: &str| key(line).is_some();
    lines.next().is_some_and(has_key) && lines.next().is_some_and(has_key)
}

/// Whether `text` is such a header and describes nothing.
pub(in crate::docs) fn is_bare(text: &str) -> bool {
    let described = |line: &str| key(line).is_some_and(|(key, value)| is_description(key) && !value.trim().is_empty());
    is_used(text)
        && !text.lines().any(described)
        && text.lines().all(|line| line.trim().is_empty() || is_boilerplate(line))
}

/// Whether a line says something of its file and nothing of what is declared in it.
pub(in crate::docs) fn is_boilerplate(line: &str) -> bool {
    let folded = line.trim().to_lowercase();
    let keyed = key(line.trim()).is_some_and(|(key, _)| !is_description(key));
    let short = folded.split(' ').count() <= 12;
    keyed || short && (folded.starts_with("copyright") || BOILERPLATE.iter().any(|words| folded.contains(words)))
}

/// The description in a header that also holds a copyright notice.
pub(in crate::docs) fn description(text: &Mapped) -> Option<Mapped> {
    let lines = text.lines();
    let found = lines
        .iter()
        .position(|line| key(text.as_str()[line.clone()].trim()).is_some_and(|(key, _)| is_description(key)))?;
    let range = value(text, &lines, found);
    let out = text.trimmed(range);
    (!out.is_blank()).then_some(out)
}

/// Reads `text` into `draft`.
pub(super) fn read(text: &Mapped, draft: &mut Draft) {
    let lines = text.lines();
    let mut i = 0;
    while i < lines.len() {
        let line = trim(text.as_str(), lines[i].clone());
        let part = &text.as_str()[line.clone()];
        let Some((key, rest)) = key(part) else {
            let end = (i + 1..lines.len()).find(|j| is_key(text, &lines[*j])).unwrap_or(lines.len());
            if !is_boilerplate(part) {
                draft.body(text.slice(lines[i].start..lines[end - 1].end));
            }
            i = end;
            continue;
        };
        if is_description(key) {
            let range = value(text, &lines, i);
            i += text.as_str()[line.start..range.end].matches('\n').count() + 1;
            draft.body(text.trimmed(range));
            continue;
        }
        let value = text.slice(line.end - rest.len()..line.end);
        match key {
            "author" | "authors" | "autor" => draft.put(&Slot::Author, value),
            "version" => draft.put(&Slot::Version, value),
            key => draft.fact(key, &value),
        }
        i += 1;
    }
}

fn is_key(text: &Mapped, line: &Range<usize>) -> bool {
    key(text.as_str()[line.clone()].trim()).is_some()
}

/// The value that begins on line `i`, with the lines up to the next key.
fn value(text: &Mapped, lines: &[Range<usize>], i: usize) -> Range<usize> {
    let line = trim(text.as_str(), lines[i].clone());
    let rest = key(&text.as_str()[line.clone()]).map_or("", |(_, rest)| rest);
    let end = (i + 1..lines.len()).find(|j| is_key(text, &lines[*j])).unwrap_or(lines.len());
    line.end - rest.len()..lines[end - 1].end
}

fn is_description(key: &str) -> bool {
    matches!(key, "description" | "beschreibung" | "purpose" | "zweck")
}

/// The key that opens `line`, and its value.
fn key(line: &str) -> Option<(&'static str, &str)> {
    let (head, rest) = line.split_once(':')?;
    let head = head.trim_start_matches(['@', '\\']).trim().to_lowercase();
    let known = KEYS.iter().find(|key| **key == head)?;
    (!rest.starts_with('=')).then_some((known, rest.trim_start()))
}
