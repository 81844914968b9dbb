//! An entity's page: what it is, what it says, what is in it.

use std::collections::BTreeSet;

use super::{Context, diagrams, findings, links, prose, relations, signature, sources, tables, variables};
use crate::book::view::entity::{CoreView, EntityView, Fact, MemberView};
use crate::book::view::finding::FindingView;
use crate::book::view::prose::{Block, Inline};
use crate::docs::{self, Documentation};
use crate::library::{Access, Item, ItemId, ItemKind};
use crate::text::Span;

/// The page of a top-level item.
pub(crate) fn view(context: &Context<'_>, id: ItemId) -> EntityView {
    let catalogue = context.catalogue();
    let item = catalogue.item(id);
    let members = members(context, id);
    EntityView {
        core: core(context, id),
        library: item.library.0 as usize,
        library_name: catalogue.libraries[item.library.0 as usize].name.clone(),
        namespace: item.namespace.clone(),
        folder: item.folder.clone(),
        relations: relations::relations(context, id),
        inheritance: diagrams::inheritance(context, id),
        members,
        inherited: relations::inherited(context, id),
        tables: tables::of(context, id),
        sources: sources::of(context, id),
        findings: own_findings(context, id),
    }
}

/// The members but accessors: by kind, then in the order of the source.
fn members(context: &Context<'_>, owner: ItemId) -> Vec<MemberView> {
    let catalogue = context.catalogue();
    let rank = |kind: ItemKind| ItemKind::ALL.iter().position(|k| *k == kind);
    let mut ids: Vec<ItemId> = super::coverage::members(context, owner).collect();
    ids.sort_by_key(|id| rank(catalogue.item(*id).kind));
    let member = |id: ItemId| MemberView {
        core: core(context, id),
        overrides: relations::overridden(context, owner, id),
        access: access(context, id),
    };
    ids.into_iter().map(member).collect()
}

fn access(context: &Context<'_>, id: ItemId) -> Option<&'static str> {
    let catalogue = context.catalogue();
    let item = catalogue.item(id);
    let has = |kind| item.children.iter().any(|child| catalogue.item(*child).kind == kind);
    match (item.kind, has(ItemKind::Getter), has(ItemKind::Setter)) {
        (ItemKind::Property, true, true) => Some("read/write"),
        (ItemKind::Property, true, false) => Some("read-only"),
        (ItemKind::Property, false, true) => Some("write-only"),
        _ => None,
    }
}

fn core(context: &Context<'_>, id: ItemId) -> CoreView {
    let catalogue = context.catalogue();
    let item = catalogue.item(id);
    let entry = context.input.docs.item(id);
    let address = context.addresses.item(id);
    let accessors: Vec<&Item> =
        item.children.iter().map(|child| catalogue.item(*child)).filter(|child| child.kind.is_accessor()).collect();
    let doc = entry.doc.as_ref();
    CoreView {
        kind: item.kind.key(),
        kind_label: item.kind.label(),
        name: item.name.clone(),
        qualified_name: catalogue.qualified_name(id),
        url: address.url(),
        anchor: address.anchor.clone(),
        label: address.label.clone(),
        file: context.input.files.get(item.place.file).path.clone(),
        line: context.input.files.line_column(item.place).line,
        documented: super::coverage::is_documented(context, id),
        badges: badges(context, id),
        brief: doc.map_or(Vec::new(), |doc| prose::inlines(context, &doc.brief)),
        detail: doc.map_or(Vec::new(), |doc| detail(context, doc)),
        facts: doc.map_or(Vec::new(), |doc| facts(context, doc)),
        documentation_from: entry.inherited_from.map(|from| links::qualified(context, from)),
        signature: signature::signature(item, &accessors),
        diagram: diagrams::interface(context, id),
        type_label: type_label(item),
        type_: links::type_parts(context, item.type_.as_ref()),
        returns: doc.and_then(|doc| doc.tags.returns.as_ref()).map_or(Vec::new(), |tag| flat(context, &tag.content)),
        sections: variables::sections(context, id),
        pragmas: item.pragmas.iter().map(|pragma| pragma.text.clone()).collect(),
    }
}

const fn type_label(item: &Item) -> Option<&'static str> {
    match (item.kind, item.type_.is_some()) {
        (_, false) => None,
        (ItemKind::Function | ItemKind::Method, _) => Some("Returns"),
        (ItemKind::Alias, _) => Some("Another name of"),
        (ItemKind::Enum | ItemKind::Subrange, _) => Some("Base type"),
        _ => Some("Type"),
    }
}

