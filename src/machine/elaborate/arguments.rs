//! Arguments: sorted by the parameters of what is called, and passed.

use super::access::{Designated, Spot};
use super::expressions::Val;
use super::routines::Parameter;
use super::{Elaborator, Lowered};
use crate::library::Section;
use crate::library::names::fold;
use crate::machine::program::{Location, StatementKind};
use crate::semantics::typing::{Operand, Type};
use crate::syntax::Node;
use crate::syntax::ast::{Argument, ArgumentKind, AstNode, CallExpression, Expression};

/// The arguments of a call, by what they are for.
pub(super) struct Arguments<'c> {
    /// Parameter and value, in the order of the text.
    pub(super) given: Vec<(usize, Expression<'c>)>,
    /// Output parameter, target, and whether it is negated.
    pub(super) outputs: Vec<(usize, Expression<'c>, bool)>,
    pub(super) enable: Option<Expression<'c>>,
    pub(super) enabled: Option<Expression<'c>>,
}

impl<'c> Elaborator<'c> {
    /// Sorts the arguments of a call by the parameters of what is called.
    pub(super) fn arguments(
        &self,
        call: CallExpression<'c>,
        parameters: &[(String, Section)],
        callee: &str,
    ) -> Lowered<Arguments<'c>> {
        let mut sorted = Arguments { given: Vec::new(), outputs: Vec::new(), enable: None, enabled: None };
        let positions: Vec<usize> = (0..parameters.len()).filter(|n| parameters[*n].1 != Section::Output).collect();
        for (n, argument) in call.arguments().enumerate() {
            let key = argument.name().map(|name| fold(name.text()));
            let number = key.as_ref().and_then(|key| parameters.iter().position(|(known, _)| known == key));
            let Some(value) = argument.value() else { continue };
            match (argument.kind(), number) {
                (ArgumentKind::Positional, _) => {
                    let number = positions.get(n).copied().ok_or_else(|| {
                        let message = format!("`{callee}` takes {} arguments", positions.len());
                        self.unsupported("types that do not fit", argument.node(), message)
                    })?;
                    sorted.given.push((number, value));
                }
                (ArgumentKind::Input, Some(number)) => sorted.given.push((number, value)),
                (ArgumentKind::Output | ArgumentKind::NegatedOutput, Some(number)) => {
                    sorted.outputs.push((number, value, argument.kind() == ArgumentKind::NegatedOutput));
                }
                (ArgumentKind::Input, None) if key.as_deref() == Some("en") => sorted.enable = Some(value),
                (ArgumentKind::Output, None) if key.as_deref() == Some("eno") => sorted.enabled = Some(value),
                (_, None) => return Err(self.no_parameter(callee, argument)),
            }
        }
        Ok(sorted)
    }

    fn no_parameter(&self, callee: &str, argument: Argument<'c>) -> super::Unsupported {
        let name = argument.name().map_or("", |name| name.text());
        self.unsupported("types that do not fit", argument.node(), format!("`{callee}` has no parameter `{name}`"))
    }

    /// All values first, then the assignments: the same function may be called in its own arguments.
    pub(super) fn pass_all(
        &mut self,
        parameters: &[Parameter],
        given: &[(usize, Expression<'c>)],
        node: Node<'c>,
    ) -> Lowered<()> {
        let mut values: Vec<Val> = Vec::new();
        for (number, expression) in given {
            let mark = self.body.out.len();
            let value = self.argument(&parameters[*number], *expression)?;
            self.keep_before(mark, &mut values)?;
            values.push(value);
        }
        for ((number, expression), value) in given.iter().zip(values) {
            let parameter = &parameters[*number];
            match value {
                Val::Scalar(Operand::Typed(expr, type_))
                    if type_ == parameter.spot.type_ && type_.range().is_none() =>
                {
                    let target = parameter.spot.location.clone();
                    self.emit(StatementKind::Assign { target, value: expr, range: None });
                }
                value => self.store(&parameter.spot, value, expression.node())?,
            }
        }
        for (number, parameter) in parameters.iter().enumerate() {
            let left_out = !given.iter().any(|(n, _)| *n == number);
            match parameter.section {
                Section::Input if left_out && parameter.has_initial => {
                    let length = self.known_size(&parameter.spot.type_)?;
                    let target = parameter.spot.location.clone();
                    self.emit(StatementKind::Reset { target, length });
                }
                Section::InOut if left_out => {
                    let message = format!("the in-out `{}` is left out", parameter.key);
                    return Err(self.unsupported("types that do not fit", node, message));
                }
                _ => {}
            }
        }
        Ok(())
    }

    /// The value of an argument: for an in-out, the address.
    fn argument(&mut self, parameter: &Parameter, expression: Expression<'c>) -> Lowered<Val> {
        let node = expression.node();
        let type_ = parameter.spot.type_.clone();
        match &type_ {
            Type::Reference { target, .. } if parameter.section == Section::InOut => {
                let target = target.as_ref().clone();
                let expr = match self.designate(expression)? {
                    Designated::Spot(spot) => {
                        let spot = self.followed(spot);
                        self.bound(&target, spot, node)?
                    }
                    Designated::Path(path) => return Err(self.unknown(&path.join("."), node)),
                    // `VAR_IN_OUT CONSTANT` takes values too.
                    designated => {
                        let value = self.value_of(designated, node)?;
                        let spot = match value {
                            Val::Scalar(operand) => self.kept_as(operand, &target)?,
                            Val::Memory(spot) => spot,
                            text @ Val::Text(..) => {
                                let (text, wide) = self.text(text, node)?;
                                let type_ = Type::Text { capacity: text.capacity, wide };
                                let spot = Spot { location: text.location, type_, constant: true };
                                self.widened(spot, &target, node)?
                            }
                        };
                        self.bound(&target, spot, node)?
                    }
                };
                Ok(Val::Scalar(Operand::Typed(expr, type_)))
            }
            Type::Reference { implicit: true, target } => {
                let target = target.as_ref().clone();
                let spot = self.spot(expression)?;
                let expr = self.bound(&target, spot, node)?;
                Ok(Val::Scalar(Operand::Typed(expr, type_)))
            }
            Type::Reference { .. } | Type::Interface { .. } => {
                let designated = self.designate(expression)?;
                let expr = self.reference_value(&type_, designated, node)?;
                Ok(Val::Scalar(Operand::Typed(expr, type_)))
            }
            _ => self.value(expression),
        }
    }

    /// A value as a variable of a type.
    fn kept_as(&mut self, operand: Operand<Location>, type_: &Type) -> Lowered<Spot> {
        let value = crate::semantics::typing::convert::assigned(operand, type_)?.expr;
        let location = self.spilled(value);
        Ok(Spot { location, type_: type_.clone(), constant: true })
    }

    /// A string in as many slots as the parameter sees.
    fn widened(&mut self, spot: Spot, type_: &Type, node: Node<'c>) -> Lowered<Spot> {
        let Type::Text { capacity, wide } = *type_ else { return Ok(spot) };
        let location = self.temporary_text(capacity, wide)?;
        let target = Spot { location, type_: type_.clone(), constant: true };
        self.store(&target, Val::Memory(spot), node)?;
        Ok(target)
    }
}
