//! Expressions to values. What has an effect, a call, is emitted before; what was evaluated further left is kept where such a
//! call could change it.

use super::access::{Designated, Spot};
use super::{Elaborator, Lowered};
use crate::library::ItemKind;
use crate::machine::program::{Location, StatementKind, Text, TextOperation};
use crate::semantics::expr::{Expr, ExprKind};
use crate::semantics::typing::literal::{self, Constant};
use crate::semantics::typing::{Operand, Type};
use crate::syntax::Node;
use crate::syntax::ast::{Expression, UnaryOperator};

/// What an expression is worth.
#[derive(Clone, Debug)]
pub(super) enum Val {
    /// A scalar.
    Scalar(Operand<Location>),
    /// A string, array, structure or instance in memory.
    Memory(Spot),
    /// Characters of a literal, and whether they are wide.
    Text(Vec<u16>, bool),
}

impl Val {
    /// How a message calls its type.
    pub(super) fn type_name(&self) -> String {
        match self {
            Self::Scalar(operand) => operand.type_name(),
            Self::Memory(spot) => spot.type_.to_string(),
            Self::Text(_, wide) => if *wide { "WSTRING" } else { "STRING" }.to_owned(),
        }
    }

    /// Whether it is a string.
    pub(super) const fn is_text(&self) -> bool {
        matches!(self, Self::Text(..) | Self::Memory(Spot { type_: Type::Text { .. }, .. }))
    }
}

impl<'c> Elaborator<'c> {
    /// The value of an expression.
    pub(super) fn value(&mut self, expression: Expression<'c>) -> Lowered<Val> {
        let node = expression.node();
        match expression {
            Expression::Literal(literal) => {
                let value = literal::of(literal).map_err(|why| self.unsupported("a literal", node, why))?;
                let place = self.place(node);
                Ok(match value {
                    Constant::Text(codes, wide) => Val::Text(codes, wide),
                    // No characters are left, so it is an operand.
                    other => Val::Scalar(other.operand(place).ok_or_else(|| self.incomplete(node))?),
                })
            }
            Expression::Paren(_) => {
                let inner = expression.inner().ok_or_else(|| self.incomplete(node))?;
                self.value(inner)
            }
            Expression::Unary(unary) => {
                let operator = unary.operator().ok_or_else(|| self.incomplete(node))?;
                let operand = unary.operand().ok_or_else(|| self.incomplete(node))?;
                if operator == UnaryOperator::Address {
                    return self.address_of(operand, node);
                }
                let operand = self.operand(operand)?;
                let place = self.place(node);
                Ok(Val::Scalar(crate::semantics::typing::binary::unary(operator, operand, place)?))
            }
            Expression::Binary(binary) => self.binary(binary),
            Expression::Assign(assign) => {
                let target = self.assign_expression(assign)?;
                let target = self.followed(target);
                Ok(self.read(target, node))
            }
            Expression::Call(call) => {
                let value = self.call(call)?;
                value.ok_or_else(|| {
                    let text = super::types::short(node.text());
                    self.unsupported("types that do not fit", node, format!("`{text}` gives nothing"))
                })
            }
            Expression::This(_) => match self.body.class {
                Some(class) => {
                    let this = Spot::this(self.instance_type(class));
                    Ok(Val::Scalar(Operand::Typed(this.address(), this.pointer_type())))
                }
                None => Err(self.unsupported("a name that means nothing here", node, "`THIS` outside of a block")),
            },
            Expression::Array(_) | Expression::Struct(_) | Expression::Repeat(_) => {
                Err(self.unsupported("an initial value in a statement", node, "a list of values in a statement"))
            }
            _ => {
                let designated = self.designate(expression)?;
                self.value_of(designated, node)
            }
        }
    }

    /// The value of what an expression names.
    pub(super) fn value_of(&mut self, designated: Designated, node: Node<'c>) -> Lowered<Val> {
        match designated {
            Designated::Spot(spot) => {
                let spot = self.followed(spot);
                Ok(self.read(spot, node))
            }
            Designated::Value(operand) => {
                let place = self.place(node);
                Ok(Val::Scalar(operand.at(place)))
            }
            Designated::Text(codes, wide) => Ok(Val::Text(codes, wide)),
            Designated::Bit(spot, number) => {
                let place = self.place(node);
                let value = Operand::Typed(spot.read(), spot.type_);
                Ok(Val::Scalar(crate::semantics::typing::binary::bit(value, number, place)?))
            }
            Designated::Member { this, item, class } if self.world.item(item).kind == ItemKind::Property => {
                self.get_property(&this, item, class, node)
            }
            Designated::Path(path) => Err(self.unknown(&path.join("."), node)),
            Designated::Item(item) if self.world.item(item).kind == ItemKind::GlobalVariables => {
                Err(self.unsupported("a value of this kind", node, "a list of globals as a value"))
            }
            Designated::Item(_) | Designated::Super(_) | Designated::Member { .. } => {
                let text = super::types::short(node.text());
                Err(self.unsupported("a value of this kind", node, format!("`{text}` is no value")))
            }
        }
    }

