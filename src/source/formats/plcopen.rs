//! PLCopen XML (TC6, namespaces `tc6_0200` and `tc6_0201`), with the additions of CODESYS.
//!
//! Declarations are XML here. Where the exporting tool adds them as text (`InterfaceAsPlainText`), that is taken; otherwise
//! `plcopen_declaration` writes them as Structured Text, each word with the place of the element it comes from; so does `chart` with
//! sequential function charts. Other graphical bodies are kept as they stand. Methods, properties and interfaces are additions of CODESYS
//! (`addData`).

use std::collections::BTreeMap;

use super::plcopen_declaration as declaration;
use super::{Claim, Format, Input, Unwrapped, chart, note_if_empty, xhtml, xml_notes};
use crate::source::note::Note;
use crate::source::paths;
use crate::source::projects::{About, Draft, Member, ProjectKind};
use crate::source::xml::{Element, Xml};
use crate::text::{Body, Fragment, Language, Object, ObjectKind, Vendor};

/// PLCopen XML.
#[derive(Debug)]
pub(super) struct PlcOpen;

impl Format for PlcOpen {
    fn name(&self) -> &'static str {
        "PLCopen XML"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["xml", "plcopen", "plcopenxml"]
    }

    fn claims(&self, input: &Input<'_>) -> Claim {
        if input.head().contains("plcopen.org/xml/tc6") { Claim::Sure } else { Claim::No }
    }

    fn unwrap(&self, input: &Input<'_>) -> Unwrapped {
        let xml = Xml::parse(input.text, &[]);
        let folders = Folders::new(xml.document());
        let mut objects = Vec::new();
        let mut notes = xml_notes(&xml);
        collect(xml.document(), &folders, &mut objects, &mut notes);
        notes.extend(note_if_empty(&objects, "POU, type or variable list"));
        let project = xml.root().and_then(|root| project(root, input.path));
        let product = xml.root().and_then(|root| root.child("fileHeader")).and_then(|head| head.value("productName"));
        let vendor =
            if product.is_some_and(|name| name.contains("TwinCAT")) { Vendor::TwinCat } else { Vendor::Codesys };
        Unwrapped { objects, vendor, notes, project, ..Unwrapped::default() }
    }
}

/// What the head of the file says of its project.
fn project(root: Element<'_>, path: &str) -> Option<Draft> {
    let head = root.child("contentHeader")?;
    let name = head.value("name").filter(|name| !name.is_empty())?;
    let mut draft = Draft::new(ProjectKind::PlcOpen, name, path);
    let information = head.descendants().find(|element| element.name() == "ProjectInformation");
    let named = |wanted: &str| {
        let mut all = information?.children_named("property");
        all.find(|property| property.value("name").as_deref() == Some(wanted))?.trimmed()
    };
    let some = |value: Option<String>| value.filter(|value| !value.trim().is_empty());
    draft.about = About {
        title: named("Title"),
        version: some(head.value("version")).or_else(|| named("Version")),
        company: named("Company"),
        author: named("Author").or_else(|| some(head.value("author"))),
        description: named("Description").or_else(|| head.child_text("Comment")),
        namespace: named("DefaultNamespace"),
    };
    draft.members.push(Member {
        path: paths::name(path).to_owned(),
        span: head.name_span(),
        file: None,
        folder: Vec::new(),
        exclude_from_build: false,
        description: None,
    });
    Some(draft)
}

/// The folders of the objects; CODESYS adds them at the end of the file.
#[derive(Default)]
struct Folders {
    paths: Vec<Vec<String>>,
    by_identity: BTreeMap<String, usize>,
}

impl Folders {
    fn new(root: Element<'_>) -> Self {
        let mut folders = Self::default();
        for structure in root.descendants().filter(|element| element.name() == "ProjectStructure") {
            folders.enter(structure, Vec::new());
        }
        folders
    }

    fn enter(&mut self, element: Element<'_>, path: Vec<String>) {
        let here = self.paths.len();
        self.paths.push(path);
        for child in element.children() {
            if let Some(identity) = child.value("ObjectId").filter(|_| child.name() == "Object") {
                self.by_identity.insert(identity, here);
            }
            if child.children().next().is_some() {
                let mut inner = self.paths[here].clone();
                inner.extend(child.value("Name").filter(|_| child.name() == "Folder"));
                self.enter(child, inner);
            }
        }
    }

    fn of(&self, element: Element<'_>) -> Vec<String> {
        let found = id(element).and_then(|identity| self.by_identity.get(&identity));
        found.map_or_else(Vec::new, |path| self.paths[*path].clone())
    }
}

