//! What a convention's reader makes of a comment: Markdown and tags that are still text.

use super::tag_names::Slot;
use crate::docs::mapped::Mapped;
use crate::docs::model::Fact;

/// A part of the detail.
pub(in crate::docs) enum Part {
    /// Markdown.
    Text(Mapped),
    /// A remark set apart, in Markdown.
    Note { style: &'static str, title: String, text: Mapped },
}

/// What is said of a parameter.
pub(in crate::docs) struct DraftParam {
    pub(in crate::docs) name: Mapped,
    pub(in crate::docs) note: String,
    pub(in crate::docs) text: Mapped,
}

/// Documentation that is not read as Markdown yet.
#[derive(Default)]
pub(in crate::docs) struct Draft {
    pub(in crate::docs) brief: Option<Mapped>,
    pub(in crate::docs) parts: Vec<Part>,
    pub(in crate::docs) params: Vec<DraftParam>,
    pub(in crate::docs) returns: Option<Mapped>,
    pub(in crate::docs) see: Vec<Mapped>,
    pub(in crate::docs) copies: Vec<Mapped>,
    pub(in crate::docs) since: Option<Mapped>,
    pub(in crate::docs) deprecated: Option<Mapped>,
    pub(in crate::docs) examples: Vec<Mapped>,
    pub(in crate::docs) todos: Vec<Mapped>,
    pub(in crate::docs) version: Option<Mapped>,
    pub(in crate::docs) authors: Vec<Mapped>,
    pub(in crate::docs) internal: bool,
    pub(in crate::docs) requirements: Vec<Mapped>,
    pub(in crate::docs) history: Vec<Mapped>,
    pub(in crate::docs) facts: Vec<Fact>,
}

impl Draft {
    /// Adds prose.
    pub(super) fn body(&mut self, text: Mapped) {
        if !text.is_blank() {
            self.parts.push(Part::Text(text));
        }
    }

    /// Adds `key: value`.
    pub(super) fn fact(&mut self, key: &str, value: &Mapped) {
        if !value.is_blank() {
            let value_text = value.as_str().trim().to_owned();
            self.facts.push(Fact { key: key.trim().to_owned(), value: value_text, place: value.whole() });
        }
    }

    /// Puts `text` where the tag `slot` belongs.
    pub(super) fn put(&mut self, slot: &Slot, text: Mapped) {
        match slot {
            Slot::Brief => match self.brief {
                None if !text.is_blank() => self.brief = Some(text),
                _ => self.body(text),
            },
            Slot::Body => self.body(text),
            Slot::Param { .. } => {}
            Slot::Returns => append(&mut self.returns, text),
            Slot::See => push(&mut self.see, text),
            Slot::Copy => push(&mut self.copies, text),
            Slot::Since => append(&mut self.since, text),
            Slot::Deprecated => append(&mut self.deprecated, text),
            Slot::Example => push(&mut self.examples, text),
            Slot::Todo => push(&mut self.todos, text),
            Slot::Version => append(&mut self.version, text),
            Slot::Author => push(&mut self.authors, text),
            Slot::Req => push(&mut self.requirements, text),
            Slot::History => push(&mut self.history, text),
            Slot::Note(style, title) => {
                if !text.is_blank() {
                    self.parts.push(Part::Note { style, title: (*title).to_owned(), text });
                }
            }
            Slot::Internal => {
                self.internal = true;
                self.body(text);
            }
            Slot::Fact(key) => self.fact(key, &text),
        }
    }

    /// Adds what is said of one parameter, or of several with commas between their names.
    pub(super) fn param(&mut self, names: &Mapped, note: &str, text: &Mapped) {
        let mut start = 0;
        for part in names.as_str().split(',') {
            let name = names.trimmed(start..start + part.len());
            start += part.len() + 1;
            if !name.is_blank() {
                self.params.push(DraftParam { name, note: note.to_owned(), text: text.clone() });
            }
        }
    }
}

fn push(list: &mut Vec<Mapped>, text: Mapped) {
    if !text.is_blank() {
        list.push(text);
    }
}

/// Deprecation needs no words; a second text follows the first.
fn append(have: &mut Option<Mapped>, text: Mapped) {
    match have {
        None => *have = Some(text),
        Some(have) => {
            have.add("\n\n");
            have.append_all(&text);
        }
    }
}
