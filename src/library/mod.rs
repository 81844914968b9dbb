//! What the tree declares, resolved: libraries, entities, variables, references, inheritance.
//!
//! The [`Catalogue`] keeps where a comment stands, not what it means; `docs/` reads it.

pub mod elementary;
pub mod item;
pub mod listing;
pub mod lower;
pub mod names;
pub mod relations;
pub mod resolve;
pub mod type_use;

use std::sync::Arc;

use crate::syntax::Tree;
use crate::text::{FileId, Fragment, Place, Span};

pub use item::{
    Access, Comment, Excerpt, FragmentId, Item, ItemBody, ItemId, ItemKind, LibraryId, Placement, Pragma, Section,
    Target, TypeUse, Variable,
};

/// A library: what one project, package or folder holds.
#[derive(Clone, Debug, Default)]
pub struct Library {
    /// Name.
    pub name: String,
    /// Version; empty if unknown.
    pub version: String,
    /// Author or company; empty if unknown.
    pub author: String,
    /// Its own words about itself; empty if none.
    pub description: String,
    /// What made it a library: `TwinCAT 3 project`, `folder`, …
    pub format: String,
    /// Its folder below the root of the tree; empty for the root itself.
    pub path: String,
    /// The libraries that it refers to.
    pub references: Vec<String>,
}

/// A fragment of a file, with its text.
#[derive(Clone, Debug)]
pub struct Source {
    /// The file.
    pub file: FileId,
    /// Text and way back.
    pub fragment: Fragment,
    /// Its tree, where it was parsed.
    pub tree: Option<Arc<Tree>>,
}

/// Everything that a tree declares.
#[derive(Clone, Debug, Default)]
pub struct Catalogue {
    /// The libraries, in the order of their paths.
    pub libraries: Vec<Library>,
    /// The items, in the order of the files and of the source.
    pub items: Vec<Item>,
    /// The fragments.
    pub sources: Vec<Source>,
}

impl Catalogue {
    /// The item that `id` names.
    ///
    /// # Panics
    /// If `id` comes from another catalogue.
    #[must_use]
    pub fn item(&self, id: ItemId) -> &Item {
        &self.items[id.0 as usize]
    }

    /// All items with their names in this catalogue.
    pub fn iter(&self) -> impl Iterator<Item = (ItemId, &Item)> {
        self.items.iter().enumerate().map(|(i, item)| (ItemId(u32::try_from(i).unwrap_or(u32::MAX)), item))
    }

    /// The text of a fragment.
    #[must_use]
    pub fn text(&self, id: FragmentId) -> &Arc<str> {
        &self.sources[id.0 as usize].fragment.text
    }

    /// The text of an excerpt.
    #[must_use]
    pub fn excerpt(&self, excerpt: Excerpt) -> &str {
        excerpt.span.of(self.text(excerpt.fragment))
    }

    /// Where in its file a span of a fragment stands.
    #[must_use]
    pub fn place(&self, fragment: FragmentId, span: Span) -> Place {
        let source = &self.sources[fragment.0 as usize];
        Place::new(source.file, source.fragment.map.span(span))
    }

    /// The top-level item that `id` is or stands in.
    #[must_use]
    pub fn top(&self, id: ItemId) -> ItemId {
        let mut at = id;
        while let Some(parent) = self.item(at).parent {
            at = parent;
        }
        at
    }

    /// The name with its owners and namespace, dot by dot.
    #[must_use]
    pub fn qualified_name(&self, id: ItemId) -> String {
        let item = self.item(id);
        let mut name = match item.parent {
            Some(parent) => self.qualified_name(parent),
            None => item.namespace.join("."),
        };
        if !name.is_empty() {
            name.push('.');
        }
        name.push_str(&item.name);
        name
    }
}
