//! Format-neutral pages, addresses, the search index, and the views that templates see.
//!
//! A [`view::Book`] holds everything that a manual shows, with every link resolved and every total
//! counted once; the renderers only lay it out.

mod build;
pub mod model;
pub mod view;

pub use build::{Input, Narrative, build};
