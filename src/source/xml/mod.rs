//! XML with byte-exact places that never fails: a damaged file gives problems and as much of a tree as can be had.
//!
//! Three things ask for a reader of our own. Places must be exact to the byte, through entities, split CDATA
//! sections and `\r\n`, which the XML standard would have folded. A file that a merge has damaged
//! still holds declarations worth documenting. And memory and depth are bounded: elements beyond
//! [`MAX_DEPTH`] and [`MAX_NODES`] are a problem and not a crash; entities that a document type declares are never expanded.
//!
//! `scan` splits the text into tags and what stands between, `tree` nests them, `text` reads character data.
//! The tests hold all three against roxmltree.

mod scan;
mod text;
mod tree;

pub(crate) use tree::{Element, Mixed, Xml};

use crate::text::Span;

/// Elements may nest so deep.
pub(crate) const MAX_DEPTH: usize = 200;

/// A file may hold so many elements.
pub(crate) const MAX_NODES: usize = 4_000_000;

/// So many problems are kept; nobody reads more.
pub(crate) const MAX_PROBLEMS: usize = 1000;

/// What is wrong with the XML.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Problem {
    pub(crate) span: Span,
    pub(crate) message: String,
    /// Whether it is a document type, which is no damage.
    pub(crate) doctype: bool,
}

impl Problem {
    /// Adds a problem to `problems`, up to [`MAX_PROBLEMS`].
    fn add(problems: &mut Vec<Self>, span: Span, message: impl Into<String>) {
        if problems.len() < MAX_PROBLEMS {
            problems.push(Self { span, message: message.into(), doctype: false });
        }
    }
}
