//! Arranges entities by library and folder, and into page runs.
//!
//! A page run begins on a new page and has a running header of its own; the typesetter lays out runs in
//! parallel. What is large by nature (a function block, a program, a class, a list of globals) is a run
//! by itself; what is small (functions, interfaces, types) flows together with its neighbours, but not
//! endlessly.

use serde_json::{Map, Value, json};

use super::array;
use crate::book::view::{Book, LibraryView};

/// The entities of a run of small ones, at most.
const LONGEST: usize = 24;
/// Kinds that begin a page.
const LARGE: &[&str] = &["function-block", "program", "class", "gvl"];

/// Moves the entities into their libraries: `libraries[].sections[].runs[].entities[]`.
pub(super) fn arrange(rest: &mut Map<String, Value>, book: &Book, entities: Vec<Value>) {
    let mut sections: Vec<Vec<Section<'_>>> = book.libraries.iter().map(|_| Vec::new()).collect();
    for (view, value) in book.entities.iter().zip(entities) {
        let Some(list) = sections.get_mut(view.library) else { continue };
        if list.last().is_none_or(|section| section.folder != view.folder.as_slice()) {
            let shown = value.get("folder").cloned().unwrap_or_else(|| json!([]));
            list.push(Section { folder: &view.folder, shown, runs: Vec::new() });
        }
        if let Some(section) = list.last_mut() {
            section.push(value, LARGE.contains(&view.core.kind));
        }
    }
    let libraries = array(rest, "libraries").iter_mut().zip(&book.libraries).zip(sections);
    for ((value, view), sections) in libraries {
        let Value::Object(library) = value else { continue };
        let folders = std::mem::take(array(library, "folders"));
        library.remove("folders");
        let list = sections.into_iter().map(|section| section.value(view, &folders)).collect();
        library.insert("sections".to_owned(), Value::Array(list));
    }
}

/// A folder of a library.
struct Section<'a> {
    folder: &'a [String],
    /// The folder as it is printed.
    shown: Value,
    runs: Vec<Run>,
}

/// What shares its pages.
struct Run {
    large: bool,
    entities: Vec<Value>,
}

impl Section<'_> {
    fn push(&mut self, entity: Value, large: bool) {
        match self.runs.last_mut().filter(|run| !large && !run.large && run.entities.len() < LONGEST) {
            Some(run) => run.entities.push(entity),
            None => self.runs.push(Run { large, entities: vec![entity] }),
        }
    }

    /// The section with its list of entries, which the library has by folder.
    fn value(self, library: &LibraryView, folders: &[Value]) -> Value {
        let place = library.folders.iter().position(|folder| folder.path == self.folder);
        let entries = place.and_then(|index| folders.get(index)).and_then(|folder| folder.get("entities"));
        let runs: Vec<Value> = self
            .runs
            .into_iter()
            .map(|run| json!({ "single": run.entities.len() == 1, "entities": run.entities }))
            .collect();
        json!({ "path": self.shown, "entries": entries.cloned().unwrap_or_else(|| json!([])), "runs": runs })
    }
}
