//! Revision histories: kept, but apart from documentation.
//!
//! A history opens with a heading (`revision history`, `Change log:`; OSCAT spells it in several
//! ways) or with a line that names a version and a date; it reaches to the end of the comment, or
//! to the next line that opens a tag. A comment with no heading is a history if most of its lines
//! begin with a version or a date; so is its last paragraph if all of that paragraph's do.

use crate::docs::mapped::Mapped;

const HEADINGS: [&str; 18] = [
    "revision history",
    "revision histroy",
    "revison history",
    "revision hystory",
    "revisions",
    "version history",
    "history",
    "histroy",
    "change history",
    "change log",
    "changelog",
    "changes",
    "release notes",
    "modification history",
    "änderungshistorie",
    "änderungen",
    "versionshistorie",
    "historie",
];

/// Cuts `text` into prose and history; a part without words is `None`.
pub(super) fn split(text: &Mapped) -> (Option<Mapped>, Option<Mapped>) {
    let lines = text.lines();
    let line = |i: usize| &text.as_str()[lines[i].clone()];
    let opens = (0..lines.len()).find(|i| is_heading(line(*i)) && (*i + 1 == lines.len() || is_dated(text, *i + 1)));
    let Some(start) = opens.or_else(|| mostly_entries(text).then_some(0)).or_else(|| last_entries(text)) else {
        return ((!text.is_blank()).then(|| text.clone()), None);
    };
    let end = (start + 1..lines.len()).find(|i| line(*i).trim_start().starts_with('@')).unwrap_or(lines.len());
    let mut prose = text.slice(0..lines[start].start);
    if let Some(rest) = lines.get(end) {
        prose.append(text, rest.start..text.as_str().len());
    }
    let body = if is_heading(line(start)) { start + 1 } else { start };
    let history = match (lines.get(body), lines.get(end - 1)) {
        (Some(first), Some(last)) if body < end => text.trimmed(first.start..last.end),
        _ => Mapped::beside(text),
    };
    (filled(prose), filled(history))
}

fn filled(text: Mapped) -> Option<Mapped> {
    let range = super::super::mapped::trim(text.as_str(), 0..text.as_str().len());
    text.as_str()[range.clone()].contains(char::is_alphanumeric).then(|| {
        // Only whole lines go, so that the indentation of the first one stays what it was.
        let start = text.as_str()[..range.start].rfind('\n').map_or(0, |at| at + 1);
        text.slice(start..range.end)
    })
}

fn is_heading(line: &str) -> bool {
    let folded = line.trim().trim_matches(|c: char| !c.is_alphanumeric()).to_lowercase();
    HEADINGS.contains(&folded.as_str())
}

/// Whether one of the three lines from `from` on holds a digit, as entries of a history do.
fn is_dated(text: &Mapped, from: usize) -> bool {
    let lines = text.lines();
    let next = lines[from.min(lines.len())..].iter().map(|line| &text.as_str()[line.clone()]);
    next.filter(|line| !line.trim().is_empty()).take(3).any(|line| line.contains(|c: char| c.is_ascii_digit()))
}

fn mostly_entries(text: &Mapped) -> bool {
    let lines: Vec<&str> = text.as_str().lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    let entries = lines.iter().filter(|line| is_entry(line)).count();
    lines.first().is_some_and(|line| is_entry(line)) && entries >= 2 && entries * 2 > lines.len()
}

/// Where the last paragraph begins, if it is two entries or more and nothing else.
fn last_entries(text: &Mapped) -> Option<usize> {
    let lines = text.lines();
    let line = |i: usize| text.as_str()[lines[i].clone()].trim();
    let end = (0..lines.len()).rev().find(|i| !line(*i).is_empty())?;
    let start = (0..=end).rev().take_while(|i| !line(*i).is_empty()).last()?;
    (start < end && (start..=end).all(|i| is_entry(line(i)))).then_some(start)
}

/// Whether a line begins as `V1.2`, `1.0.3 2020-…`, `2020-05-01` or `01.05.2020` does.
fn is_entry(line: &str) -> bool {
    let mut words = line.split_whitespace().map(|word| word.trim_matches([':', '-', '|', '[', ']', '(', ')']));
    let named =
        |word: &str| ["version", "rev", "rev.", "ver", "ver."].iter().any(|name| word.eq_ignore_ascii_case(name));
    let word = words.find(|word| !named(word)).unwrap_or("");
    is_date(word)
        || is_version(word) && line.split_whitespace().any(|word| is_date(word.trim_matches([',', '(', ')', ':'])))
}

fn is_date(word: &str) -> bool {
    let parts: Vec<&str> = word.split(['.', '-', '/']).collect();
    let number = |part: &&str| !part.is_empty() && part.len() <= 4 && part.chars().all(|c| c.is_ascii_digit());
    parts.len() == 3 && parts.iter().all(number) && parts.iter().any(|part| part.len() == 4)
}

fn is_version(word: &str) -> bool {
    let word = word.trim_start_matches(['v', 'V']);
    word.contains('.') && word.split('.').all(|part| !part.is_empty() && part.chars().all(|c| c.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::FileId;

    fn cut(text: &str) -> (Option<String>, Option<String>) {
        let mut mapped = Mapped::new(FileId(0));
        mapped.push(text, 0);
        let (prose, history) = split(&mapped);
        (prose.map(|m| m.as_str().to_owned()), history.map(|m| m.as_str().to_owned()))
    }

    #[test]
    fn a_heading_with_dated_lines_opens_a_history() {
        let (prose, history) = cut("Adds two numbers.\n\nRevision histroy\nab 1. may 2008 rev 1.0\n first");
        assert_eq!(prose.as_deref(), Some("Adds two numbers."));
        assert_eq!(history.as_deref(), Some("ab 1. may 2008 rev 1.0\n first"));
    }

    #[test]
    fn entries_need_no_heading() {
        let (prose, history) = cut("V1.0 2020-01-01 first\nV1.1 2021-02-03 second");
        assert_eq!(prose, None);
        assert!(history.is_some());
    }

    #[test]
    fn entries_at_the_end_need_no_heading() {
        let (prose, history) = cut("Turns.\n\nVersion 1.0 2020-01-01 first\nVersion 1.1 2021-02-03 second");
        assert_eq!(prose.as_deref(), Some("Turns."));
        assert_eq!(history.as_deref(), Some("Version 1.0 2020-01-01 first\nVersion 1.1 2021-02-03 second"));
        let text = "Made by A.\n\nVersion 1.0 2020-01-01";
        assert_eq!(cut(text), (Some(text.to_owned()), None));
    }

    #[test]
    fn the_word_in_a_sentence_is_prose() {
        let text = "Keeps a history\nof the last 10 values.";
        assert_eq!(cut(text), (Some(text.to_owned()), None));
    }
}
