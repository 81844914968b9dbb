//! What rules look at.

use crate::docs::{Docs, Entry};
use crate::evidence::record::Answer;
use crate::library::{Access, Catalogue, Item, ItemId, ItemKind, Section};
use crate::table::AttachedTable;

/// What rules look at.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// What the tree declares.
    pub catalogue: &'a Catalogue,
    /// What its comments say.
    pub docs: &'a Docs,
    /// The test tables, with the items that they belong to.
    pub tables: &'a [AttachedTable],
    /// What is known of each table, in their order; empty before anybody asked.
    pub answers: &'a [Answer],
}

impl<'a> Context<'a> {
    /// The items that a manual describes: all but accessors, and all but what is private.
    pub fn described(self) -> impl Iterator<Item = (ItemId, &'a Item, &'a Entry)> {
        let described = self.catalogue.iter().filter(|(_, item)| !item.kind.is_accessor());
        described.map(move |(id, item)| (id, item, self.entry(id)))
    }

    /// What the comments say of an item.
    #[must_use]
    pub fn entry(self, id: ItemId) -> &'a Entry {
        &self.docs.items[id.0 as usize]
    }

    /// What the comments say of a variable.
    #[must_use]
    pub fn variable(self, id: ItemId, index: usize) -> &'a Entry {
        &self.docs.variables[id.0 as usize][index]
    }

    /// Whether users of the library meet this item: it is public or protected, and so are its owners.
    #[must_use]
    pub fn is_public(self, id: ItemId) -> bool {
        let item = self.catalogue.item(id);
        let visible = matches!(item.access, Access::Public | Access::Protected);
        visible && item.parent.is_none_or(|parent| self.is_public(parent))
    }

    /// Whether a variable wants documentation of its own.
    #[must_use]
    pub fn wants_documentation(self, item: &Item, section: Section) -> bool {
        section.is_interface() && !matches!(item.kind, ItemKind::Getter | ItemKind::Setter | ItemKind::Property)
    }
}
