//! B&R Automation Studio: the `.apj` of a machine, the `.lby` of a library, the `.prg` of a program.
//!
//! Library and program name their files, each with a description. A path that begins with `\` is
//! seen from the folder of the `.apj`; `membership` finds that.

use super::{Draft, LibraryReference, Member, ProjectKind, folder_name};
use crate::source::formats::{Input, xml_notes};
use crate::source::note::Note;
use crate::source::paths;
use crate::source::xml::{Element, Xml};

/// The project that `input` tells of, if it is one of B&R's.
pub(super) fn read(input: &Input<'_>) -> Option<(Draft, Vec<Note>)> {
    if !input.text.trim_start().starts_with('<') {
        return None;
    }
    let xml = Xml::parse(input.text, &[]);
    let root = xml.root()?;
    let (kind, name) = match root.name() {
        "Library" => (ProjectKind::AutomationStudioLibrary, folder_name(input.path)),
        "Program" => (ProjectKind::AutomationStudioProgram, folder_name(input.path)),
        "Project" => (ProjectKind::AutomationStudio, paths::stem(input.path).to_owned()),
        _ => return None,
    };
    let mut draft = Draft::new(kind, name, input.path);
    draft.about.version = root.value("Version").filter(|version| !version.is_empty());
    draft.about.description = root.value("Description").filter(|text| !text.is_empty());
    let inside = |list: &'static str, item: &'static str| {
        root.children_named(list).flat_map(move |list| list.children_named(item))
    };
    draft.members = inside("Files", "File").filter_map(member).collect();
    draft.libraries = inside("Dependencies", "Dependency").filter_map(library).collect();
    Some((draft, xml_notes(&xml)))
}

fn member(file: Element<'_>) -> Option<Member> {
    Some(Member {
        path: file.trimmed()?,
        span: file.content(),
        file: None,
        folder: Vec::new(),
        exclude_from_build: false,
        description: file.value("Description").filter(|text| !text.is_empty()),
    })
}

fn library(dependency: Element<'_>) -> Option<LibraryReference> {
    let version = dependency.value("FromVersion").filter(|version| !version.is_empty());
    Some(LibraryReference { name: dependency.value("ObjectName")?, version, ..LibraryReference::default() })
}
