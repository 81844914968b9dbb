//! Tags as Javadoc and Doxygen write them: `@param name text`, `\return text`.
//!
//! A tag begins a line; its text reaches to the next tag or to an empty line, after which prose goes
//! on. `@example` and `@details` reach to the next tag. Words that are no tags stay text, and nothing
//! in a fence is a tag. In running text `{@link X}`, `@ref X`, `@c x` and their kind become Markdown.

use std::ops::Range;

use super::draft::Draft;
use super::tag_names::{Slot, slot};
use crate::docs::mapped::{Mapped, trim};

/// Whether a line of `text` begins with a tag.
pub(super) fn is_used(text: &str) -> bool {
    text.lines()
        .map(str::trim_start)
        .any(|line| todo(line).is_none() && tag(line).is_some() || line.starts_with("@code"))
}

/// Reads `text` into `draft`.
pub(super) fn read(text: &Mapped, draft: &mut Draft) {
    read_lines(&inline(text), draft);
}

/// Reads `text`, in which no sign stands for a command; notes to oneself are still told from prose.
pub(super) fn read_plain(text: &Mapped, draft: &mut Draft) {
    read_lines(text, draft);
}

fn read_lines(text: &Mapped, draft: &mut Draft) {
    let mut open = Open { slot: Slot::Body, text: Mapped::beside(text), explicit: false };
    let mut fence: Option<String> = None;
    for line in text.lines() {
        let part = &text.as_str()[line.clone()];
        let word = part.trim();
        if let Some(mark) = &fence {
            let closes = word.starts_with(mark.as_str()) || is_command(word, "endcode");
            if closes && is_command(word, "endcode") {
                open.line("```");
            } else {
                open.append(text, line);
            }
            fence = (!closes).then(|| mark.clone());
            continue;
        }
        if word.starts_with("```") || word.starts_with("~~~") {
            fence = Some(word[..3].to_owned());
        } else if is_command(word, "code") {
            fence = Some("```".to_owned());
            open.line("");
            open.line("```st");
            continue;
        } else if let Some((found, rest)) = tag(part) {
            let empty = Open { slot: found, text: Mapped::beside(text), explicit: true };
            std::mem::replace(&mut open, empty).close(draft);
            open.append(text, trim(text.as_str(), line.start + rest..line.end));
            continue;
        } else if word.is_empty() && open.explicit && open.slot.ends_with_paragraph() && !open.text.is_blank() {
            let empty = Open { slot: Slot::Body, text: Mapped::beside(text), explicit: false };
            std::mem::replace(&mut open, empty).close(draft);
            continue;
        }
        open.append(text, line);
    }
    open.close(draft);
}

/// A tag whose text is being collected.
struct Open {
    slot: Slot,
    text: Mapped,
    explicit: bool,
}

impl Open {
    fn append(&mut self, text: &Mapped, range: Range<usize>) {
        if !self.text.as_str().is_empty() {
            self.text.add("\n");
        }
        self.text.append(text, range);
    }

    fn line(&mut self, line: &str) {
        self.text.add("\n");
        self.text.add(line);
    }

    fn close(self, draft: &mut Draft) {
        match &self.slot {
            Slot::Param { note } => param(&self.text, note, draft),
            slot => draft.put(slot, self.text),
        }
    }
}

/// `[in] {TYPE} name - text`
fn param(text: &Mapped, note: &str, draft: &mut Draft) {
    let source = text.as_str();
    let mut note = note.to_owned();
    let mut at = 0;
    for (open, close) in [('[', ']'), ('{', '}')] {
        let rest = source[at..].trim_start();
        if rest.starts_with(open)
            && let Some(end) = rest.find(close)
        {
            rest[1..end].trim().clone_into(&mut note);
            at = source.len() - rest.len() + end + 1;
        }
    }
    let rest = source[at..].trim_start();
    let start = source.len() - rest.len();
    // The name may stand in quotes.
    let inset = rest.len() - rest.trim_start_matches(['`', '\'', '"']).len();
    let in_name = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | ',' | '^');
    let len = rest[inset..].find(|c| !in_name(c)).unwrap_or(rest.len() - inset);
    let name = rest[inset..inset + len].trim_end_matches([',', '.']);
    let quotes = rest[inset + len..].len() - rest[inset + len..].trim_start_matches(['`', '\'', '"']).len();
    let len = inset + len + if inset > 0 { quotes } else { 0 };
    let after = source[start + len..].trim_start_matches([' ', '\t', ':']);
    let after = after.strip_prefix("- ").or_else(|| after.strip_prefix("– ")).unwrap_or(after);
    let names = text.slice(start + inset..start + inset + name.len());
    draft.param(&names, &note, &text.slice(source.len() - after.len()..source.len()));
}

