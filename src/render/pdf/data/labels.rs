//! Which places of the book can be linked to, and which labels are worth printing.
//!
//! Each label costs the typesetter a tracked element, so those of variables are printed only where a
//! link leads to them. A label that two places claim belongs to the first.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Map, Value};

use super::super::Parts;
use super::array;
use crate::book::view::Book;
use crate::book::view::entity::CoreView;

/// The labels of a book.
#[derive(Default)]
pub(super) struct Labels {
    /// From a label to the one that is printed for it: itself, or its owner's where it is not printed.
    known: BTreeMap<String, String>,
    /// The labels that some link leads to.
    used: BTreeSet<String>,
}

impl Labels {
    /// Collects the labels of what is printed.
    pub(super) fn of(book: &Book, parts: Parts) -> Self {
        let mut out = Self::default();
        if parts.chapters {
            book.chapters.iter().for_each(|chapter| out.define(&chapter.label, &chapter.label));
        }
        book.libraries.iter().for_each(|library| out.define(&library.label, &library.label));
        for entity in book.entities.iter().filter(|entity| entity.library < book.libraries.len()) {
            out.define_core(&entity.core, parts);
            entity.members.iter().for_each(|member| out.define_core(&member.core, parts));
            for table in &entity.tables {
                let target = if parts.tables { &table.label } else { &entity.core.label };
                out.define(&table.label, target);
            }
        }
        out
    }

    fn define_core(&mut self, core: &CoreView, parts: Parts) {
        self.define(&core.label, &core.label);
        for section in &core.sections {
            for variable in &section.variables {
                let printed = section.public || parts.internals;
                self.define(&variable.label, if printed { &variable.label } else { &core.label });
            }
        }
    }

    fn define(&mut self, label: &str, target: &str) {
        if !label.is_empty() && !target.is_empty() && !self.known.contains_key(label) {
            self.known.insert(label.to_owned(), target.to_owned());
        }
    }

    /// The label that is printed for a label; `None` if there is no such place.
    pub(super) fn resolve(&mut self, label: &str) -> Option<String> {
        let target = self.known.get(label)?.clone();
        self.used.insert(target.clone());
        Some(target)
    }

    /// Takes out the labels that are not to be printed.
    pub(super) fn mark(&self, rest: &mut Map<String, Value>, entities: &mut [Value]) {
        let mut printed = BTreeSet::new();
        for key in ["chapters", "libraries"] {
            array(rest, key).iter_mut().for_each(|each| self.keep(each, &mut printed, false));
        }
        for entity in entities {
            self.mark_core(entity, &mut printed);
            let Value::Object(entity) = entity else { continue };
            array(entity, "members").iter_mut().for_each(|member| self.mark_core(member, &mut printed));
            array(entity, "tables").iter_mut().for_each(|table| self.keep(table, &mut printed, false));
        }
    }

    fn mark_core(&self, core: &mut Value, printed: &mut BTreeSet<String>) {
        self.keep(core, printed, false);
        let Value::Object(core) = core else { return };
        for section in array(core, "sections") {
            let Value::Object(section) = section else { continue };
            array(section, "variables").iter_mut().for_each(|variable| self.keep(variable, printed, true));
        }
    }

    /// Keeps a label that is the first of its kind, and used if it has to be.
    fn keep(&self, value: &mut Value, printed: &mut BTreeSet<String>, only_used: bool) {
        let Value::Object(object) = value else { return };
        let label = object.get("label").and_then(Value::as_str).unwrap_or_default().to_owned();
        let wanted = !label.is_empty() && (!only_used || self.used.contains(&label));
        if !(wanted && printed.insert(label)) {
            object.insert("label".to_owned(), Value::Null);
        }
    }
}
