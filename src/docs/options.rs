//! What a user may say about the documentation of a tree.

use super::Convention;
use crate::library::Placement;

/// How comments are read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// The convention that all comments are written in; `None` finds it out for each comment.
    pub profile: Option<Convention>,
    /// The placements that may document an entity, the preferred one first.
    pub order: Vec<Placement>,
    /// Whether a comment needs one of the marks `///`, `//!`, `(**`, `(*!`, `(*~`, `/**` to be documentation.
    pub marked_only: bool,
}

impl Options {
    /// The order in which placements are preferred, unless configured otherwise.
    pub const ORDER: [Placement; 7] = [
        Placement::Container,
        Placement::Above,
        Placement::Trailing,
        Placement::BelowHeader,
        Placement::AfterSections,
        Placement::FirstInBody,
        Placement::BetweenSections,
    ];
}

impl Default for Options {
    fn default() -> Self {
        Self { profile: None, order: Self::ORDER.to_vec(), marked_only: false }
    }
}
