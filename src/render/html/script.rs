//! The data that scripts load: the search index and the navigation. Both are classic scripts that set a global, since
//! a page from `file://` may load a script and may not fetch a file.

use std::collections::BTreeMap;

use super::escape::script_string;
use super::lists::{kind_short, link_url};
use crate::book::view::{Book, FolderView};

/// A brief description is cut to this many characters in the search index.
const BRIEF: usize = 120;

/// `RUNGBOOK_INDEX`: the kinds, the contexts, and for each name `[name, kind, context, url, brief]`, where kind and
/// context are indices.
pub(super) fn search_index(book: &Book) -> String {
    let mut kinds = Pool::default();
    let mut contexts = Pool::default();
    let mut entries = String::new();
    for (i, entry) in book.index.iter().enumerate() {
        let brief: String = entry.brief.chars().take(BRIEF).collect();
        entries.push_str(if i == 0 { "\n[" } else { ",\n[" });
        entries.push_str(&script_string(&entry.name));
        entries.push_str(&format!(",{},{},", kinds.index(entry.kind_label), contexts.index(&entry.context)));
        entries.push_str(&script_string(&entry.url));
        if !brief.is_empty() {
            entries.push(',');
            entries.push_str(&script_string(&brief));
        }
        entries.push(']');
    }
    format!(
        "window.RUNGBOOK_INDEX={{\"kinds\":{},\"contexts\":{},\"entries\":[{entries}\n]}};\n",
        kinds.json(),
        contexts.json()
    )
}

/// `RUNGBOOK_NAV`: for each library `[name, url, folders]`, for each folder `[path, url, entities]`, for each entity
/// `[name, url, kind]`.
pub(super) fn navigation(book: &Book) -> String {
    let library = |library: &crate::book::view::LibraryView| {
        let folders: Vec<String> = library.folders.iter().map(nav_folder).collect();
        format!("[{},{},[{}]]", script_string(&library.name), script_string(&library.url), folders.join(","))
    };
    let libraries: Vec<String> = book.libraries.iter().map(library).collect();
    format!("window.RUNGBOOK_NAV=[\n{}\n];\n", libraries.join(",\n"))
}

fn nav_folder(folder: &FolderView) -> String {
    let path: Vec<String> = folder.path.iter().map(|part| script_string(part)).collect();
    let entities: Vec<String> = folder
        .entities
        .iter()
        .filter_map(|entry| {
            let url = link_url(entry.link.to.as_ref())?;
            let short = script_string(kind_short(entry.kind));
            Some(format!("[{},{},{short}]", script_string(&entry.link.name), script_string(url)))
        })
        .collect();
    format!("\n[[{}],{},[{}]]", path.join(","), script_string(&folder.url), entities.join(","))
}

/// Strings, each once, in the order in which they came.
#[derive(Default)]
struct Pool {
    strings: Vec<String>,
    places: BTreeMap<String, usize>,
}

impl Pool {
    fn index(&mut self, text: &str) -> usize {
        if let Some(&place) = self.places.get(text) {
            return place;
        }
        let place = self.strings.len();
        self.strings.push(text.to_owned());
        self.places.insert(text.to_owned(), place);
        place
    }

    fn json(&self) -> String {
        let strings: Vec<String> = self.strings.iter().map(|text| script_string(text)).collect();
        format!("[{}]", strings.join(","))
    }
}