/// Access and flags, in lower case.
pub(crate) fn badges(context: &Context<'_>, id: ItemId) -> Vec<String> {
    let item = context.catalogue().item(id);
    let entry = context.input.docs.item(id);
    let deprecated = entry.obsolete.is_some() || entry.doc.as_ref().is_some_and(|doc| doc.tags.deprecated.is_some());
    let flags = [
        (item.access != Access::Public, item.access.name()),
        (item.is_abstract, "abstract"),
        (item.is_final, "final"),
        (item.is_override, "override"),
        (deprecated, "deprecated"),
        (entry.doc.as_ref().is_some_and(|doc| doc.tags.internal), "internal"),
    ];
    let mut seen = BTreeSet::new();
    flags.into_iter().filter(|(is, name)| *is && seen.insert(*name)).map(|(_, name)| name.to_owned()).collect()
}

/// The detail, with what parameter tags say of names that do not exist.
fn detail(context: &Context<'_>, doc: &Documentation) -> Vec<Block> {
    let mut blocks = prose::blocks(context, &doc.detail);
    let lost = doc.tags.params.iter().filter(|param| param.target.is_none());
    let items: Vec<_> = lost
        .map(|param| (vec![Inline::Code { text: param.name.clone() }], prose::blocks(context, &param.content)))
        .collect();
    if !items.is_empty() {
        blocks.push(Block::Definitions { items });
    }
    blocks
}

fn facts(context: &Context<'_>, doc: &Documentation) -> Vec<Fact> {
    let tags = &doc.tags;
    let titled: [(&str, &[docs::Tag]); 7] = [
        ("Deprecated", tags.deprecated.as_slice()),
        ("Example", &tags.examples),
        ("To do", &tags.todos),
        ("See also", &tags.see),
        ("Since", tags.since.as_slice()),
        ("Version", tags.version.as_slice()),
        ("Author", &tags.authors),
    ];
    let fact = |(title, tags): (&str, &[docs::Tag])| Fact {
        title: title.to_owned(),
        content: tags.iter().flat_map(|tag| prose::blocks(context, &tag.content)).collect(),
    };
    let mut facts: Vec<Fact> = titled.into_iter().filter(|(_, tags)| !tags.is_empty()).map(fact).collect();
    if !tags.requirements.is_empty() {
        let names: Vec<&str> = tags.requirements.iter().map(|(name, _)| name.as_str()).collect();
        let content = vec![Block::Paragraph { content: vec![Inline::text(names.join(", "))] }];
        facts.push(Fact { title: "Requirements".to_owned(), content });
    }
    if !tags.history.is_empty() {
        facts.push(Fact { title: "History".to_owned(), content: prose::blocks(context, &tags.history) });
    }
    facts
}

/// The inlines of the paragraphs in `blocks`; what is no paragraph as plain text.
pub(crate) fn flat(context: &Context<'_>, blocks: &[docs::Block]) -> Vec<Inline> {
    let mut out = Vec::new();
    for block in blocks {
        if !out.is_empty() {
            out.push(Inline::text(" "));
        }
        match block {
            docs::Block::Paragraph(content) => out.extend(prose::inlines(context, content)),
            other => out.push(Inline::text(docs::Block::plain(std::slice::from_ref(other)).trim().to_owned())),
        }
    }
    out
}

/// The findings in the excerpts of an item and of its members.
fn own_findings(context: &Context<'_>, id: ItemId) -> Vec<FindingView> {
    let Some(spans) = extent(context, id) else { return Vec::new() };
    let (file, span) = spans;
    let of_file = context.findings.get(&file).into_iter().flatten().map(|i| &context.input.findings[*i]);
    let inside =
        of_file.filter(|finding| span.start <= finding.place.span.start && finding.place.span.start <= span.end);
    inside.map(|finding| findings::view(finding, context.input.files)).collect()
}

/// The file and the range from the item's first excerpt or comment to its last.
fn extent(context: &Context<'_>, id: ItemId) -> Option<(crate::text::FileId, Span)> {
    let catalogue = context.catalogue();
    let item = catalogue.item(id);
    let file = item.place.file;
    let mut span = item.place.span;
    let ids = std::iter::once(id).chain(item.children.iter().copied());
    for item in ids.map(|id| catalogue.item(id)) {
        let excerpts = item.declaration.into_iter().chain(sources::excerpt(item.body));
        for excerpt in excerpts {
            span = span.cover(catalogue.place(excerpt.fragment, excerpt.span).span);
        }
        for comment in &item.comments {
            for part in &comment.spans {
                span = span.cover(catalogue.place(comment.fragment, *part).span);
            }
        }
    }
    Some((file, span))
}
