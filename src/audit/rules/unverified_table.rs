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
//! `rungbook verify` decides it; the verdict is kept in the store, and `build` and `check` know it from then on. A block or
//! table that has changed since makes it *stale*. Or set `unverified-table = "off"` under `[audit.rules]` while the tables are still being
//! written.

use crate::audit::{Context, Rule};
use crate::diagnostic::{Code, Finding, Severity};
use crate::evidence::record::Verdict;

/// The code.
pub static CODE: Code =
    Code { name: "unverified-table", severity: Severity::Warning, page: include_str!("unverified_table.rs") };

/// The rule.
pub const RULE: Rule = Rule { code: &CODE, default: true, check };

fn check(context: &Context<'_>, out: &mut Vec<Finding>) {
    for (index, table) in context.tables.iter().enumerate() {
        let verdict = context.answers.get(index).map_or(&Verdict::Unverified, |answer| &answer.verdict);
        if matches!(verdict, Verdict::Verified | Verdict::Violated) {
            continue;
        }
        let message = format!("test table `{}` is {}", table.table.name, verdict.word());
        let finding = Finding::new(&CODE, table.table.place, message);
        let detail = verdict.detail();
        out.push(if detail.is_empty() { finding } else { finding.help(detail) });
    }
}
