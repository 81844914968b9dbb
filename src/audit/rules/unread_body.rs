//! # A body is drawn and not shown
//!
//! The body of this entity is a Sequential Function Chart, a Function Block Diagram, a Ladder Diagram or
//! a Continuous Function Chart. It is kept and listed; the manual does not show it, and nothing in it is
//! checked. The declaration and its comments are read as always.
//!
//! ```xml
//! <Implementation>
//!   <CFC>…</CFC>
//! </Implementation>
//! ```
//!
//! ## What to do
//!
//! Nothing, if the page is useful without it. Otherwise describe in the comment what the drawing does.

use crate::audit::{Context, Rule};
use crate::diagnostic::{Code, Finding, Severity};
use crate::library::ItemBody;
use crate::text::Language;

/// The code.
pub static CODE: Code = Code { name: "unread-body", severity: Severity::Info, page: include_str!("unread_body.rs") };

/// The rule.
pub const RULE: Rule = Rule { code: &CODE, default: true, check };

fn check(context: &Context<'_>, out: &mut Vec<Finding>) {
    for (id, item) in context.catalogue.iter() {
        let ItemBody::Drawn(language, _) = item.body else { continue };
        let language = match language {
            Language::Sfc => "SFC",
            Language::Fbd => "FBD",
            Language::Ld => "LD",
            Language::Cfc => "CFC",
            Language::Ecc => "an execution control chart",
            Language::Unknown => "a language that is not known",
        };
        let message =
            format!("the body of `{}` is drawn in {language} and not shown", context.catalogue.qualified_name(id));
        out.push(Finding::new(&CODE, item.place, message));
    }
}
