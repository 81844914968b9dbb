//! `CASE`.

use super::{Elaborator, Lowered};
use crate::machine::program::{Arm, StatementKind};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::literal::{self, Constant};
use crate::semantics::typing::types::is_whole;
use crate::syntax::Node;
use crate::syntax::ast::{AstNode, CaseStatement, Expression, Range};

impl<'c> Elaborator<'c> {
    pub(super) fn case_statement(&mut self, statement: CaseStatement<'c>) -> Lowered<()> {
        let node = statement.node();
        let selector = statement.selector().ok_or_else(|| self.incomplete(node))?;
        let selector = self.operand(selector)?.settled();
        let mut arms = Vec::new();
        for branch in statement.branches() {
            if self.world.is_excluded(branch.node()) {
                continue;
            }
            let mut labels = Vec::new();
            for label in branch.labels() {
                let label = self.label(label);
                labels.extend(self.tell(label));
            }
            let body = self.list(branch.statements())?;
            arms.push(Arm { labels, body });
        }
        let otherwise = self.list(statement.otherwise())?;
        let (selector, _) = selector?;
        if !is_whole(selector.scalar) && selector.scalar != Scalar::Bool {
            return Err(self.unsupported("types that do not fit", node, "a `CASE` whose selector is no integer"));
        }
        self.emit(StatementKind::Case { selector, arms, otherwise });
        Ok(())
    }

    /// A label as a closed range of numbers.
    fn label(&mut self, node: Node<'c>) -> Lowered<(i128, i128)> {
        let scope = self.body.item;
        if let Some(range) = Range::cast(node) {
            return self.range(range, scope);
        }
        let expression = Expression::cast(node).ok_or_else(|| self.incomplete(node))?;
        if let Expression::Literal(literal) = expression
            && let Ok(Constant::Text(codes, _)) = literal::of(literal)
            && let [code] = codes.as_slice()
        {
            return Ok((i128::from(*code), i128::from(*code)));
        }
        let number = self.constant_number(expression, scope)?;
        Ok((number, number))
    }
}
