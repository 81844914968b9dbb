//! Findings as pages see them.

use serde::Serialize;

/// One finding.
#[derive(Clone, Debug, Serialize)]
pub struct FindingView {
    /// The code's name.
    pub code: String,
    /// `error`, `warning` or `info`.
    pub severity: &'static str,
    /// The message.
    pub message: String,
    /// File below the tree's root.
    pub file: String,
    /// Line, from 1.
    pub line: u32,
    /// Column, from 1.
    pub column: u32,
    /// What would help.
    pub help: Vec<String>,
}

/// How often a code was found.
#[derive(Clone, Debug, Serialize)]
pub struct CodeCount {
    /// The code's name.
    pub code: String,
    /// What it means: the title of its page.
    pub title: String,
    /// `error`, `warning` or `info`.
    pub severity: &'static str,
    /// How often.
    pub count: usize,
}

/// How files were read: some of it follows from what lies around them, or was guessed.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct ReadingView {
    /// The format that they were taken for.
    pub format: String,
    /// Their encoding.
    pub encoding: String,
    /// Whether comments nest, as far as the format or the file says so: `yes`, `no`, `as each object says`, or `open`.
    pub comments_nest: &'static str,
    /// How many files.
    pub files: usize,
}

/// A file that is not in the manual.
#[derive(Clone, Debug, Serialize)]
pub struct SkippedView {
    /// File below the tree's root.
    pub file: String,
    /// Why.
    pub reason: String,
}
