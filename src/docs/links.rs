//! What a name in prose means.
//!
//! A path such as `FB_Cylinder.Extend` is looked up without regard to case: first among the members
//! of the documented block and of what it stands in (inherited ones too), then among the entities of
//! the same library, then of any; what stands before the entity must be its namespace or the name of
//! its library. A path goes on through members and through the types of variables.
//!
//! Brackets mean other things in PLC comments: `[mm]`, `[0..5]`, `a[i]`. So text in brackets is a link
//! only if it resolves, or if it can mean nothing else: it is in backticks, has a `_`, or has a `.`
//! between identifiers.

use std::collections::BTreeMap;

use super::prose::LinkTarget;
use crate::library::{Catalogue, Item, ItemId, ItemKind, Target};

/// Units that stand in brackets behind a value; a short name is not taken for a link to a variable.
const UNITS: [&str; 62] = [
    "mm", "cm", "dm", "m", "km", "um", "nm", "s", "ms", "us", "ns", "min", "h", "d", "A", "mA", "V", "mV", "kV", "W",
    "kW", "MW", "Hz", "kHz", "MHz", "bar", "mbar", "Pa", "kPa", "hPa", "K", "C", "F", "N", "Nm", "kN", "J", "kJ",
    "kWh", "kg", "g", "mg", "t", "l", "ml", "rpm", "deg", "rad", "inc", "bit", "bits", "byte", "bytes", "Byte",
    "Bytes", "Ohm", "x", "y", "z", "i", "n", "e",
];

/// The names of a catalogue.
#[derive(Debug)]
pub(super) struct Index<'a> {
    catalogue: &'a Catalogue,
    entities: BTreeMap<String, Vec<ItemId>>,
    globals: BTreeMap<String, Vec<(ItemId, usize)>>,
}

impl<'a> Index<'a> {
    /// Reads the names of `catalogue`.
    pub(super) fn new(catalogue: &'a Catalogue) -> Self {
        let mut entities: BTreeMap<String, Vec<ItemId>> = BTreeMap::new();
        let mut globals: BTreeMap<String, Vec<(ItemId, usize)>> = BTreeMap::new();
        for (id, item) in catalogue.iter() {
            if item.parent.is_none() {
                entities.entry(item.name.to_lowercase()).or_default().push(id);
            }
            if item.kind == ItemKind::GlobalVariables {
                for (i, variable) in item.variables.iter().enumerate() {
                    globals.entry(variable.name.to_lowercase()).or_default().push((id, i));
                }
            }
        }
        Self { catalogue, entities, globals }
    }

    /// What `path` means in the documentation of `scope`.
    pub(super) fn resolve(&self, scope: Option<ItemId>, path: &str) -> Option<LinkTarget> {
        let names = segments(path)?;
        self.resolve_names(scope, &names)
    }

    /// Whether text in brackets is a link, and where to; `None` for text that is only text.
    pub(super) fn shortcut(&self, scope: Option<ItemId>, written: &str) -> Option<LinkTarget> {
        let code = written.len() > 2 && written.starts_with('`') && written.ends_with('`');
        let bare = written.trim_matches('`').trim();
        let names = segments(bare)?;
        let is_unit = !code && UNITS.contains(&bare);
        match self.resolve_names(scope, &names) {
            Some(_) if is_unit => None,
            Some(target) => Some(target),
            None => {
                let long = names.iter().any(|name| name.chars().count() > 1);
                let meant = code || bare.contains('_') || names.len() > 1 && long;
                (meant && !names[0].starts_with(|c: char| c.is_ascii_digit()))
                    .then(|| LinkTarget::Broken { text: bare.to_owned() })
            }
        }
    }

    /// The variable `name` of `scope`, or of what it extends, for a parameter tag.
    pub(super) fn parameter(&self, scope: ItemId, name: &str) -> Option<(ItemId, usize)> {
        match self.member(scope, name)? {
            LinkTarget::Variable(id, i) => Some((id, i)),
            _ => None,
        }
    }

    /// What `id` extends, implements, and so on, nearest first, bases before interfaces.
    pub(super) fn bases(&self, id: ItemId) -> Vec<ItemId> {
        let mut out = Vec::new();
        let mut interfaces = Vec::new();
        let mut at = vec![id];
        while let Some(next) = at.pop() {
            let item = self.catalogue.item(next);
            for base in item.extends.iter().filter_map(type_item).rev() {
                if base != id && !out.contains(&base) {
                    out.push(base);
                    at.push(base);
                }
            }
            interfaces.extend(item.implements.iter().filter_map(type_item));
        }
        for interface in interfaces {
            let mut at = vec![interface];
            while let Some(next) = at.pop() {
                if next != id && !out.contains(&next) {
                    out.push(next);
                    at.extend(self.catalogue.item(next).extends.iter().filter_map(type_item));
                }
            }
        }
        out
    }

    fn resolve_names(&self, scope: Option<ItemId>, names: &[&str]) -> Option<LinkTarget> {
        let names = match names {
            [first, rest @ ..] if is_self(first) && !rest.is_empty() => rest,
            _ => names,
        };
        self.in_scope(scope, names).or_else(|| self.in_tree(scope, names)).or_else(|| self.in_globals(scope, names))
    }

