//! The zoo, second part: one small file or folder for each quirk of a container (`tests/zoo/containers`) and of a
//! comment (`tests/zoo/comments`), each with what it must give: how it was read, what it declares, which comment
//! documents what, and what is found wrong. The syntax of texts is in `syntax/zoo.rs`.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use rungbook::docs::{Documentation, Entry, Verdict};
use rungbook::library::{Item, ItemBody, ItemId};
use rungbook::pipeline::{self, Project};
use rungbook::source::{self, Disk, Memory};

use super::support::settings;

/// The entries of a folder of the zoo that are not snapshots.
pub(super) fn animals(folder: &str) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/zoo").join(folder);
    let entries = fs::read_dir(root).expect("the zoo").flatten().map(|entry| entry.path());
    let mut found: Vec<PathBuf> = entries.filter(|path| !path.to_string_lossy().contains(".snap")).collect();
    found.sort();
    found
}

fn place(project: &Project, place: rungbook::text::Place) -> String {
    let at = project.files.line_column(place);
    format!("{}:{}:{}", project.files.get(place.file).path, at.line, at.column)
}

/// What the comments of an entity or a variable were taken for.
fn documentation(project: &Project, entry: &Entry, indent: &str, out: &mut String) {
    if let Some(doc) = &entry.doc {
        let inherited = entry.inherited_from.map_or(String::new(), |from| {
            let item = project.catalogue.item(from);
            let parent = item.parent.map_or("", |parent| project.catalogue.item(parent).name.as_str());
            format!(", from {parent}.{}", item.name)
        });
        let _ = writeln!(
            out,
            "{indent}= {:?} ({}, {:?}{inherited})",
            doc.brief_text(),
            doc.convention.key(),
            doc.placement
        );
        tags(doc, indent, out);
    }
    if entry.inherited_from.is_none() {
        for considered in &entry.considered {
            if let Verdict::Rejected(reason) = considered.verdict {
                let at = project.files.line_column(considered.place);
                let _ = writeln!(out, "{indent}- line {}: {}", at.line, reason.text());
            }
        }
    }
}

fn tags(doc: &Documentation, indent: &str, out: &mut String) {
    let tags = &doc.tags;
    let mut facts: Vec<String> = Vec::new();
    facts.extend((!doc.detail.is_empty()).then(|| format!("{} more blocks", doc.detail.len())));
    facts.extend(tags.params.iter().map(|param| {
        format!("parameter {}{}", param.name, if param.target.is_some() { "" } else { ", which is none" })
    }));
    let counted = [
        (usize::from(tags.returns.is_some()), "returns"),
        (tags.see.len(), "see"),
        (usize::from(tags.since.is_some()), "since"),
        (usize::from(tags.deprecated.is_some()), "deprecated"),
        (tags.examples.len(), "example"),
        (tags.todos.len(), "todo"),
        (usize::from(tags.version.is_some()), "version"),
        (tags.authors.len(), "author"),
        (usize::from(tags.internal), "internal"),
        (tags.history.len(), "history"),
    ];
    facts.extend(counted.into_iter().filter(|(count, _)| *count > 0).map(|(count, what)| format!("{what} {count}")));
    facts.extend(tags.requirements.iter().map(|(id, _)| format!("requirement {id}")));
    if !facts.is_empty() {
        let _ = writeln!(out, "{indent}  {}", facts.join("; "));
    }
}

fn item(project: &Project, id: ItemId, item: &Item, depth: usize, out: &mut String) {
    let indent = "  ".repeat(depth);
    let namespace: String = item.namespace.iter().map(|part| format!("{part}.")).collect();
    let type_ = item.type_.as_ref().map_or(String::new(), |type_| format!(" : {}", type_.text));
    let body = match &item.body {
        ItemBody::None => "",
        ItemBody::St(_) => ", Structured Text",
        ItemBody::Il(_) => ", Instruction List",
        ItemBody::Drawn(language, _) => &format!(", {language:?}"),
    };
    let folder = if item.folder.is_empty() { String::new() } else { format!(", in {}", item.folder.join("/")) };
    let _ = writeln!(
        out,
        "{indent}{} {namespace}{}{type_} ({}{body}{folder}) at {}",
        item.kind.key(),
        item.name,
        item.access,
        place(project, item.place)
    );
    documentation(project, project.docs.item(id), &format!("{indent}  "), out);
    for (key, value) in &item.properties {
        let _ = writeln!(out, "{indent}  {key}: {value}");
    }
    for (index, variable) in item.variables.iter().enumerate() {
        let type_ = variable.type_.as_ref().map_or("", |type_| type_.text.as_str());
        let initial = variable.initial.as_ref().map_or(String::new(), |initial| format!(" := {initial}"));
        let _ = writeln!(out, "{indent}  {} {} : {type_}{initial}", variable.section.key(), variable.name);
        if let Some(entry) = project.docs.variable(id, index) {
            documentation(project, entry, &format!("{indent}    "), out);
        }
    }
    for child in &item.children {
        self::item(project, *child, project.catalogue.item(*child), depth + 1, out);
    }
}

/// What the tool makes of the file or folder at `path`.
fn show(path: &Path) -> String {
    let name = path.file_name().expect("a name").to_string_lossy().into_owned();
    if path.is_dir() {
        let disk = Disk::new(path).expect("a folder");
        described(&disk)
    } else {
        described(&Memory::new().with(&name, fs::read(path).expect("a file")))
    }
}

fn described(fs: &dyn source::FileSystem) -> String {
    let mut out = String::new();
    let tree = source::read_tree(fs, &source::Options::default(), &|_| {});
    for unit in &tree.units {
        let file = tree.files.get(unit.file);
        let nesting = match unit.nested_comments {
            Some(true) => ", comments nest",
            Some(false) => ", comments do not nest",
            None => "",
        };
        let _ = writeln!(out, "{}: {}, {}{nesting}", file.path, unit.format, file.encoding.name());
    }
    for project in &tree.projects {
        let _ = writeln!(
            out,
            "project {} {} by {}: {}; refers to {:?}",
            project.name,
            project.about.version.as_deref().unwrap_or("-"),
            project.about.author.as_deref().unwrap_or("-"),
            project.about.description.as_deref().unwrap_or("-"),
            project.libraries.iter().map(|library| &library.name).collect::<Vec<_>>()
        );
    }
    let project = pipeline::read(fs, "tree", &settings(""), &|_| {});
    for (id, top) in project.catalogue.iter().filter(|(_, item)| item.parent.is_none()) {
        item(&project, id, top, 0, &mut out);
    }
    for finding in &project.findings {
        let _ = writeln!(out, "{} {}: {}", place(&project, finding.place), finding.code.name, finding.message);
        for help in finding.help.iter().filter(|_| finding.code.name == "binary-project") {
            let _ = writeln!(out, "  help: {help}");
        }
    }
    for (path, reason) in &project.skipped {
        let _ = writeln!(out, "skipped {path}: {reason}");
    }
    if project.other_files > 0 {
        let _ = writeln!(out, "{} other files", project.other_files);
    }
    out
}

fn check(folder: &str) {
    for path in animals(folder) {
        let name = path.file_name().expect("a name").to_string_lossy().replace('.', "_");
        let mut settings = insta::Settings::clone_current();
        settings.set_snapshot_path(format!("../zoo/{folder}"));
        settings.set_prepend_module_to_snapshot(false);
        settings.set_omit_expression(true);
        settings.bind(|| insta::assert_snapshot!(name, show(&path)));
    }
}

#[test]
fn containers() {
    check("containers");
}

#[test]
fn comments() {
    check("comments");
}