/// The tag that opens `line`, and the offset behind its name; `TODO` and `FIXME` need no sign.
fn tag(line: &str) -> Option<(Slot, usize)> {
    let space = line.len() - line.trim_start().len();
    if let Some(len) = todo(&line[space..]) {
        return Some((Slot::Todo, space + len));
    }
    if let Some(rest) = line[space..].strip_prefix("{@inheritDoc}") {
        return Some((Slot::Copy, line.len() - rest.len()));
    }
    let rest = line[space..].strip_prefix(['@', '\\'])?;
    let len = rest.find(|c: char| !(c.is_ascii_alphabetic() || c == '_')).unwrap_or(rest.len());
    let ends = rest[len..].chars().next().is_none_or(|c| c.is_whitespace() || matches!(c, ':' | '[' | '{' | '.'));
    let found = slot(&rest[..len]).filter(|_| ends)?;
    let colon = usize::from(rest[len..].starts_with(':'));
    Some((found, space + 1 + len + colon))
}

/// The length of the word that opens a note to oneself.
fn todo(line: &str) -> Option<usize> {
    let word = ["TODO", "ToDo", "Todo", "FIXME", "XXX"].into_iter().find(|word| line.starts_with(word))?;
    let rest = &line[word.len()..];
    let ends = rest.is_empty() || rest.starts_with([':', ' ', '\t', '-', '(']);
    ends.then(|| word.len() + rest.len() - rest.trim_start_matches([':', ' ', '\t', '-']).len())
}

/// Whether `word` is the command `name`, possibly with arguments.
fn is_command(word: &str, name: &str) -> bool {
    let rest = word.strip_prefix(['@', '\\']).and_then(|rest| rest.strip_prefix(name));
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['{', ' ']))
}

/// Commands in running text as Markdown.
fn inline(text: &Mapped) -> Mapped {
    let source = text.as_str();
    if !source.contains(['@', '\\']) {
        return text.clone();
    }
    let mut out = Mapped::beside(text);
    let mut from = 0;
    for (at, _) in source.match_indices(['@', '\\']) {
        if at < from {
            continue;
        }
        if let Some((start, end, argument, form)) = command(source, at) {
            out.append(text, from..start);
            let (open, close) = form;
            out.add(open);
            out.append(text, argument);
            out.add(close);
            from = end;
        }
    }
    out.append(text, from..source.len());
    out
}

/// Where a command begins and ends, its argument, and what stands round it in Markdown.
type Command = (usize, usize, Range<usize>, (&'static str, &'static str));

fn command(source: &str, at: usize) -> Option<Command> {
    let rest = &source[at + 1..];
    let len = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
    let braced = source[..at].ends_with('{');
    let boundary = source[..at].chars().next_back().is_none_or(|c| !c.is_alphanumeric());
    let form = match (&rest[..len], braced) {
        ("link" | "linkplain", true) | ("ref" | "link", false) => ("[`", "`]"),
        ("code" | "literal", true) | ("c" | "p", false) => ("`", "`"),
        ("b", false) => ("**", "**"),
        ("e" | "em" | "a", false) => ("*", "*"),
        _ => return None,
    };
    let argument = rest[len..].trim_start_matches(' ');
    let start = source.len() - argument.len();
    let end = if braced {
        start + argument.find(['}', '\n']).filter(|end| argument[*end..].starts_with('}'))?
    } else {
        let end = argument.find(char::is_whitespace).unwrap_or(argument.len());
        start + argument[..end].trim_end_matches(['.', ',', ';', ':', ')']).len()
    };
    let usable = boundary && end > start && len < rest.len() && !source[start..end].contains('`');
    usable.then(|| {
        let begin = if braced { at - 1 } else { at };
        (begin, if braced { end + 1 } else { end }, start..end, form)
    })
}
