//! The ways in which people write documentation, one file each.
//!
//! Each reader turns the clean text of a chunk into a [`Draft`]: Markdown and tags, still with the
//! way back to the file. Which reader fits is found out from the text itself unless a profile says
//! it; several chunks add to one draft, each read by its own convention.

mod draft;
pub(super) mod file_header;
mod javadoc;
mod neuron;
pub(super) mod oscat;
mod rst;
mod tag_names;
mod xml;

use super::comment::Marker;
use super::mapped::Mapped;
use super::model::Convention;

pub(super) use draft::{Draft, Part};
pub(super) use neuron::description;

/// Reads `text` into `draft`, and says by which convention.
pub(super) fn read(text: &Mapped, marker: Marker, profile: Option<Convention>, draft: &mut Draft) -> Convention {
    let convention = profile.unwrap_or_else(|| detect(text, marker));
    match convention {
        Convention::Markdown | Convention::Neuron => javadoc::read_plain(text, draft),
        Convention::Javadoc => javadoc::read(text, draft),
        Convention::Xml => read_xml(text, draft),
        Convention::Te1030 => read_xml(&xml::cross_references(text), draft),
        Convention::LibDoc | Convention::Plcdoc => rst::read(text, draft),
        Convention::Oscat => oscat::read(text, draft),
        Convention::FileHeader => file_header::read(text, draft),
    }
    convention
}

/// Elements; text that is not well-formed is text, in which tags still count.
fn read_xml(text: &Mapped, draft: &mut Draft) {
    if !xml::read(text, draft) {
        javadoc::read(text, draft);
    }
}

/// The convention that `text` is written in.
fn detect(text: &Mapped, marker: Marker) -> Convention {
    let source = text.as_str();
    if marker == Marker::Bang {
        Convention::Te1030
    } else if xml::is_used(source) {
        Convention::Xml
    } else if oscat::is_used(source) {
        Convention::Oscat
    } else if file_header::is_used(source) {
        Convention::FileHeader
    } else if rst::has_typed_fields(source) {
        Convention::Plcdoc
    } else if rst::is_used(source) {
        Convention::LibDoc
    } else if javadoc::is_used(source) {
        Convention::Javadoc
    } else {
        Convention::Markdown
    }
}