    /// From the documented item outwards.
    fn in_scope(&self, scope: Option<ItemId>, names: &[&str]) -> Option<LinkTarget> {
        let mut at = scope;
        while let Some(id) = at {
            let item = self.catalogue.item(id);
            if let Some(first) = self.member(id, names[0])
                && let Some(target) = self.walk(first, &names[1..])
            {
                return Some(target);
            }
            if same(&item.name, names[0])
                && let Some(target) = self.walk(LinkTarget::Item(id), &names[1..])
            {
                return Some(target);
            }
            at = item.parent;
        }
        None
    }

    /// Among all entities, with their namespaces and libraries before them.
    fn in_tree(&self, scope: Option<ItemId>, names: &[&str]) -> Option<LinkTarget> {
        (0..names.len()).find_map(|k| {
            let found = self.entities.get(&names[k].to_lowercase())?;
            let fitting = found.iter().copied().filter(|id| self.is_qualified(*id, &names[..k]));
            self.nearest(scope, fitting, |id| *id)
                .iter()
                .find_map(|id| self.walk(LinkTarget::Item(*id), &names[k + 1..]))
        })
    }

    fn in_globals(&self, scope: Option<ItemId>, names: &[&str]) -> Option<LinkTarget> {
        let found = self.globals.get(&names[0].to_lowercase())?;
        let near = self.nearest(scope, found.iter().copied(), |found| found.0);
        near.iter().find_map(|(id, i)| self.walk(LinkTarget::Variable(*id, *i), &names[1..]))
    }

    /// The candidates, those of the same library first.
    fn nearest<T: Copy>(
        &self,
        scope: Option<ItemId>,
        found: impl Iterator<Item = T>,
        of: impl Fn(&T) -> ItemId,
    ) -> Vec<T> {
        let library = scope.map(|scope| self.catalogue.item(scope).library);
        let mut all: Vec<T> = found.collect();
        all.sort_by_key(|candidate| Some(self.catalogue.item(of(candidate)).library) != library);
        all
    }

    /// Whether `prefix` may stand before the name of `id`: the end of its namespace, or its library.
    fn is_qualified(&self, id: ItemId, prefix: &[&str]) -> bool {
        let item = self.catalogue.item(id);
        let Some(last) = prefix.last() else { return true };
        let library = self.catalogue.libraries.get(item.library.0 as usize);
        let in_library = library.is_some_and(|library| same(&library.name, last));
        let space = &item.namespace;
        let in_space = prefix.len() <= space.len()
            && space[space.len() - prefix.len()..].iter().zip(prefix).all(|(have, want)| same(have, want));
        in_library || in_space
    }

    fn walk(&self, from: LinkTarget, names: &[&str]) -> Option<LinkTarget> {
        names.iter().try_fold(from, |at, name| {
            let owner = match &at {
                LinkTarget::Item(id) => Some(*id),
                LinkTarget::Variable(id, i) => {
                    let type_ = self.catalogue.item(*id).variables.get(*i)?.type_.as_ref()?;
                    type_item(type_)
                }
                _ => None,
            };
            self.member(owner?, name)
        })
    }

    /// The variable or member `name` of `id` or of what it extends and implements.
    fn member(&self, id: ItemId, name: &str) -> Option<LinkTarget> {
        let item = self.catalogue.item(id);
        if let Some(own) = self.own_member(id, item, name) {
            return Some(own);
        }
        self.bases(id).into_iter().find_map(|base| self.own_member(base, self.catalogue.item(base), name))
    }

    fn own_member(&self, id: ItemId, item: &Item, name: &str) -> Option<LinkTarget> {
        let variable = item.variables.iter().position(|variable| same(&variable.name, name));
        let child = || {
            let found = item.children.iter().copied().find(|child| same(&self.catalogue.item(*child).name, name));
            found.filter(|child| !self.catalogue.item(*child).kind.is_accessor())
        };
        variable.map(|i| LinkTarget::Variable(id, i)).or_else(|| child().map(LinkTarget::Item))
    }
}

/// The item that a type names, whatever is built around it.
fn type_item(type_: &crate::library::TypeUse) -> Option<ItemId> {
    type_.names.iter().rev().find_map(|(_, target)| match target {
        Target::Item(id) => Some(*id),
        _ => None,
    })
}

fn same(a: &str, b: &str) -> bool {
    a.eq_ignore_ascii_case(b) || a.to_lowercase() == b.to_lowercase()
}

fn is_self(name: &str) -> bool {
    name.eq_ignore_ascii_case("this") || name.eq_ignore_ascii_case("super")
}

/// The identifiers of a path such as `THIS^.Extend()`, `E_State#Idle` or `FB_Pump::Start`; `None` if it is no path.
pub(super) fn segments(path: &str) -> Option<Vec<&str>> {
    let path = path.trim();
    let path = path.split_once('(').filter(|(_, rest)| rest.ends_with(')')).map_or(path, |(head, _)| head);
    let parts: Vec<&str> =
        if path.contains("::") { path.split("::").collect() } else { path.split(['.', '#']).collect() };
    let names: Vec<&str> = parts.into_iter().map(|name| name.trim_end_matches('^')).collect();
    let identifier = |name: &&str| {
        name.starts_with(|c: char| c.is_alphabetic() || c == '_')
            && name.chars().all(|c| c.is_alphanumeric() || c == '_')
    };
    names.iter().all(identifier).then_some(names)
}
