//! # A test table has no verdict
//!
//! The table is shown in the manual as part of the specification, and nobody has proven that the block
//! conforms to it. A reader must not take it for a fact.
//!
//! ```st
//! (* A toggle.
//!
//!    @gtt Toggles
//!    | # | in Set | out Q | dur |
//!    |---|--------|-------|-----|
//!    | 1 | F      | F     | -   |
//!    | 2 | T      | T     | 1   | *)
//! FUNCTION_BLOCK FB_Toggle
//! ```
//!
//! ## What to do
//!
//! Prove it, or set `unverified-table = "off"` under `[audit.rules]` while the tables are still being
//! written.

use crate::audit::{Context, Rule};
use crate::diagnostic::{Code, Finding, Severity};

/// The code.
pub static CODE: Code =
    Code { name: "unverified-table", severity: Severity::Warning, page: include_str!("unverified_table.rs") };

/// The rule.
pub const RULE: Rule = Rule { code: &CODE, default: true, check };

fn check(context: &Context<'_>, out: &mut Vec<Finding>) {
    for table in context.tables {
        let message = format!("test table `{}` is unverified", table.table.name);
        out.push(Finding::new(&CODE, table.table.place, message));
    }
}
