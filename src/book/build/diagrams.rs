//! Drawings of an entity: its interface, and where it stands in the inheritance.

use super::Context;
use crate::book::view::entity::Diagram;
use crate::book::view::prose::Href;
use crate::figure::interface::{self, Block, Compartment, Edge, Entry, Pin};
use crate::figure::{Drawing, inheritance as hierarchy};
use crate::library::names::{bases, lineage};
use crate::library::{Access, Item, ItemId, ItemKind, Section, TypeUse, Variable};

/// The drawing of the interface; nothing for what has none.
pub(crate) fn interface(context: &Context<'_>, id: ItemId) -> Option<Diagram> {
    let item = context.catalogue().item(id);
    let block = match item.kind {
        ItemKind::FunctionBlock | ItemKind::Function | ItemKind::Program | ItemKind::Method | ItemKind::Class => {
            pins(context, id)
        }
        ItemKind::Interface | ItemKind::Struct | ItemKind::Union | ItemKind::Enum => listed(context, id),
        _ => return None,
    };
    let nothing = block.inputs.is_empty()
        && block.outputs.is_empty()
        && block.in_outs.is_empty()
        && block.returns.is_none()
        && block.compartments.iter().all(|compartment| compartment.entries.is_empty());
    (!nothing).then(|| diagram(&interface::draw(&block)))
}

fn diagram(drawing: &Drawing) -> Diagram {
    let (width, height) = drawing.points();
    Diagram { svg: drawing.to_svg(), alt: drawing.alt.clone(), width, height }
}

fn pins(context: &Context<'_>, id: ItemId) -> Block {
    let catalogue = context.catalogue();
    let item = catalogue.item(id);
    let mut owners = lineage(catalogue, id);
    owners.retain(|owner| catalogue.item(*owner).kind == item.kind);
    owners.reverse();
    let of = |section: Section| -> Vec<Pin> {
        let variables = owners.iter().flat_map(|owner| &catalogue.item(*owner).variables);
        variables.filter(|variable| variable.section == section).map(pin).collect()
    };
    Block {
        name: item.name.clone(),
        stereotype: Some(item.kind.label().to_lowercase()),
        inputs: of(Section::Input),
        outputs: of(Section::Output),
        in_outs: of(Section::InOut),
        returns: item.type_.as_ref().map(|type_| type_.text.clone()),
        ..Block::default()
    }
}

fn pin(variable: &Variable) -> Pin {
    let edge = match variable.edge {
        Some("r_edge") => Some(Edge::Rising),
        Some("f_edge") => Some(Edge::Falling),
        _ => None,
    };
    Pin {
        name: variable.name.clone(),
        type_: text(variable.type_.as_ref()),
        edge,
        default: variable.initial.clone().unwrap_or_default(),
        ..Pin::default()
    }
}

fn text(type_: Option<&TypeUse>) -> String {
    type_.map_or(String::new(), |type_| type_.text.clone())
}

fn listed(context: &Context<'_>, id: ItemId) -> Block {
    let catalogue = context.catalogue();
    let item = catalogue.item(id);
    let of_kind = |title: &str, kind: ItemKind| {
        let children = item.children.iter().map(|child| catalogue.item(*child)).filter(|child| child.kind == kind);
        let entries: Vec<Entry> = children.map(member).collect();
        (!entries.is_empty()).then(|| Compartment { title: title.to_owned(), entries })
    };
    let compartments = match item.kind {
        ItemKind::Interface => [of_kind("Properties", ItemKind::Property), of_kind("Methods", ItemKind::Method)]
            .into_iter()
            .flatten()
            .collect(),
        _ => vec![Compartment { title: String::new(), entries: item.variables.iter().map(field).collect() }],
    };
    Block {
        name: item.name.clone(),
        stereotype: Some(item.kind.label().to_lowercase()),
        compartments,
        ..Block::default()
    }
}

fn field(variable: &Variable) -> Entry {
    Entry {
        name: variable.name.clone(),
        type_: text(variable.type_.as_ref()),
        value: if variable.section == Section::Value {
            variable.initial.clone().unwrap_or_default()
        } else {
            String::new()
        },
        ..Entry::default()
    }
}

fn member(item: &Item) -> Entry {
    let access = match item.access {
        Access::Public => interface::Access::Public,
        Access::Internal => interface::Access::Internal,
        Access::Protected => interface::Access::Protected,
        Access::Private => interface::Access::Private,
    };
    Entry { access, name: item.name.clone(), type_: text(item.type_.as_ref()), ..Entry::default() }
}

/// The drawing of the inheritance; nothing where there is none.
pub(crate) fn inheritance(context: &Context<'_>, id: ItemId) -> Option<Diagram> {
    let catalogue = context.catalogue();
    let above = lineage(catalogue, id);
    let mut nodes: Vec<hierarchy::Node> = above.iter().map(|at| node(context, id, *at)).collect();
    let mut links = Vec::new();
    for (from, at) in above.iter().enumerate() {
        let item = catalogue.item(*at);
        for base in bases(catalogue, *at) {
            let Some(to) = above.iter().position(|other| *other == base) else { continue };
            let implements = item.implements.iter().any(|type_| type_.item() == Some(base));
            links.push(hierarchy::Link { from, to, implements });
        }
        let unknown = |types: &[TypeUse]| {
            types.iter().filter(|type_| type_.item().is_none()).map(|type_| type_.text.clone()).collect::<Vec<_>>()
        };
        for (names, implements) in [(unknown(&item.extends), false), (unknown(&item.implements), true)] {
            for name in names {
                links.push(hierarchy::Link { from, to: nodes.len(), implements });
                nodes.push(hierarchy::Node {
                    name,
                    interface: implements,
                    external: true,
                    ..hierarchy::Node::default()
                });
            }
        }
    }
    let derived = derived(context, id);
    hierarchy::draw(&hierarchy::Hierarchy { nodes, links, derived }).map(|drawing| diagram(&drawing))
}

fn derived(context: &Context<'_>, id: ItemId) -> Vec<hierarchy::Derived> {
    let relations = context.input.relations;
    let lists = [(&relations.extended_by, false), (&relations.implemented_by, true)];
    let each = lists
        .into_iter()
        .flat_map(|(map, implements)| map.get(&id).into_iter().flatten().map(move |derived| (*derived, implements)));
    each.map(|(derived, implements)| hierarchy::Derived { node: node(context, id, derived), implements }).collect()
}

fn node(context: &Context<'_>, page: ItemId, id: ItemId) -> hierarchy::Node {
    let item = context.catalogue().item(id);
    hierarchy::Node {
        name: item.name.clone(),
        interface: item.kind == ItemKind::Interface,
        abstract_: item.is_abstract,
        href: (id != page).then(|| relative(context, page, id)).flatten(),
        ..hierarchy::Node::default()
    }
}

/// The address of an item, seen from the page of another one.
fn relative(context: &Context<'_>, page: ItemId, id: ItemId) -> Option<String> {
    let Href::Page { url, .. } = context.addresses.item(id).href() else { return None };
    let depth = context.addresses.item(page).page.matches('/').count();
    Some(format!("{}{url}", "../".repeat(depth)))
}
