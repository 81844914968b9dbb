//! The book as one PDF, set by typst in process.
//!
//! The templates under `templates/pdf/` are code of this project (or of the user, who may replace any of
//! them); the book reaches them as JSON and so stays data: no text of a source tree is ever parsed as
//! markup. Everything that is cheaper or safer outside the typesetter happens in [`data`] before it
//! starts: links to places that are not printed are taken out, characters that no font has are replaced and counted, column
//! widths are planned, prose that nests too deeply is flattened. The templates avoid queries and states per entity; running
//! headers are plain text of a page run, and runs are laid out in parallel.

mod data;
mod error;
mod fonts;
mod options;
mod plan;
mod templates;
mod world;

use std::collections::BTreeMap;

use typst_layout::PagedDocument;
use typst_pdf::{PdfOptions, PdfStandards};

use crate::book::view::Book;

pub use error::Error;
pub use options::{Attachment, Date, Options, Paper, Parts, Standard};
pub use templates::EMBEDDED;

/// A finished manual.
#[derive(Clone, Debug)]
pub struct Output {
    /// The PDF.
    pub bytes: Vec<u8>,
    /// How many pages it has.
    pub pages: usize,
    /// What the typesetter warned of; empty unless a template or a font is amiss.
    pub warnings: Vec<String>,
    /// Characters that no font has and how often each was replaced.
    pub replaced: BTreeMap<char, usize>,
}

/// Sets a book as PDF.
///
/// # Errors
///
/// A font that cannot be read, a standard that does not exist, or a template that fails.
pub fn render(book: &Book, options: &Options) -> Result<Output, Error> {
    let fonts = fonts::Fonts::new(&options.fonts)?;
    let data = data::build(book, options, &fonts)?;
    let world = world::Manual::new(options, fonts, data.files);
    let result = typeset(&world, options);
    // What was memoised belongs to this book; the next one shares little with it.
    typst::comemo::evict(0);
    let (bytes, pages, warnings) = result?;
    Ok(Output { bytes, pages, warnings, replaced: data.replaced })
}

/// Lays out and exports.
fn typeset(world: &world::Manual, options: &Options) -> Result<(Vec<u8>, usize, Vec<String>), Error> {
    let compiled = typst::compile::<PagedDocument>(world);
    let warnings = world.describe_all(&compiled.warnings);
    let document = compiled.output.map_err(|list| Error::Template(world.describe_all(&list)))?;
    let bytes =
        typst_pdf::pdf(&document, &export(options)?).map_err(|list| Error::Export(world.describe_all(&list)))?;
    Ok((bytes, document.pages().len(), warnings))
}

/// The options of the export.
fn export(options: &Options) -> Result<PdfOptions, Error> {
    let standards =
        PdfStandards::new(options.standard.list()).map_err(|error| Error::Standard(error.message().to_string()))?;
    Ok(PdfOptions {
        creator: typst::foundations::Smart::Custom(Some(options.creator.clone())),
        timestamp: options.date.and_then(Date::timestamp),
        tagged: options.tagged || options.standard.needs_tags(),
        standards,
        ..PdfOptions::default()
    })
}
