//! Documentation that a member takes over from what it overrides or implements, or from what
//! `@copydoc` names.
//!
//! A member without prose takes that of the nearest member of the same name and kind among what its
//! block extends, then implements; so do its variables, by name. Its own tags stay. Test tables
//! stay with the block that they were written for.

use super::model::{Docs, Documentation, Entry, Tags};
use crate::library::names::lineage;
use crate::library::{Catalogue, Item, ItemId};

/// How many `@copydoc` are followed, should they form a circle.
const HOPS: usize = 8;

/// Fills the entries of `docs` that have no documentation of their own.
pub(super) fn inherit(catalogue: &Catalogue, docs: &mut Docs) {
    let mut found: Vec<(ItemId, Option<usize>, ItemId, Documentation)> = Vec::new();
    for (id, item) in catalogue.iter().filter(|(_, item)| !item.kind.is_accessor()) {
        let lacking: Vec<usize> = (0..item.variables.len()).filter(|i| lacks(docs.variable(id, *i))).collect();
        if !lacks(Some(docs.item(id))) && lacking.is_empty() {
            continue;
        }
        let sources = sources(catalogue, docs, id, item);
        if lacks(Some(docs.item(id))) {
            let doc = sources.iter().find_map(|base| Some((*base, own(docs.item(*base))?)));
            found.extend(doc.map(|(base, doc)| (id, None, base, doc)));
        }
        for i in lacking {
            let doc = sources.iter().find_map(|base| {
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
            take_over(entry, base, doc);
        }
    }
}

/// Whether an entry says nothing in prose.
fn lacks(entry: Option<&Entry>) -> bool {
    entry.is_some_and(|entry| entry.doc.as_ref().is_none_or(Documentation::is_silent))
}

/// Where documentation may come from, the preferred one first.
fn sources(catalogue: &Catalogue, docs: &Docs, id: ItemId, item: &Item) -> Vec<ItemId> {
    let copy_of = |id: ItemId| docs.item(id).doc.as_ref().and_then(|doc| doc.tags.copy_of);
    let mut out: Vec<ItemId> =
        std::iter::successors(copy_of(id), |at| copy_of(*at)).take(HOPS).filter(|source| *source != id).collect();
    if let Some(parent) = item.parent {
        out.extend(lineage(catalogue, parent).into_iter().skip(1).filter_map(|base| member(catalogue, base, item)));
    }
    out
}

/// Puts `doc` into `entry`, beside the tags that it has.
fn take_over(entry: &mut Entry, base: ItemId, mut doc: Documentation) {
    if let Some(own) = entry.doc.take() {
        let params = if own.tags.params.is_empty() { doc.tags.params } else { own.tags.params };
        doc.tags = Tags { params, returns: own.tags.returns.or(doc.tags.returns), ..own.tags };
        doc.tables = own.tables;
        doc.places = own.places;
    }
    entry.doc = Some(doc);
    entry.inherited_from = Some(base);
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
