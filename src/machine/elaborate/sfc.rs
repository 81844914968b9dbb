//! Sequential function charts.

use super::{Elaborator, Lowered};
use crate::library::ItemId;
use crate::semantics::typing::Type;
use crate::syntax::ast::{AstNode, Body};

impl<'c> Elaborator<'c> {
    /// The variables that a chart adds to the instances of its block, by folded names.
    pub(super) fn chart_fields(&mut self, item: ItemId) -> Lowered<Vec<(String, Type)>> {
        let _ = item;
        Ok(Vec::new())
    }

    /// The statements of a chart.
    pub(super) fn chart(&mut self, body: Body<'c>) -> Lowered<()> {
        Err(self.unsupported("a sequential function chart", body.node(), "a sequential function chart"))
    }
}
