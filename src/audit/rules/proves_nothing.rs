//! # A verified table proves nothing
//!
//! The block conforms to the table, and so would any other: no run reaches a row of the table, or no row that a run
//! reaches says anything about an output, or the table may be over before it begins. The verdict is true and worthless; it must not
//! be counted as evidence.
//!
//! ```st
//! (* A lamp.
//!
//!    @gtt Follows the switch
//!    | # | in Switch | out Lamp | dur |
//!    |---|-----------|----------|-----|
//!    | 1 | T         | -        | 1   | *)
//! FUNCTION_BLOCK FB_Lamp
//! VAR_INPUT Switch : BOOL; END_VAR
//! VAR_OUTPUT Lamp : BOOL; END_VAR
//! Lamp := Switch;
//! END_FUNCTION_BLOCK
//! ```
//!
//! ## What to do
//!
//! Say in the output cells what the block has to do, here `T` below `Lamp`. Where no row is reached, look for input cells that
//! exclude each other, or for a global variable that no value satisfies. `rungbook verify` lists what is not covered.

use crate::audit::{Context, Rule};
use crate::diagnostic::{Code, Finding, Severity};
use crate::evidence::record::Verdict;

/// The code.
pub static CODE: Code =
    Code { name: "proves-nothing", severity: Severity::Warning, page: include_str!("proves_nothing.rs") };

/// The rule.
pub const RULE: Rule = Rule { code: &CODE, default: true, check };

fn check(context: &Context<'_>, out: &mut Vec<Finding>) {
    for (table, answer) in context.tables.iter().zip(context.answers) {
        let Some(coverage) = answer.coverage.as_ref().filter(|_| answer.verdict == Verdict::Verified) else { continue };
        for reason in &coverage.vacuous {
            let message = format!("test table `{}` is verified and proves nothing: {reason}", table.table.name);
            out.push(Finding::new(&CODE, table.table.place, message));
        }
    }
}
