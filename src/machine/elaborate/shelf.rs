//! A library that the tool brings along: the standard blocks, and the stubs of the configuration.

use std::sync::OnceLock;

use crate::library::names::Names;
use crate::library::{Catalogue, Library, LibraryId, lower, resolve};
use crate::text::{Body, Encoding, Files, Fragment, Object, ObjectKind, Span, Unit, Vendor};

/// A catalogue with its names.
#[derive(Debug)]
pub(super) struct Shelf {
    /// What it declares.
    pub(super) catalogue: Catalogue,
    /// What names mean in it.
    pub(super) names: Names,
    /// What is wrong with its text, in the order of the texts.
    pub(super) faults: Vec<String>,
}

/// The standard blocks, parsed once.
pub(super) fn standard() -> &'static Shelf {
    static SHELF: OnceLock<Shelf> = OnceLock::new();
    let own = std::iter::once(("library", include_str!("library.st")));
    SHELF.get_or_init(|| Shelf::parse(crate::machine::standard::SOURCES.iter().copied().chain(own)))
}

impl Shelf {
    /// The library that these texts declare, each with the name of its file.
    pub(super) fn parse<'a>(texts: impl Iterator<Item = (&'a str, &'a str)>) -> Self {
        let mut files = Files::default();
        let mut units = Vec::new();
        for (path, text) in texts {
            let file = files.add(path, text, Encoding::Utf8);
            let mut object = Object::new(ObjectKind::Text, None, Span::at(0));
            object.declaration = Some(Fragment::verbatim(text, 0));
            object.body = Body::None;
            let (format, vendor) = ("text", Vendor::Standard);
            units.push(Unit { file, format, vendor, nested_comments: None, project: None, objects: vec![object] });
        }
        let library = LibraryId(0);
        let units: Vec<(&Unit, LibraryId)> = units.iter().map(|unit| (unit, library)).collect();
        let libraries = vec![Library { name: "standard".to_owned(), ..Library::default() }];
        let lowered = lower::units(&units, libraries, &files, &|_| {});
        let mut catalogue = lowered.catalogue;
        let names = resolve::resolve(&mut catalogue);
        let faults = lowered.findings.into_iter().map(|finding| finding.message).collect();
        Self { catalogue, names, faults }
    }
}
