//! Two releases compared: interfaces by the rules of CODESYS, documentation, tables cell by cell, evidence.

pub mod interface;
pub mod tables;
pub mod types;

use std::collections::BTreeMap;

use serde::Serialize;

use super::snapshot::{Entity, Snapshot};
use interface::Change;
use tables::TableChange;

/// The difference between two releases.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Comparison {
    /// The older one.
    pub old: Release,
    /// The newer one.
    pub new: Release,
    /// What changed for users of the interfaces, by entity.
    pub interface: Vec<Change>,
    /// What changed in the documentation.
    pub documentation: Vec<DocChange>,
    /// What changed in tables.
    pub tables: Vec<TableChange>,
    /// Tables that were verified and are not any more.
    pub lost: Vec<Lost>,
    /// The least step of the version that these changes ask for.
    pub advice: Step,
}

/// Names a release.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Release {
    /// Its title.
    pub title: String,
    /// Its version; empty if unknown.
    pub version: String,
    /// Its commit; empty if unknown.
    pub commit: String,
}

/// A step of a version, as Semantic Versioning 2.0.0 has it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Step {
    /// Nothing that users can tell.
    #[default]
    Patch,
    /// More than before, and all of before.
    Minor,
    /// Something that worked may not work any more.
    Major,
}

impl Step {
    /// The word.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Patch => "patch",
            Self::Minor => "minor",
            Self::Major => "major",
        }
    }
}

/// A change of documentation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct DocChange {
    /// The entity, or the variable in it.
    pub name: String,
    /// `added`, `removed` or `changed`.
    pub what: &'static str,
    /// The first line as it was; empty for a variable.
    pub old: String,
    /// The first line as it is.
    pub new: String,
}

/// Evidence that was lost.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Lost {
    /// The block.
    pub block: String,
    /// The table.
    pub table: String,
    /// The word of its verdict now, or `removed`.
    pub now: String,
}

impl Comparison {
    /// How many changes may break a user.
    #[must_use]
    pub fn breaking(&self) -> usize {
        self.interface.iter().filter(|change| change.breaking).count()
    }

    /// Whether nothing changed.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.interface.is_empty() && self.documentation.is_empty() && self.tables.is_empty() && self.lost.is_empty()
    }
}

/// Compares two releases.
#[must_use]
pub fn compare(old: &Snapshot, new: &Snapshot) -> Comparison {
    let interface = interface::compare(old, new);
    let tables = tables::compare(old, new);
    let lost = lost(old, new);
    // A block that has been proven to conform and does not, or of which that is not promised any more, breaks its users.
    let is_broken = |lost: &Lost| lost.now == "violated" || lost.now == "removed";
    let advice = if interface.iter().any(|change| change.breaking) || lost.iter().any(is_broken) {
        Step::Major
    } else if !interface.is_empty() || !tables.is_empty() || !lost.is_empty() {
        Step::Minor
    } else {
        Step::Patch
    };
    Comparison {
        old: release(old),
        new: release(new),
        documentation: documentation(old, new),
        lost,
        interface,
        tables,
        advice,
    }
}

fn release(of: &Snapshot) -> Release {
    Release { title: of.title.clone(), version: of.version.clone(), commit: of.commit.clone() }
}

/// Names are not case-sensitive.
pub(super) fn fold(name: &str) -> String {
    name.to_uppercase()
}

pub(super) fn by_name(snapshot: &Snapshot) -> BTreeMap<String, &Entity> {
    snapshot.entities.iter().map(|entity| (fold(&entity.name), entity)).collect()
}

/// Changes of documentation, of what is in both releases.
fn documentation(old: &Snapshot, new: &Snapshot) -> Vec<DocChange> {
    let before = by_name(old);
    let mut out = Vec::new();
    let mut push = |name: String, was: Option<_>, is: Option<_>, briefs: (&str, &str)| {
        let what = match (was, is) {
            (None, Some(_)) => "added",
            (Some(_), None) => "removed",
            (Some(a), Some(b)) if a != b => "changed",
            _ => return,
        };
        out.push(DocChange { name, what, old: briefs.0.to_owned(), new: briefs.1.to_owned() });
    };
    for entity in &new.entities {
        let Some(was) = before.get(&fold(&entity.name)) else { continue };
        push(entity.name.clone(), was.doc, entity.doc, (&was.brief, &entity.brief));
        for variable in &entity.variables {
            let same = was.variables.iter().find(|other| fold(&other.name) == fold(&variable.name));
            if let Some(same) = same {
                push(format!("{}.{}", entity.name, variable.name), same.doc, variable.doc, ("", ""));
            }
        }
    }
    out
}

/// Tables that were verified and are not.
fn lost(old: &Snapshot, new: &Snapshot) -> Vec<Lost> {
    let verified = old.tables.iter().filter(|table| table.verdict == "verified");
    let lost = verified.filter_map(|table| {
        let same = |other: &&super::snapshot::Table| tables::key(other) == tables::key(table);
        let now = new.tables.iter().find(same).map_or("removed", |table| table.verdict.as_str());
        let lost = Lost { block: table.block.clone(), table: table.name.clone(), now: now.to_owned() };
        (now != "verified").then_some(lost)
    });
    lost.collect()
}
