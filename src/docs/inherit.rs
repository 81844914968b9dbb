//! Documentation that a member takes over from what it overrides or implements.
//!
//! A member without documentation takes that of the nearest member of the same name and kind among
//! what its block extends, then implements; so do its variables, by name. Test tables stay
//! with the block that they were written for.

use super::links::Index;
use super::model::{Docs, Documentation, Entry, Tags};
use crate::library::{Catalogue, Item, ItemId};

/// Fills the entries of `docs` that have no documentation of their own.
pub(super) fn inherit(catalogue: &Catalogue, index: &Index<'_>, docs: &mut Docs) {
    let mut found: Vec<(ItemId, Option<usize>, ItemId, Documentation)> = Vec::new();
    for (id, item) in catalogue.iter() {
        let Some(parent) = item.parent.filter(|_| item.kind.is_member() && !item.kind.is_accessor()) else { continue };
        let variables = 0..item.variables.len();
        let lacks = docs.item(id).doc.is_none()
            || variables.clone().any(|i| docs.variable(id, i).is_some_and(|entry| entry.doc.is_none()));
        if !lacks {
            continue;
        }
        let overridden: Vec<ItemId> =
            index.bases(parent).into_iter().filter_map(|base| member(catalogue, base, item)).collect();
        if docs.item(id).doc.is_none() {
            let doc = overridden.iter().find_map(|base| Some((*base, own(docs.item(*base))?)));
            found.extend(doc.map(|(base, doc)| (id, None, base, doc)));
        }
        for i in variables.filter(|i| docs.variable(id, *i).is_some_and(|entry| entry.doc.is_none())) {
            let doc = overridden.iter().find_map(|base| {
                let name = &item.variables[i].name;
                let found = catalogue.item(*base).variables.iter().position(|v| v.name.eq_ignore_ascii_case(name))?;
                Some((*base, own(docs.variable(*base, found)?)?))
            });
            found.extend(doc.map(|(base, doc)| (id, Some(i), base, doc)));
        }
    }
    for (id, variable, base, doc) in found {
        let entry = match variable {
            None => docs.items.get_mut(id.0 as usize),
            Some(i) => docs.variables.get_mut(id.0 as usize).and_then(|entries| entries.get_mut(i)),
        };
        if let Some(entry) = entry {
            entry.doc = Some(doc);
            entry.inherited_from = Some(base);
        }
    }
}

/// The member of `base` that `item` overrides or implements.
fn member(catalogue: &Catalogue, base: ItemId, item: &Item) -> Option<ItemId> {
    let children = catalogue.item(base).children.iter().copied();
    let mut fitting = children.filter(|child| {
        let child = catalogue.item(*child);
        child.kind == item.kind && child.name.to_lowercase() == item.name.to_lowercase()
    });
    fitting.next()
}

/// What an entry says of its own, as far as it can be taken over.
fn own(entry: &Entry) -> Option<Documentation> {
    let doc = entry.doc.as_ref().filter(|doc| !doc.is_silent())?;
    let tags = Tags { gtt_paths: Vec::new(), requirements: Vec::new(), history: Vec::new(), ..doc.tags.clone() };
    Some(Documentation { tables: Vec::new(), tags, ..doc.clone() })
}
