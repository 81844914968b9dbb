//! # A link in prose leads nowhere
//!
//! A comment links to an entity or a member that the tree does not have. It is shown as plain text.
//!
//! In brackets, `[FB_Cylinder]` and `[FB_Cylinder.Extend]` are links; `[mm]` and `[1..5]` are not:
//! what stands in brackets is taken for a link if it names something, holds an underscore or a dot
//! between two names, or stands in backticks as well.
//!
//! ```st
//! (* Moves like [FB_Zylinder.Extend] does. *)
//! FUNCTION_BLOCK FB_Gripper
//! ```
//!
//! ## What to do
//!
//! Use the name as declared (letter case does not matter), with its owner for a member, or write the
//! brackets as `\[` and `\]` where no link is meant.

use crate::audit::{Context, Rule};
use crate::diagnostic::{Code, Finding, Severity};
use crate::docs::Documentation;

/// The code.
pub static CODE: Code = Code { name: "broken-link", severity: Severity::Warning, page: include_str!("broken_link.rs") };

/// The rule.
pub const RULE: Rule = Rule { code: &CODE, default: true, check };

fn check(context: &Context<'_>, out: &mut Vec<Finding>) {
    for (id, item) in context.catalogue.iter() {
        let variables = (0..item.variables.len()).filter_map(|i| context.docs.variable(id, i));
        let entries = std::iter::once(context.entry(id)).chain(variables);
        let own = entries.filter(|entry| entry.inherited_from.is_none()).filter_map(|entry| entry.doc.as_ref());
        for (text, place) in own.flat_map(Documentation::broken_links) {
            let message = format!("nothing here is called `{text}`");
            out.push(
                Finding::new(&CODE, place, message).help("use the name as declared, or `\\[` for a plain bracket"),
            );
        }
    }
}
