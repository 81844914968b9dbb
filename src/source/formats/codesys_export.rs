//! CODESYS V3 exports (`.export`): the objects of a project, serialised as XML, text line by line.
//!
//! Each object is an entry with a `MetaObject` (name, identity, the identity of what holds it) and an `Object` whose
//! `Interface` and `Implementation` are text documents. What an object is follows from its declaration; what has none is
//! an action, an accessor or a folder. Lines are joined by line ends that stand for the line's element.

use std::collections::BTreeMap;

use super::keyword::leading;
use super::{Claim, Format, Input, Unwrapped, note_if_empty, xml_notes};
use crate::source::fragment::FragmentBuilder;
use crate::source::xml::{Element, Xml};
use crate::text::{Body, Fragment, Language, Object, ObjectKind, Span, Vendor};

/// CODESYS V3 exports.
#[derive(Debug)]
pub(super) struct CodesysExport;

impl Format for CodesysExport {
    fn name(&self) -> &'static str {
        "CODESYS export"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["export"]
    }

    fn claims(&self, input: &Input<'_>) -> Claim {
        if input.head().contains("<ExportFile") { Claim::Sure } else { Claim::No }
    }

    fn unwrap(&self, input: &Input<'_>) -> Unwrapped {
        let xml = Xml::parse(input.text, &[]);
        let entries: Vec<Entry<'_>> = xml.document().descendants().filter_map(entry).collect();
        let objects = assemble(&entries);
        let mut notes = xml_notes(&xml);
        notes.extend(note_if_empty(&objects, "POU, type or variable list"));
        Unwrapped { objects, vendor: Vendor::Codesys, notes, ..Unwrapped::default() }
    }
}

/// The child that the serialisation calls `name`.
fn field<'x>(element: Element<'x>, name: &str) -> Option<Element<'x>> {
    element.children().find(|child| child.attribute("Name").is_some_and(|attribute| attribute.value == name))
}

/// One object of the project.
struct Entry<'x> {
    id: String,
    parent: String,
    name: Element<'x>,
    object: Element<'x>,
    path: Vec<String>,
}

fn entry(element: Element<'_>) -> Option<Entry<'_>> {
    let meta = field(element, "MetaObject")?;
    let text = |name: &str| field(meta, name).and_then(Element::trimmed).unwrap_or_default();
    Some(Entry {
        id: text("Guid"),
        parent: text("ParentGuid"),
        name: field(meta, "Name")?,
        object: field(element, "Object")?,
        path: field(element, "Path")
            .map(|path| path.children().filter_map(Element::trimmed).collect())
            .unwrap_or_default(),
    })
}

/// Puts members under their owners, and gives the rest in its order.
fn assemble(entries: &[Entry<'_>]) -> Vec<Object> {
    let index: BTreeMap<&str, usize> =
        entries.iter().enumerate().map(|(index, entry)| (entry.id.as_str(), index)).collect();
    let mut objects: Vec<Option<Object>> = entries.iter().map(object).collect();
    // What is exported after its owner is taken first, so that members are complete when they move.
    let mut order: Vec<usize> = (0..entries.len()).collect();
    order.sort_by_key(|at| std::cmp::Reverse(depth(entries, &index, *at)));
    for at in order {
        let owner = index.get(entries[at].parent.as_str()).copied().filter(|owner| *owner != at);
        let Some(owner) = owner.filter(|owner| objects[*owner].is_some()) else { continue };
        let Some(mut member) = objects[at].take() else { continue };
        if let Some(holder) = &mut objects[owner] {
            correct_kind(holder, &mut member);
            holder.children.push(member);
        }
    }
    let mut objects: Vec<Object> = objects.into_iter().flatten().collect();
    objects.iter_mut().for_each(in_order);
    objects
}

fn depth(entries: &[Entry<'_>], index: &BTreeMap<&str, usize>, mut at: usize) -> usize {
    // A chain longer than this is a ring.
    for depth in 0..32 {
        match index.get(entries[at].parent.as_str()) {
            Some(parent) if *parent != at => at = *parent,
            _ => return depth,
        }
    }
    32
}

fn in_order(object: &mut Object) {
    object.children.sort_by_key(|child| child.span);
    object.children.iter_mut().for_each(in_order);
}

/// A member without a declaring word: an accessor below a property, an action below a POU.
fn correct_kind(owner: &Object, member: &mut Object) {
    if owner.kind == ObjectKind::Property {
        let is_setter = member.name.as_deref().is_some_and(|name| name.eq_ignore_ascii_case("set"));
        member.kind = if is_setter { ObjectKind::Setter } else { ObjectKind::Getter };
    }
}

fn object(entry: &Entry<'_>) -> Option<Object> {
    let declaration = field(entry.object, "Interface").and_then(document);
    let implementation = field(entry.object, "Implementation");
    if declaration.is_none() && implementation.is_none() {
        return None;
    }
    let declared = declaration.as_ref().and_then(|declaration| leading(&declaration.text));
    let kind = declared.map_or(ObjectKind::Action, |found| found.kind);
    let mut object = Object::new(kind, entry.name.trimmed(), entry.name.content());
    object.declaration = declaration;
    object.folder.clone_from(&entry.path);
    object.body = implementation.map_or(Body::None, |implementation| match document(implementation) {
        Some(text) => Body::St(text),
        None => Body::Other(Language::Unknown, implementation.raw()),
    });
    object.properties.push(("id".to_owned(), entry.id.clone()));
    if field(entry.object, "ParameterList").and_then(Element::trimmed).as_deref() == Some("True") {
        object.properties.push(("parameter_list".to_owned(), "True".to_owned()));
    }
    Some(object)
}

/// The text of a document, if `holder` has one.
fn document(holder: Element<'_>) -> Option<Fragment> {
    let document = field(holder, "TextDocument")?;
    let mut out = FragmentBuilder::new();
    if let Some(lines) = field(document, "TextLines") {
        for line in lines.children() {
            if let Some(text) = field(line, "Text") {
                out.fragment(&text.text()).standing_for("\n", Span::at(text.content().end));
            }
        }
    } else if let Some(blob) = field(document, "TextBlobForSerialisation") {
        out.fragment(&blob.text());
    }
    Some(out.finish(document.content().start))
}
