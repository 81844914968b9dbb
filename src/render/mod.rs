//! Book to bytes: renderers lay out what a [`crate::book::view::Book`] holds and return the files; only `cli/` writes.
//!
//! [`theme`] holds the embedded templates and style files, each of which a user's file of the same name replaces.

pub mod html;
#[cfg(feature = "pdf")]
pub mod pdf;
pub mod theme;
