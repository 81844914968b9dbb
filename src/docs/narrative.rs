//! Prose that stands in no comment: narrative pages, descriptions of projects, remarks of tables.

use super::links::Index;
use super::mapped::Mapped;
use super::markdown::Reader;
use super::prose::Block;
use crate::library::Catalogue;
use crate::library::names::Names;
use crate::text::FileId;

/// Reads Markdown whose links name entities of the whole tree.
#[derive(Debug)]
pub struct Narrator<'a> {
    index: Index<'a>,
}

impl<'a> Narrator<'a> {
    /// For `catalogue`, whose names are `names`.
    #[must_use]
    pub const fn new(catalogue: &'a Catalogue, names: &'a Names) -> Self {
        Self { index: Index::new(catalogue, names) }
    }

    /// The blocks of `text`. Places in them mean nothing.
    #[must_use]
    pub fn blocks(&self, text: &str) -> Vec<Block> {
        let mut mapped = Mapped::new(FileId(0));
        mapped.push(text, 0);
        Reader { index: &self.index, scope: None }.blocks(&mapped)
    }
}
