//! Links to items, variables and types.

use super::Context;
use crate::book::view::entity::{EntityLink, TypePart};
use crate::library::{ItemId, Target, TypeUse};

/// A link to an item, by its own name.
pub(crate) fn item(context: &Context<'_>, id: ItemId) -> EntityLink {
    named(context, id, context.catalogue().item(id).name.clone())
}

/// A link to an item, by its name with its owners.
pub(crate) fn qualified(context: &Context<'_>, id: ItemId) -> EntityLink {
    named(context, id, context.catalogue().qualified_name(id))
}

fn named(context: &Context<'_>, id: ItemId, name: String) -> EntityLink {
    let kind_label = context.catalogue().item(id).kind.label();
    EntityLink { name, kind_label, to: Some(context.addresses.item(id).href()) }
}

/// A name that belongs to no file of this tree.
pub(crate) fn external(name: &str) -> EntityLink {
    EntityLink { name: name.to_owned(), kind_label: "", to: None }
}

/// A type's text, with the names of this tree linked.
pub(crate) fn type_parts(context: &Context<'_>, type_: Option<&TypeUse>) -> Vec<TypePart> {
    let Some(type_) = type_ else { return Vec::new() };
    let mut parts = Vec::new();
    let mut at = 0;
    let plain = |parts: &mut Vec<TypePart>, text: &str| {
        if !text.is_empty() {
            parts.push(TypePart { text: text.to_owned(), to: None });
        }
    };
    for (span, target) in &type_.names {
        let Target::Item(id) = target else { continue };
        let range = span.range();
        plain(&mut parts, type_.text.get(at..range.start).unwrap_or(""));
        let text = span.of(&type_.text).to_owned();
        parts.push(TypePart { text, to: Some(context.addresses.item(*id).href()) });
        at = range.end;
    }
    plain(&mut parts, type_.text.get(at..).unwrap_or(""));
    parts
}

/// The types after `EXTENDS` or `IMPLEMENTS`, as links.
pub(crate) fn bases(context: &Context<'_>, types: &[TypeUse]) -> Vec<EntityLink> {
    let link = |type_: &TypeUse| match type_.names.last() {
        Some((_, Target::Item(id))) => named(context, *id, type_.text.clone()),
        _ => external(&type_.text),
    };
    types.iter().map(link).collect()
}
