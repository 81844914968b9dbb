//! What an entity extends, implements and uses, and who does so to it.

use super::{Context, links};
use crate::book::view::entity::{EntityLink, InheritedView, Relation};
use crate::library::names::{fold, lineage};
use crate::library::{Access, ItemId};

use std::collections::{BTreeMap, BTreeSet};

/// The relations of an entity that hold something.
pub(crate) fn relations(context: &Context<'_>, id: ItemId) -> Vec<Relation> {
    let item = context.catalogue().item(id);
    let all = context.input.relations;
    let list = |map: &BTreeMap<ItemId, Vec<ItemId>>| map.get(&id).map_or(Vec::new(), |ids| linked(context, ids));
    let set = |map: &BTreeMap<ItemId, BTreeSet<ItemId>>| {
        map.get(&id).map_or(Vec::new(), |ids| linked(context, &ids.iter().copied().collect::<Vec<_>>()))
    };
    let relations = [
        ("extends", "Extends", links::bases(context, &item.extends)),
        ("implements", "Implements", links::bases(context, &item.implements)),
        ("extended-by", "Extended by", list(&all.extended_by)),
        ("implemented-by", "Implemented by", list(&all.implemented_by)),
        ("uses", "Uses", set(&all.uses)),
        ("used-by", "Used by", set(&all.used_by)),
    ];
    let relations = relations.into_iter().filter(|(_, _, links)| !links.is_empty());
    relations.map(|(key, title, links)| Relation { key, title, links }).collect()
}

/// By name, without regard to case.
fn linked(context: &Context<'_>, ids: &[ItemId]) -> Vec<EntityLink> {
    let mut links: Vec<EntityLink> = ids.iter().map(|id| links::item(context, *id)).collect();
    links.sort_by_cached_key(|link| fold(&link.name));
    links
}

/// The members that an entity has from its bases and does not override.
pub(crate) fn inherited(context: &Context<'_>, id: ItemId) -> Vec<InheritedView> {
    let catalogue = context.catalogue();
    let names = |owner: ItemId| catalogue.item(owner).children.iter().map(|child| fold(&catalogue.item(*child).name));
    let mut seen: BTreeSet<String> = names(id).collect();
    let mut views = Vec::new();
    for owner in lineage(catalogue, id).into_iter().skip(1) {
        for child in &catalogue.item(owner).children {
            let member = catalogue.item(*child);
            if member.access == Access::Private || !seen.insert(fold(&member.name)) {
                continue;
            }
            let doc = context.input.docs.items[child.0 as usize].doc.as_ref();
            views.push(InheritedView {
                link: links::item(context, *child),
                kind_label: member.kind.label(),
                from: links::item(context, owner),
                brief: doc.map_or(Vec::new(), |doc| super::prose::inlines(context, &doc.brief)),
            });
        }
    }
    views
}

/// The members of bases and interfaces that `member` overrides or implements.
pub(crate) fn overridden(context: &Context<'_>, owner: ItemId, member: ItemId) -> Vec<EntityLink> {
    let catalogue = context.catalogue();
    let name = fold(&catalogue.item(member).name);
    let children = |id: ItemId| catalogue.item(id).children.iter().copied();
    let bases = lineage(catalogue, owner).into_iter().skip(1);
    let same = bases.flat_map(children).filter(|child| fold(&catalogue.item(*child).name) == name);
    same.map(|child| links::qualified(context, child)).collect()
}
