//! TwinCAT 3: `TcPlcObject` in XML, one object a file, declarations and bodies in CDATA sections.
//!
//! ```xml
//! <TcPlcObject><POU Name="…"><Declaration><![CDATA[…]]></Declaration>
//!   <Implementation><ST><![CDATA[…]]></ST></Implementation>
//!   <Folder Name="a"/><Method Name="…" FolderPath="a\">…</Method></POU></TcPlcObject>
//! ```
//!
//! A damaged file is read as far as it goes: members that a lost closing tag has put inside another
//! member are taken as members of the owner.

use super::{Claim, Format, Input, Unwrapped, chart, note_if_empty, xml_notes};
use crate::source::codes;
use crate::source::note::Note;
use crate::source::xml::{Element, Xml};
use crate::text::{Body, Language, Object, ObjectKind, Vendor};

/// TwinCAT 3 objects.
#[derive(Debug)]
pub(super) struct TwinCat;

/// Elements that hold text alone.
const LEAVES: &[&str] = &["Declaration", "ST", "IL"];

impl Format for TwinCat {
    fn name(&self) -> &'static str {
        "TwinCAT 3"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["tcpou", "tcdut", "tcgvl", "tcio", "tctto"]
    }

    fn claims(&self, _: &Input<'_>) -> Claim {
        Claim::Sure
    }

    fn unwrap(&self, input: &Input<'_>) -> Unwrapped {
        let xml = Xml::parse(input.text, LEAVES);
        let mut notes = xml_notes(&xml);
        let mut objects = Vec::new();
        let root = xml.roots().find(|root| root.name() == "TcPlcObject");
        for element in root.unwrap_or(xml.document()).children() {
            top(element, &mut objects, &mut notes);
        }
        notes.extend(note_if_empty(&objects, "TwinCAT object"));
        Unwrapped { objects, vendor: Vendor::TwinCat, notes, ..Unwrapped::default() }
    }
}

/// The kind of the object that an element called `name` holds, below the root.
fn top_kind(name: &str) -> Option<ObjectKind> {
    Some(match name {
        "POU" => ObjectKind::Pou,
        "DUT" => ObjectKind::DataType,
        "GVL" => ObjectKind::GlobalVariables,
        "Itf" => ObjectKind::Interface,
        "Task" => ObjectKind::Task,
        _ => return None,
    })
}

/// The kind of the member that an element called `name` holds.
fn member_kind(name: &str) -> Option<ObjectKind> {
    Some(match name {
        "Method" => ObjectKind::Method,
        "Property" => ObjectKind::Property,
        "Get" => ObjectKind::Getter,
        "Set" => ObjectKind::Setter,
        "Action" => ObjectKind::Action,
        "Transition" => ObjectKind::Transition,
        _ => return None,
    })
}

fn top(element: Element<'_>, objects: &mut Vec<Object>, notes: &mut Vec<Note>) {
    let name = element.name();
    if let Some(kind) = top_kind(name) {
        let mut object = object(kind, element, notes);
        if kind == ObjectKind::Task {
            task_properties(element, &mut object);
        } else {
            members(element, &mut object.children, notes);
        }
        objects.push(object);
    } else if let Some(kind) = member_kind(name) {
        // The owner's tags are lost; its members are all that is left.
        objects.push(object(kind, element, notes));
        members(element, objects, notes);
    } else if element.attribute("Name").is_some() {
        let message = format!("`{name}` is an object of TwinCAT that is not read");
        notes.push(Note::new(&codes::UNKNOWN_OBJECT, element.name_span(), message));
    }
}

fn object(kind: ObjectKind, element: Element<'_>, notes: &mut Vec<Note>) -> Object {
    let name = element.attribute("Name");
    let span = name.as_ref().map_or(element.name_span(), |name| name.span);
    let mut object = Object::new(kind, name.map(|name| name.value.into_owned()), span);
    object.folder = folder(element);
    object.declaration = element.child("Declaration").map(Element::text);
    if let Some(implementation) = element.child("Implementation") {
        object.body = body(implementation, &mut object.children, notes);
    }
    for (attribute, key) in [("Id", "id"), ("ParameterList", "parameter_list"), ("SpecialFunc", "special_function")] {
        if let Some(value) = element.value(attribute).filter(|value| !value.is_empty() && value != "None") {
            object.properties.push((key.to_owned(), value));
        }
    }
    object
}

/// `FolderPath="a\b\"` as its parts.
fn folder(element: Element<'_>) -> Vec<String> {
    let path = element.value("FolderPath").unwrap_or_default();
    path.split('\\').filter(|part| !part.is_empty()).map(str::to_owned).collect()
}

fn body(implementation: Element<'_>, inner: &mut Vec<Object>, notes: &mut Vec<Note>) -> Body {
    let Some(child) = implementation.children().next() else { return Body::None };
    match child.name() {
        "ST" => Body::St(child.text()),
        "IL" => Body::Il(child.text()),
        "SFC" => chart::body(chart::twincat(child), child, inner, notes),
        "LD" => Body::Other(Language::Ld, child.raw()),
        "FBD" => Body::Other(Language::Fbd, child.raw()),
        // Networks are shown as ladder, function block diagram or list, as the user likes.
        "NWL" => Body::Other(Language::Fbd, child.raw()),
        "CFC" => Body::Other(Language::Cfc, child.raw()),
        _ => Body::Other(Language::Unknown, child.raw()),
    }
}

/// Adds the members inside `owner`; those inside a member (see above) follow it, except a property's accessors.
fn members(owner: Element<'_>, out: &mut Vec<Object>, notes: &mut Vec<Note>) {
    for element in owner.children() {
        let Some(kind) = member_kind(element.name()) else { continue };
        let mut member = object(kind, element, notes);
        let mut inner = Vec::new();
        members(element, &mut inner, notes);
        let is_accessor = |object: &Object| matches!(object.kind, ObjectKind::Getter | ObjectKind::Setter);
        let (own, lost): (Vec<_>, Vec<_>) =
            inner.into_iter().partition(|object| kind == ObjectKind::Property && is_accessor(object));
        member.children.extend(own);
        out.push(member);
        out.extend(lost);
    }
}

fn task_properties(element: Element<'_>, task: &mut Object) {
    for (child, key) in [("CycleTime", "cycle_time_us"), ("Priority", "priority")] {
        if let Some(value) = element.child_text(child) {
            task.properties.push((key.to_owned(), value));
        }
    }
    for call in element.children_named("PouCall") {
        if let Some(name) = call.child_text("Name") {
            task.properties.push(("call".to_owned(), name));
        }
    }
}
