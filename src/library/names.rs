//! Names to items: case-insensitive as IEC 61131-3 (6.1.2) is, by library, namespace and inheritance.
//!
//! Several libraries of one tree may declare the same name. A name means the declaration in its own
//! namespace and library first, then in its own library, then in any other, in the order of the
//! tree; so a lookup never depends on the order of threads.

use std::collections::{BTreeMap, BTreeSet};

use super::{Catalogue, ItemId, LibraryId, Target, TypeUse};

/// Names are compared in this form.
#[must_use]
pub fn fold(name: &str) -> String {
    if name.is_ascii() { name.to_ascii_lowercase() } else { name.to_lowercase() }
}

/// What a name can mean, by its folded form.
#[derive(Clone, Debug, Default)]
pub struct Names {
    top: BTreeMap<String, Vec<ItemId>>,
    globals: BTreeMap<String, Vec<(ItemId, usize)>>,
}

/// From where a name is looked up.
#[derive(Clone, Copy, Debug)]
pub struct Scope<'a> {
    /// The library.
    pub library: LibraryId,
    /// The namespace.
    pub namespace: &'a [String],
}

/// What a path of names leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    /// An item.
    Item(ItemId),
    /// The variable at this index of an item.
    Variable(ItemId, usize),
}

impl Names {
    /// Indexes `catalogue`.
    #[must_use]
    pub fn new(catalogue: &Catalogue) -> Self {
        let mut names = Self::default();
        for (id, item) in catalogue.iter().filter(|(_, item)| item.parent.is_none()) {
            names.top.entry(fold(&item.name)).or_default().push(id);
            if item.kind == super::ItemKind::GlobalVariables {
                for (i, variable) in item.variables.iter().enumerate() {
                    names.globals.entry(fold(&variable.name)).or_default().push((id, i));
                }
            }
        }
        names
    }

    /// All top-level items of that name.
    #[must_use]
    pub fn all(&self, name: &str) -> &[ItemId] {
        self.top.get(&fold(name)).map_or(&[], Vec::as_slice)
    }

    /// The top-level item that `name` means in `scope`.
    #[must_use]
    pub fn top(&self, catalogue: &Catalogue, name: &str, scope: Scope<'_>) -> Option<ItemId> {
        self.all(name).iter().copied().min_by_key(|id| distance(catalogue, *id, scope))
    }

    /// The global variable that `name` means in `scope`.
    #[must_use]
    pub fn global(&self, catalogue: &Catalogue, name: &str, scope: Scope<'_>) -> Option<Found> {
        let candidates = self.globals.get(&fold(name))?;
        let best = |(id, _): &&(ItemId, usize)| (catalogue.item(*id).library != scope.library, *id);
        candidates.iter().min_by_key(best).map(|(id, i)| Found::Variable(*id, *i))
    }

    /// What the path `parts` means in `scope`: a name, a member of what it names, and so on; leading
    /// parts may be a namespace or a library's name.
    ///
    /// Of several items of that name the nearest in which the rest of the path is found is meant.
    #[must_use]
    pub fn path(&self, catalogue: &Catalogue, parts: &[&str], scope: Scope<'_>) -> Option<Found> {
        let item = (0..parts.len()).find_map(|split| {
            let (prefix, rest) = parts.split_at(split);
            let (name, members) = rest.split_first()?;
            let prefix: Vec<String> = prefix.iter().map(|part| fold(part)).collect();
            let mut fitting: Vec<ItemId> =
                self.all(name).iter().copied().filter(|id| is_within(catalogue, *id, &prefix)).collect();
            fitting.sort_by_key(|id| distance(catalogue, *id, scope));
            fitting.into_iter().find_map(|id| self.descend(catalogue, Found::Item(id), members))
        });
        let (first, rest) = parts.split_first()?;
        item.or_else(|| self.descend(catalogue, self.global(catalogue, first, scope)?, rest))
    }

    /// What the path `parts` means inside of `id`: from its members outwards to the members of what it stands in, and
    /// then in the tree.
    #[must_use]
    pub fn seen_from(&self, catalogue: &Catalogue, id: ItemId, parts: &[&str]) -> Option<Found> {
        let (first, rest) = parts.split_first()?;
        let mut at = Some(id);
        while let Some(owner) = at {
            let item = catalogue.item(owner);
            let member = self.member(catalogue, owner, first);
            let itself = (fold(&item.name) == fold(first)).then_some(Found::Item(owner));
            let found = [member, itself].into_iter().flatten().find_map(|found| self.descend(catalogue, found, rest));
            if found.is_some() {
                return found;
            }
            at = item.parent;
        }
        let item = catalogue.item(id);
        self.path(catalogue, parts, Scope { library: item.library, namespace: &item.namespace })
    }

