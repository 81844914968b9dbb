//! A table and the block that it specifies.

use super::Table;
use crate::library::ItemId;

/// A table, with its block if that is known.
#[derive(Clone, Debug)]
pub struct AttachedTable {
    /// The table.
    pub table: Table,
    /// The block or program that it specifies.
    pub item: Option<ItemId>,
    /// The messages of the errors in it.
    pub errors: Vec<TableError>,
    /// The table bound to its block, where it could be read and its block is known.
    pub bound: Option<super::bind::BoundTable>,
}

/// An error in a table, as its page shows it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableError {
    /// The finding's message.
    pub message: String,
    /// Where.
    pub place: crate::text::Place,
}
