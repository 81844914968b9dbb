//! What a user puts beside the tree: narrative pages, templates, theme files.

use std::collections::BTreeMap;

use crate::book::Narrative;
use crate::library::Library;
use crate::source::{EntryKind, FileSystem};
use crate::text::decode;

/// No page, template or style sheet is larger.
const LIMIT: u64 = 4 << 20;

/// The files below `rungbook/templates` and `rungbook/themes`, by their path below these.
pub(super) fn read(fs: &dyn FileSystem) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    for root in ["rungbook/templates", "rungbook/themes"] {
        let prefix = root.strip_prefix("rungbook/").unwrap_or(root);
        for path in files(fs, root) {
            let name = path.strip_prefix(root).unwrap_or(&path).trim_start_matches('/');
            if let Some(text) = text(fs, &path) {
                found.insert(format!("{prefix}/{name}"), text);
            }
        }
    }
    found
}

/// The Markdown files below `folder`: `index.md` first, then by path.
pub(super) fn narratives(fs: &dyn FileSystem, folder: &str) -> Vec<Narrative> {
    let mut paths: Vec<String> = files(fs, folder).into_iter().filter(|path| path.ends_with(".md")).collect();
    paths.sort_by_key(|path| (!path.ends_with("/index.md"), path.matches('/').count(), path.clone()));
    let read = |path: String| text(fs, &path).map(|text| Narrative { path, text });
    paths.into_iter().filter_map(read).collect()
}

/// Describes each library that has no words of its own by the `README.md` in its folder.
pub(super) fn descriptions(fs: &dyn FileSystem, libraries: &mut [Library]) {
    for library in libraries.iter_mut().filter(|library| library.description.is_empty()) {
        let names = ["README.md", "Readme.md", "readme.md"];
        let folder = if library.path.is_empty() { String::new() } else { format!("{}/", library.path) };
        let found = names.iter().find_map(|name| text(fs, &format!("{folder}{name}")));
        library.description = found.unwrap_or_default();
    }
}

fn text(fs: &dyn FileSystem, path: &str) -> Option<String> {
    fs.read(path, LIMIT).ok().map(|bytes| decode::decode(&bytes).text)
}

/// All files below `folder`, by path; none if it is not there.
fn files(fs: &dyn FileSystem, folder: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(at) = folders.pop() {
        for entry in fs.entries(&at).unwrap_or_default() {
            let path = format!("{at}/{}", entry.name);
            match entry.kind {
                EntryKind::File(_) => found.push(path),
                EntryKind::Folder => folders.push(path),
                _ => {}
            }
        }
    }
    found.sort();
    found
}
