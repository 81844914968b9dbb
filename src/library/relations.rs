//! Who extends, implements and uses whom.

use std::collections::{BTreeMap, BTreeSet};

use super::{Catalogue, Item, ItemId, Target, TypeUse};

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
    /// Collects them.
    #[must_use]
    pub fn new(catalogue: &Catalogue) -> Self {
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

fn targets(uses: &[TypeUse]) -> impl Iterator<Item = ItemId> {
    uses.iter().filter_map(|use_| match use_.names.last() {
        Some((_, Target::Item(id))) => Some(*id),
        _ => None,
    })
}
