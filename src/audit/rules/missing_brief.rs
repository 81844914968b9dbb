//! # The documentation has no brief description
//!
//! A comment documents this entity, and it begins with a list, a table, code, a heading or tags:
//! there is no first line to show in lists and in the search.
//!
//! ```st
//! (* @param Extend extend while true *)
//! FUNCTION_BLOCK FB_Cylinder
//! ```
//!
//! ## What to do
//!
//! Begin with one line that says what it is.
//!
//! ```st
//! (* A single-acting pneumatic cylinder.
//!
//!    @param Extend extend while true *)
//! FUNCTION_BLOCK FB_Cylinder
//! ```

use crate::audit::{Context, Rule};
use crate::diagnostic::{Code, Finding, Severity};

/// The code.
pub static CODE: Code =
    Code { name: "missing-brief", severity: Severity::Warning, page: include_str!("missing_brief.rs") };

/// The rule.
pub const RULE: Rule = Rule { code: &CODE, default: true, check };

fn check(context: &Context<'_>, out: &mut Vec<Finding>) {
    for (id, item, entry) in context.described() {
        let Some(doc) = entry.doc.as_ref().filter(|_| entry.inherited_from.is_none()) else { continue };
        if doc.brief.is_empty() && context.is_public(id) {
            let message = format!("the documentation of `{}` has no brief description", item.name);
            out.push(
                Finding::new(&CODE, doc.place().unwrap_or(item.place), message)
                    .help("begin it with one line that says what it is"),
            );
        }
    }
}
