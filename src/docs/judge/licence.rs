//! Copyright notices and licences.
//!
//! A paragraph with the wording of one of the usual licences is set aside, and so is what stands
//! between two such paragraphs (the conditions of a BSD licence) and a short title before the
//! first. What is left is prose: some write a line of documentation below the notice.

use std::ops::Range;

use crate::docs::conventions::file_header;
use crate::docs::mapped::Mapped;

/// Wording of licences, in lower case. The GNU family, MIT, BSD, Apache, MPL, SPDX tags.
const WORDING: [&str; 28] = [
    "all rights reserved",
    "permission is hereby granted",
    "permission to use, copy, modify",
    "permission notice shall be included",
    "free software",
    "gnu general public",
    "gnu lesser",
    "gnu affero",
    "mit license",
    "apache license",
    "bsd license",
    "mozilla public",
    "spdx-license-identifier",
    "spdx-filecopyrighttext",
    "without any warranty",
    "without warranties",
    "warranty of any kind",
    "is provided \"as is\"",
    "is provided by the copyright",
    "redistribution and use in",
    "redistributions of source",
    "redistributions in binary",
    "neither the name of",
    "you may not use this file",
    "unless required by applicable law",
    "you may obtain a copy",
    "you should have received a copy",
    "under the terms of the",
];

/// The prose without licences; `None` if nothing is left.
pub(super) fn without(text: &Mapped) -> Option<Mapped> {
    let paragraphs = paragraphs(text);
    let is_licence = |range: &Range<usize>| speaks_of_licence(&text.as_str()[range.clone()]);
    let Some(first) = paragraphs.iter().position(is_licence) else { return Some(text.clone()) };
    if let Some(described) = file_header::description(text) {
        return Some(described);
    }
    let last = paragraphs.iter().rposition(is_licence).unwrap_or(first);
    let mut out = Mapped::beside(text);
    let before = paragraphs[..first].iter().map(|range| text.as_str()[range.clone()].trim().len()).sum::<usize>();
    let is_title = before < 100;
    let kept = if is_title { &[][..] } else { &paragraphs[..first] };
    for range in kept.iter().chain(&paragraphs[last + 1..]) {
        if is_boilerplate(&text.as_str()[range.clone()]) {
            continue;
        }
        if !out.as_str().is_empty() {
            out.add("\n\n");
        }
        out.append(text, range.clone());
    }
    out.as_str().contains(char::is_alphabetic).then_some(out)
}

fn speaks_of_licence(paragraph: &str) -> bool {
    let folded = paragraph.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
    WORDING.iter().any(|wording| folded.contains(wording)) || has_notice(&folded)
}

/// A copyright notice: the word or the sign, with a year, a name or the other sign behind it.
fn has_notice(folded: &str) -> bool {
    if folded.contains('©') {
        return true;
    }
    folded.match_indices("copyright").any(|(at, word)| {
        let opens = at == 0 || folded[..at].ends_with(['.', '|', ' ']) && folded[..at].len() < 40;
        let rest = folded[at + word.len()..].trim_start_matches([' ', ':', '-', ',']);
        let named =
            rest.starts_with("(c)") || rest.starts_with("by ") || rest.starts_with(|c: char| c.is_ascii_digit());
        named || opens && (rest.is_empty() || folded[at + word.len()..].trim_start().starts_with([':', '-', ',']))
    })
}

/// What generated headers say of their file: `Data types of library X`, `Author: Y`.
fn is_boilerplate(paragraph: &str) -> bool {
    paragraph.lines().all(|line| line.trim().is_empty() || file_header::is_boilerplate(line))
}

/// The paragraphs: runs of lines that are not empty.
fn paragraphs(text: &Mapped) -> Vec<Range<usize>> {
    let mut out: Vec<Range<usize>> = Vec::new();
    let mut open = false;
    for line in text.lines() {
        let blank = text.as_str()[line.clone()].trim().is_empty();
        match out.last_mut() {
            Some(last) if open && !blank => last.end = line.end,
            _ if !blank => out.push(line),
            _ => {}
        }
        open = !blank;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::FileId;

    fn left(text: &str) -> Option<String> {
        let mut mapped = Mapped::new(FileId(0));
        mapped.push(text, 0);
        without(&mapped).map(|rest| rest.as_str().to_owned())
    }

    #[test]
    fn a_notice_alone_leaves_nothing() {
        assert_eq!(left("Copyright (c) 2024 A. Author\nAll rights reserved."), None);
        assert_eq!(left("Some library\n\nLicensed under the Apache License, Version 2.0"), None);
    }

    #[test]
    fn prose_below_a_notice_stays() {
        let text = "Copyright 2024 A. Author\n\nExtends the cylinder.\n\nAnd retracts it.";
        assert_eq!(left(text).as_deref(), Some("Extends the cylinder.\n\nAnd retracts it."));
    }

    #[test]
    fn a_word_is_no_licence() {
        let text = "Checks the licence dongle and prints the copyright text.";
        assert_eq!(left(text).as_deref(), Some(text));
    }
}
