//! The manifest: every file of a bundle, what part of the evidence it is, its size and its digest.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::evidence::digest::{Digest, canonical};

/// The version of the layout.
pub const VERSION: u32 = 1;

/// Its path in a bundle.
pub const PATH: &str = "manifest.json";

/// The manifest.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// [`VERSION`].
    pub bundle_version: u32,
    /// The title of what is released.
    pub title: String,
    /// Its version; empty if unknown.
    pub version: String,
    /// The tool that made the bundle.
    pub tool: String,
    /// The commit of the sources; empty if unknown.
    pub commit: String,
    /// The date of the stamp.
    pub date: String,
    /// Who made the bundle; empty if unknown.
    pub author: String,
    /// Whether the sources are in the bundle, or their digests only.
    pub sources: bool,
    /// The files, by path.
    pub files: BTreeMap<String, File>,
}

/// A file of a bundle.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    /// Its size in bytes.
    pub size: u64,
    /// Its digest.
    pub sha256: Digest,
}

impl File {
    /// Of these bytes.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        Self { size: bytes.len() as u64, sha256: Digest::of(bytes) }
    }
}

impl Manifest {
    /// Its bytes.
    #[must_use]
    pub fn bytes(&self) -> Vec<u8> {
        canonical(self)
    }

    /// Reads what [`Manifest::bytes`] wrote.
    ///
    /// # Errors
    /// If it is no manifest of this version, or not in the canonical form.
    pub fn parse(bytes: &[u8]) -> Result<Self, String> {
        let manifest: Self = serde_json::from_slice(bytes).map_err(|error| error.to_string())?;
        if manifest.bundle_version != VERSION {
            return Err(format!("the bundle has version {}; this tool reads {VERSION}", manifest.bundle_version));
        }
        if manifest.bytes() != bytes {
            return Err("it is not in the canonical form".to_owned());
        }
        Ok(manifest)
    }
}
