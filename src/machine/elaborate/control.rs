//! `IF`, `FOR`, `WHILE`, `REPEAT`.

use super::{Elaborator, Lowered};
use crate::machine::program::{Location, Statement, StatementKind};
use crate::semantics::expr::{Expr, Op};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::convert::assigned;
use crate::semantics::typing::types::is_whole;
use crate::semantics::typing::{Operand, apply, constant};
use crate::syntax::Node;
use crate::syntax::ast::{AstNode, ForStatement, IfBranch, IfStatement, LoopStatement, StatementList};

impl<'c> Elaborator<'c> {
    pub(super) fn if_statement(&mut self, statement: IfStatement<'c>) -> Lowered<()> {
        let branches: Vec<IfBranch<'c>> = statement.branches().collect();
        let otherwise = statement.otherwise();
        self.branches(&branches, otherwise, statement.node())
    }

    fn branches(
        &mut self,
        branches: &[IfBranch<'c>],
        otherwise: Option<StatementList<'c>>,
        node: Node<'c>,
    ) -> Lowered<()> {
        // From the last one to the first, so that many of them need no deep recursion.
        let mut rest = self.list(otherwise)?;
        for branch in branches.iter().rev() {
            let inner = rest;
            rest = self.block(|this| {
                let condition = match branch.condition {
                    Some(condition) => this.condition(condition),
                    None => Err(this.incomplete(node)),
                };
                let then = this.list(branch.statements)?;
                let condition = condition?;
                this.emit(StatementKind::If { condition, then, otherwise: inner });
                Ok(())
            })?;
        }
        self.body.out.extend(rest);
        Ok(())
    }

    pub(super) fn for_statement(&mut self, statement: ForStatement<'c>) -> Lowered<()> {
        let node = statement.node();
        let parts = statement.variable().zip(statement.from()).zip(statement.to());
        let ((variable, from), to) = parts.ok_or_else(|| self.incomplete(node))?;
        let body = self.list(statement.statements())?;
        let control = self.spot(variable)?;
        let scalar = control.type_.scalar().filter(|scalar| is_whole(*scalar));
        let scalar = scalar.ok_or_else(|| {
            let message = format!("a `FOR` with a control variable of type `{}`", control.type_);
            self.unsupported("types that do not fit", node, message)
        })?;
        let mut bounds = vec![from, to];
        bounds.extend(statement.by());
        let mut values = self.operands(&bounds)?.into_iter();
        let mut next = || values.next().unwrap_or(Operand::Integer(1, None));
        let from = assigned(next(), &control.type_)?.expr;
        let (to, by) = (self.bound_value(next(), scalar)?, self.bound_value(next(), scalar)?);
        self.emit(StatementKind::For { control: control.location, scalar, from, to, by, body });
        Ok(())
    }

    /// The end or the step of a `FOR`, in the type of its control variable where that holds it.
    fn bound_value(&self, operand: Operand<Location>, scalar: Scalar) -> Lowered<Expr<Location>> {
        if let Operand::Integer(value, place) = operand
            && crate::semantics::typing::types::holds(scalar, value)
        {
            return Ok(constant(scalar, scalar.bits(value), place));
        }
        let name = operand.type_name();
        let (expr, _) = operand.settled()?;
        if !is_whole(expr.scalar) {
            let message = format!("a bound of type `{name}`");
            return Err(super::Unsupported::new("types that do not fit", expr.place, message));
        }
        Ok(expr)
    }

    fn leave_if(&mut self, condition: Expr<Location>) {
        let place = self.body.place;
        let then = vec![Statement { kind: StatementKind::Exit, place }];
        self.emit(StatementKind::If { condition, then, otherwise: Vec::new() });
    }

    pub(super) fn while_statement(&mut self, statement: LoopStatement<'c>) -> Lowered<()> {
        let condition = statement.condition().ok_or_else(|| self.incomplete(statement.node()))?;
        let body = self.block(|this| {
            let condition = this.condition(condition)?;
            this.leave_if(apply(Op::Not, Scalar::Bool, vec![condition], None));
            this.statements(statement.statements().into_iter().flat_map(StatementList::statements));
            Ok(())
        })?;
        self.emit(StatementKind::Loop { body, after: Vec::new() });
        Ok(())
    }

    pub(super) fn repeat_statement(&mut self, statement: LoopStatement<'c>) -> Lowered<()> {
        let condition = statement.condition().ok_or_else(|| self.incomplete(statement.node()))?;
        let body = self.list(statement.statements())?;
        let after = self.block(|this| {
            let condition = this.condition(condition)?;
            this.leave_if(condition);
            Ok(())
        })?;
        self.emit(StatementKind::Loop { body, after });
        Ok(())
    }
}
