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
/// What a spreadsheet left open.
pub static TABLE_IMPORT_GUESS: Code =
    Code { name: "table-import-guess", severity: Severity::Info, page: include_str!("pages/table-import-guess.md") };

/// A spreadsheet cell that cannot be trusted.
pub static TABLE_IMPORT_REFUSED: Code = Code {
    name: "table-import-refused",
    severity: Severity::Error,
    page: include_str!("pages/table-import-refused.md"),
};

/// A row at the end that is never checked.
pub static TABLE_NEVER_CHECKED: Code = Code {
    name: "table-never-checked",
    severity: Severity::Warning,
    page: include_str!("pages/table-never-checked.md"),
};

/// A row that no run reaches.
pub static TABLE_NEVER_REACHED: Code = Code {
    name: "table-never-reached",
    severity: Severity::Warning,
    page: include_str!("pages/table-never-reached.md"),
};

/// Strict conformance to a table without an end.
pub static TABLE_NEVER_STRICT: Code =
    Code { name: "table-never-strict", severity: Severity::Warning, page: include_str!("pages/table-never-strict.md") };

/// A table that may be over before it begins.
pub static TABLE_EMPTY_RUN: Code =
    Code { name: "table-empty-run", severity: Severity::Warning, page: include_str!("pages/table-empty-run.md") };

/// A global variable that is used once.
pub static TABLE_GLOBAL_ONCE: Code =
    Code { name: "table-global-once", severity: Severity::Warning, page: include_str!("pages/table-global-once.md") };

/// A Boolean that may be meant as a condition.
pub static TABLE_AMBIGUOUS_BOOLEAN: Code = Code {
    name: "table-ambiguous-boolean",
    severity: Severity::Warning,
    page: include_str!("pages/table-ambiguous-boolean.md"),
};

/// A column that is never constrained.
pub static TABLE_FREE_COLUMN: Code =
    Code { name: "table-free-column", severity: Severity::Warning, page: include_str!("pages/table-free-column.md") };

/// A value from before the run.
pub static TABLE_EARLY_PAST: Code =
    Code { name: "table-early-past", severity: Severity::Warning, page: include_str!("pages/table-early-past.md") };

/// Blank cells that repeat the one above.
pub static TABLE_BLANK_REPEATS: Code =
    Code { name: "table-blank-repeats", severity: Severity::Info, page: include_str!("pages/table-blank-repeats.md") };

/// A name in a cell or a header that nothing has.
pub static TABLE_UNKNOWN_NAME: Code =
    Code { name: "table-unknown-name", severity: Severity::Error, page: include_str!("pages/table-unknown-name.md") };

/// A cell whose type is not that of its column.
pub static TABLE_TYPE: Code =
    Code { name: "table-type", severity: Severity::Error, page: include_str!("pages/table-type.md") };

/// A header that declares another type than the variable has.
pub static TABLE_DECLARED_TYPE: Code = Code {
    name: "table-declared-type",
    severity: Severity::Warning,
    page: include_str!("pages/table-declared-type.md"),
};

/// A column that assumes what the unit does, or asserts what its environment does.
pub static TABLE_DIRECTION: Code =
    Code { name: "table-direction", severity: Severity::Warning, page: include_str!("pages/table-direction.md") };

/// Cells that no values satisfy.
pub static TABLE_CONTRADICTION: Code = Code {
    name: "table-contradiction",
    severity: Severity::Warning,
    page: include_str!("pages/table-contradiction.md"),
};

/// A table that no inputs satisfy.
pub static TABLE_NO_INPUT: Code =
    Code { name: "table-no-input", severity: Severity::Warning, page: include_str!("pages/table-no-input.md") };

/// Rows that may follow the same row and admit the same inputs.
pub static TABLE_OVERLAP: Code =
    Code { name: "table-overlap", severity: Severity::Info, page: include_str!("pages/table-overlap.md") };

/// All codes of the room.
pub static ALL: &[&Code] = &[
    &TABLE_CONTRADICTION,
    &TABLE_NO_INPUT,
    &TABLE_OVERLAP,
    &TABLE_UNKNOWN_NAME,
    &TABLE_TYPE,
    &TABLE_DECLARED_TYPE,
    &TABLE_DIRECTION,
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
    &TABLE_IMPORT_GUESS,
    &TABLE_IMPORT_REFUSED,
    &TABLE_NEVER_CHECKED,
    &TABLE_NEVER_REACHED,
    &TABLE_NEVER_STRICT,
    &TABLE_EMPTY_RUN,
    &TABLE_GLOBAL_ONCE,
    &TABLE_AMBIGUOUS_BOOLEAN,
    &TABLE_FREE_COLUMN,
    &TABLE_EARLY_PAST,
    &TABLE_BLANK_REPEATS,
];
