//! # A parameter tag names nothing
//!
//! `@param` names something that is no variable of the entity, nor of what it extends: it was renamed,
//! removed or misspelt. The description would be lost, so it is shown below the detail.
//!
//! ```st
//! (* A cylinder.
//!    @param Extent extend while true *)
//! FUNCTION_BLOCK FB_Cylinder
//! VAR_INPUT
//!     Extend : BOOL;
//! END_VAR
//! ```
//!
//! ## What to do
//!
//! Use the name as declared; letter case does not matter.

use crate::audit::{Context, Rule};
use crate::diagnostic::{Code, Finding, Severity};
use crate::library::names::lineage;
use crate::library::{Catalogue, ItemId};
use crate::text::near::nearest;

/// The code.
pub static CODE: Code =
    Code { name: "unknown-parameter", severity: Severity::Warning, page: include_str!("unknown_parameter.rs") };

/// The rule.
pub const RULE: Rule = Rule { code: &CODE, default: true, check };

fn check(context: &Context<'_>, out: &mut Vec<Finding>) {
    for (id, item, entry) in context.described() {
        let Some(doc) = &entry.doc else { continue };
        if entry.inherited_from.is_some() {
            continue;
        }
        let names = names(context.catalogue, id);
        for param in &doc.tags.params {
            if param.target.is_some() {
                continue;
            }
            let message = format!("`{}` has no parameter `{}`", item.name, param.name);
            let mut finding = Finding::new(&CODE, param.place, message);
            if let Some(near) = nearest(&param.name, names.iter().copied()) {
                finding = finding.help(format!("did you mean `{near}`?"));
            }
            out.push(finding);
        }
    }
}

fn names(catalogue: &Catalogue, id: ItemId) -> Vec<&str> {
    let own = lineage(catalogue, id).into_iter().flat_map(|owner| {
        let item = catalogue.item(owner);
        let accessors = item.children.iter().map(|child| catalogue.item(*child));
        let accessors = accessors.filter(|child| child.kind.is_accessor());
        item.variables.iter().chain(accessors.flat_map(|child| &child.variables))
    });
    own.map(|variable| variable.name.as_str()).collect()
}
