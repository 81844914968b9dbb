//! Comments to structured prose, tags and links.
//!
//! The library says which comments stand where; this room says what they mean. For each item and
//! each variable of the catalogue it
//!
//! 1. cuts the comments into chunks and takes delimiters, gutters and boxes off ([`comment`]),
//! 2. sets aside what is never documentation: licences, revision histories, commented-out code,
//!    separators, placeholders ([`judge`]),
//! 3. chooses among the places where documentation may stand ([`placement`]),
//! 4. cuts out test tables ([`tables`]) and reads the rest by the convention that it is written in
//!    ([`conventions`]) into Markdown and tags,
//! 5. and reads the Markdown into blocks whose links are resolved ([`markdown`], [`links`]).
//!
//! Every step keeps the way back to the file, so that a broken link, a parameter that does not
//! exist and the cell of a table have exact places. What was set aside, and why, stays in
//! [`Entry::considered`]. This room gives no findings: it gives facts, and `audit/` judges them.

mod comment;
mod conventions;
mod inherit;
mod judge;
mod links;
mod mapped;
mod markdown;
pub mod model;
mod narrative;
pub mod options;
mod placement;
pub mod prose;
mod read;
mod tables;

pub use model::{
    Considered, Convention, Docs, Documentation, Entry, Fact, ParamTag, Reason, TableText, Tag, Tags, Verdict,
};
pub use narrative::Narrator;
pub use options::Options;
pub use prose::{Align, Block, Inline, LinkTarget, ListItem};
pub use read::read;

#[cfg(test)]
mod tests;
