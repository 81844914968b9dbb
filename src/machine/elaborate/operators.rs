//! Operators with two operands: on scalars, on strings, on pointers; short circuit where the right side calls something.

use super::expressions::Val;
use super::{Elaborator, Lowered};
use crate::machine::program::{Location, StatementKind};
use crate::semantics::expr::{Expr, ExprKind, Op};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::binary::binary;
use crate::semantics::typing::convert::logical;
use crate::semantics::typing::{Operand, Type, apply, constant};
use crate::syntax::Node;
use crate::syntax::ast::{AstNode, BinaryExpression, BinaryOperator};

impl<'c> Elaborator<'c> {
    /// `left operator right`.
    pub(super) fn binary(&mut self, expression: BinaryExpression<'c>) -> Lowered<Val> {
        // A chain of operators is a tree that leans to the left; it is walked without recursion.
        let mut chain = vec![expression];
        while let Some(crate::syntax::ast::Expression::Binary(left)) = chain.last().and_then(|last| last.left()) {
            chain.push(left);
        }
        let innermost = chain.last().copied().unwrap_or(expression);
        let first = innermost.left().ok_or_else(|| self.incomplete(innermost.node()))?;
        let mut value = self.value(first)?;
        while let Some(next) = chain.pop() {
            value = self.binary_step(value, next)?;
        }
        Ok(value)
    }

    fn binary_step(&mut self, left: Val, expression: BinaryExpression<'c>) -> Lowered<Val> {
        let node = expression.node();
        let operator = expression.operator().ok_or_else(|| self.incomplete(node))?;
        let right = expression.right().ok_or_else(|| self.incomplete(node))?;
        let mark = self.body.out.len();
        let value = self.value(right)?;
        if self.body.out.len() > mark && matches!(operator, BinaryOperator::AndThen | BinaryOperator::OrElse) {
            let right_statements = self.body.out.split_off(mark);
            return self.short_circuit(operator, left, value, right_statements, node);
        }
        let mut both = [left];
        self.keep_before(mark, &mut both)?;
        let [left] = both;
        if left.is_text() || value.is_text() {
            return self.compare_texts(operator, left, value, node);
        }
        let (left, right) = (self.scalar(left, node)?, self.scalar(value, node)?);
        if let Some(moved) = self.pointer_arithmetic(operator, &left, &right, node)? {
            return Ok(Val::Scalar(moved));
        }
        let place = self.place(node);
        Ok(Val::Scalar(binary(operator, left, right, place)?))
    }

    /// `AND_THEN` and `OR_ELSE` whose right side needs statements: these are done only where it counts.
    fn short_circuit(
        &mut self,
        operator: BinaryOperator,
        left: Val,
        right: Val,
        statements: Vec<crate::machine::program::Statement>,
        node: Node<'c>,
    ) -> Lowered<Val> {
        let left = logical(self.scalar(left, node)?)?;
        let right = logical(self.scalar(right, node)?)?;
        let result = self.spilled(left);
        let read = Expr { kind: ExprKind::Read(result.clone()), scalar: Scalar::Bool, place: self.place(node) };
        let condition = match operator {
            BinaryOperator::AndThen => read.clone(),
            _ => apply(Op::Not, Scalar::Bool, vec![read.clone()], None),
        };
        let place = self.body.place;
        let kind = StatementKind::Assign { target: result, value: right, range: None };
        let mut then = statements;
        then.push(crate::machine::program::Statement { kind, place });
        self.emit(StatementKind::If { condition, then, otherwise: Vec::new() });
        Ok(Val::Scalar(Operand::of(read)))
    }

    /// `pointer + bytes` and `pointer - bytes`, where the bytes are whole elements.
    fn pointer_arithmetic(
        &mut self,
        operator: BinaryOperator,
        left: &Operand<Location>,
        right: &Operand<Location>,
        node: Node<'c>,
    ) -> Lowered<Option<Operand<Location>>> {
        let op = match operator {
            BinaryOperator::Add => Op::Add,
            BinaryOperator::Subtract => Op::Sub,
            _ => return Ok(None),
        };
        let (pointer, number, type_) = match (left, right) {
            (Operand::Typed(pointer, type_ @ Type::Reference { .. }), number) => (pointer, number, type_),
            (number, Operand::Typed(pointer, type_ @ Type::Reference { .. })) if op == Op::Add => {
                (pointer, number, type_)
            }
            _ => return Ok(None),
        };
        let Type::Reference { target, .. } = type_ else { return Ok(None) };
        let scalar = self.leading_scalar(target)?;
        let bytes = scalar.map(|scalar| i128::from(scalar.width().div_ceil(8)));
        let fail = || self.unsupported("pointer arithmetic", node, format!("arithmetic with a pointer to `{target}`"));
        let bytes = bytes.ok_or_else(fail)?;
        let steps = match number.number() {
            Some(number) if number % bytes == 0 => {
                constant(Scalar::Ref, Scalar::Ref.bits(number / bytes), number_place(right))
            }
            None if bytes == 1 => {
                let (expr, _) = number.clone().settled()?;
                let wide = crate::semantics::typing::converted(expr, crate::semantics::typing::types::UDINT);
                crate::semantics::typing::reinterpreted(wide, Scalar::Ref)
            }
            _ => return Err(fail()),
        };
        let place = self.place(node);
        let moved = apply(op, Scalar::Ref, vec![pointer.clone(), steps], place);
        Ok(Some(Operand::Typed(moved, type_.clone())))
    }
}

const fn number_place(operand: &Operand<Location>) -> Option<crate::text::Place> {
    operand.place()
}
