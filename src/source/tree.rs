//! What a tree of files holds, read and unwrapped.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use super::paths;
use super::projects::Project;
use crate::diagnostic::{Code, Finding};
use crate::text::{FileId, Files, Unit};

/// A tree of files, unwrapped.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    /// Every file that was read, and every one that should have been, ordered by path.
    pub files: Files,
    /// One for every file that holds program text, ordered by path.
    pub units: Vec<Unit>,
    /// The projects that name files, ordered by path.
    pub projects: Vec<Project>,
    /// The files of test tables, ordered by path.
    pub tables: Vec<TableFile>,
    /// What was left alone, and why, ordered by path; the path of a folder ends in `/`.
    pub skipped: Vec<Skipped>,
    /// What is wrong with the tree, ordered by place.
    pub findings: Vec<Finding>,
}

impl Tree {
    /// How many files were skipped, by reason and by extension (in lower case, empty for none).
    #[must_use]
    pub fn skipped_counts(&self) -> BTreeMap<(&str, String), usize> {
        let mut counts = BTreeMap::new();
        for skipped in &self.skipped {
            *counts.entry((skipped.reason.as_ref(), paths::extension(&skipped.path))).or_insert(0) += 1;
        }
        counts
    }
}

/// A file or folder that was left alone.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Skipped {
    /// Its path below the root.
    pub path: String,
    /// Why; a few words.
    pub reason: Cow<'static, str>,
    /// The finding that tells of it, if there is one.
    pub code: Option<&'static Code>,
}

/// A file of test tables.
#[derive(Clone, Debug)]
pub struct TableFile {
    /// The file; its text is empty if it is a spreadsheet.
    pub file: FileId,
    /// Its path below the root.
    pub path: String,
    /// Its bytes.
    pub bytes: Arc<[u8]>,
}
