//! rungbook turns a PLC source tree (IEC 61131-3) into a reference manual with its test tables: a site and a PDF.
//!
//! # The way of the data
//!
//! ```text
//! tree of files ─ source ─▶ units ─ syntax ─▶ trees ─ library ─▶ the resolved library
//!                                                       │
//!                  docs (what the comments say) ◀───────┤
//!                  table (test tables, bound) ◀─────────┤
//!                  machine (transition system) ◀────────┘
//!                         │
//!          prove ─▶ verdicts, certificates, runs ─▶ recheck ─▶ evidence
//!                         │
//!   audit (findings) ─────┤
//!                         ▼
//!   figure ─▶ book (pages, addresses, search, views) ─▶ render/html · render/pdf ─▶ bytes
//! ```
//!
//! `logic` (terms, graphs, solvers) and `semantics` (what types and operators mean) stand below tables and machine, so that a
//! cell and a statement cannot mean different things.
//!
//! It flows one way; nothing calls back. Each room's own module doc says what it is for and what
//! it leaves to others; `tests/it/tidy.rs` holds which room may import which, and fails on an
//! arrow that is not listed. Nothing is re-exported here, so that every edge can be seen.

pub mod audit;
pub mod book;
pub mod cli;
pub mod config;
pub mod diagnostic;
pub mod docs;
pub mod evidence;
pub mod figure;
pub mod library;
pub mod logic;
pub mod machine;
pub mod pipeline;
pub mod prove;
pub mod recheck;
pub mod render;
pub mod semantics;
pub mod source;
pub mod syntax;
pub mod table;
pub mod text;
