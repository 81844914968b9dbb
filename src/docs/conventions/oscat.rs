//! OSCAT: after the last `END_VAR` a block of `version 1.2 date`, `programmer`, `tested by`, then
//! prose. Other libraries of the time write the same with colons.

use super::draft::Draft;
use super::tag_names::Slot;
use crate::docs::mapped::{Mapped, trim};

const KEYS: [&str; 6] = ["version", "programmer", "tested by", "testet by", "author", "date"];

/// Whether `text` opens with such a block.
pub(in crate::docs) fn is_used(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let versioned = |line: &str| key(line).is_some_and(|(key, rest)| key == "version" && has_digit(rest));
    let first = lines.next().is_some_and(versioned);
    first && lines.take(3).any(|line| key(line).is_some_and(|(key, _)| key != "version"))
}

fn has_digit(text: &str) -> bool {
    text.contains(|c: char| c.is_ascii_digit())
}

/// The key that opens `line`, and what follows.
fn key(line: &str) -> Option<(&'static str, &str)> {
    KEYS.iter().find_map(|key| {
        let head = line.get(..key.len()).filter(|head| head.eq_ignore_ascii_case(key))?;
        let rest = &line[head.len()..];
        (rest.is_empty() || rest.starts_with([' ', '\t', ':'])).then_some((*key, rest))
    })
}

/// Reads `text` into `draft`.
pub(super) fn read(text: &Mapped, draft: &mut Draft) {
    let lines = text.lines();
    let mut body = 0;
    for (i, line) in lines.iter().enumerate() {
        let line = trim(text.as_str(), line.clone());
        let part = &text.as_str()[line.clone()];
        if part.is_empty() {
            continue;
        }
        let Some((key, rest)) = key(part) else { break };
        let rest = rest.trim_start_matches([':', ' ', '\t']);
        let value = text.slice(line.end - rest.len()..line.end);
        match key {
            "version" => draft.put(&Slot::Version, value),
            "programmer" | "author" => draft.put(&Slot::Author, value),
            key => draft.fact(if key == "testet by" { "tested by" } else { key }, &value),
        }
        body = i + 1;
    }
    if let Some(first) = lines.get(body) {
        draft.body(text.slice(first.start..text.as_str().len()));
    }
}
