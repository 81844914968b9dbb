//! Integration tests, one module a room.

mod cli;
mod corpora;
mod docs;
mod html;
mod model;
#[cfg(feature = "pdf")]
mod pdf;
mod rules;
mod source;
mod support;
mod syntax;
mod table;
mod tidy;
