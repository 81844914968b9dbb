//! From units to items: parses every fragment and takes out what it declares.
//!
//! Each unit is lowered alone, so that all can be at once; then they are put together in their
//! order. Nothing is resolved here.

mod comments;
mod container;
mod members;
mod text;
mod types;
mod variables;

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::names::fold;
use super::{Catalogue, FragmentId, Item, ItemBody, ItemId, ItemKind, Library, LibraryId, Source};
use crate::diagnostic::Finding;
use crate::syntax::{self, Entry, Parse};
use crate::text::{Files, Fragment, Object, Place, Span, Unit, Vendor};

/// Items and what was wrong with the text that they stand in.
#[derive(Debug, Default)]
pub struct Lowered {
    /// The items, not resolved yet.
    pub catalogue: Catalogue,
    /// What could not be read.
    pub findings: Vec<Finding>,
}

/// Lowers `units`, each with its library.
pub fn units<'a>(
    units: &[(&'a Unit, LibraryId)],
    libraries: Vec<Library>,
    files: &'a Files,
    progress: &(dyn Fn(usize) + Sync),
) -> Lowered {
    let part = |&(unit, library): &(&'a Unit, LibraryId)| {
        let path = &files.get(unit.file).path;
        let home = &libraries[library.0 as usize].path;
        let mut lowering = Lowering::new(unit, library, path, home);
        unit.objects.iter().for_each(|object| lowering.object(object, None));
        progress(1);
        lowering
    };
    let parts: Vec<Lowering<'_>> = units.par_iter().map(part).collect();
    let mut lowered = Lowered::default();
    parts.into_iter().for_each(|part| join(&mut lowered, part));
    adopt(&mut lowered.catalogue);
    lowered.catalogue.libraries = libraries;
    lowered
}

fn count(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

/// Appends a part, with its numbers moved behind those that are there.
fn join(lowered: &mut Lowered, part: Lowering<'_>) {
    let items = count(lowered.catalogue.items.len());
    let fragments = count(lowered.catalogue.sources.len());
    let item = |id: ItemId| ItemId(id.0 + items);
    let fragment = |id: &mut FragmentId| id.0 += fragments;
    for mut own in part.items {
        own.parent = own.parent.map(item);
        own.children.iter_mut().for_each(|child| *child = item(*child));
        let variables = own.variables.iter_mut().flat_map(|variable| &mut variable.comments);
        own.comments.iter_mut().chain(variables).for_each(|comment| fragment(&mut comment.fragment));
        own.declaration.iter_mut().for_each(|excerpt| fragment(&mut excerpt.fragment));
        match &mut own.body {
            ItemBody::None => {}
            ItemBody::St(excerpt) | ItemBody::Il(excerpt) | ItemBody::Drawn(_, excerpt) => {
                fragment(&mut excerpt.fragment);
            }
        }
        lowered.catalogue.items.push(own);
    }
    lowered.catalogue.sources.extend(part.sources);
    lowered.findings.extend(part.findings);
}

/// Gives each action that is declared as `Pou.Action` to its POU, which may stand in another file of the library.
fn adopt(catalogue: &mut Catalogue) {
    let alone = |item: &Item| item.kind == ItemKind::Action && item.parent.is_none() && item.name.contains('.');
    let adopted: Vec<usize> = (0..catalogue.items.len()).filter(|i| alone(&catalogue.items[*i])).collect();
    if adopted.is_empty() {
        return;
    }
    let blocks = [ItemKind::FunctionBlock, ItemKind::Program, ItemKind::Function, ItemKind::Class];
    let mut owners: BTreeMap<(LibraryId, String), Vec<usize>> = BTreeMap::new();
    for (i, item) in catalogue.items.iter().enumerate() {
        if item.parent.is_none() && blocks.contains(&item.kind) {
            owners.entry((item.library, fold(&item.name))).or_default().push(i);
        }
    }
    for i in adopted {
        let item = &catalogue.items[i];
        let Some((owner, name)) = item.name.rsplit_once('.') else { continue };
        let (key, name, file) = ((item.library, fold(owner.trim())), name.trim().to_owned(), item.place.file);
        let found = owners.get(&key).into_iter().flatten();
        let Some(parent) = found.copied().min_by_key(|other| catalogue.items[*other].place.file != file) else {
            continue;
        };
        catalogue.items[parent].children.push(ItemId(count(i)));
        let item = &mut catalogue.items[i];
        item.parent = Some(ItemId(count(parent)));
        item.name = name;
        item.folder.clear();
    }
}

/// A unit being lowered; its numbers begin at 0.
struct Lowering<'a> {
    unit: &'a Unit,
    library: LibraryId,
    /// The file's name without its extension.
    stem: &'a str,
    /// The folders between the library and the file.
    folder: Vec<String>,
    namespace: Vec<String>,
    items: Vec<Item>,
    sources: Vec<Source>,
    findings: Vec<Finding>,
}

impl<'a> Lowering<'a> {
    fn new(unit: &'a Unit, library: LibraryId, path: &'a str, home: &str) -> Self {
        let below = path.strip_prefix(home).unwrap_or(path).trim_start_matches('/');
        let (folder, name) = below.rsplit_once('/').unwrap_or(("", below));
        Self {
            unit,
            library,
            stem: name.split('.').next().unwrap_or(name),
            folder: folder.split('/').filter(|part| !part.is_empty()).map(str::to_owned).collect(),
            namespace: Vec::new(),
            items: Vec::new(),
            sources: Vec::new(),
            findings: Vec::new(),
        }
    }

    /// Parses a fragment of `object` and keeps it; what was wrong becomes findings.
    fn parse(&mut self, fragment: &Fragment, entry: Entry, object: &Object) -> FragmentId {
        let nested =
            object.properties.iter().find(|(key, _)| key == "nested_comments").map(|(_, value)| value == "yes");
        let options = syntax::Options {
            nested_comments: nested.or(self.unit.nested_comments),
            quoted_names: self.unit.vendor == Vendor::Siemens,
        };
        let Parse { tree, errors } = syntax::parse(fragment.text.clone(), entry, &options);
        for error in errors {
            let place = Place::new(self.unit.file, fragment.map.span(error.span));
            self.findings.push(error.finding(place));
        }
        self.keep(fragment, Some(tree))
    }

    /// Keeps a fragment that is not parsed.
    fn keep(&mut self, fragment: &Fragment, tree: Option<syntax::Tree>) -> FragmentId {
        let id = FragmentId(count(self.sources.len()));
        let tree = tree.map(std::sync::Arc::new);
        self.sources.push(Source { file: self.unit.file, fragment: fragment.clone(), tree });
        id
    }

    fn place(&self, fragment: FragmentId, span: Span) -> Place {
        let source = &self.sources[fragment.0 as usize];
        Place::new(source.file, source.fragment.map.span(span))
    }

    /// Adds an item to its parent.
    fn push(&mut self, item: Item) -> ItemId {
        let id = ItemId(count(self.items.len()));
        if let Some(parent) = item.parent {
            self.items[parent.0 as usize].children.push(id);
        }
        self.items.push(item);
        id
    }

    fn item_mut(&mut self, id: ItemId) -> &mut Item {
        &mut self.items[id.0 as usize]
    }

    /// An item with nothing in it but what follows from where it stands.
    fn blank(&self, kind: super::ItemKind, name: &str, place: Place, parent: Option<ItemId>) -> Item {
        Item {
            kind,
            name: name.to_owned(),
            place,
            parent,
            children: Vec::new(),
            library: self.library,
            namespace: self.namespace.clone(),
            folder: if parent.is_none() { self.folder.clone() } else { Vec::new() },
            access: super::Access::Public,
            is_abstract: false,
            is_final: false,
            is_override: false,
            extends: Vec::new(),
            implements: Vec::new(),
            type_: None,
            variables: Vec::new(),
            pragmas: Vec::new(),
            comments: Vec::new(),
            declaration: None,
            body: ItemBody::None,
            properties: Vec::new(),
        }
    }
}
