//! The book as the templates read it.
//!
//! Values are built from the views, then arranged by library, folder and page run, given their column
//! widths, made printable, and freed of links that lead nowhere. The templates can so set what they get
//! without looking anything up.

mod clean;
mod labels;
mod runs;

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::{Map, Value, json};

use super::fonts::{Fonts, Printable};
use super::{Error, Options, Parts, plan};
use crate::book::view::Book;
use crate::book::view::entity::EntityView;
use clean::Cleaner;
use labels::Labels;

/// What the templates read.
pub(super) struct Data {
    /// Name and bytes of each file.
    pub(super) files: Vec<(&'static str, Vec<u8>)>,
    /// Characters that no font has and how often each was replaced.
    pub(super) replaced: BTreeMap<char, usize>,
}

/// Prepares a book.
pub(super) fn build(book: &Book, options: &Options, fonts: &Fonts) -> Result<Data, Error> {
    let labels = Labels::of(book, options.parts);
    let mut cleaner = Cleaner::new(Printable::new(fonts), labels);
    let space = plan::Space::of(options.paper);
    let mut entities = Vec::with_capacity(book.entities.len());
    for entity in &book.entities {
        let mut value = cleaned(&mut cleaner, entity_value(entity, options.parts, space)?);
        fit(&mut value);
        entities.push(value);
    }
    let rest = cleaned(&mut cleaner, rest(book, options.parts)?);
    let mut rest = fields(rest);
    cleaner.labels.mark(&mut rest, &mut entities);
    runs::arrange(&mut rest, book, entities);
    let files = vec![
        ("data/book.json", bytes(&Value::Object(rest))?),
        ("data/options.json", bytes(&settings(book, options, space))?),
    ];
    Ok(Data { files, replaced: cleaner.printable.replaced })
}

/// Cleans a value.
fn cleaned(cleaner: &mut Cleaner<'_>, mut value: Value) -> Value {
    cleaner.clean(&mut value);
    value
}

/// Everything but the entities.
fn rest(book: &Book, parts: Parts) -> Result<Value, Error> {
    let none = || Value::Array(Vec::new());
    let chapters = if parts.chapters { value(&book.chapters)? } else { none() };
    let findings = if parts.findings { value(&book.findings)? } else { none() };
    let mut coverage = value(&book.coverage)?;
    if !parts.holes
        && let Some(list) = coverage.get_mut("undocumented")
    {
        *list = none();
    }
    let entry = |entry: &crate::book::view::IndexEntry| json!({ "name": entry.name, "kind_label": entry.kind_label, "context": entry.context, "place": entry.label });
    let index: Vec<Value> = if parts.index { book.index.iter().map(entry).collect() } else { Vec::new() };
    Ok(json!({
        "front": value(&book.front)?,
        "totals": value(&book.totals)?,
        "chapters": chapters,
        "libraries": value(&book.libraries)?,
        "coverage": coverage,
        "findings": findings,
        "codes": value(&book.codes)?,
        "readings": value(&book.readings)?,
        "skipped": value(&book.skipped)?,
        "externals": value(&book.externals)?,
        "index": index,
    }))
}

/// An entity with what is printed of it, and with its column widths.
fn entity_value(entity: &EntityView, parts: Parts, space: plan::Space) -> Result<Value, Error> {
    let mut out = fields(value(entity)?);
    out.remove("findings");
    if !parts.sources {
        out.remove("sources");
    }
    for source in array(&mut out, "sources") {
        if let Value::Object(source) = source {
            source.remove("runs");
            source.remove("links");
        }
    }
    sections(&mut out, &entity.core.sections, parts, space);
    for (member, view) in array(&mut out, "members").iter_mut().zip(&entity.members) {
        if let Value::Object(member) = member {
            sections(member, &view.core.sections, parts, space);
        }
    }
    if parts.tables {
        for (table, view) in array(&mut out, "tables").iter_mut().zip(&entity.tables) {
            if let Value::Object(table) = table {
                table.insert("plan".to_owned(), plan::table(view, space));
            }
        }
    } else {
        out.insert("tables".to_owned(), json!([]));
    }
    Ok(Value::Object(out))
}

/// Adds column widths to the sections and takes out those that are not printed.
fn sections(
    owner: &mut Map<String, Value>,
    views: &[crate::book::view::entity::SectionView],
    parts: Parts,
    space: plan::Space,
) {
    let list = std::mem::take(array(owner, "sections"));
    let kept = list.into_iter().zip(views).filter(|(_, view)| view.public || parts.internals);
    *array(owner, "sections") = kept
        .map(|(mut value, view)| {
            if let Value::Object(section) = &mut value {
                section.insert("columns".to_owned(), plan::section(view, space));
            }
            value
        })
        .collect();
}

/// Lets long words be broken where their columns ask for it.
fn fit(entity: &mut Value) {
    let Value::Object(entity) = entity else { return };
    array(entity, "tables").iter_mut().for_each(plan::fit_table);
    array(entity, "sections").iter_mut().for_each(plan::fit_section);
    for member in array(entity, "members") {
        if let Value::Object(member) = member {
            array(member, "sections").iter_mut().for_each(plan::fit_section);
        }
    }
}

/// What the templates need to know of the options.
fn settings(book: &Book, options: &Options, space: plan::Space) -> Value {
    json!({
        "paper": options.paper.name(),
        "language": language(&book.front.language),
        "text_fonts": options.text_fonts,
        "mono_fonts": options.mono_fonts,
        "margin": plan::MARGIN,
        "width": space.portrait,
        "height": space.height,
        "attachments": options.attachments.iter().enumerate().map(|(n, attachment)| json!({
            "path": attachment.path,
            "file": format!("/attachments/{n}"),
            "mime": attachment.mime,
        })).collect::<Vec<_>>(),
        "parts": {
            "chapters": options.parts.chapters,
            "internals": options.parts.internals,
            "tables": options.parts.tables,
            "sources": options.parts.sources,
            "coverage": options.parts.coverage,
            "holes": options.parts.holes,
            "findings": options.parts.findings,
            "index": options.parts.index,
        },
    })
}

/// The first part of a language tag; English where it is none.
fn language(tag: &str) -> String {
    let first = tag.split('-').next().unwrap_or_default().to_ascii_lowercase();
    let valid = (2..=3).contains(&first.len()) && first.bytes().all(|byte| byte.is_ascii_lowercase());
    if valid { first } else { "en".to_owned() }
}

/// The list in a field; an absent one is made.
fn array<'a>(object: &'a mut Map<String, Value>, key: &str) -> &'a mut Vec<Value> {
    let value = object.entry(key).or_insert_with(|| Value::Array(Vec::new()));
    if !value.is_array() {
        *value = Value::Array(Vec::new());
    }
    value.as_array_mut().expect("it was made a list one line above")
}

/// The fields of a value that serialises to an object.
fn fields(value: Value) -> Map<String, Value> {
    match value {
        Value::Object(map) => map,
        _ => Map::new(),
    }
}

/// A view as a value.
fn value(view: &impl Serialize) -> Result<Value, Error> {
    serde_json::to_value(view).map_err(|error| Error::Data(error.to_string()))
}

/// A value as bytes.
fn bytes(value: &Value) -> Result<Vec<u8>, Error> {
    serde_json::to_vec(value).map_err(|error| Error::Data(error.to_string()))
}