    /// The value of a variable.
    pub(super) fn read(&self, spot: Spot, node: Node<'c>) -> Val {
        match spot.type_.scalar() {
            Some(_) => {
                let mut expr = spot.read();
                expr.place = self.place(node);
                Val::Scalar(Operand::Typed(expr, spot.type_))
            }
            None => Val::Memory(spot),
        }
    }

    /// The scalar value of an expression.
    pub(super) fn operand(&mut self, expression: Expression<'c>) -> Lowered<Operand<Location>> {
        let value = self.value(expression)?;
        self.scalar(value, expression.node())
    }

    pub(super) fn scalar(&self, value: Val, node: Node<'c>) -> Lowered<Operand<Location>> {
        match value {
            Val::Scalar(operand) => Ok(operand),
            other => {
                let message = format!("`{}` where a number is needed", other.type_name());
                Err(self.unsupported("types that do not fit", node, message))
            }
        }
    }

    /// The scalar values of expressions, from left to right.
    pub(super) fn operands(&mut self, expressions: &[Expression<'c>]) -> Lowered<Vec<Operand<Location>>> {
        let values = self.values(expressions)?;
        let pairs = values.into_iter().zip(expressions);
        pairs.map(|(value, expression)| self.scalar(value, expression.node())).collect()
    }

    /// The values of expressions, from left to right: what a later call could change is kept before it.
    pub(super) fn values(&mut self, expressions: &[Expression<'c>]) -> Lowered<Vec<Val>> {
        let mut values: Vec<Val> = Vec::new();
        for expression in expressions {
            let mark = self.body.out.len();
            let value = self.value(*expression)?;
            self.keep_before(mark, &mut values)?;
            values.push(value);
        }
        Ok(values)
    }

    /// Keeps values as they were before the statement number `mark`, if a call follows it.
    pub(super) fn keep_before(&mut self, mark: usize, values: &mut [Val]) -> Lowered<()> {
        if !self.has_calls(mark) {
            return Ok(());
        }
        let later = self.body.out.split_off(mark);
        for value in values.iter_mut() {
            *value = self.kept_value(value.clone())?;
        }
        self.body.out.extend(later);
        Ok(())
    }

    /// Whether something is called from the statement number `mark` on.
    pub(super) fn has_calls(&self, mark: usize) -> bool {
        self.body.out.iter().skip(mark).any(|statement| calls(&statement.kind))
    }

    fn kept_value(&mut self, value: Val) -> Lowered<Val> {
        Ok(match value {
            Val::Scalar(Operand::Typed(expr, type_)) if !matches!(expr.kind, ExprKind::Const(_)) => {
                let (scalar, place) = (expr.scalar, expr.place);
                let location = self.spilled(expr);
                Val::Scalar(Operand::Typed(Expr { kind: ExprKind::Read(location), scalar, place }, type_))
            }
            Val::Memory(Spot { location, type_: Type::Text { capacity, wide }, .. }) => {
                let target = self.temporary_text(capacity, wide)?;
                let source = Text { location, capacity };
                let copy = TextOperation::Assign(Text { location: target.clone(), capacity }, source);
                self.emit(StatementKind::Text(Box::new(copy)));
                Val::Memory(Spot { location: target, type_: Type::Text { capacity, wide }, constant: true })
            }
            other => other,
        })
    }

    /// The slot in which a value is kept.
    pub(super) fn spilled(&mut self, value: Expr<Location>) -> Location {
        let target = self.temporary(value.scalar);
        self.emit(StatementKind::Assign { target: target.clone(), value, range: None });
        target
    }

    /// An operand that may be repeated without repeating what it calculates.
    pub(super) fn shared(&mut self, operand: Operand<Location>) -> Operand<Location> {
        match operand {
            Operand::Typed(expr, type_) if matches!(expr.kind, ExprKind::Apply(..) | ExprKind::If(..)) => {
                let (scalar, place) = (expr.scalar, expr.place);
                let location = self.spilled(expr);
                Operand::Typed(Expr { kind: ExprKind::Read(location), scalar, place }, type_)
            }
            other => other,
        }
    }

    /// A condition.
    pub(super) fn condition(&mut self, expression: Expression<'c>) -> Lowered<Expr<Location>> {
        let operand = self.operand(expression)?;
        Ok(crate::semantics::typing::convert::logical(operand)?)
    }
}

/// Whether a statement, or one inside it, calls something.
fn calls(kind: &StatementKind) -> bool {
    let any = |list: &[crate::machine::program::Statement]| list.iter().any(|statement| calls(&statement.kind));
    match kind {
        StatementKind::Call { .. } | StatementKind::Dispatch { .. } => true,
        StatementKind::If { then, otherwise, .. } => any(then) || any(otherwise),
        StatementKind::Case { arms, otherwise, .. } => arms.iter().any(|arm| any(&arm.body)) || any(otherwise),
        StatementKind::For { body, .. } => any(body),
        StatementKind::Loop { body, after } => any(body) || any(after),
        _ => false,
    }
}
