//! # A conditional pragma is stepped over
//!
//! `{IF …}`, `{ELSE}` and `{END_IF}` choose at compile time which text counts. Which defines a compiler
//! will be given is not known here, so the pragmas are stepped over and all branches are read: the
//! manual shows what any of them declares. `{define …}` and `{undefine …}`, which such branches ask for,
//! are stepped over with them.
//!
//! ```st
//! {IF defined (SIMULATION)}
//! fbAxis : FB_SimulatedAxis;
//! {ELSE}
//! fbAxis : FB_Axis;
//! {END_IF}
//! ```
//!
//! ## What to do
//!
//! Nothing, if that is what readers should see. A pragma that cuts a construct in half makes it
//! unreadable; put whole declarations and statements into each branch.

use crate::audit::{Context, Rule};
use crate::diagnostic::{Code, Finding, Severity};
use crate::library::FragmentId;
use crate::syntax::TokenKind;

/// The code.
pub static CODE: Code =
    Code { name: "conditional-pragma", severity: Severity::Info, page: include_str!("conditional_pragma.rs") };

/// The rule.
pub const RULE: Rule = Rule { code: &CODE, default: true, check };

fn check(context: &Context<'_>, out: &mut Vec<Finding>) {
    for (i, source) in context.catalogue.sources.iter().enumerate() {
        let Some(tree) = &source.tree else { continue };
        for token in tree.tokens().filter(|token| token.kind() == TokenKind::Pragma) {
            let message = match first_word(token.text()).as_str() {
                "if" => "a conditional pragma is stepped over; all its branches are read",
                "define" | "undefine" => "a definition for conditional pragmas is stepped over",
                _ => continue,
            };
            let place = context.catalogue.place(FragmentId(u32::try_from(i).unwrap_or(u32::MAX)), token.span());
            out.push(Finding::new(&CODE, place, message));
        }
    }
}

/// The word that a pragma begins with, in lower case.
fn first_word(pragma: &str) -> String {
    let inner = pragma.trim_start_matches('{').trim_start();
    inner.split(|c: char| !c.is_ascii_alphabetic() && c != '_').next().unwrap_or("").to_ascii_lowercase()
}
