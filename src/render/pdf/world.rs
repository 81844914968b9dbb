//! What the typesetter sees: fonts, templates and data, all in memory.

use std::collections::BTreeMap;

use typst::diag::{FileError, FileResult, SourceDiagnostic};
use typst::foundations::{Bytes, Datetime, Duration};
use typst::syntax::{FileId, RootedPath, Source, VirtualPath, VirtualRoot};
use typst::text::{Font, FontBook};
use typst::utils::LazyHash;
use typst::{Library, LibraryExt, World, WorldExt};
use typst_kit::files::{FileLoader, FileStore};

use super::fonts::Fonts;
use super::{Options, templates};

/// Files in memory, by path below the root.
struct Memory(BTreeMap<String, Bytes>);

impl FileLoader for Memory {
    fn load(&self, id: FileId) -> FileResult<Bytes> {
        let path = id.get().vpath().get_without_slash();
        let project = matches!(id.get().root(), VirtualRoot::Project);
        let found = self.0.get(path).filter(|_| project);
        found.cloned().ok_or_else(|| FileError::NotFound(path.into()))
    }
}

/// The world of a manual.
pub(super) struct Manual {
    library: LazyHash<Library>,
    fonts: Fonts,
    files: FileStore<Memory>,
    main: FileId,
    today: Option<Datetime>,
}

impl Manual {
    pub(super) fn new(options: &Options, fonts: Fonts, data: Vec<(&'static str, Vec<u8>)>) -> Self {
        let templates = templates::files(&options.templates).into_iter();
        let data = data.into_iter().map(|(name, bytes)| (name.to_owned(), bytes));
        let attached = options.attachments.iter().enumerate();
        let attached = attached.map(|(n, attachment)| (format!("attachments/{n}"), attachment.bytes.clone()));
        let files = templates.chain(data).chain(attached).map(|(name, bytes)| (name, Bytes::new(bytes))).collect();
        Self {
            library: LazyHash::new(Library::default()),
            fonts,
            files: FileStore::new(Memory(files)),
            main: main_id(),
            today: options.date.and_then(super::Date::datetime),
        }
    }

    /// Messages of the typesetter, each with its place and its hints.
    pub(super) fn describe_all(&self, list: &[SourceDiagnostic]) -> Vec<String> {
        list.iter().map(|each| self.describe(each)).collect()
    }

    fn describe(&self, diagnostic: &SourceDiagnostic) -> String {
        let mut out = match self.place(diagnostic) {
            Some(place) => format!("{place}: {}", diagnostic.message),
            None => diagnostic.message.to_string(),
        };
        for hint in &diagnostic.hints {
            out.push_str(&format!(" ({})", hint.v));
        }
        out
    }

    /// File and line of a message.
    fn place(&self, diagnostic: &SourceDiagnostic) -> Option<String> {
        let id = diagnostic.span.id()?;
        let start = self.range(diagnostic.span)?.start;
        let line = self.source(id).ok()?.lines().byte_to_line(start)?;
        Some(format!("{}:{}", id.get().vpath().get_without_slash(), line + 1))
    }
}

/// The main template's id.
fn main_id() -> FileId {
    let path = VirtualPath::new(templates::MAIN).expect("the name of the main template is a plain path");
    FileId::new(RootedPath::new(VirtualRoot::Project, path))
}

impl World for Manual {
    fn library(&self) -> &LazyHash<Library> {
        &self.library
    }

    fn book(&self) -> &LazyHash<FontBook> {
        self.fonts.store.book()
    }

    fn main(&self) -> FileId {
        self.main
    }

    fn source(&self, id: FileId) -> FileResult<Source> {
        self.files.source(id)
    }

    fn file(&self, id: FileId) -> FileResult<Bytes> {
        self.files.file(id)
    }

    fn font(&self, index: usize) -> Option<Font> {
        self.fonts.store.font(index)
    }

    fn today(&self, _offset: Option<Duration>) -> Option<Datetime> {
        self.today
    }
}
