//! Finds the test tables of a tree and the blocks that they belong to.
//!
//! A table belongs to a block by standing in its comment, by a `@gtt path` in it, by naming it, by a
//! file of the block's name, or by a file of the same stem as the one that declares a single block.

use std::collections::BTreeMap;

use crate::config::tables::TableReading;
use crate::diagnostic::{Finding, Severity};
use crate::docs::Docs;
use crate::library::names::{Names, fold};
use crate::library::{Catalogue, ItemId, ItemKind};
use crate::source::{TableFile, Tree};
use crate::table::codes::{MISSING_TABLE_FILE, UNATTACHED_TABLE};
use crate::table::read::{self, Read};
use crate::table::{AttachedTable, Piece, Table, TableError};
use crate::table::{bind, decide, form, lint};
use crate::text::FileId;

/// The tables and what is wrong with them.
#[derive(Default)]
pub(super) struct Tables {
    pub(super) tables: Vec<AttachedTable>,
    pub(super) findings: Vec<Finding>,
}

/// All tables of `tree`: those in comments in the order of the catalogue, then those in files.
pub(super) fn attach(tree: &Tree, catalogue: &Catalogue, names: &Names, docs: &Docs, reading: &TableReading) -> Tables {
    let mut all = Tables::default();
    let mut named: BTreeMap<String, ItemId> = BTreeMap::new();
    for (id, item) in catalogue.iter() {
        let Some(doc) = docs.item(id).doc.as_ref().filter(|_| docs.item(id).inherited_from.is_none()) else { continue };
        for text in &doc.tables {
            let piece = Piece::new(text.place.file, &text.text, &text.map);
            all.take(read::pipe::read(&piece, &reading.all), (catalogue, names), |_| Some(id));
        }
        for (path, place) in &doc.tags.gtt_paths {
            let wanted = beside(&tree.files.get(item.place.file).path, path);
            match tree.tables.iter().find(|table| fold(&table.path) == fold(&wanted)) {
                Some(table) => _ = named.insert(table.path.clone(), id),
                None => all.findings.push(
                    Finding::new(&MISSING_TABLE_FILE, *place, format!("there is no table file `{wanted}`"))
                        .help("the path is seen from the file that holds the comment"),
                ),
            }
        }
    }
    let owners = Owners::new(tree, catalogue, names);
    for table in &tree.tables {
        let read = file(tree, table, reading);
        let by_path = named.get(&table.path).copied();
        all.take(read, (catalogue, names), |found| by_path.or_else(|| owners.of(table, found)));
    }
    all
}

/// Reads a table file in the form that its name says.
fn file(tree: &Tree, table: &TableFile, reading: &TableReading) -> Read {
    let text = &tree.files.get(table.file).text;
    form::read(
        &form::File { id: table.file, path: &table.path, text, bytes: &table.bytes },
        &reading.options(&table.path),
    )
}

impl Tables {
    fn take(&mut self, read: Read, (catalogue, names): (&Catalogue, &Names), owner: impl Fn(&Table) -> Option<ItemId>) {
        for mut table in read.tables {
            let inside = |finding: &&Finding| {
                finding.severity == Severity::Error
                    && finding.place.file == table.place.file
                    && table.place.span.contains(finding.place.span)
            };
            let error = |finding: &Finding| TableError { message: finding.message.clone(), place: finding.place };
            let mut errors: Vec<TableError> = read.findings.iter().filter(inside).map(error).collect();
            let item = owner(&table);
            if item.is_none() {
                let message = format!("test table `{}` belongs to no block", table.name);
                let help = "name the file after its block, or write `for BLOCK` in the table's heading";
                self.findings.push(Finding::new(&UNATTACHED_TABLE, table.place, message).help(help));
            }
            let bound = item.map(|item| {
                let (bound, findings) = bind::bind(&table, catalogue, names, item);
                errors.extend(findings.iter().filter(|f| f.severity == Severity::Error).map(error));
                self.findings.extend(findings);
                bound
            });
            if !table.has_errors() {
                self.findings.extend(lint::lint(&table));
            }
            if let Some(bound) = &bound {
                self.findings.extend(decide::lint::lint(&table, bound));
            }
            table.errors = bound.as_ref().map_or(table.errors, |bound| bound.errors);
            self.tables.push(AttachedTable { table, item, errors, bound });
        }
        self.findings.extend(read.findings);
    }
}

/// The path `path`, written in the file `from`.
fn beside(from: &str, path: &str) -> String {
    let mut parts: Vec<&str> = from.split('/').collect();
    parts.pop();
    for part in path.split(['/', '\\']) {
        match part {
            "" | "." => {}
            ".." => _ = parts.pop(),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

/// What declares blocks, for tables that stand in files of their own.
struct Owners<'a> {
    catalogue: &'a Catalogue,
    names: &'a Names,
    /// Blocks by the file that declares them.
    by_file: BTreeMap<FileId, Vec<ItemId>>,
    /// Files by their path without extension.
    by_stem: BTreeMap<String, Vec<FileId>>,
}

impl<'a> Owners<'a> {
    fn new(tree: &Tree, catalogue: &'a Catalogue, names: &'a Names) -> Self {
        let mut by_file: BTreeMap<FileId, Vec<ItemId>> = BTreeMap::new();
        for (id, item) in catalogue.iter().filter(|(_, item)| testable(item.kind)) {
            by_file.entry(item.place.file).or_default().push(id);
        }
        let mut by_stem: BTreeMap<String, Vec<FileId>> = BTreeMap::new();
        for file in by_file.keys() {
            by_stem.entry(stem(&tree.files.get(*file).path)).or_default().push(*file);
        }
        Self { catalogue, names, by_file, by_stem }
    }

    fn of(&self, file: &TableFile, table: &Table) -> Option<ItemId> {
        let neighbours = self.by_stem.get(&stem(&file.path)).into_iter().flatten();
        let near: Vec<ItemId> = neighbours.flat_map(|file| &self.by_file[file]).copied().collect();
        let called = |name: &str| {
            let same = |id: &&ItemId| fold(&self.catalogue.item(**id).name) == fold(name);
            let anywhere = || self.names.all(name).iter().find(|id| testable(self.catalogue.item(**id).kind)).copied();
            near.iter().find(same).copied().or_else(anywhere)
        };
        if let Some(unit) = &table.unit {
            return called(&unit.text);
        }
        let name = stem(&file.path);
        let name = name.rsplit('/').next().unwrap_or(&name);
        called(name).or_else(|| single(self.catalogue, &near))
    }
}

/// The only block, or the only program, of a file.
fn single(catalogue: &Catalogue, near: &[ItemId]) -> Option<ItemId> {
    let programs = || near.iter().copied().filter(|id| catalogue.item(*id).kind == ItemKind::Program);
    match (near, programs().count()) {
        ([only], _) => Some(*only),
        (_, 1) => programs().next(),
        _ => None,
    }
}

const fn testable(kind: ItemKind) -> bool {
    matches!(kind, ItemKind::FunctionBlock | ItemKind::Program | ItemKind::Function | ItemKind::Class)
}

/// The path without its extensions (`.gtt.md` has two), folded.
fn stem(path: &str) -> String {
    let path = fold(path);
    let name_at = path.rfind('/').map_or(0, |at| at + 1);
    let end = path[name_at..].find('.').map_or(path.len(), |at| name_at + at);
    path[..end].to_owned()
}
