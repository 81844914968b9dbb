//! What of a tree is read, and what is told while it is.

use std::fmt;

use ignore::gitignore::{Gitignore, GitignoreBuilder};

/// How a tree is read.
#[derive(Clone, Debug)]
pub struct Options {
    /// Which paths are looked at.
    pub filter: Filter,
    /// The folder that the manual is written to, seen from the root; it is not read.
    pub output: Option<String>,
    /// Files with more bytes are a finding and are not read.
    pub max_file_size: u64,
}

impl Default for Options {
    fn default() -> Self {
        Self { filter: Filter::default(), output: None, max_file_size: 128 << 20 }
    }
}

/// How far the reading has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// So many files lie in the tree.
    Walked(usize),
    /// One more of `total` files is read and unwrapped.
    Read {
        /// The number of files that will be read.
        total: usize,
    },
}

/// Globs that choose paths, in the syntax of `.gitignore` files: `*.st`, `/generated/`, `**/old/**`.
#[derive(Clone, Debug, Default)]
pub struct Filter {
    include: Option<Gitignore>,
    exclude: Option<Gitignore>,
}

/// A glob that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadGlob {
    /// The glob.
    pub glob: String,
    /// What is wrong with it.
    pub reason: String,
}

impl fmt::Display for BadGlob {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the glob `{}` cannot be read: {}", self.glob, self.reason)
    }
}

impl std::error::Error for BadGlob {}

impl Filter {
    /// Paths that match one of `include` (any path, where it is empty) and none of `exclude`.
    ///
    /// # Errors
    /// If a glob cannot be read.
    pub fn new(include: &[String], exclude: &[String]) -> Result<Self, BadGlob> {
        Ok(Self { include: matcher(include)?, exclude: matcher(exclude)? })
    }

    /// Whether the file at `path` is chosen.
    #[must_use]
    pub fn takes_file(&self, path: &str) -> bool {
        let included =
            self.include.as_ref().is_none_or(|globs| globs.matched_path_or_any_parents(path, false).is_ignore());
        let excluded =
            self.exclude.as_ref().is_some_and(|globs| globs.matched_path_or_any_parents(path, false).is_ignore());
        included && !excluded
    }

    /// Whether anything below the folder at `path` can be chosen.
    #[must_use]
    pub fn enters_folder(&self, path: &str) -> bool {
        !self.exclude.as_ref().is_some_and(|globs| globs.matched(path, true).is_ignore())
    }
}

fn matcher(globs: &[String]) -> Result<Option<Gitignore>, BadGlob> {
    if globs.is_empty() {
        return Ok(None);
    }
    let mut builder = GitignoreBuilder::new("");
    for glob in globs {
        builder.add_line(None, glob).map_err(|error| bad(glob, &error))?;
    }
    builder.build().map(Some).map_err(|error| bad(&globs.join(" "), &error))
}

fn bad(glob: &str, error: &ignore::Error) -> BadGlob {
    BadGlob { glob: glob.to_owned(), reason: error.to_string() }
}
