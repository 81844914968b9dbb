//! Lists: libraries with their folders, entities by kind, the index, externals.

use std::collections::BTreeSet;

use super::address::{slug, unique};
use super::{Context, coverage, links, prose};
use crate::book::view::prose::Inline;
use crate::book::view::{Entry, FolderView, IndexEntry, KindList, LibraryView};
use crate::library::names::fold;
use crate::library::relations::Relations;
use crate::library::{ItemId, ItemKind, LibraryId};

/// The pages by kind: key, title, kinds.
const KINDS: [(&str, &str, &[ItemKind]); 7] = [
    ("program", "Programs", &[ItemKind::Program]),
    ("function-block", "Function blocks", &[ItemKind::FunctionBlock, ItemKind::Class]),
    ("function", "Functions", &[ItemKind::Function]),
    ("interface", "Interfaces", &[ItemKind::Interface]),
    ("type", "Types", &[ItemKind::Struct, ItemKind::Enum, ItemKind::Union, ItemKind::Alias, ItemKind::Subrange]),
    ("gvl", "Global variables", &[ItemKind::GlobalVariables]),
    ("task", "Tasks", &[ItemKind::Task]),
];

/// The libraries, in order.
pub(crate) fn libraries(context: &Context<'_>, order: &[ItemId]) -> Vec<LibraryView> {
    let catalogue = context.catalogue();
    let ids = (0..catalogue.libraries.len()).map(|i| LibraryId(u32::try_from(i).unwrap_or(u32::MAX)));
    ids.map(|id| {
        let own: Vec<ItemId> = order.iter().copied().filter(|item| catalogue.item(*item).library == id).collect();
        library(context, id, &own)
    })
    .collect()
}

fn library(context: &Context<'_>, id: LibraryId, own: &[ItemId]) -> LibraryView {
    let library = &context.catalogue().libraries[id.0 as usize];
    let address = context.addresses.library(id);
    let all: Vec<ItemId> =
        own.iter().flat_map(|top| std::iter::once(*top).chain(coverage::members(context, *top))).collect();
    let documented = all.iter().filter(|id| coverage::is_documented(context, **id)).count();
    LibraryView {
        name: library.name.clone(),
        url: address.page.clone(),
        label: address.label.clone(),
        version: library.version.clone(),
        author: library.author.clone(),
        format: library.format.clone(),
        path: library.path.clone(),
        description: prose::markdown(context, &library.description),
        references: library.references.clone(),
        folders: folders(context, &address.page, own),
        entities: all.len(),
        documented,
        documented_percent: coverage::percent(documented, all.len()),
        tables: own.iter().map(|id| tables(context, *id)).sum(),
    }
}

fn tables(context: &Context<'_>, id: ItemId) -> usize {
    context.tables.get(&id).map_or(0, Vec::len)
}

fn folders(context: &Context<'_>, overview: &str, own: &[ItemId]) -> Vec<FolderView> {
    let base = overview.trim_end_matches("index.html");
    let mut taken = BTreeSet::new();
    let path = |id: &ItemId| &context.catalogue().item(*id).folder;
    own.chunk_by(|a, b| path(a) == path(b))
        .map(|chunk| {
            let path = path(&chunk[0]).clone();
            let stem = if path.is_empty() { "top".to_owned() } else { slug(&path.join("-")) };
            FolderView {
                url: format!("{base}folders/{}.html", unique(&stem, &mut taken)),
                path,
                entities: chunk.iter().map(|id| entry(context, *id)).collect(),
            }
        })
        .collect()
}

fn entry(context: &Context<'_>, id: ItemId) -> Entry {
    let catalogue = context.catalogue();
    let item = catalogue.item(id);
    Entry {
        link: links::item(context, id),
        kind: item.kind.key(),
        library: catalogue.libraries[item.library.0 as usize].name.clone(),
        brief: brief(context, id),
        documented: coverage::is_documented(context, id),
        tables: tables(context, id),
        badges: super::entity::badges(context, id),
    }
}

fn brief(context: &Context<'_>, id: ItemId) -> Vec<Inline> {
    let doc = context.input.docs.items[id.0 as usize].doc.as_ref();
    doc.map_or(Vec::new(), |doc| prose::inlines(context, &doc.brief))
}

/// Entities by kind; kinds without any are left out.
pub(crate) fn kinds(context: &Context<'_>, order: &[ItemId]) -> Vec<KindList> {
    let mut by_name: Vec<ItemId> = order.to_vec();
    by_name.sort_by_cached_key(|id| (fold(&context.catalogue().item(*id).name), *id));
    let list = |(key, title, kinds): &(&'static str, &'static str, &[ItemKind])| {
        let of_kind = by_name.iter().filter(|id| kinds.contains(&context.catalogue().item(**id).kind));
        let entries = of_kind.map(|id| entry(context, *id)).collect();
        KindList { key, title, url: format!("kinds/{key}.html"), entries }
    };
    KINDS.iter().map(list).filter(|list| !list.entries.is_empty()).collect()
}

/// Everything with a name, sorted by it.
pub(crate) fn index(context: &Context<'_>, order: &[ItemId]) -> Vec<IndexEntry> {
    let catalogue = context.catalogue();
    let mut entries = Vec::new();
    for top in order {
        for id in std::iter::once(*top).chain(coverage::members(context, *top)) {
            let item = catalogue.item(id);
            let address = context.addresses.item(id);
            let owner = item.parent.map(|parent| catalogue.qualified_name(parent));
            entries.push(IndexEntry {
                name: item.name.clone(),
                kind_label: item.kind.label(),
                context: owner.unwrap_or_else(|| catalogue.libraries[item.library.0 as usize].name.clone()),
                url: address.url(),
                label: address.label.clone(),
                brief: Inline::plain(&brief(context, id)),
            });
        }
    }
    entries.sort_by_cached_key(|entry| (fold(&entry.name), fold(&entry.context), entry.url.clone()));
    entries
}

/// Names that belong to no file of the tree, by name.
pub(crate) fn externals(relations: &Relations) -> Vec<(String, usize)> {
    let mut list: Vec<(String, usize)> = relations.externals.iter().map(|(name, n)| (name.clone(), *n)).collect();
    list.sort_by_cached_key(|(name, _)| fold(name));
    list
}
