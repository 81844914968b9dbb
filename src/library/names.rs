//! Names to items: case-insensitive as IEC 61131-3 (6.1.2) is, by library, namespace and inheritance.
//!
//! Several libraries of one tree may declare the same name. A name means the declaration in its own
//! namespace and library first, then in its own library, then in any other, in the order of the
//! tree; so a lookup never depends on the order of threads.

use std::collections::{BTreeMap, BTreeSet};

use super::{Catalogue, ItemId, LibraryId, Target};

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
        let best = |id: &ItemId| {
            let item = catalogue.item(*id);
            let near = shared(&item.namespace, scope.namespace);
            (item.library != scope.library, std::cmp::Reverse(near), *id)
        };
        self.all(name).iter().copied().min_by_key(best)
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
    #[must_use]
    pub fn path(&self, catalogue: &Catalogue, parts: &[&str], scope: Scope<'_>) -> Option<Found> {
        let (first, rest) = parts.split_first()?;
        if let Some(id) = self.top(catalogue, first, scope)
            && let Some(found) = self.descend(catalogue, Found::Item(id), rest)
        {
            return Some(found);
        }
        if rest.is_empty() {
            return self.global(catalogue, first, scope);
        }
        self.qualified(catalogue, parts)
    }

    fn qualified(&self, catalogue: &Catalogue, parts: &[&str]) -> Option<Found> {
        (1..parts.len()).find_map(|split| {
            let (prefix, rest) = parts.split_at(split);
            let (name, members) = rest.split_first()?;
            let prefix: Vec<String> = prefix.iter().map(|part| fold(part)).collect();
            let matching = self.all(name).iter().find(|id| is_within(catalogue, **id, &prefix))?;
            self.descend(catalogue, Found::Item(*matching), members)
        })
    }

    fn descend(&self, catalogue: &Catalogue, from: Found, rest: &[&str]) -> Option<Found> {
        let Some((name, rest)) = rest.split_first() else {
            return Some(from);
        };
        let next = match from {
            Found::Item(id) => self.member(catalogue, id, name)?,
            Found::Variable(id, i) => {
                let owner = self.type_of(catalogue, id, i)?;
                self.member(catalogue, owner, name)?
            }
        };
        self.descend(catalogue, next, rest)
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

    /// The member or variable `name` of `id`, or of what it extends.
    #[must_use]
    pub fn member(&self, catalogue: &Catalogue, id: ItemId, name: &str) -> Option<Found> {
        let name = fold(name);
        let lineage = lineage(catalogue, id);
        lineage.into_iter().find_map(|owner| {
            let item = catalogue.item(owner);
            let child = item.children.iter().find(|child| fold(&catalogue.item(**child).name) == name);
            let variable = || item.variables.iter().position(|variable| fold(&variable.name) == name);
            child.map(|id| Found::Item(*id)).or_else(|| variable().map(|i| Found::Variable(owner, i)))
        })
    }
}

fn shared(a: &[String], b: &[String]) -> usize {
    a.iter().zip(b).take_while(|(a, b)| fold(a) == fold(b)).count()
}

/// Whether the item's library or namespace ends in `prefix`, which is folded.
fn is_within(catalogue: &Catalogue, id: ItemId, prefix: &[String]) -> bool {
    let item = catalogue.item(id);
    let namespace: Vec<String> = item.namespace.iter().map(|part| fold(part)).collect();
    let library = &catalogue.libraries[item.library.0 as usize];
    namespace.ends_with(prefix) || (prefix.len() == 1 && fold(&library.name) == prefix[0])
}

/// `id` and what it extends, nearest first; then the interfaces of all of them. A cycle ends it.
#[must_use]
pub fn lineage(catalogue: &Catalogue, id: ItemId) -> Vec<ItemId> {
    let mut seen = BTreeSet::from([id]);
    let mut order = vec![id];
    let mut at = 0;
    while at < order.len() {
        for base in bases(catalogue, order[at]) {
            if seen.insert(base) {
                order.push(base);
            }
        }
        at += 1;
    }
    order
}

/// What `id` extends and implements and is in this tree, in the order of the source.
pub fn bases(catalogue: &Catalogue, id: ItemId) -> impl Iterator<Item = ItemId> {
    let item = catalogue.item(id);
    item.extends.iter().chain(&item.implements).filter_map(|use_| match use_.names.last() {
        Some((_, Target::Item(id))) => Some(*id),
        _ => None,
    })
}
