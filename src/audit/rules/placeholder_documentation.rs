//! # The documentation is a placeholder
//!
//! The comment is what an editor or a template puts there (`TODO: Add your comment here`), or it only
//! repeats the name. It is not counted as documentation.
//!
//! ```st
//! // TODO: Add your comment here
//! FUNCTION_BLOCK FB_Cylinder
//! ```
//!
//! ## What to do
//!
//! Say what it is for, what it needs, and what it does in a case of error; or take the comment out.
//!
//! ```st
//! // A single-acting pneumatic cylinder with one end switch.
//! FUNCTION_BLOCK FB_Cylinder
//! ```

use crate::audit::{Context, Rule};
use crate::diagnostic::{Code, Finding, Severity};

/// The code.
pub static CODE: Code = Code {
    name: "placeholder-documentation",
    severity: Severity::Warning,
    page: include_str!("placeholder_documentation.rs"),
};

/// The rule.
pub const RULE: Rule = Rule { code: &CODE, default: true, check };

fn check(context: &Context<'_>, out: &mut Vec<Finding>) {
    let help = "say what it is for, or take the comment out";
    for (id, item, entry) in context.described() {
        if let Some(place) = entry.placeholder {
            let message = format!("the documentation of `{}` is a placeholder", context.catalogue.qualified_name(id));
            out.push(Finding::new(&CODE, place, message).help(help));
        }
        for (i, variable) in item.variables.iter().enumerate() {
            if let Some(place) = context.variable(id, i).placeholder {
                let message = format!("the documentation of `{}` is a placeholder", variable.name);
                out.push(Finding::new(&CODE, place, message).help(help));
            }
        }
    }
}
