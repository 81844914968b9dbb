//! Statements.

use super::access::{Designated, Spot};
use super::expressions::Val;
use super::{Elaborator, Lowered};
use crate::library::ItemKind;
use crate::machine::program::{Location, Statement as Lowest, StatementKind, Text, TextOperation};
use crate::semantics::expr::{Expr, ExprKind, Op};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::convert::{assigned, logical};
use crate::semantics::typing::{Operand, Type, apply, constant};
use crate::syntax::Node;
use crate::syntax::ast::{
    AssignExpression, AssignOperator, AssignStatement, AstNode, BinaryOperator, Expression, Statement, StatementList,
};

impl<'c> Elaborator<'c> {
    /// Statements one after the other; what is not modelled is told, and the next one goes on.
    pub(super) fn statements(&mut self, statements: impl Iterator<Item = Statement<'c>>) {
        for statement in statements {
            if self.world.is_excluded(statement.node()) {
                continue;
            }
            let outer = self.body.place;
            self.body.place = self.place(statement.node());
            let lowered = self.statement(statement);
            self.tell(lowered);
            self.body.place = outer;
        }
    }

    /// The statements of a list, as a block of their own.
    pub(super) fn list(&mut self, list: Option<StatementList<'c>>) -> Lowered<Vec<Lowest>> {
        self.block(|this| {
            this.statements(list.into_iter().flat_map(StatementList::statements));
            Ok(())
        })
    }

    fn statement(&mut self, statement: Statement<'c>) -> Lowered<()> {
        let node = statement.node();
        match statement {
            Statement::Assign(assign) => self.assign_statement(assign),
            Statement::Expression(expression, _) => self.expression_statement(expression),
            Statement::If(branches) => self.if_statement(branches),
            Statement::Case(case) => self.case_statement(case),
            Statement::For(loop_) => self.for_statement(loop_),
            Statement::While(loop_) => self.while_statement(loop_),
            Statement::Repeat(loop_) => self.repeat_statement(loop_),
            Statement::Exit(_) => {
                self.emit(StatementKind::Exit);
                Ok(())
            }
            Statement::Continue(_) => {
                self.emit(StatementKind::Continue);
                Ok(())
            }
            Statement::Return(_) => {
                self.emit(StatementKind::Return);
                Ok(())
            }
            Statement::Region(_) => {
                let list = statement.region_statements();
                self.statements(list.into_iter().flat_map(StatementList::statements));
                Ok(())
            }
            Statement::Empty(_) | Statement::Label(_) => Ok(()),
            Statement::Jump(_) => {
                Err(self.unsupported("a jump", node, "a jump to a label").help("write it with `IF` and loops"))
            }
            Statement::Try(_) => Err(self.unsupported("`__TRY`", node, "`__TRY` with `__CATCH`")),
        }
    }

    fn expression_statement(&mut self, expression: Expression<'c>) -> Lowered<()> {
        let node = expression.node();
        match expression.unwrapped() {
            Expression::Call(call) => self.call(call).map(drop),
            Expression::Assign(assign) => self.assign_expression(assign).map(drop),
            other => match self.designate(other)? {
                Designated::Member { this, item, .. } if self.world.item(item).kind == ItemKind::Action => {
                    self.call_action(&this, item);
                    Ok(())
                }
                Designated::Path(path) => Err(self.unknown(&path.join("."), node)),
                // A value without an effect.
                _ => Ok(()),
            },
        }
    }

    fn assign_statement(&mut self, assign: AssignStatement<'c>) -> Lowered<()> {
        let node = assign.node();
        let target = assign.target().ok_or_else(|| self.incomplete(node))?;
        let value = assign.value().ok_or_else(|| self.incomplete(node))?;
        let operator = assign.operator().ok_or_else(|| self.incomplete(node))?;
        self.assign(target, operator, value, node).map(drop)
    }

    /// `a := b` as an expression; gives its target.
    pub(super) fn assign_expression(&mut self, assign: AssignExpression<'c>) -> Lowered<Spot> {
        let node = assign.node();
        let target = assign.target().ok_or_else(|| self.incomplete(node))?;
        let value = assign.value().ok_or_else(|| self.incomplete(node))?;
        let operator = assign.operator().ok_or_else(|| self.incomplete(node))?;
        let spot = self.assign(target, operator, value, node)?;
        spot.ok_or_else(|| {
            self.unsupported("an assignment as a value", node, "an assignment to a bit or property as a value")
        })
    }