fn collect(element: Element<'_>, folders: &Folders, objects: &mut Vec<Object>, notes: &mut Vec<Note>) {
    for child in element.children() {
        match top(child, notes) {
            Some(mut object) => {
                object.folder = folders.of(child);
                objects.push(object);
            }
            None => collect(child, folders, objects, notes),
        }
        if child.name() == "resource" {
            objects.extend(child.children_named("task").map(task));
        }
    }
}

/// The identity that CODESYS gives an object.
fn id(element: Element<'_>) -> Option<String> {
    let data = element.child("addData")?.children_named("data");
    data.filter_map(|data| data.child_text("ObjectId")).next().or_else(|| element.value("ObjectId"))
}

fn top(element: Element<'_>, notes: &mut Vec<Note>) -> Option<Object> {
    let kind = match element.name() {
        "pou" => ObjectKind::Pou,
        "dataType" => ObjectKind::DataType,
        "globalVars" => ObjectKind::GlobalVariables,
        "Interface" if element.attribute("name").is_some() => ObjectKind::Interface,
        _ => return None,
    };
    Some(object(kind, element, notes))
}

fn object(kind: ObjectKind, element: Element<'_>, notes: &mut Vec<Note>) -> Object {
    let name = element.attribute("name").filter(|name| !name.value.is_empty());
    let span = name.as_ref().map_or(element.name_span(), |name| name.span);
    let mut object = Object::new(kind, name.map(|name| name.value.into_owned()), span);
    let plain = plain_text(element);
    object.documentation = if plain.is_some() { None } else { documentation(element) };
    object.declaration = plain.or_else(|| declaration::of(kind, element));
    if let Some(found) = element.child("body") {
        object.body = body(found, &mut object.children, notes);
    }
    if let Some(id) = id(element) {
        object.properties.push(("id".to_owned(), id));
    }
    members(element, &mut object.children, notes);
    object
}

/// The declaration as text, where the tool adds it.
fn plain_text(element: Element<'_>) -> Option<Fragment> {
    let holders = [element.child("interface"), Some(element)];
    let data = holders.into_iter().flatten().filter_map(|holder| holder.child("addData"));
    let text = data.flat_map(|data| data.children_named("data")).find_map(|data| data.child("InterfaceAsPlainText"))?;
    Some(xhtml::code(text.child("xhtml").unwrap_or(text)))
}

fn documentation(element: Element<'_>) -> Option<Fragment> {
    let inside = element.child("interface").and_then(|interface| interface.child("documentation"));
    xhtml::markdown(inside.or_else(|| element.child("documentation"))?)
}

/// The body; actions that are drawn inside of a chart are added to `inner`.
fn body(body: Element<'_>, inner: &mut Vec<Object>, notes: &mut Vec<Note>) -> Body {
    for child in body.children() {
        match child.name() {
            "ST" => return Body::St(xhtml::code(child.child("xhtml").unwrap_or(child))),
            "IL" => return Body::Il(xhtml::code(child.child("xhtml").unwrap_or(child))),
            "SFC" => return chart::body(chart::plcopen(child), child, inner, notes),
            "FBD" => return Body::Other(Language::Fbd, child.raw()),
            "LD" => return Body::Other(Language::Ld, child.raw()),
            _ => {}
        }
    }
    let added = body.descendants().find(|element| element.name() == "data" && element.value("name").is_some());
    match added {
        Some(data) if data.value("name").is_some_and(|name| name.ends_with("cfc")) => {
            Body::Other(Language::Cfc, data.raw())
        }
        Some(data) => Body::Other(Language::Unknown, data.raw()),
        None => Body::None,
    }
}

fn members(owner: Element<'_>, out: &mut Vec<Object>, notes: &mut Vec<Note>) {
    for child in owner.children() {
        let kind = match child.name() {
            "action" => ObjectKind::Action,
            "transition" => ObjectKind::Transition,
            "Method" | "method" => ObjectKind::Method,
            "Property" | "property" => ObjectKind::Property,
            "GetAccessor" => ObjectKind::Getter,
            "SetAccessor" => ObjectKind::Setter,
            "actions" | "transitions" | "addData" | "data" => {
                members(child, out, notes);
                continue;
            }
            _ => continue,
        };
        out.push(object(kind, child, notes));
    }
}

fn task(element: Element<'_>) -> Object {
    let name = element.attribute("name");
    let span = name.as_ref().map_or(element.name_span(), |name| name.span);
    let mut task = Object::new(ObjectKind::Task, name.map(|name| name.value.into_owned()), span);
    for key in ["interval", "priority", "single"] {
        if let Some(value) = element.value(key).filter(|value| !value.is_empty()) {
            task.properties.push((key.to_owned(), value));
        }
    }
    for instance in element.children_named("pouInstance") {
        let called = instance.value("typeName").filter(|name| !name.is_empty()).or_else(|| instance.value("name"));
        task.properties.extend(called.map(|name| ("call".to_owned(), name)));
    }
    task
}
