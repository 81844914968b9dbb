//! Parameter tables: the variables of an item by section.

use super::{Context, links, prose};
use crate::book::view::entity::{SectionView, VariableView};
use crate::book::view::prose::{Block, Inline};
use crate::library::names::lineage;
use crate::library::{ItemId, ItemKind, Section, Variable};

/// The sections of an item that hold something. Inputs, outputs and in-outs of its bases come first in
/// theirs, since callers see them as its own.
pub(crate) fn sections(context: &Context<'_>, id: ItemId) -> Vec<SectionView> {
    let catalogue = context.catalogue();
    let mut owners: Vec<ItemId> = lineage(catalogue, id);
    owners.retain(|owner| *owner == id || inherits(catalogue.item(*owner).kind));
    owners.reverse();
    let accessors = accessors(context, id);
    let section = |section: Section| {
        let inherited = owners.iter().flat_map(|owner| own(context, *owner, section, *owner != id));
        let variables: Vec<VariableView> =
            inherited.chain(accessors.iter().flat_map(|id| own(context, *id, section, false))).collect();
        let public = section.is_interface();
        let title = section.title().to_owned();
        (!variables.is_empty()).then_some(SectionView { key: section.key(), title, public, variables })
    };
    Section::ALL.into_iter().filter_map(section).collect()
}

const fn inherits(kind: ItemKind) -> bool {
    matches!(kind, ItemKind::FunctionBlock | ItemKind::Class | ItemKind::Struct | ItemKind::Program)
}

fn accessors(context: &Context<'_>, id: ItemId) -> Vec<ItemId> {
    let catalogue = context.catalogue();
    let children = catalogue.item(id).children.iter().copied();
    match catalogue.item(id).kind {
        ItemKind::Property => children.filter(|child| catalogue.item(*child).kind.is_accessor()).collect(),
        _ => Vec::new(),
    }
}

fn own(context: &Context<'_>, id: ItemId, section: Section, inherited: bool) -> Vec<VariableView> {
    if inherited && !section.is_interface() {
        return Vec::new();
    }
    let variables = context.catalogue().item(id).variables.iter().enumerate();
    let chosen = variables.filter(|(_, variable)| variable.section == section);
    chosen.map(|(i, variable)| view(context, id, i, variable, inherited)).collect()
}

fn view(context: &Context<'_>, id: ItemId, index: usize, variable: &Variable, inherited: bool) -> VariableView {
    let address = context.addresses.variable(id, index);
    let flags = [(variable.constant, "constant"), (variable.retain, "retain"), (variable.persistent, "persistent")];
    let mut badges: Vec<String> = flags.into_iter().filter(|(is, _)| *is).map(|(_, name)| name.to_owned()).collect();
    badges.extend(variable.edge.map(str::to_owned));
    let (brief, detail) = documentation(context, id, index);
    VariableView {
        name: variable.name.clone(),
        anchor: if inherited { String::new() } else { address.anchor.clone() },
        label: if inherited { String::new() } else { address.label.clone() },
        type_: links::type_parts(context, variable.type_.as_ref()),
        initial: variable.initial.clone().unwrap_or_default(),
        address: variable.address.clone().unwrap_or_default(),
        badges,
        brief,
        detail,
        pragmas: variable.pragmas.iter().map(|pragma| pragma.text.clone()).collect(),
        line: context.input.files.line_column(variable.place).line,
        inherited_from: inherited.then(|| links::item(context, id)),
    }
}

/// Its own comment, or what a parameter tag of its owner says: `docs/` has joined them.
fn documentation(context: &Context<'_>, id: ItemId, index: usize) -> (Vec<Inline>, Vec<Block>) {
    let Some(doc) = context.input.docs.variable(id, index).and_then(|entry| entry.doc.as_ref()) else {
        return (Vec::new(), Vec::new());
    };
    (prose::inlines(context, &doc.brief), prose::blocks(context, &doc.detail))
}
