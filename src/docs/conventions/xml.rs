//! Elements: `<summary>`, `<param name="x">`, `<remarks>`, as .NET, TcOpen (`(*~ <docu> … ~*)`) and
//! Beckhoff TE1030 write them.
//!
//! Only known elements count; any other `<…>` is text. Elements that do not nest make the whole
//! text plain: a comment is no document, and a guess would lose words. What is inside becomes
//! Markdown, so that people may mix both, as TcOpen does.

mod lex;

use std::ops::Range;

use super::draft::Draft;
use super::javadoc;
use super::tag_names::{Slot, slot};
use crate::docs::mapped::{Mapped, trim};
use lex::{Piece, pieces};

/// Elements that say that the text is meant as XML.
const TELLING: [&str; 13] = [
    "<summary",
    "<docu>",
    "<description>",
    "<remarks",
    "<returns",
    "<param ",
    "<para>",
    "<example>",
    "<see ",
    "<seealso",
    "<paramref",
    "<note ",
    "<inheritdoc",
];

/// Whether `text` is written in elements.
pub(super) fn is_used(text: &str) -> bool {
    let lower = text.to_ascii_lowercase();
    TELLING.iter().any(|name| lower.contains(name))
}

/// Reads `text` into `draft`; `false`, with nothing read, if its elements do not nest.
pub(super) fn read(text: &Mapped, draft: &mut Draft) -> bool {
    let Some(pieces) = pieces(text.as_str()) else { return false };
    let mut writer = Writer { text, stack: vec![Level::new(text, Slot::Body)], draft, lists: Vec::new(), rows: None };
    for piece in pieces {
        writer.piece(piece);
    }
    writer.finish();
    true
}

/// `$FB_Name`, TE1030's cross-reference, as a link.
pub(super) fn cross_references(text: &Mapped) -> Mapped {
    let source = text.as_str();
    let mut out = Mapped::beside(text);
    let mut from = 0;
    for (at, _) in source.match_indices('$') {
        let rest = &source[at + 1..];
        let len = rest.find(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '.'))).unwrap_or(rest.len());
        let name = rest[..len].trim_end_matches('.');
        if at < from || !name.starts_with(|c: char| c.is_alphabetic() || c == '_') {
            continue;
        }
        out.append(text, from..at);
        out.add("[`");
        out.append(text, at + 1..at + 1 + name.len());
        out.add("`]");
        from = at + 1 + name.len();
    }
    out.append(text, from..source.len());
    out
}

/// An element that collects text of its own.
struct Level {
    slot: Slot,
    param: Option<Mapped>,
    is_link: bool,
    text: Mapped,
}

impl Level {
    const fn new(text: &Mapped, slot: Slot) -> Self {
        Self { slot, param: None, is_link: false, text: Mapped::beside(text) }
    }
}

struct Writer<'a> {
    text: &'a Mapped,
    stack: Vec<Level>,
    draft: &'a mut Draft,
    lists: Vec<Option<u32>>,
    /// Rows of the open table so far.
    rows: Option<usize>,
}

