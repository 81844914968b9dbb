//! What a release offers, as plain data: interfaces, documentation, tables with their verdicts. A bundle carries one, so
//! that two releases can be compared without reading either's sources again.

use serde::{Deserialize, Serialize};

use super::digest::{Digest, canonical};

/// The version of the format.
pub const VERSION: u32 = 1;

/// Its path in a bundle.
pub const PATH: &str = "snapshot.json";

/// What a release offers.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Snapshot {
    /// [`VERSION`].
    pub snapshot_version: u32,
    /// The title of the release.
    pub title: String,
    /// Its version; empty if unknown.
    pub version: String,
    /// Its commit; empty if unknown.
    pub commit: String,
    /// Its entities, members included.
    pub entities: Vec<Entity>,
    /// Its test tables.
    pub tables: Vec<Table>,
}

/// An entity or a member of one.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entity {
    /// The key of its kind.
    pub kind: String,
    /// Its qualified name.
    pub name: String,
    /// The qualified name of what it stands in; empty at the top.
    pub owner: String,
    /// `public`, `internal`, `protected` or `private`; for a member the narrower of its own and its owner's.
    pub access: String,
    /// `ABSTRACT`.
    pub is_abstract: bool,
    /// `FINAL`.
    pub is_final: bool,
    /// What it extends.
    pub extends: Vec<String>,
    /// What it implements.
    pub implements: Vec<String>,
    /// Return type, property type, aliased type or base type; empty if it has none.
    #[serde(rename = "type")]
    pub type_: String,
    /// The variables of its interface, in order.
    pub variables: Vec<Variable>,
    /// The first line of its documentation; empty if it has none.
    pub brief: String,
    /// The digest of its documentation; absent if it has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub doc: Option<Digest>,
}

/// A variable, field or value.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variable {
    /// The key of its section.
    pub section: String,
    /// Its name.
    pub name: String,
    /// Its type with white space folded; empty for a value of an enumeration.
    #[serde(rename = "type")]
    pub type_: String,
    /// Its initial value as written; empty if it has none.
    pub initial: String,
    /// `CONSTANT`.
    pub constant: bool,
    /// The digest of its documentation; absent if it has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub doc: Option<Digest>,
}

/// A test table as it is printed.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// The qualified name of its block; empty if it has none.
    pub block: String,
    /// Its name.
    pub name: String,
    /// Cycle time, constants, global variables, options: name and value.
    pub facts: Vec<(String, String)>,
    /// Its columns: `in` or `out`, and the header.
    pub columns: Vec<(String, String)>,
    /// Its rows.
    pub rows: Vec<Row>,
    /// The word of its verdict.
    pub verdict: String,
}

/// A row.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// Number or name.
    pub id: String,
    /// What holds in each column; a blank cell has the text of the one above.
    pub cells: Vec<String>,
    /// The duration.
    pub duration: String,
    /// The remark.
    pub remark: String,
}

impl Snapshot {
    /// Its bytes.
    #[must_use]
    pub fn bytes(&self) -> Vec<u8> {
        canonical(self)
    }

    /// Reads what [`Snapshot::bytes`] wrote.
    ///
    /// # Errors
    /// If it is no snapshot of this version.
    pub fn parse(bytes: &[u8]) -> Result<Self, String> {
        let snapshot: Self = serde_json::from_slice(bytes).map_err(|error| error.to_string())?;
        if snapshot.snapshot_version != VERSION {
            return Err(format!("the snapshot has version {}; this tool reads {VERSION}", snapshot.snapshot_version));
        }
        Ok(snapshot)
    }
}
