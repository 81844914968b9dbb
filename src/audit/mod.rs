//! Rules, one a file: what is undocumented, unverified, broken.
//!
//! A rule reads the [`Context`] and gives findings; it changes nothing and asks no other rule. The
//! `//!` text at the top of its file is the page that `rungbook explain` prints.

pub mod context;
pub mod rules;

use crate::diagnostic::{Code, Finding};

pub use context::Context;

/// A rule.
#[derive(Debug)]
pub struct Rule {
    /// Its code; the page is its file's own text.
    pub code: &'static Code,
    /// Whether it runs unless configured otherwise.
    pub default: bool,
    /// Finds fault.
    pub check: fn(&Context<'_>, &mut Vec<Finding>),
}

/// All rules.
pub static RULES: &[Rule] = &[
    rules::block_without_table::RULE,
    rules::broken_link::RULE,
    rules::conditional_pragma::RULE,
    rules::missing_brief::RULE,
    rules::placeholder_documentation::RULE,
    rules::proves_nothing::RULE,
    rules::undocumented::RULE,
    rules::undocumented_member::RULE,
    rules::unknown_parameter::RULE,
    rules::unread_body::RULE,
    rules::unverified_table::RULE,
    rules::violated_table::RULE,
];

/// Every code of every room, by name.
#[must_use]
pub fn codes() -> Vec<&'static Code> {
    let rooms =
        [crate::source::codes::ALL, crate::syntax::codes::ALL, crate::table::codes::ALL, crate::evidence::codes::ALL];
    let mut all: Vec<_> = RULES.iter().map(|rule| rule.code).chain(rooms.into_iter().flatten().copied()).collect();
    all.sort_by_key(|code| code.name);
    all
}

/// The code of that name.
#[must_use]
pub fn code(name: &str) -> Option<&'static Code> {
    codes().into_iter().find(|code| code.name == name)
}

/// Runs the rules that `runs` lets run, given each one's name and default.
pub fn check(context: &Context<'_>, runs: impl Fn(&str, bool) -> bool) -> Vec<Finding> {
    let mut findings = Vec::new();
    for rule in RULES.iter().filter(|rule| runs(rule.code.name, rule.default)) {
        (rule.check)(context, &mut findings);
    }
    findings
}
