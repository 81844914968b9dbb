//! Addresses: where each item's page is, and under which label the PDF knows it.
//!
//! Pages are `library/name.html` in lower case, so that two names that differ in letter case only
//! do not fall onto one file where the file system folds case; a second comer gets `-2`.

use std::collections::BTreeSet;

use crate::book::view::prose::Href;
use crate::library::{Catalogue, ItemId, LibraryId};

/// Names that Windows keeps for devices.
const DEVICES: [&str; 10] = ["con", "prn", "aux", "nul", "com1", "com2", "com3", "lpt1", "lpt2", "lpt3"];

/// Folders and pages of the site that no library may take.
const RESERVED: [&str; 5] = ["assets", "chapters", "codes", "kinds", "folders"];

/// The address of an item or a variable.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Address {
    /// The page below the site's root.
    pub(crate) page: String,
    /// The anchor on it; empty for the page itself.
    pub(crate) anchor: String,
    /// The label in the PDF.
    pub(crate) label: String,
}

impl Address {
    /// Page and anchor.
    pub(crate) fn url(&self) -> String {
        if self.anchor.is_empty() { self.page.clone() } else { format!("{}#{}", self.page, self.anchor) }
    }

    /// As a link.
    pub(crate) fn href(&self) -> Href {
        Href::Page { url: self.url(), label: self.label.clone() }
    }
}

/// The addresses of everything in a catalogue.
#[derive(Clone, Debug, Default)]
pub(crate) struct Addresses {
    libraries: Vec<Address>,
    items: Vec<Address>,
    variables: Vec<Vec<Address>>,
}

impl Addresses {
    /// Gives every library, item and variable its address.
    pub(crate) fn new(catalogue: &Catalogue) -> Self {
        let mut taken: BTreeSet<String> = RESERVED.iter().map(|name| (*name).to_owned()).collect();
        let slugs: Vec<String> = catalogue.libraries.iter().map(|lib| unique(&slug(&lib.name), &mut taken)).collect();
        let mut addresses = Self {
            libraries: slugs.iter().map(|slug| page(format!("{slug}/index.html"), format!("lib:{slug}"))).collect(),
            ..Self::default()
        };
        let mut pages: BTreeSet<String> = slugs.iter().map(|slug| format!("{slug}/index")).collect();
        pages.extend(slugs.iter().map(|slug| format!("{slug}/folders")));
        for (id, item) in catalogue.iter() {
            let address = match item.parent {
                None => {
                    let stem = format!("{}/{}", slugs[item.library.0 as usize], slug(&item.name));
                    let stem = unique(&stem, &mut pages);
                    page(format!("{stem}.html"), format!("e:{}", stem.replace('/', ":")))
                }
                Some(parent) => addresses.member(catalogue, parent, &item.name, &mut pages),
            };
            addresses.items.push(address);
            let variables = addresses.variables_of(catalogue, id, &mut pages);
            addresses.variables.push(variables);
        }
        addresses
    }

    fn member(&self, catalogue: &Catalogue, parent: ItemId, name: &str, taken: &mut BTreeSet<String>) -> Address {
        let owner = &self.items[parent.0 as usize];
        let mut anchor = slug(name);
        if catalogue.item(parent).parent.is_some() {
            anchor = format!("{}.{anchor}", owner.anchor);
        } else {
            anchor = format!("m-{anchor}");
        }
        self.inside(owner, &anchor, taken)
    }

    fn variables_of(&self, catalogue: &Catalogue, id: ItemId, taken: &mut BTreeSet<String>) -> Vec<Address> {
        let owner = &self.items[id.0 as usize];
        let prefix = if owner.anchor.is_empty() { "v".to_owned() } else { format!("{}.v", owner.anchor) };
        let names = catalogue.item(id).variables.iter();
        names.map(|variable| self.inside(owner, &format!("{prefix}-{}", slug(&variable.name)), taken)).collect()
    }

    fn inside(&self, owner: &Address, anchor: &str, taken: &mut BTreeSet<String>) -> Address {
        let full = unique(&format!("{}#{anchor}", owner.page), taken);
        let anchor = full.rsplit('#').next().unwrap_or(anchor).to_owned();
        let top = owner.label.split('#').next().unwrap_or("").split("::").next().unwrap_or("");
        Address { page: owner.page.clone(), label: format!("{top}::{anchor}"), anchor }
    }

    /// Of a library's overview.
    pub(crate) fn library(&self, id: LibraryId) -> &Address {
        &self.libraries[id.0 as usize]
    }

    /// Of an item.
    pub(crate) fn item(&self, id: ItemId) -> &Address {
        &self.items[id.0 as usize]
    }

    /// Of a variable.
    pub(crate) fn variable(&self, id: ItemId, index: usize) -> &Address {
        &self.variables[id.0 as usize][index]
    }
}

fn page(page: String, label: String) -> Address {
    Address { page, anchor: String::new(), label }
}

/// `name` for a file, an anchor and a label: lower case ASCII letters, digits, `_` and `-`; anything
/// else by its code point.
pub(crate) fn slug(name: &str) -> String {
    let mut out = String::with_capacity(name.len());
    for c in name.chars() {
        match c {
            'a'..='z' | '0'..='9' | '_' | '-' => out.push(c),
            'A'..='Z' => out.push(c.to_ascii_lowercase()),
            ' ' | '.' | '/' => out.push('-'),
            other => out.push_str(&format!("x{:x}", u32::from(other))),
        }
    }
    if out.is_empty() || DEVICES.contains(&out.as_str()) {
        out.push('_');
    }
    out.truncate(120);
    out
}

/// `name`, or the first of `name-2`, `name-3`, … that is not taken; it is taken then.
pub(crate) fn unique(name: &str, taken: &mut BTreeSet<String>) -> String {
    let mut candidate = name.to_owned();
    let mut n = 2;
    while !taken.insert(candidate.clone()) {
        candidate = format!("{name}-{n}");
        n += 1;
    }
    candidate
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slug_is_safe_everywhere() {
        assert_eq!(slug("FB_Zylinder"), "fb_zylinder");
        assert_eq!(slug("../Größe"), "---grxf6xdfe");
        assert_eq!(slug("NUL"), "nul_");
        assert_eq!(slug(""), "_");
    }

    #[test]
    fn a_second_comer_gets_a_number() {
        let mut taken = BTreeSet::new();
        let names: Vec<_> = (0..3).map(|_| unique("a", &mut taken)).collect();
        assert_eq!(names, ["a", "a-2", "a-3"]);
    }
}
