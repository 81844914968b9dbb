//! # A function block has no test table
//!
//! A public, concrete function block has no test table, so nothing about its behaviour can be verified.
//! This rule is off unless `rungbook.toml` switches it on:
//!
//! ```toml
//! [audit.rules]
//! block-without-table = "warning"
//! ```
//!
//! ## What to do
//!
//! Put a `@gtt` table into the block's comment, or a file of the same stem beside it (`FB_Cylinder.gtt`).

use crate::audit::{Context, Rule};
use crate::diagnostic::{Code, Finding, Severity};
use crate::library::ItemKind;

/// The code.
pub static CODE: Code =
    Code { name: "block-without-table", severity: Severity::Warning, page: include_str!("block_without_table.rs") };

/// The rule.
pub const RULE: Rule = Rule { code: &CODE, default: false, check };

fn check(context: &Context<'_>, out: &mut Vec<Finding>) {
    for (id, item, _) in context.described() {
        let concrete = item.kind == ItemKind::FunctionBlock && !item.is_abstract;
        let tested = || context.tables.iter().any(|table| table.item == Some(id));
        if concrete && context.is_public(id) && !tested() {
            let message = format!("function block `{}` has no test table", item.name);
            out.push(Finding::new(&CODE, item.place, message));
        }
    }
}
