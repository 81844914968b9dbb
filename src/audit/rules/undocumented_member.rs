//! # A member of a public entity has no documentation
//!
//! A method, property, action or transition, or a variable of an interface (an input, output or
//! in-out, a global, a field, a value) that other people can use has no comment.
//!
//! Reported once for an entity where several of its variables lack one: the message names them all, at
//! the place of the first. `PRIVATE` and `INTERNAL` members, and internal variables, are not reported.
//! A method that overrides or implements a documented one has that documentation.
//!
//! ```st
//! VAR_INPUT
//!     Extend : BOOL;
//! END_VAR
//! ```
//!
//! ## What to do
//!
//! Put a comment behind the declaration, or above it.
//!
//! ```st
//! VAR_INPUT
//!     Extend : BOOL;   // extend, and stay extended, while true
//! END_VAR
//! ```

use crate::audit::{Context, Rule};
use crate::diagnostic::{Code, Finding, Severity};
use crate::library::{Item, ItemId, Variable};

/// The code.
pub static CODE: Code =
    Code { name: "undocumented-member", severity: Severity::Warning, page: include_str!("undocumented_member.rs") };

/// The rule.
pub const RULE: Rule = Rule { code: &CODE, default: true, check };

/// How many names a message lists.
const LISTED: usize = 6;

fn check(context: &Context<'_>, out: &mut Vec<Finding>) {
    for (id, item, entry) in context.described() {
        if !context.is_public(id) {
            continue;
        }
        if item.parent.is_some() && entry.doc.is_none() && entry.placeholder.is_none() {
            let message = format!(
                "{} `{}` has no documentation",
                item.kind.label().to_lowercase(),
                context.catalogue.qualified_name(id)
            );
            let help = "put a comment above its header, directly below it, or at the beginning of its body";
            out.push(Finding::new(&CODE, item.place, message).help(help));
        }
        out.extend(variables(context, id, item));
    }
}

fn variables(context: &Context<'_>, id: ItemId, item: &Item) -> Option<Finding> {
    let bare: Vec<&Variable> = item
        .variables
        .iter()
        .enumerate()
        .filter(|(_, variable)| context.wants_documentation(item, variable.section))
        .filter(|(i, _)| {
            let entry = context.variable(id, *i);
            entry.doc.is_none() && entry.placeholder.is_none()
        })
        .map(|(_, variable)| variable)
        .collect();
    let first = bare.first()?;
    let mut names: Vec<String> = bare.iter().take(LISTED).map(|v| format!("`{}`", v.name)).collect();
    if bare.len() > LISTED {
        names.push(format!("{} more", bare.len() - LISTED));
    }
    let owner = context.catalogue.qualified_name(id);
    let have = if bare.len() == 1 { "has" } else { "have" };
    let message = format!("{} of `{owner}` {have} no documentation", names.join(", "));
    Some(Finding::new(&CODE, first.place, message).help("put a comment behind each declaration, or above it"))
}
