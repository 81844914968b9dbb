//! What a tree offers, for the comparison of releases.

use super::{Project, Stamp};
use crate::config::Settings;
use crate::docs::{Entry, TableText};
use crate::evidence::digest::Digest;
use crate::evidence::record::{Answer, Record};
use crate::evidence::snapshot::{self, Entity, Row, Snapshot, Table, Variable};
use crate::library::{Access, Item, ItemId, TypeUse};
use crate::table::AttachedTable;
use crate::table::cell::time_text;
use crate::table::layout::{self, DurationText};
use crate::text::Span;

/// The snapshot of a project.
#[must_use]
pub fn snapshot(project: &Project, settings: &Settings, stamp: &Stamp, records: &[(Record, Answer)]) -> Snapshot {
    let described = project.catalogue.iter().filter(|(_, item)| !item.kind.is_accessor());
    let mut entities: Vec<Entity> = described.map(|(id, item)| entity(project, id, item)).collect();
    entities.sort_by(|a, b| a.name.cmp(&b.name));
    let tables = project.tables.iter().zip(records).map(|(attached, (record, _))| table(project, attached, record));
    let (title, version) = super::title(project, settings);
    Snapshot {
        snapshot_version: snapshot::VERSION,
        title,
        version,
        commit: stamp.commit.clone(),
        entities,
        tables: tables.collect(),
    }
}

fn entity(project: &Project, id: ItemId, item: &Item) -> Entity {
    let names = |list: &[TypeUse]| list.iter().map(|use_| use_.text.clone()).collect();
    let docs = &project.docs;
    let entry = docs.item(id);
    let variables = item.variables.iter().enumerate().filter(|(_, variable)| variable.section.is_interface());
    Entity {
        kind: item.kind.key().to_owned(),
        name: project.catalogue.qualified_name(id),
        owner: item.parent.map_or_else(String::new, |parent| project.catalogue.qualified_name(parent)),
        access: access(project, id).name().to_owned(),
        is_abstract: item.is_abstract
            || item.parent.is_some_and(|p| project.catalogue.item(p).kind.key() == "interface"),
        is_final: item.is_final,
        extends: names(&item.extends),
        implements: names(&item.implements),
        type_: item.type_.as_ref().map_or_else(String::new, |use_| use_.text.clone()),
        variables: variables
            .map(|(index, variable)| Variable {
                section: variable.section.key().to_owned(),
                name: variable.name.clone(),
                type_: variable.type_.as_ref().map_or_else(String::new, |use_| use_.text.clone()),
                initial: variable.initial.clone().unwrap_or_default(),
                constant: variable.constant,
                doc: docs.variable(id, index).and_then(|entry| doc(project, entry)),
            })
            .collect(),
        brief: entry.doc.as_ref().map_or_else(String::new, |doc| doc.brief_text()),
        doc: doc(project, entry),
    }
}

/// The narrower of an item's access and its owners'.
fn access(project: &Project, id: ItemId) -> Access {
    let item = project.catalogue.item(id);
    item.parent.map_or(item.access, |parent| item.access.max(access(project, parent)))
}

/// The digest of the comments, without layout and without the tables in them; none for inherited documentation.
fn doc(project: &Project, entry: &Entry) -> Option<Digest> {
    let doc = entry.doc.as_ref().filter(|_| entry.inherited_from.is_none())?;
    let mut words = Vec::new();
    for place in &doc.places {
        let text = &project.files.get(place.file).text;
        let mut from = place.span.start;
        let inside = |table: &&TableText| table.place.file == place.file && place.span.contains(table.place.span);
        for table in doc.tables.iter().filter(inside) {
            words.extend(Span::new(from, table.place.span.start).of(text).split_whitespace());
            from = table.place.span.end;
        }
        words.extend(Span::new(from, place.span.end).of(text).split_whitespace());
    }
    Some(Digest::of_parts(words))
}

fn table(project: &Project, attached: &AttachedTable, record: &Record) -> Table {
    let table = &attached.table;
    let layout = layout::layout(table);
    let mut facts = Vec::new();
    if let Some(cycle) = table.options.cycle {
        facts.push(("cycle time".to_owned(), time_text(cycle.nanos)));
    }
    facts.push(("conformance".to_owned(), if table.options.strict { "strict" } else { "weak" }.to_owned()));
    facts.extend(layout.constants.iter().chain(&layout.globals).cloned());
    let brackets = layout.brackets.iter().map(|bracket| {
        let rows = [bracket.first, bracket.last].map(|row| layout.rows.get(row).map_or("", |row| row.id.as_str()));
        (format!("rows {} to {}", rows[0], rows[1]), duration(&bracket.label))
    });
    facts.extend(brackets);
    let group = |head: &layout::Head| if head.kind.is_assumption() { "in" } else { "out" };
    Table {
        block: attached.item.map_or_else(String::new, |item| project.catalogue.qualified_name(item)),
        name: table.name.clone(),
        facts,
        columns: layout.columns.iter().map(|head| (group(head).to_owned(), head.name.clone())).collect(),
        rows: layout
            .rows
            .iter()
            .map(|line| Row {
                id: line.id.clone(),
                cells: line.cells.iter().map(|cell| cell.text.clone()).collect(),
                duration: duration(&line.duration),
                remark: line.remark.clone(),
            })
            .collect(),
        verdict: record.verdict.word().to_owned(),
    }
}

fn duration(text: &DurationText) -> String {
    if text.progress { format!("{} p", text.text) } else { text.text.clone() }
}
