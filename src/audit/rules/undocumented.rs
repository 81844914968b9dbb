//! # A public entity has no documentation
//!
//! A function block, function, program, interface, type or list of globals that other people can use
//! has no comment that says what it is for. The page of such an entity shows only its signature.
//!
//! Entities that are `INTERNAL` are not reported. Methods, properties and variables have a rule
//! of their own, `undocumented-member`.
//!
//! ```st
//! FUNCTION_BLOCK FB_Cylinder
//! VAR_INPUT
//!     Extend : BOOL;
//! END_VAR
//! ```
//!
//! ## What to do
//!
//! Put a comment above the header, directly below it, or after the last `END_VAR`. Its first line is
//! the brief description.
//!
//! ```st
//! (* A single-acting pneumatic cylinder with one end switch.
//!
//!    Extends while `Extend` is true; a spring takes it back. *)
//! FUNCTION_BLOCK FB_Cylinder
//! ```

use crate::audit::{Context, Rule};
use crate::diagnostic::{Code, Finding, Severity};
use crate::library::ItemKind;

/// The code.
pub static CODE: Code =
    Code { name: "undocumented", severity: Severity::Warning, page: include_str!("undocumented.rs") };

/// The rule.
pub const RULE: Rule = Rule { code: &CODE, default: true, check };

fn check(context: &Context<'_>, out: &mut Vec<Finding>) {
    for (id, item, entry) in context.described() {
        let missing = entry.doc.is_none() && entry.placeholder.is_none();
        let task = item.kind == ItemKind::Task;
        if item.parent.is_none() && !task && missing && context.is_public(id) {
            let message = format!("{} `{}` has no documentation", item.kind.label().to_lowercase(), item.name);
            let help = "put a comment above its header, directly below it, or after its last `END_VAR`";
            out.push(Finding::new(&CODE, item.place, message).help(help));
        }
    }
}