impl Writer<'_> {
    fn piece(&mut self, piece: Piece<'_>) {
        match piece {
            Piece::Text(range) => self.prose(range),
            Piece::Entity(text) => {
                // An escaped bracket is a bracket and opens nothing.
                self.add(if matches!(text, "<" | "&") { "\\" } else { "" });
                self.add(text);
            }
            Piece::Code(range) => self.code(range),
            Piece::Inline(range) => {
                let range = trim(self.text.as_str(), range);
                self.add("`");
                self.append(range);
                self.add("`");
            }
            Piece::Open { name, attributes, empty } => self.open(name, &attributes, empty),
            Piece::Close(name) => self.close(name),
        }
    }

    fn prose(&mut self, range: Range<usize>) {
        if self.rows.is_none() {
            self.append(range);
            return;
        }
        // The cells of a table stand on one line.
        let source = self.text.as_str();
        let mut from = range.start;
        for (at, _) in source[range.clone()].match_indices('\n') {
            self.append(from..range.start + at);
            self.add(" ");
            from = range.start + at + 1;
        }
        self.append(from..range.end);
    }

    fn code(&mut self, range: Range<usize>) {
        let source = self.text.as_str();
        let lines: Vec<_> = self.text.slice(range.clone()).lines();
        let filled = |line: &&Range<usize>| !source[range.start + line.start..range.start + line.end].trim().is_empty();
        let first = lines.iter().position(|line| filled(&line)).unwrap_or(lines.len());
        let last = lines.iter().rposition(|line| filled(&line)).map_or(first, |last| last + 1);
        let indent = |line: &Range<usize>| {
            let part = &source[range.start + line.start..range.start + line.end];
            part.len() - part.trim_start().len()
        };
        let shared = lines[first..last].iter().filter(filled).map(indent).min().unwrap_or(0);
        self.add("\n\n```st\n");
        for line in &lines[first..last] {
            let start = range.start + line.start + shared.min(line.len());
            self.append(start..range.start + line.end);
            self.add("\n");
        }
        self.add("```\n\n");
    }

    fn open(&mut self, name: &str, attributes: &lex::Attributes, empty: bool) {
        match name {
            "docu" | "doc" | "member" | "term" | "tbody" | "thead" => {}
            "description" | "value" if !self.lists.is_empty() => {}
            "para" | "p" => self.add("\n\n"),
            "br" => self.add("\\\n"),
            "b" | "strong" => self.add("**"),
            "i" | "em" | "u" => self.add("*"),
            "h1" | "h2" | "h3" | "h4" | "h5" | "h6" => {
                self.add("\n\n");
                self.add(&"######"[..name[1..].parse().unwrap_or(1)]);
                self.add(" ");
            }
            "ul" | "list" | "ol" => {
                let numbered = name == "ol" || attributes.get(self.text, "type").as_str() == "number";
                self.lists.push(numbered.then_some(0));
                self.add("\n\n");
            }
            "li" | "item" | "listheader" => self.item(),
            "table" => {
                self.rows = Some(0);
                self.add("\n\n");
            }
            "tr" => self.add("\n|"),
            "td" | "th" => self.add(" "),
            "see" | "a" => self.link(attributes, empty),
            "paramref" | "typeparamref" => {
                self.add("`");
                let name = attributes.get(self.text, "name");
                self.level().append_all(&name);
                self.add("`");
            }
            "inheritdoc" => {
                let target = attributes.target(self.text);
                self.draft.put(&Slot::Copy, target);
                if !empty {
                    self.push(Slot::Body, attributes);
                }
            }
            "seealso" if empty || attributes.has_target() => {
                let target = attributes.target(self.text);
                self.draft.put(&Slot::See, target);
                if !empty {
                    self.push(Slot::Fact("see also"), attributes);
                }
            }
            _ => {
                if let Some(found) = slot(name).or_else(|| (name == "typeparam").then_some(Slot::Param { note: "" })) {
                    self.push(found, attributes);
                    if empty {
                        self.pop();
                    }
                }
            }
        }
    }

    fn push(&mut self, slot: Slot, attributes: &lex::Attributes) {
        let slot = match (&slot, attributes.get(self.text, "type").as_str().to_lowercase().as_str()) {
            (Slot::Note(..), "warning" | "caution" | "security") => Slot::Note("warning", "Warning"),
            (Slot::Note(..), "important") => Slot::Note("warning", "Important"),
            (Slot::Note(..), "tip" | "hint") => Slot::Note("note", "Hint"),
            _ => slot,
        };
        let mut level = Level::new(self.text, slot);
        let name = attributes.get(self.text, "name");
        level.param = (!name.is_blank()).then_some(name);
        self.stack.push(level);
    }

    fn close(&mut self, name: &str) {
        match name {
            "docu" | "doc" | "member" | "term" | "br" | "see" | "a" | "paramref" | "typeparamref" | "tbody"
            | "thead" => {
                if matches!(name, "see" | "a") {
                    self.add_link_end();
                }
            }
            "description" | "value" if !self.lists.is_empty() => {}
            "para" | "p" | "h1" | "h2" | "h3" | "h4" | "h5" | "h6" => self.add("\n\n"),
            "b" | "strong" => self.add("**"),
            "i" | "em" | "u" => self.add("*"),
            "ul" | "list" | "ol" => {
                self.lists.pop();
                self.add("\n\n");
            }
            "li" | "item" | "listheader" => self.add("\n"),
            "table" => {
                self.rows = None;
                self.add("\n\n");
            }
            "tr" => self.row(),
            "td" | "th" => self.add(" |"),
            _ => self.pop(),
        }
    }

    fn item(&mut self) {
        let depth = self.lists.len().saturating_sub(1);
        self.add("\n");
        for _ in 0..depth {
            self.add("    ");
        }
        match self.lists.last_mut() {
            Some(Some(number)) => {
                *number += 1;
                let number = format!("{number}. ");
                self.add(&number);
            }
            _ => self.add("- "),
        }
    }

    /// After the first row of a table, the line that makes it the header.
    fn row(&mut self) {
        let Some(rows) = &mut self.rows else { return };
        *rows += 1;
        if *rows == 1 {
            let line = self.level().as_str().rsplit('\n').next().unwrap_or("").to_owned();
            let columns = line.matches(" |").count().max(1);
            self.add("\n|");
            for _ in 0..columns {
                self.add("---|");
            }
        }
    }

    /// `<see cref="X"/>`, `<see href="…">text</see>`, `<see langword="TRUE"/>`.
    fn link(&mut self, attributes: &lex::Attributes, empty: bool) {
        let word = attributes.get(self.text, "langword");
        if !word.is_blank() {
            self.add("`");
            self.level().append_all(&word);
            self.add("`");
            return;
        }
        let target = attributes.target(self.text);
        self.add("[");
        if empty {
            let shown = last_names(&target);
            self.add("`");
            self.level().append_all(&shown);
            self.add("`");
            self.add_link_target(&target);
        } else {
            self.stack.push(Level { is_link: true, param: Some(target), ..Level::new(self.text, Slot::Body) });
        }
    }

    fn add_link_end(&mut self) {
        if !self.stack.last().is_some_and(|level| level.is_link) {
            return;
        }
        let Some(level) = self.stack.pop() else { return };
        self.level().append_all(&level.text);
        self.add_link_target(&level.param.unwrap_or_else(|| Mapped::beside(self.text)));
    }

    fn add_link_target(&mut self, target: &Mapped) {
        self.add("](<");
        self.level().append_all(target);
        self.add(">)");
    }

    fn pop(&mut self) {
        if self.stack.len() < 2 {
            return;
        }
        let Some(level) = self.stack.pop() else { return };
        match (&level.slot, &level.param) {
            (Slot::Param { note }, Some(name)) => self.draft.param(name, note, &level.text),
            (Slot::Param { .. }, None) => self.draft.put(&Slot::Body, level.text),
            (Slot::Brief, _) => {
                // What stands behind the summary stands behind it in the detail too.
                self.draft.put(&Slot::Brief, level.text);
            }
            (slot, _) => {
                self.flush();
                self.draft.put(slot, level.text);
            }
        }
    }

    /// Hands on the prose collected so far, so that a remark stands where it was written.
    fn flush(&mut self) {
        let text = self.text;
        let level = self.stack.last_mut();
        if let Some(level) = level.filter(|level| level.slot == Slot::Body && !level.is_link) {
            let prose = std::mem::replace(&mut level.text, Mapped::beside(text));
            self.draft.body(prose);
        }
    }

    fn finish(mut self) {
        while self.stack.len() > 1 {
            self.pop();
        }
        if let Some(level) = self.stack.pop() {
            javadoc::read(&level.text, self.draft);
        }
    }

    fn level(&mut self) -> &mut Mapped {
        if self.stack.is_empty() {
            self.stack.push(Level::new(self.text, Slot::Body));
        }
        let last = self.stack.len() - 1;
        &mut self.stack[last].text
    }

    fn add(&mut self, text: &str) {
        self.level().add(text);
    }

    fn append(&mut self, range: Range<usize>) {
        let text = self.text;
        self.level().append(text, range);
    }
}

/// The last two names of a path: the block and its member.
fn last_names(target: &Mapped) -> Mapped {
    let source = target.as_str();
    let path = source.split('(').next().unwrap_or(source);
    let start = path.rmatch_indices('.').nth(1).map_or(0, |(at, _)| at + 1);
    target.slice(start..path.len())
}
