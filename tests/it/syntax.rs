//! Tests of `syntax`.

mod access;
mod properties;
mod recovery;
pub(crate) mod zoo;
