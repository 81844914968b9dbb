//! The projects that name files: what they are called, who made them, which files belong to them.

mod apax;
mod automation_studio;
mod plcproj;

use super::formats::Input;
use super::note::Note;
use super::paths;
use crate::text::{FileId, Span};

/// What kind of file tells of a project.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ProjectKind {
    /// TwinCAT 3: a `.plcproj`.
    TwinCat,
    /// SIMATIC AX: an `apax.yml`.
    SimaticAx,
    /// B&R Automation Studio: the `.apj` of a whole machine.
    AutomationStudio,
    /// B&R Automation Studio: the `.lby` of a library.
    AutomationStudioLibrary,
    /// B&R Automation Studio: the `.prg` of a program, whose `.var` and `.typ` files are its own.
    AutomationStudioProgram,
    /// A project exported as PLCopen XML, which is its only file.
    PlcOpen,
}

/// A project.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Project {
    /// What kind of project it is.
    pub kind: ProjectKind,
    /// Its name.
    pub name: String,
    /// The file that tells of it.
    pub file: FileId,
    /// The folder of that file.
    pub folder: String,
    /// What the file says of it.
    pub about: About,
    /// The libraries that it refers to, in its order.
    pub libraries: Vec<LibraryReference>,
    /// The files that it names, in its order.
    pub members: Vec<Member>,
}

impl Project {
    /// The member that is `file`.
    #[must_use]
    pub fn member(&self, file: FileId) -> Option<&Member> {
        self.members.iter().find(|member| member.file == Some(file))
    }
}

/// What a project says of itself.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct About {
    /// The title, where it differs from the name.
    pub title: Option<String>,
    /// The version.
    pub version: Option<String>,
    /// The company.
    pub company: Option<String>,
    /// The author.
    pub author: Option<String>,
    /// The description.
    pub description: Option<String>,
    /// The namespace that its objects live in.
    pub namespace: Option<String>,
}

/// A library that a project refers to.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LibraryReference {
    /// Its name.
    pub name: String,
    /// Its version, where one is fixed.
    pub version: Option<String>,
    /// Who made it.
    pub company: Option<String>,
    /// The namespace under which the project sees it.
    pub namespace: Option<String>,
}

/// A file that a project names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Member {
    /// Its path below the root of the tree; as the project writes it, where that leads out of the tree.
    pub path: String,
    /// Where the project names it.
    pub span: Span,
    /// The file, if it holds program text.
    pub file: Option<FileId>,
    /// The folder inside the project, outermost first.
    pub folder: Vec<String>,
    /// Whether the project leaves it out of the program.
    pub exclude_from_build: bool,
    /// What the project says of it.
    pub description: Option<String>,
}

/// A project before the files have names.
#[derive(Clone, Debug)]
pub(super) struct Draft {
    pub(super) kind: ProjectKind,
    pub(super) name: String,
    pub(super) folder: String,
    pub(super) about: About,
    pub(super) libraries: Vec<LibraryReference>,
    /// Their paths are written as in the project file.
    pub(super) members: Vec<Member>,
}

impl Draft {
    pub(super) fn new(kind: ProjectKind, name: String, path: &str) -> Self {
        let (about, libraries, members) = (About::default(), Vec::new(), Vec::new());
        Self { kind, name, folder: paths::folder(path).to_owned(), about, libraries, members }
    }
}

/// Whether the file at `path` may tell of a project.
pub(super) fn reads(path: &str) -> bool {
    matches!(paths::extension(path).as_str(), "plcproj" | "lby" | "prg" | "apj") || apax::is_manifest(path)
}

/// The project that `input` tells of, if it is a project's file.
pub(super) fn read(input: &Input<'_>) -> Option<(Draft, Vec<Note>)> {
    match paths::extension(input.path).as_str() {
        "plcproj" => Some(plcproj::read(input)),
        "lby" | "prg" | "apj" => automation_studio::read(input),
        _ if apax::is_manifest(input.path) => Some((apax::read(input), Vec::new())),
        _ => None,
    }
}

/// The name of the folder that holds `path`, for projects that have no other name.
fn folder_name(path: &str) -> String {
    let folder = paths::name(paths::folder(path));
    if folder.is_empty() { paths::stem(path).to_owned() } else { folder.to_owned() }
}
