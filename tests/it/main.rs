//! Integration tests, one module a room.
#![allow(clippy::disallowed_methods, reason = "tests write and read files of their own")]
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "tests report what they measured or skipped")]

mod archival;
mod cli;
mod corpora;
mod docs;
mod elaborate;
mod evidence;
mod exhaustive;
mod fuzz;
mod geteta;
mod hostile;
mod html;
mod library;
mod logic;
mod machine;
mod model;
#[cfg(feature = "pdf")]
mod pdf;
mod prove;
mod recheck;
mod rules;
mod source;
mod support;
mod syntax;
mod table;
mod tidy;
mod totals;
mod translate;
mod verify;
mod zoo;
