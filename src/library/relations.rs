//! Who extends, implements and uses whom.

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use super::names::{Found, Names};
use super::{Catalogue, Item, ItemBody, ItemId, Target, TypeUse, listing};

/// The relations between items of a catalogue, both ways.
#[derive(Clone, Debug, Default)]
pub struct Relations {
    /// By base: the items that extend it.
    pub extended_by: BTreeMap<ItemId, Vec<ItemId>>,
    /// By interface: the items that implement it.
    pub implemented_by: BTreeMap<ItemId, Vec<ItemId>>,
    /// By top-level item: the top-level items that its declarations and bodies name.
    pub uses: BTreeMap<ItemId, BTreeSet<ItemId>>,
    /// The other way round.
    pub used_by: BTreeMap<ItemId, BTreeSet<ItemId>>,
    /// Names that belong to no file of the tree, with how often they are used as a type.
    pub externals: BTreeMap<String, usize>,
}

impl Relations {
    /// Collects them: bases and types from declarations, other uses from bodies.
    #[must_use]
    pub fn new(catalogue: &Catalogue, names: &Names) -> Self {
        let mut relations = Self::default();
        for (id, item) in catalogue.iter() {
            for base in targets(&item.extends) {
                relations.extended_by.entry(base).or_default().push(id);
            }
            for base in targets(&item.implements) {
                relations.implemented_by.entry(base).or_default().push(id);
            }
            relations.add_uses(catalogue, id, item);
        }
        let bodies: Vec<(ItemId, BTreeSet<ItemId>)> = catalogue
            .items
            .par_iter()
            .enumerate()
            .filter_map(|(i, item)| named_in_body(catalogue, names, i, item))
            .collect();
        for (user, used) in bodies {
            used.into_iter().for_each(|used| relations.add_use(user, used));
        }
        relations
    }

    fn add_uses(&mut self, catalogue: &Catalogue, id: ItemId, item: &Item) {
        let user = catalogue.top(id);
        let types = item.type_.iter().chain(item.variables.iter().filter_map(|v| v.type_.as_ref()));
        for use_ in types {
            for (span, target) in &use_.names {
                match target {
                    Target::Item(used) => self.add_use(user, catalogue.top(*used)),
                    Target::External => {
                        *self.externals.entry(span.of(&use_.text).to_owned()).or_default() += 1;
                    }
                    Target::Elementary => {}
                }
            }
        }
        for use_ in item.extends.iter().chain(&item.implements) {
            for (span, target) in &use_.names {
                if *target == Target::External {
                    *self.externals.entry(span.of(&use_.text).to_owned()).or_default() += 1;
                }
            }
        }
    }

    fn add_use(&mut self, user: ItemId, used: ItemId) {
        if user != used {
            self.uses.entry(user).or_default().insert(used);
            self.used_by.entry(used).or_default().insert(user);
        }
    }
}

/// The top-level items that the body of an item names, members counted for their owners.
fn named_in_body(
    catalogue: &Catalogue,
    names: &Names,
    index: usize,
    item: &Item,
) -> Option<(ItemId, BTreeSet<ItemId>)> {
    let (ItemBody::St(excerpt) | ItemBody::Il(excerpt)) = item.body else { return None };
    let id = ItemId(u32::try_from(index).unwrap_or(u32::MAX));
    let targets = listing::tokens(catalogue, names, id, excerpt).into_iter().filter_map(|token| token.target);
    let used = targets.map(|target| match target {
        Found::Item(id) | Found::Variable(id, _) => catalogue.top(id),
    });
    Some((catalogue.top(id), used.collect()))
}

fn targets(uses: &[TypeUse]) -> impl Iterator<Item = ItemId> {
    uses.iter().filter_map(|use_| match use_.names.last() {
        Some((_, Target::Item(id))) => Some(*id),
        _ => None,
    })
}