    /// An assignment; gives the variable that is assigned, if it is one.
    fn assign(
        &mut self,
        target: Expression<'c>,
        operator: AssignOperator,
        value: Expression<'c>,
        node: Node<'c>,
    ) -> Lowered<Option<Spot>> {
        match operator {
            AssignOperator::Assign => {}
            AssignOperator::Reference => {
                let spot = match self.designate(target)? {
                    Designated::Spot(spot) => spot,
                    _ => {
                        return Err(self.unsupported(
                            "a value where a variable is needed",
                            node,
                            "`REF=` on what is no variable",
                        ));
                    }
                };
                if matches!(spot.type_, Type::Interface { .. }) {
                    self.assign_value(&spot, value)?;
                } else {
                    self.bind_reference(&spot, value)?;
                }
                return Ok(Some(spot));
            }
            AssignOperator::Set | AssignOperator::Reset => return self.latch(target, operator, value, node).map(Some),
            AssignOperator::Try => {
                return Err(self.unsupported("an assignment attempt", node, "an assignment attempt (`?=`)"));
            }
            AssignOperator::Add => return self.compound(target, BinaryOperator::Add, value, node).map(Some),
            AssignOperator::Subtract => return self.compound(target, BinaryOperator::Subtract, value, node).map(Some),
            AssignOperator::Multiply => return self.compound(target, BinaryOperator::Multiply, value, node).map(Some),
            AssignOperator::Divide => return self.compound(target, BinaryOperator::Divide, value, node).map(Some),
        }
        match self.designate(target)? {
            Designated::Spot(spot) => {
                let spot = self.followed(spot);
                self.check_writable(&spot, node)?;
                self.assign_value(&spot, value)?;
                Ok(Some(spot))
            }
            Designated::Bit(spot, number) => {
                let operand = self.operand(value)?;
                let bit = logical(operand)?;
                self.write_bit(&spot, number, bit);
                Ok(None)
            }
            Designated::Member { this, item, class } if self.world.item(item).kind == ItemKind::Property => {
                self.set_property(&this, item, class, value, node)?;
                Ok(None)
            }
            Designated::Path(path) => Err(self.unknown(&path.join("."), node)),
            _ => Err(self.unsupported(
                "a value where a variable is needed",
                node,
                "an assignment to what is no variable",
            )),
        }
    }

    /// A constant duration where a whole number is needed, as number of cycles: blocks that count cycles are written so for
    /// checkers that know no other time. The verdict says so.
    fn counted_in_cycles(&mut self, operand: Operand<Location>, type_: &Type) -> Operand<Location> {
        let Operand::Typed(Expr { kind: ExprKind::Const(bits), scalar: Scalar::Time(width), place }, _) = &operand
        else {
            return operand;
        };
        let whole = matches!(type_.scalar(), Some(Scalar::Int { .. })) && matches!(type_, Type::Scalar(_));
        let nanos = if *width == 32 { bits.saturating_mul(1_000_000) } else { *bits };
        let cycle = self.options.cycle_time;
        if !whole || cycle == 0 || nanos % cycle != 0 {
            return operand;
        }
        let count = nanos / cycle;
        self.assumptions.insert(format!("a duration of {} ms as a number is {count} cycles", nanos / 1_000_000));
        Operand::Integer(i128::from(count), *place)
    }

    fn check_writable(&self, spot: &Spot, node: Node<'c>) -> Lowered<()> {
        if spot.constant {
            return Err(self.unsupported("an assignment to a constant", node, "an assignment to a constant"));
        }
        Ok(())
    }

    /// `target := value` for any type. The parts of the target are calculated before the value is.
    pub(super) fn assign_value(&mut self, spot: &Spot, value: Expression<'c>) -> Lowered<()> {
        let node = value.node();
        if matches!(spot.type_, Type::Reference { .. } | Type::Interface { .. })
            && !matches!(value.unwrapped(), Expression::Assign(_))
        {
            let designated = self.designate(value)?;
            let expr = self.reference_value(&spot.type_, designated, node)?;
            self.emit(StatementKind::Assign { target: spot.location.clone(), value: expr, range: None });
            return Ok(());
        }
        let mark = self.body.out.len();
        let value = self.value(value)?;
        if self.has_calls(mark) {
            let later = self.body.out.split_off(mark);
            let location = self.frozen(spot.location.clone());
            self.body.out.extend(later);
            return self.store(&Spot { location, ..spot.clone() }, value, node);
        }
        self.store(spot, value, node)
    }

