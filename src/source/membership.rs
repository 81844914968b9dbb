//! What lies around a file: the tool whose folder it stands in, and the project that it belongs to.

use std::collections::BTreeMap;

use super::formats::Setting;
use super::projects::{Draft, Member, Project, ProjectKind};
use super::tree::Tree;
use super::{codes, paths};
use crate::diagnostic::Finding;
use crate::text::{FileId, Place, Vendor};

/// The settings of all folders.
#[derive(Debug, Default)]
pub(super) struct Settings {
    folders: BTreeMap<String, Setting>,
}

impl Settings {
    /// The settings that the files at `paths` make.
    pub(super) fn new<'p>(paths: impl Iterator<Item = &'p str>) -> Self {
        let mut folders = BTreeMap::new();
        for path in paths {
            let setting = match paths::extension(path).as_str() {
                "yml" | "yaml" if paths::stem(path) == "apax" => Setting::SimaticAx,
                "apj" | "pkg" | "lby" => Setting::BAndR,
                _ => continue,
            };
            folders.insert(paths::folder(path).to_owned(), setting);
        }
        Self { folders }
    }

    /// The setting of the file at `path`: that of the nearest folder that has one.
    pub(super) fn of(&self, path: &str) -> Setting {
        ancestors(path).find_map(|folder| self.folders.get(folder)).copied().unwrap_or_default()
    }
}

/// The folder of `path`, the folder of that, and so on to the root.
fn ancestors(path: &str) -> impl Iterator<Item = &str> {
    std::iter::successors(Some(paths::folder(path)), |folder| (!folder.is_empty()).then(|| paths::folder(folder)))
}

/// Turns `drafts` into the projects of `tree` and says which unit belongs to which.
pub(super) fn join(tree: &mut Tree, drafts: Vec<(FileId, Draft)>, all: &[(String, u64)]) {
    let lookup = Lookup::new(tree, all);
    let roots: Vec<String> = drafts
        .iter()
        .filter(|(_, draft)| draft.kind == ProjectKind::AutomationStudio)
        .map(|(_, draft)| draft.folder.clone())
        .collect();
    let mut findings = Vec::new();
    for (file, draft) in drafts {
        let Draft { kind, name, folder, about, libraries, mut members } = draft;
        for member in &mut members {
            let found = lookup.resolve(&folder, &roots, member);
            if !found {
                findings.push(missing(file, member, &name));
            }
        }
        tree.projects.push(Project { kind, name, file, folder, about, libraries, members });
    }
    assign(tree, &mut findings);
    tree.findings.append(&mut findings);
}

fn missing(file: FileId, member: &Member, project: &str) -> Finding {
    let message = format!("the project `{project}` names `{}`, which is not in the tree", member.path);
    Finding::new(&codes::PROJECT_NAMES_MISSING_FILE, Place::new(file, member.span), message)
        .help("add the file, or take it out of the project")
}

/// Paths of the tree, found without regard to the case of letters, as on the systems where such projects are made.
struct Lookup {
    paths: BTreeMap<String, (String, Option<FileId>)>,
    exact: BTreeMap<String, Option<FileId>>,
}

impl Lookup {
    fn new(tree: &Tree, all: &[(String, u64)]) -> Self {
        let mut exact: BTreeMap<String, Option<FileId>> = all.iter().map(|(path, _)| (path.clone(), None)).collect();
        for skipped in &tree.skipped {
            exact.entry(skipped.path.clone()).or_default();
        }
        for unit in &tree.units {
            exact.insert(tree.files.get(unit.file).path.clone(), Some(unit.file));
        }
        let mut paths = BTreeMap::new();
        for (path, file) in &exact {
            paths.entry(path.to_lowercase()).or_insert_with(|| (path.clone(), *file));
        }
        Self { paths, exact }
    }

    /// Gives `member` its path below the root and its file; whether there is such a file.
    fn resolve(&self, folder: &str, roots: &[String], member: &mut Member) -> bool {
        let from_root = member.path.starts_with(['\\', '/']);
        let base = if from_root {
            roots.iter().filter(|root| paths::is_below(folder, root) || folder == *root).max_by_key(|root| root.len())
        } else {
            None
        };
        let written = member.path.trim_start_matches(['\\', '/']);
        let path = match (from_root, base) {
            (true, None) => None,
            (true, Some(root)) => paths::resolve(root, written),
            (false, _) => paths::resolve(folder, written),
        };
        let Some(path) = path else { return false };
        let found = match self.exact.get_key_value(&path) {
            Some((path, file)) => Some((path.clone(), *file)),
            None => self.paths.get(&path.to_lowercase()).cloned(),
        };
        let is_found = found.is_some();
        (member.path, member.file) = found.unwrap_or((path, None));
        is_found
    }
}

/// Says of every unit which project it belongs to: one that names it, of several the nearest; otherwise the nearest whose
/// folder holds it.
fn assign(tree: &mut Tree, findings: &mut Vec<Finding>) {
    let mut named: BTreeMap<FileId, Vec<usize>> = BTreeMap::new();
    for (index, project) in tree.projects.iter().enumerate() {
        for file in project.members.iter().filter_map(|member| member.file) {
            named.entry(file).or_default().push(index);
        }
    }
    let Tree { files, units, projects, .. } = tree;
    let by_folder = by_folder(projects);
    for unit in units {
        let path = &files.get(unit.file).path;
        let nearest = ancestors(path).find_map(|folder| by_folder.get(folder)).map(|found| found[0]);
        let holding = |index: &&usize| {
            let folder = &projects[**index].folder;
            (if paths::is_below(path, folder) { folder.len() + 1 } else { 0 }, usize::MAX - **index)
        };
        let naming = named.get(&unit.file).and_then(|found| found.iter().max_by_key(holding)).copied();
        unit.project = naming.or(nearest);
        let (None, Some(project)) = (naming, nearest.map(|index| &projects[index])) else { continue };
        if names_its_files(project.kind, unit.vendor) {
            let message =
                format!("the project `{}` does not name `{}`, which lies below it", project.name, paths::name(path));
            let finding = Finding::of_file(&codes::NOT_IN_PROJECT, unit.file, message);
            findings.push(
                finding.help("add the file to the project, or remove it; until then it is documented with the project"),
            );
        }
    }
}

/// Whether a project of `kind` would name a file of `vendor` if it were part of it.
fn names_its_files(kind: ProjectKind, vendor: Vendor) -> bool {
    match kind {
        ProjectKind::TwinCat => vendor == Vendor::TwinCat,
        ProjectKind::AutomationStudioLibrary | ProjectKind::AutomationStudioProgram => vendor == Vendor::BAndR,
        ProjectKind::SimaticAx | ProjectKind::AutomationStudio | ProjectKind::PlcOpen => false,
    }
}

fn by_folder(projects: &[Project]) -> BTreeMap<&str, Vec<usize>> {
    let mut folders: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    // An exported project is one file, and its neighbours are none of its.
    let with_folder = projects.iter().enumerate().filter(|(_, project)| project.kind != ProjectKind::PlcOpen);
    for (index, project) in with_folder {
        folders.entry(project.folder.as_str()).or_default().push(index);
    }
    folders
}
