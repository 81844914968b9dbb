//! Prose as a tree, with its links resolved and their places kept.

use crate::library::ItemId;
use crate::text::Place;

/// A block of prose.
#[derive(Clone, Debug, PartialEq)]
pub enum Block {
    /// A paragraph.
    Paragraph(Vec<Inline>),
    /// A heading, from level 1.
    Heading(u8, Vec<Inline>),
    /// A bulleted list, or a numbered one with its first number.
    List {
        /// The first number; `None` for bullets.
        start: Option<u64>,
        /// The items.
        items: Vec<ListItem>,
    },
    /// A code block.
    Code {
        /// The language in lower case; empty if unknown.
        language: String,
        /// The code, without a line break at its end.
        text: String,
    },
    /// A quotation.
    Quote(Vec<Block>),
    /// A remark set apart.
    Note {
        /// `note`, `warning`, `remark` or another of the kind.
        style: String,
        /// Its title.
        title: String,
        /// What it says.
        content: Vec<Block>,
    },
    /// A table.
    Table {
        /// One for each column.
        align: Vec<Align>,
        /// The header's cells.
        head: Vec<Vec<Inline>>,
        /// The rows' cells.
        rows: Vec<Vec<Vec<Inline>>>,
    },
    /// A definition list.
    Definitions(Vec<(Vec<Inline>, Vec<Block>)>),
    /// A horizontal rule.
    Rule,
}

/// How the cells of a column stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Not said.
    None,
    /// Left.
    Left,
    /// Centred.
    Center,
    /// Right.
    Right,
}

/// An item of a list.
#[derive(Clone, Debug, PartialEq)]
pub struct ListItem {
    /// Ticked or not, for an item of a task list.
    pub checked: Option<bool>,
    /// What it says.
    pub content: Vec<Block>,
}

/// A run of text in a block.
#[derive(Clone, Debug, PartialEq)]
pub enum Inline {
    /// Plain text.
    Text(String),
    /// Code.
    Code(String),
    /// Emphasis.
    Emph(Vec<Inline>),
    /// Strong emphasis.
    Strong(Vec<Inline>),
    /// Struck out.
    Strike(Vec<Inline>),
    /// A link.
    Link {
        /// Where to.
        target: LinkTarget,
        /// Where it is written.
        place: Place,
        /// What is shown.
        content: Vec<Inline>,
    },
    /// A picture.
    Image {
        /// The path as written.
        source: String,
        /// The text for it.
        alt: String,
    },
    /// A line break that was meant.
    Break,
}

/// Where a link leads.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LinkTarget {
    /// To an item.
    Item(ItemId),
    /// To a variable of an item.
    Variable(ItemId, usize),
    /// To an address with `http:`, `https:` or `mailto:`.
    External(String),
    /// Nowhere, though it was meant to lead to an entity.
    Broken {
        /// What was written.
        text: String,
    },
}

impl Inline {
    /// The text without its form.
    #[must_use]
    pub fn plain(inlines: &[Self]) -> String {
        let mut out = String::new();
        for inline in inlines {
            match inline {
                Self::Text(text) | Self::Code(text) => out.push_str(text),
                Self::Emph(content) | Self::Strong(content) | Self::Strike(content) => {
                    out.push_str(&Self::plain(content));
                }
                Self::Link { content, .. } => out.push_str(&Self::plain(content)),
                Self::Image { alt, .. } => out.push_str(alt),
                Self::Break => out.push(' '),
            }
        }
        out
    }

    pub(super) fn collect_links<'a>(inlines: &'a [Self], out: &mut Vec<(&'a LinkTarget, Place)>) {
        for inline in inlines {
            match inline {
                Self::Emph(content) | Self::Strong(content) | Self::Strike(content) => {
                    Self::collect_links(content, out);
                }
                Self::Link { target, place, content } => {
                    out.push((target, *place));
                    Self::collect_links(content, out);
                }
                Self::Text(_) | Self::Code(_) | Self::Image { .. } | Self::Break => {}
            }
        }
    }
}

impl Block {
    /// The text without its form, with a line break after each block.
    #[must_use]
    pub fn plain(blocks: &[Self]) -> String {
        let mut out = String::new();
        for block in blocks {
            match block {
                Self::Paragraph(content) | Self::Heading(_, content) => out.push_str(&Inline::plain(content)),
                Self::List { items, .. } => items.iter().for_each(|item| out.push_str(&Self::plain(&item.content))),
                Self::Code { text, .. } => out.push_str(text),
                Self::Quote(content) | Self::Note { content, .. } => out.push_str(&Self::plain(content)),
                Self::Table { head, rows, .. } => {
                    for row in std::iter::once(head).chain(rows) {
                        for cell in row {
                            out.push_str(&Inline::plain(cell));
                            out.push(' ');
                        }
                    }
                }
                Self::Definitions(items) => {
                    for (term, meaning) in items {
                        out.push_str(&Inline::plain(term));
                        out.push(' ');
                        out.push_str(&Self::plain(meaning));
                    }
                }
                Self::Rule => {}
            }
            if !out.ends_with('\n') {
                out.push('\n');
            }
        }
        out
    }

    pub(super) fn collect_links<'a>(blocks: &'a [Self], out: &mut Vec<(&'a LinkTarget, Place)>) {
        for block in blocks {
            match block {
                Self::Paragraph(content) | Self::Heading(_, content) => Inline::collect_links(content, out),
                Self::List { items, .. } => {
                    items.iter().for_each(|item| Self::collect_links(&item.content, out));
                }
                Self::Quote(content) | Self::Note { content, .. } => Self::collect_links(content, out),
                Self::Table { head, rows, .. } => {
                    for cell in std::iter::once(head).chain(rows).flatten() {
                        Inline::collect_links(cell, out);
                    }
                }
                Self::Definitions(items) => {
                    for (term, meaning) in items {
                        Inline::collect_links(term, out);
                        Self::collect_links(meaning, out);
                    }
                }
                Self::Code { .. } | Self::Rule => {}
            }
        }
    }
}
