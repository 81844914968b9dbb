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

use super::prose::LinkTarget;
use crate::library::names::{Found, Names, Scope};
use crate::library::{Catalogue, ItemId, LibraryId};

/// Units that stand in brackets behind a value; a short name is not taken for a link to a variable.
const UNITS: [&str; 62] = [
    "mm", "cm", "dm", "m", "km", "um", "nm", "s", "ms", "us", "ns", "min", "h", "d", "A", "mA", "V", "mV", "kV", "W",
    "kW", "MW", "Hz", "kHz", "MHz", "bar", "mbar", "Pa", "kPa", "hPa", "K", "C", "F", "N", "Nm", "kN", "J", "kJ",
    "kWh", "kg", "g", "mg", "t", "l", "ml", "rpm", "deg", "rad", "inc", "bit", "bits", "byte", "bytes", "Byte",
    "Bytes", "Ohm", "x", "y", "z", "i", "n", "e",
];

/// The names of a catalogue, as prose sees them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Index<'a> {
    catalogue: &'a Catalogue,
    names: &'a Names,
}

impl<'a> Index<'a> {
    /// Of `catalogue`, whose names are `names`.
    pub(super) const fn new(catalogue: &'a Catalogue, names: &'a Names) -> Self {
        Self { catalogue, names }
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
        match self.names.member(self.catalogue, scope, name)? {
            Found::Variable(id, i) => Some((id, i)),
            Found::Item(_) => None,
        }
    }

    fn resolve_names(&self, scope: Option<ItemId>, names: &[&str]) -> Option<LinkTarget> {
        let names = match names {
            [first, rest @ ..] if is_self(first) && !rest.is_empty() => rest,
            _ => names,
        };
        let nowhere = Scope { library: LibraryId(u32::MAX), namespace: &[] };
        let found = match scope {
            Some(id) => self.names.seen_from(self.catalogue, id, names),
            None => self.names.path(self.catalogue, names, nowhere),
        };
        found.map(|found| match found {
            Found::Item(id) => LinkTarget::Item(id),
            Found::Variable(id, i) => LinkTarget::Variable(id, i),
        })
    }
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
