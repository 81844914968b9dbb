//! Prose as a tree: what a comment or a narrative page says, with its links already resolved.
//!
//! Both renderers walk this tree. Text is text: no renderer may take a string from here as markup.

use serde::Serialize;

/// A block of prose, after CommonMark and its common extensions.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Block {
    /// A paragraph.
    Paragraph {
        /// What it says.
        content: Vec<Inline>,
    },
    /// A heading; level 1 is the highest inside this prose.
    Heading {
        /// 1 to 6.
        level: u8,
        /// Its anchor on the page, unique there.
        anchor: String,
        /// What it says.
        content: Vec<Inline>,
    },
    /// A bulleted or numbered list.
    List {
        /// The first number; `None` for a bulleted list.
        start: Option<u64>,
        /// The items.
        items: Vec<ListItem>,
    },
    /// A code block.
    Code {
        /// The language that its fence names, in lower case; empty if none. `st` for Structured Text.
        language: String,
        /// The code, without a line break at its end.
        text: String,
    },
    /// A quotation.
    Quote {
        /// What is quoted.
        content: Vec<Block>,
    },
    /// A remark set apart, such as `Note` or `Deprecated`.
    Note {
        /// `note`, `warning`, `deprecated`, `todo`, `example`, `history`.
        style: String,
        /// Its title.
        title: String,
        /// What it says.
        content: Vec<Block>,
    },
    /// A table.
    Table {
        /// `left`, `right`, `center` or `none`, one a column.
        align: Vec<&'static str>,
        /// The header's cells.
        head: Vec<Vec<Inline>>,
        /// The rows' cells.
        rows: Vec<Vec<Vec<Inline>>>,
    },
    /// A definition list.
    Definitions {
        /// Term and meaning.
        items: Vec<(Vec<Inline>, Vec<Block>)>,
    },
    /// A horizontal rule.
    Rule,
}

/// An item of a list.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ListItem {
    /// Ticked or not, for an item of a task list.
    pub checked: Option<bool>,
    /// What it says.
    pub content: Vec<Block>,
}

/// A run of text in a block.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Inline {
    /// Plain text.
    Text {
        /// The text.
        text: String,
    },
    /// Code.
    Code {
        /// The code.
        text: String,
    },
    /// Emphasis.
    Emph {
        /// What is emphasised.
        content: Vec<Inline>,
    },
    /// Strong emphasis.
    Strong {
        /// What is emphasised.
        content: Vec<Inline>,
    },
    /// Struck out.
    Strike {
        /// What is struck out.
        content: Vec<Inline>,
    },
    /// A link.
    Link {
        /// Where to.
        to: Href,
        /// What is shown.
        content: Vec<Inline>,
    },
    /// A picture in the tree; shown as its text where it cannot be embedded.
    Image {
        /// The path as written.
        source: String,
        /// The text for it.
        alt: String,
    },
    /// A line break.
    Break,
}

/// Where a link goes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Href {
    /// A place in this manual.
    Page {
        /// Below the site's root, with its anchor, such as `basics/fb_hysteresis.html#out-q`.
        url: String,
        /// The label in the PDF, unique in the book.
        label: String,
    },
    /// An address elsewhere: `https:`, `http:` or `mailto:`; nothing else gets here.
    External {
        /// The address.
        url: String,
    },
    /// It was meant for a place in this manual and there is none.
    Broken {
        /// What was written.
        target: String,
    },
}

impl Inline {
    /// Plain text.
    pub fn text(text: impl Into<String>) -> Self {
        Self::Text { text: text.into() }
    }

    /// The text without its form, for a search index or a title.
    #[must_use]
    pub fn plain(inlines: &[Self]) -> String {
        let mut out = String::new();
        for inline in inlines {
            match inline {
                Self::Text { text } | Self::Code { text } => out.push_str(text),
                Self::Emph { content }
                | Self::Strong { content }
                | Self::Strike { content }
                | Self::Link { content, .. } => out.push_str(&Self::plain(content)),
                Self::Image { alt, .. } => out.push_str(alt),
                Self::Break => out.push(' '),
            }
        }
        out
    }
}