    fn descend(&self, catalogue: &Catalogue, from: Found, rest: &[&str]) -> Option<Found> {
        rest.iter().try_fold(from, |at, name| {
            let owner = match at {
                Found::Item(id) => id,
                Found::Variable(id, i) => self.type_of(catalogue, id, i)?,
            };
            self.member(catalogue, owner, name)
        })
    }

    /// The item that is the type of a variable, if its type is the name of one.
    #[must_use]
    pub fn type_of(&self, catalogue: &Catalogue, id: ItemId, variable: usize) -> Option<ItemId> {
        let type_ = catalogue.item(id).variables.get(variable)?.type_.as_ref()?;
        type_.names.iter().rev().find_map(|(_, target)| match target {
            Target::Item(id) => Some(*id),
            Target::Elementary | Target::External => None,
        })
    }

    /// The variable or member `name` of `id`, or of what it extends and implements.
    #[must_use]
    pub fn member(&self, catalogue: &Catalogue, id: ItemId, name: &str) -> Option<Found> {
        let name = fold(name);
        lineage(catalogue, id).into_iter().find_map(|owner| own_member(catalogue, owner, &name))
    }
}

/// The variable or member of `owner` itself that is called `name`, which is folded. Accessors have no name of their own.
fn own_member(catalogue: &Catalogue, owner: ItemId, name: &str) -> Option<Found> {
    let item = catalogue.item(owner);
    let variable = item.variables.iter().position(|variable| fold(&variable.name) == name);
    let child = || {
        let named = |child: &&ItemId| {
            let child = catalogue.item(**child);
            fold(&child.name) == name && !child.kind.is_accessor()
        };
        item.children.iter().find(named)
    };
    variable.map(|i| Found::Variable(owner, i)).or_else(|| child().map(|id| Found::Item(*id)))
}

/// How far an item is from `scope`: another library, then a namespace that shares less, then the order of the tree.
fn distance(catalogue: &Catalogue, id: ItemId, scope: Scope<'_>) -> (bool, std::cmp::Reverse<usize>, ItemId) {
    let item = catalogue.item(id);
    (item.library != scope.library, std::cmp::Reverse(shared(&item.namespace, scope.namespace)), id)
}

fn shared(a: &[String], b: &[String]) -> usize {
    a.iter().zip(b).take_while(|(a, b)| fold(a) == fold(b)).count()
}

/// Whether the item's library or namespace ends in `prefix`, which is folded.
fn is_within(catalogue: &Catalogue, id: ItemId, prefix: &[String]) -> bool {
    let item = catalogue.item(id);
    let namespace: Vec<String> = item.namespace.iter().map(|part| fold(part)).collect();
    let library = catalogue.libraries.get(item.library.0 as usize).map(|library| fold(&library.name));
    namespace.ends_with(prefix) || (prefix.len() == 1 && library.as_ref() == prefix.first())
}

/// `id` and what it extends, nearest first; then the interfaces of all of them, and what those extend. A cycle ends it.
#[must_use]
pub fn lineage(catalogue: &Catalogue, id: ItemId) -> Vec<ItemId> {
    let mut seen = BTreeSet::from([id]);
    let mut order = vec![id];
    follow(catalogue, &mut order, &mut seen, 0);
    let blocks = order.len();
    for at in 0..blocks {
        let interfaces = targets(&catalogue.item(order[at]).implements).filter(|base| seen.insert(*base));
        order.extend(interfaces.collect::<Vec<_>>());
    }
    follow(catalogue, &mut order, &mut seen, blocks);
    order
}

/// Appends what the items of `order` from `at` on extend, and what that extends.
fn follow(catalogue: &Catalogue, order: &mut Vec<ItemId>, seen: &mut BTreeSet<ItemId>, mut at: usize) {
    while at < order.len() {
        order.extend(targets(&catalogue.item(order[at]).extends).filter(|base| seen.insert(*base)));
        at += 1;
    }
}

/// What `id` extends and implements and is in this tree, in the order of the source.
pub fn bases(catalogue: &Catalogue, id: ItemId) -> impl Iterator<Item = ItemId> {
    let item = catalogue.item(id);
    targets(&item.extends).chain(targets(&item.implements))
}

/// The items that `uses` name and that are in this tree.
fn targets(uses: &[TypeUse]) -> impl Iterator<Item = ItemId> {
    uses.iter().filter_map(|used| match used.names.last() {
        Some((_, Target::Item(id))) => Some(*id),
        _ => None,
    })
}
