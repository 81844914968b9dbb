//! # A test table is violated
//!
//! There is a run in which the block does not do what the table demands. The manual shows it beside the table, cycle by cycle;
//! it was played again on the interpreter.
//!
//! ```st
//! (* A lamp.
//!
//!    @gtt Follows the switch
//!    | # | in Switch | out Lamp | dur |
//!    |---|-----------|----------|-----|
//!    | 1 | T         | T        | 1   | *)
//! FUNCTION_BLOCK FB_Lamp
//! VAR_INPUT Switch : BOOL; END_VAR
//! VAR_OUTPUT Lamp : BOOL; END_VAR
//! Lamp := NOT Switch;
//! END_FUNCTION_BLOCK
//! ```
//!
//! ## What to do
//!
//! Mend the block, or the table: the failing cell is marked, with what was expected and seen. Then run `rungbook verify` again.

use crate::audit::{Context, Rule};
use crate::diagnostic::{Code, Finding, Severity};
use crate::evidence::record::Verdict;

/// The code.
pub static CODE: Code =
    Code { name: "violated-table", severity: Severity::Error, page: include_str!("violated_table.rs") };

/// The rule.
pub const RULE: Rule = Rule { code: &CODE, default: true, check };

fn check(context: &Context<'_>, out: &mut Vec<Finding>) {
    for (table, answer) in context.tables.iter().zip(context.answers) {
        if answer.verdict == Verdict::Violated {
            let message = format!("test table `{}` is violated", table.table.name);
            out.push(Finding::new(&CODE, table.table.place, message));
        }
    }
}
