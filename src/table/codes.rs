//! The kinds of finding that the room gives.

use crate::diagnostic::{Code, Severity};

/// A table that cannot be read as one.
pub static TABLE_SYNTAX: Code =
    Code { name: "table-syntax", severity: Severity::Error, page: include_str!("pages/table-syntax.md") };

/// A cell that cannot be read.
pub static TABLE_CELL: Code =
    Code { name: "table-cell", severity: Severity::Error, page: include_str!("pages/table-cell.md") };

/// A cell that asks for the future.
pub static TABLE_FUTURE_REFERENCE: Code = Code {
    name: "table-future-reference",
    severity: Severity::Error,
    page: include_str!("pages/table-future-reference.md"),
};

/// A duration that cannot be read or counted.
pub static TABLE_DURATION: Code =
    Code { name: "table-duration", severity: Severity::Error, page: include_str!("pages/table-duration.md") };

/// A time where the length of a cycle is not known.
pub static TABLE_CYCLE_TIME: Code =
    Code { name: "table-cycle-time", severity: Severity::Warning, page: include_str!("pages/table-cycle-time.md") };

/// A column that is no column of the table.
pub static TABLE_COLUMN: Code =
    Code { name: "table-column", severity: Severity::Error, page: include_str!("pages/table-column.md") };

/// A name that is taken, or that nothing has.
pub static TABLE_NAME: Code =
    Code { name: "table-name", severity: Severity::Error, page: include_str!("pages/table-name.md") };

/// Blocks that do not close.
pub static TABLE_BLOCK: Code =
    Code { name: "table-block", severity: Severity::Error, page: include_str!("pages/table-block.md") };

/// A spelling of an earlier version.
pub static TABLE_OLD_SPELLING: Code =
    Code { name: "table-old-spelling", severity: Severity::Info, page: include_str!("pages/table-old-spelling.md") };

/// A part of the language that is read and has no meaning here.
pub static TABLE_UNSUPPORTED: Code =
    Code { name: "table-unsupported", severity: Severity::Warning, page: include_str!("pages/table-unsupported.md") };

/// A table whose block nothing names.
pub static UNATTACHED_TABLE: Code =
    Code { name: "unattached-table", severity: Severity::Warning, page: include_str!("pages/unattached-table.md") };

/// A `@gtt` path that leads to no table.
pub static MISSING_TABLE_FILE: Code =
    Code { name: "missing-table-file", severity: Severity::Warning, page: include_str!("pages/missing-table-file.md") };

/// All codes of the room.
pub static ALL: &[&Code] = &[
    &TABLE_SYNTAX,
    &TABLE_CELL,
    &TABLE_FUTURE_REFERENCE,
    &TABLE_DURATION,
    &TABLE_CYCLE_TIME,
    &TABLE_COLUMN,
    &TABLE_NAME,
    &TABLE_BLOCK,
    &TABLE_OLD_SPELLING,
    &TABLE_UNSUPPORTED,
    &UNATTACHED_TABLE,
    &MISSING_TABLE_FILE,
];
