//! The kinds of findings that reading a text gives.

use crate::diagnostic::{Code, Severity};

/// Something that cannot be read as any construct; it was skipped.
pub static UNREADABLE_CONSTRUCT: Code = Code {
    name: "unreadable-construct",
    severity: Severity::Error,
    page: include_str!("pages/unreadable-construct.md"),
};

/// A construct that is never closed.
pub static MISSING_END: Code =
    Code { name: "missing-end", severity: Severity::Error, page: include_str!("pages/missing-end.md") };

/// A statement or declaration without its `;`; it was read as if it had one.
pub static MISSING_SEMICOLON: Code =
    Code { name: "missing-semicolon", severity: Severity::Warning, page: include_str!("pages/missing-semicolon.md") };

/// An operator of another language; it was read as the one that it stands for.
pub static FOREIGN_OPERATOR: Code =
    Code { name: "foreign-operator", severity: Severity::Warning, page: include_str!("pages/foreign-operator.md") };

/// A comment that holds the beginning of another one, where nothing says whether comments nest.
pub static COMMENT_NESTING_GUESSED: Code = Code {
    name: "comment-nesting-guessed",
    severity: Severity::Info,
    page: include_str!("pages/comment-nesting-guessed.md"),
};

/// A comment or pragma that is never closed.
pub static UNTERMINATED_COMMENT: Code = Code {
    name: "unterminated-comment",
    severity: Severity::Error,
    page: include_str!("pages/unterminated-comment.md"),
};

/// A string without its closing quote.
pub static UNTERMINATED_STRING: Code =
    Code { name: "unterminated-string", severity: Severity::Error, page: include_str!("pages/unterminated-string.md") };

/// Nesting beyond what is followed.
pub static NESTING_TOO_DEEP: Code =
    Code { name: "nesting-too-deep", severity: Severity::Error, page: include_str!("pages/nesting-too-deep.md") };

/// All codes of this room.
pub static ALL: &[&Code] = &[
    &UNREADABLE_CONSTRUCT,
    &MISSING_END,
    &MISSING_SEMICOLON,
    &FOREIGN_OPERATOR,
    &COMMENT_NESTING_GUESSED,
    &UNTERMINATED_COMMENT,
    &UNTERMINATED_STRING,
    &NESTING_TOO_DEEP,
];
