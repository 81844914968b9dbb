//! Which library each file belongs to: the project that names it, or the tree itself.

use crate::library::{Library, LibraryId};
use crate::source::{Project, ProjectKind, Tree};

/// The libraries of a tree.
pub(super) struct Libraries {
    /// In the order of their paths; the tree itself first, if a file belongs to no project.
    pub(super) list: Vec<Library>,
    /// For each unit, its library.
    pub(super) of_unit: Vec<LibraryId>,
}

/// The libraries of `tree`, whose folder is called `name`. A project that holds no file is none.
pub(super) fn of(tree: &Tree, name: &str) -> Libraries {
    let used = |project: Option<usize>| tree.units.iter().any(|unit| unit.project == project);
    let mut list = Vec::new();
    let mut index: Vec<Option<LibraryId>> = vec![None; tree.projects.len() + 1];
    let homes = std::iter::once(None).chain((0..tree.projects.len()).map(Some));
    for home in homes.filter(|home| used(*home) || (home.is_none() && tree.units.is_empty())) {
        let id = LibraryId(u32::try_from(list.len()).unwrap_or(u32::MAX));
        index[home.map_or(0, |i| i + 1)] = Some(id);
        list.push(home.map_or_else(|| folder(name), |i| project(&tree.projects[i])));
    }
    let of_unit = tree.units.iter().map(|unit| index[unit.project.map_or(0, |i| i + 1)]);
    let of_unit = of_unit.map(|id| id.unwrap_or(LibraryId(0))).collect();
    Libraries { list, of_unit }
}

fn folder(name: &str) -> Library {
    Library { name: name.to_owned(), format: "folder".to_owned(), ..Library::default() }
}

fn project(project: &Project) -> Library {
    let about = &project.about;
    Library {
        name: about.title.clone().unwrap_or_else(|| project.name.clone()),
        version: about.version.clone().unwrap_or_default(),
        author: about.company.clone().or_else(|| about.author.clone()).unwrap_or_default(),
        description: about.description.clone().unwrap_or_default(),
        format: format(project.kind).to_owned(),
        path: project.folder.clone(),
        references: project.libraries.iter().map(|reference| reference.name.clone()).collect(),
    }
}

const fn format(kind: ProjectKind) -> &'static str {
    match kind {
        ProjectKind::TwinCat => "TwinCAT 3 project",
        ProjectKind::SimaticAx => "SIMATIC AX package",
        ProjectKind::AutomationStudio => "Automation Studio project",
        ProjectKind::AutomationStudioLibrary => "Automation Studio library",
        ProjectKind::AutomationStudioProgram => "Automation Studio program",
        ProjectKind::PlcOpen => "PLCopen XML project",
    }
}
