//! Lines that let a finding pass, `@allow CODE: reason`. They speak to the tool and are no documentation.

use crate::docs::mapped::Mapped;

/// `text` without such lines.
pub(super) fn without(text: &Mapped) -> Mapped {
    if !text.as_str().contains("@allow") {
        return text.clone();
    }
    let mut out = Mapped::beside(text);
    for line in text.lines() {
        let word = text.as_str()[line.clone()].trim_start();
        if word.strip_prefix("@allow").is_some_and(|rest| rest.starts_with([' ', '\t', ':'])) {
            continue;
        }
        if !out.as_str().is_empty() {
            out.add("\n");
        }
        out.append(text, line);
    }
    out
}
