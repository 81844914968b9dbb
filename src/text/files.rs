//! The table of files that a run has seen.

use std::sync::Arc;

use super::{Encoding, LineColumn, LineIndex, Place};

/// Names a file in [`Files`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FileId(pub u32);

/// One file: its path below the root, its decoded text, and its lines.
#[derive(Clone, Debug)]
pub struct SourceFile {
    /// Path below the root of the tree, with `/` between its parts.
    pub path: String,
    /// The decoded text; empty for a file that could not be read.
    pub text: Arc<str>,
    /// How the bytes were read.
    pub encoding: Encoding,
    /// Where the lines begin.
    pub lines: LineIndex,
}

/// All files of a run, in the order in which they were added.
#[derive(Clone, Debug, Default)]
pub struct Files {
    files: Vec<SourceFile>,
}

impl Files {
    /// Adds a file and gives its name in this table.
    pub fn add(&mut self, path: impl Into<String>, text: impl Into<Arc<str>>, encoding: Encoding) -> FileId {
        let text = text.into();
        let lines = LineIndex::new(&text);
        let id = FileId(u32::try_from(self.files.len()).unwrap_or(u32::MAX));
        self.files.push(SourceFile { path: path.into(), text, encoding, lines });
        id
    }

    /// The file that `id` names.
    ///
    /// # Panics
    /// If `id` comes from another table.
    #[must_use]
    pub fn get(&self, id: FileId) -> &SourceFile {
        &self.files[id.0 as usize]
    }

    /// All files with their names.
    pub fn iter(&self) -> impl Iterator<Item = (FileId, &SourceFile)> {
        self.files.iter().enumerate().map(|(i, f)| (FileId(u32::try_from(i).unwrap_or(u32::MAX)), f))
    }

    /// The number of files.
    #[must_use]
    pub fn len(&self) -> usize {
        self.files.len()
    }

    /// Whether there is no file.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.files.is_empty()
    }

    /// Line and column at which `place` begins.
    #[must_use]
    pub fn line_column(&self, place: Place) -> LineColumn {
        let file = self.get(place.file);
        file.lines.line_column(&file.text, place.span.start)
    }

    /// The text at `place`.
    #[must_use]
    pub fn text(&self, place: Place) -> &str {
        place.span.of(&self.get(place.file).text)
    }
}