    /// Puts a value into a variable.
    pub(super) fn store(&mut self, spot: &Spot, value: Val, node: Node<'c>) -> Lowered<()> {
        let target = spot.location.clone();
        match (&spot.type_, value) {
            (Type::Text { capacity, .. }, Val::Text(codes, _)) => {
                let target = Text { location: target, capacity: *capacity };
                self.emit(StatementKind::Text(Box::new(TextOperation::Literal(target, codes))));
            }
            (
                Type::Text { capacity, wide: a },
                Val::Memory(Spot { location, type_: Type::Text { capacity: from, wide: b }, .. }),
            ) if *a == b => {
                let target = Text { location: target, capacity: *capacity };
                let source = Text { location, capacity: from };
                self.emit(StatementKind::Text(Box::new(TextOperation::Assign(target, source))));
            }
            (type_, Val::Memory(source)) if *type_ == source.type_ => {
                let length = self.known_size(type_)?;
                self.emit(StatementKind::Copy { target, source: source.location, length });
            }
            (type_, Val::Scalar(operand)) if type_.scalar() == Some(Scalar::Ref) => {
                let value = self.reference_value(type_, Designated::Value(operand), node)?;
                self.emit(StatementKind::Assign { target, value, range: None });
            }
            (type_, Val::Scalar(operand)) if type_.scalar().is_some() => {
                let place = self.place(node);
                let operand = self.counted_in_cycles(operand, type_);
                let value = assigned(operand.at(place), type_)?.expr;
                self.emit(StatementKind::Assign { target, value, range: type_.range() });
            }
            // A character is a string of length one.
            (Type::Scalar(scalar @ Scalar::Bits(8 | 16)), Val::Text(codes, _)) if codes.len() == 1 => {
                let value = constant(*scalar, u64::from(codes[0]), self.place(node));
                self.emit(StatementKind::Assign { target, value, range: None });
            }
            (type_, value) => {
                let message = format!("a value of type `{}` for a `{type_}`", value.type_name());
                return Err(self.unsupported("types that do not fit", node, message));
            }
        }
        Ok(())
    }

    /// `target S= value` and `target R= value`.
    fn latch(
        &mut self,
        target: Expression<'c>,
        operator: AssignOperator,
        value: Expression<'c>,
        node: Node<'c>,
    ) -> Lowered<Spot> {
        let condition = self.condition(value)?;
        let bits = u64::from(operator == AssignOperator::Set);
        let place = self.place(node);
        match self.designate(target)? {
            Designated::Spot(spot) => {
                let spot = self.followed(spot);
                if spot.type_.scalar() != Some(Scalar::Bool) {
                    return Err(self.unsupported(
                        "types that do not fit",
                        node,
                        format!("`S=` or `R=` on a `{}`", spot.type_),
                    ));
                }
                let (target, value) = (spot.location.clone(), constant(Scalar::Bool, bits, place));
                let then = self.block(|this| {
                    this.emit(StatementKind::Assign { target, value, range: None });
                    Ok(())
                })?;
                self.emit(StatementKind::If { condition, then, otherwise: Vec::new() });
                Ok(spot)
            }
            Designated::Bit(spot, number) => {
                let then = self.block(|this| {
                    this.write_bit(&spot, number, constant(Scalar::Bool, bits, place));
                    Ok(())
                })?;
                self.emit(StatementKind::If { condition, then, otherwise: Vec::new() });
                Ok(spot)
            }
            _ => {
                Err(self.unsupported("a value where a variable is needed", node, "`S=` or `R=` on what is no variable"))
            }
        }
    }

    /// `target += value` and its relatives.
    fn compound(
        &mut self,
        target: Expression<'c>,
        operator: BinaryOperator,
        value: Expression<'c>,
        node: Node<'c>,
    ) -> Lowered<Spot> {
        let operand = self.operand(value)?;
        let spot = self.spot(target)?;
        self.check_writable(&spot, node)?;
        let before = self.read(spot.clone(), node);
        let before = self.scalar(before, node)?;
        let place = self.place(node);
        let sum = crate::semantics::typing::binary::binary(operator, before, operand, place)?;
        self.store(&spot, Val::Scalar(sum), node)?;
        Ok(spot)
    }

    /// Writes one bit of a variable and leaves the others.
    pub(super) fn write_bit(&mut self, spot: &Spot, number: u32, bit: Expr<Location>) {
        let read = spot.read();
        let scalar = read.scalar;
        let mask = constant(scalar, 1 << number, None);
        let others = constant(scalar, scalar.bits(!(1_i128 << number)), None);
        let high = apply(Op::Or, scalar, vec![read.clone(), mask], None);
        let low = apply(Op::And, scalar, vec![read, others], None);
        let value = apply(Op::Select, scalar, vec![bit, high, low], None);
        self.emit(StatementKind::Assign { target: spot.location.clone(), value, range: spot.type_.range() });
    }
}
