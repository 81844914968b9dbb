//! Entry points for fuzzing: bytes in, a panic where a promise is broken.
//!
//! `tests/it/fuzz.rs` runs the same functions on the seeds and on what was found.

#![allow(missing_docs, reason = "the module says what its functions are")]

#[path = "../../it/html/crawl.rs"]
mod crawl;
pub mod targets;
