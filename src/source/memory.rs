//! A tree of files in memory, for tests and for whoever has the bytes already.

use std::collections::{BTreeMap, BTreeSet};

use super::{Entry, EntryKind, Failure, FileSystem};

/// Files by path; the folders follow from the paths.
#[derive(Clone, Debug, Default)]
pub struct Memory {
    files: BTreeMap<String, Vec<u8>>,
    odd: BTreeMap<String, EntryKind>,
    denied: BTreeMap<String, String>,
}

impl Memory {
    /// An empty tree.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// With a file of `bytes` at `path`.
    #[must_use]
    pub fn with(mut self, path: &str, bytes: impl AsRef<[u8]>) -> Self {
        self.files.insert(path.to_owned(), bytes.as_ref().to_vec());
        self
    }

    /// With something at `path` that is neither a file nor a folder.
    #[must_use]
    pub fn with_entry(mut self, path: &str, kind: EntryKind) -> Self {
        self.odd.insert(path.to_owned(), kind);
        self
    }

    /// With a file at `path` that is listed and then cannot be read, or a folder that cannot be listed.
    #[must_use]
    pub fn denying(mut self, path: &str, reason: &str) -> Self {
        self.denied.insert(path.to_owned(), reason.to_owned());
        self
    }
}

impl FileSystem for Memory {
    fn entries(&self, folder: &str) -> Result<Vec<Entry>, Failure> {
        if let Some(reason) = self.denied.get(folder) {
            return Err(Failure::Denied(reason.clone()));
        }
        let below = |path: &str| -> Option<String> {
            let rest = if folder.is_empty() { path } else { path.strip_prefix(folder)?.strip_prefix('/')? };
            Some(rest.to_owned())
        };
        let mut folders = BTreeSet::new();
        let mut entries = Vec::new();
        let files = self.files.iter().map(|(path, bytes)| (path, EntryKind::File(bytes.len() as u64)));
        let odd = self.odd.iter().map(|(path, kind)| (path, kind.clone()));
        for (path, kind) in files.chain(odd) {
            let Some(rest) = below(path) else { continue };
            match rest.split_once('/') {
                None => entries.push(Entry { name: rest, kind }),
                Some((name, _)) if folders.insert(name.to_owned()) => {
                    entries.push(Entry { name: name.to_owned(), kind: EntryKind::Folder });
                }
                Some(_) => {}
            }
        }
        Ok(entries)
    }

    fn read(&self, path: &str, limit: u64) -> Result<Vec<u8>, Failure> {
        if let Some(reason) = self.denied.get(path) {
            return Err(Failure::Denied(reason.clone()));
        }
        let bytes = self.files.get(path).ok_or_else(|| Failure::Denied("entity not found".to_owned()))?;
        if bytes.len() as u64 > limit {
            return Err(Failure::TooLarge);
        }
        Ok(bytes.clone())
    }
}
