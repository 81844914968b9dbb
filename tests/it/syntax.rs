//! Tests of `syntax`.

mod access;
mod properties;
mod recovery;
mod zoo;
