//! The store of records on the disk.
#![expect(clippy::disallowed_methods, reason = "cli reads and writes the store")]

use std::fs;
use std::path::{Path, PathBuf};

use super::{Failure, write};
use crate::config::Settings;
use crate::evidence::cache;
use crate::evidence::record::{Answer, Record};
use crate::pipeline::{Project, Stamp, records};
use crate::source::{Disk, FileSystem};

/// A store.
pub(crate) struct Store {
    root: PathBuf,
}

impl Store {
    /// The store of the tree `dir`, as configured.
    pub(crate) fn new(dir: &Path, settings: &Settings) -> Self {
        Self { root: dir.join(&settings.evidence.store) }
    }

    /// The bytes at `path` below it.
    pub(crate) fn read(&self, path: &str) -> Option<Vec<u8>> {
        fs::read(self.root.join(path)).ok()
    }

    /// What it knows of a claim.
    pub(crate) fn answer(&self, claim: &crate::evidence::record::Claim) -> Answer {
        cache::answer(claim, cache::lookup(claim, &|path| self.read(path)))
    }

    /// Keeps an answer, if it is worth keeping.
    ///
    /// # Errors
    /// If the disk refuses.
    pub(crate) fn keep(&self, record: &Record, answer: &Answer) -> Result<(), Failure> {
        if !cache::keeps(&record.verdict) {
            return Ok(());
        }
        for (path, bytes) in cache::entries(record, answer.artefact.as_ref()) {
            write::file(&self.root.join(path), &bytes)?;
        }
        Ok(())
    }
}

/// The record and answer of every table of `project`, as far as the store knows them.
pub(crate) fn known(
    dir: &Path,
    project: &Project,
    settings: &Settings,
    stamp: &Stamp,
) -> Result<Vec<(Record, Answer)>, Failure> {
    let fs = Disk::new(dir).map_err(|error| Failure(format!("`{}`: {error}", dir.display())))?;
    Ok(known_of(&fs, dir, project, settings, stamp))
}

/// The same for a project that was read from `fs`; the store is that of the folder `dir`.
pub(crate) fn known_of(
    fs: &dyn FileSystem,
    dir: &Path,
    project: &Project,
    settings: &Settings,
    stamp: &Stamp,
) -> Vec<(Record, Answer)> {
    let store = Store::new(dir, settings);
    let mut answer = |claim: &_, _: &_| cache::answer(claim, cache::lookup(claim, &|path| store.read(path)));
    let mut records = records::records(project, fs, stamp, &mut answer);
    // What an engine took differs from run to run; where bytes have to be reproducible it is not told.
    if std::env::var_os("SOURCE_DATE_EPOCH").is_some() {
        records.iter_mut().for_each(|(record, _)| record.effort = None);
    }
    records
}
