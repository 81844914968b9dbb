//! Walks trees and unwraps vendor files; the only reader of the disk beside `cli/`.
//!
//! [`read_tree`] turns a [`FileSystem`] into a [`Tree`]: the table of files, a [`Unit`] for every file
//! that holds program text, the projects that name them, the table files beside them, and a list of
//! whatever else lay there, with the reason why it was left alone. Nothing is lost without a word.
//!
//! The way of a file: `walk` finds it, `read` decodes it and asks the [`formats`] which of them claims it,
//! the format takes the container off, and `membership` says which project it belongs to. A format
//! sees one file and its [`Setting`] (what lies around it); it knows neither paths on the disk nor other files.
//!
//! [`Unit`]: crate::text::Unit
//! [`Setting`]: formats::Setting

pub mod codes;
pub mod disk;
pub mod file_system;
pub mod formats;
mod fragment;
mod membership;
pub mod memory;
mod note;
pub mod options;
pub mod paths;
pub mod projects;
mod read;
pub mod tree;
mod walk;
mod xml;

pub use disk::Disk;
pub use file_system::{Entry, EntryKind, Failure, FileSystem};
pub use memory::Memory;
pub use options::{BadGlob, Filter, Options, Progress};
pub use projects::{LibraryReference, Member, Project, ProjectKind};
pub use read::read_tree;
pub use tree::{Skipped, TableFile, Tree};
