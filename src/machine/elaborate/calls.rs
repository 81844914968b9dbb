//! Calls: of instances, programs, functions, methods, actions and properties.

use std::rc::Rc;

use super::access::{Designated, Spot};
use super::classes::LayoutKey;
use super::expressions::Val;
use super::routines::{Frame, RoutineKey};
use super::{Elaborator, Lowered};
use crate::library::{ItemId, ItemKind, Section};
use crate::machine::program::{Base, Location, StatementKind};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::convert::logical;
use crate::semantics::typing::{Operand, Type, constant, functions};
use crate::syntax::Node;
use crate::syntax::ast::{AstNode, CallExpression, Expression, UnaryOperator};

use super::texts;

impl<'c> Elaborator<'c> {
    /// A call; what it gives, if anything.
    pub(super) fn call(&mut self, call: CallExpression<'c>) -> Lowered<Option<Val>> {
        let node = call.node();
        let callee = call.callee().ok_or_else(|| self.incomplete(node))?;
        let name = match callee.unwrapped() {
            Expression::Name(name) => Some(name.text()),
            Expression::Super(_) => return self.call_super(node).map(|()| None),
            _ => None,
        };
        let designated = self.designate(callee)?;
        let is_known = |name: &str| functions::is_standard(name) || texts::function(name).is_some();
        match designated {
            Designated::Spot(spot) => {
                let spot = self.followed(spot);
                match spot.type_.clone() {
                    Type::Instance { item, .. } => self.call_instance(&spot, item, call).map(|()| None),
                    other
                        if name
                            .is_some_and(|name| name.eq_ignore_ascii_case(&self.world.item(self.body.item).name)) =>
                    {
                        let _ = other;
                        Err(self.unsupported("a recursive call", node, "a function that calls itself"))
                    }
                    other => Err(self.unsupported("types that do not fit", node, format!("a call of a `{other}`"))),
                }
            }
            Designated::Member { this, item, class } => match self.world.item(item).kind {
                ItemKind::Method => self.call_method(&this, item, class, call),
                ItemKind::Action => {
                    self.call_action(&this, item);
                    Ok(None)
                }
                _ => Err(self.unsupported("types that do not fit", node, "a call of a property")),
            },
            Designated::Item(item) => match self.world.item(item).kind {
                ItemKind::Function => self.call_function(item, call),
                ItemKind::Program => {
                    let spot = self.program_instance(item)?;
                    self.call_instance(&spot, item, call).map(|()| None)
                }
                ItemKind::GlobalVariables => match self.data_block(item)? {
                    Some(spot) => match spot.type_.clone() {
                        Type::Instance { item, .. } => self.call_instance(&spot, item, call).map(|()| None),
                        _ => Err(self.unsupported("types that do not fit", node, "a call of a data block")),
                    },
                    None => Err(self.unsupported("types that do not fit", node, "a call of a list of globals")),
                },
                _ => match name.filter(|name| is_known(name)) {
                    Some(name) => self.standard_call(name, call),
                    None => Err(self.unsupported("types that do not fit", node, "a call of a type")),
                },
            },
            Designated::Super(_) => self.call_super(node).map(|()| None),
            Designated::Path(path) => {
                let last = path.last().cloned().unwrap_or_default();
                self.standard_call(&last, call)
            }
            Designated::Value(_) if name.is_some_and(is_known) => self.standard_call(name.unwrap_or_default(), call),
            Designated::Value(_) | Designated::Bit(..) | Designated::Text(..) => {
                Err(self.unsupported("types that do not fit", node, "a call of a value"))
            }
        }
    }

    /// `SUPER^()`: the body of the block that this one extends, on the same instance.
    fn call_super(&mut self, node: Node<'c>) -> Lowered<()> {
        let base = self.super_class(node)?;
        let routine = self.routine(RoutineKey::Code(base, self.body.class));
        self.emit(StatementKind::Call { routine, this: Some(Spot::this(Type::Null).location) });
        Ok(())
    }

    /// An action, which has no parameters.
    pub(super) fn call_action(&mut self, this: &Spot, item: ItemId) {
        let class = match &this.type_ {
            Type::Instance { item, .. } => Some(*item),
            _ => self.body.class,
        };
        let routine = self.routine(RoutineKey::Code(item, class));
        self.emit(StatementKind::Call { routine, this: Some(this.location.clone()) });
    }

    /// A call of a function of our own with one argument.
    pub(super) fn call_own(&mut self, name: &str, argument: Val, node: Node<'c>) -> Lowered<Val> {
        let item = match self.world.path(&[name], self.body.item) {
            Some(crate::library::names::Found::Item(item)) => item,
            _ => return Err(self.unknown(name, node)),
        };
        let frame = self.frame(item, None)?;
        let routine = self.routine(RoutineKey::Code(item, None));
        let parameter = frame.parameters.first().ok_or_else(|| self.incomplete(node))?;
        self.store(&parameter.spot, argument, node)?;
        self.emit(StatementKind::Call { routine, this: None });
        let result = frame.result.clone().ok_or_else(|| self.incomplete(node))?;
        Ok(self.read(result, node))
    }

    /// Does a call only where `EN` holds, and tells `ENO`.
    fn enabled(
        &mut self,
        enable: Option<Expression<'c>>,
        enabled: Option<Expression<'c>>,
        call: impl FnOnce(&mut Self) -> Lowered<()>,
    ) -> Lowered<()> {
        let (condition, node) = match enable {
            Some(expression) => (Some(self.condition(expression)?), Some(expression.node())),
            None => (None, enabled.map(|target| target.node())),
        };
        let value = condition.clone().unwrap_or_else(|| constant(Scalar::Bool, 1, None));
        let kept = self.spilled(value);
        let read = Spot { location: kept, type_: Type::Scalar(Scalar::Bool), constant: true };
        match condition {
            Some(_) => {
                let then = self.block(call)?;
                self.emit(StatementKind::If { condition: read.read(), then, otherwise: Vec::new() });
            }
            None => call(self)?,
        }
        if let (Some(target), Some(node)) = (enabled, node) {
            let target = self.spot(target)?;
            self.store(&target, Val::Scalar(Operand::of(read.read())), node)?;
        }
        Ok(())
    }

    /// A call of an instance or a program.
    fn call_instance(&mut self, spot: &Spot, class: ItemId, call: CallExpression<'c>) -> Lowered<()> {
        let layout = self.layout(LayoutKey::Class(class))?;
        let is_parameter = |section| matches!(section, Section::Input | Section::Output | Section::InOut);
        let fields: Vec<_> = layout.fields.iter().filter(|field| is_parameter(field.section)).cloned().collect();
        let parameters: Vec<(String, Section)> =
            fields.iter().map(|field| (field.key.clone(), field.section)).collect();
        let name = self.world.item(class).name.clone();
        let arguments = self.arguments(call, &parameters, &name)?;
        let location = self.frozen(spot.location.clone());
        let this = Spot { location, ..spot.clone() };
        let lower = |me: &mut Self| -> Lowered<()> {
            for (number, value) in arguments.given {
                let field = this.field(&fields[number]);
                me.pass(&field, fields[number].section, value)?;
            }
            me.call_body(&this, class);
            for (number, target, negated) in arguments.outputs {
                let output = this.field(&fields[number]);
                me.take_output(&output, target, negated)?;
            }
            Ok(())
        };
        match (arguments.enable, arguments.enabled) {
            (None, None) => lower(self),
            (enable, enabled) => self.enabled(enable, enabled, lower),
        }
    }

    /// The call itself, by the class of the instance where only the run knows it.
    fn call_body(&mut self, this: &Spot, class: ItemId) {
        if matches!(this.location.base, Base::Referent(_)) && self.may_be_derived(class) {
            let dispatch = self.dispatch(class, class, Rc::new(Frame::default()));
            self.emit_dispatch(dispatch, this.address());
            return;
        }
        let dynamic =
            if this.location == Spot::this(Type::Null).location { self.body.class.unwrap_or(class) } else { class };
        let routine = self.routine(RoutineKey::Code(class, Some(dynamic)));
        self.emit(StatementKind::Call { routine, this: Some(this.location.clone()) });
    }

    /// Gives an argument to an input or in-out of an instance.
    fn pass(&mut self, field: &Spot, section: Section, value: Expression<'c>) -> Lowered<()> {
        if section == Section::InOut { self.bind_reference(field, value) } else { self.assign_value(field, value) }
    }

    fn take_output(&mut self, output: &Spot, target: Expression<'c>, negated: bool) -> Lowered<()> {
        let node = target.node();
        let value = self.read(output.clone(), node);
        let value = if negated {
            let operand = self.scalar(value, node)?;
            let place = self.place(node);
            Val::Scalar(crate::semantics::typing::binary::unary(UnaryOperator::Not, operand, place)?)
        } else {
            value
        };
        match self.designate(target)? {
            Designated::Spot(spot) => {
                let spot = self.followed(spot);
                self.store(&spot, value, node)
            }
            Designated::Bit(spot, number) => {
                let operand = self.scalar(value, node)?;
                let bit = logical(operand)?;
                self.write_bit(&spot, number, bit);
                Ok(())
            }
            Designated::Path(path) => Err(self.unknown(&path.join("."), node)),
            _ => Err(self.unsupported("a value where a variable is needed", node, "an output to what is no variable")),
        }
    }

    fn call_function(&mut self, item: ItemId, call: CallExpression<'c>) -> Lowered<Option<Val>> {
        let frame = self.frame(item, None)?;
        let routine = self.routine(RoutineKey::Code(item, None));
        self.call_routine(&frame, call, |me| {
            me.emit(StatementKind::Call { routine, this: None });
        })
    }

    /// A method, by the class of the instance where only the run knows it.
    fn call_method(
        &mut self,
        this: &Spot,
        item: ItemId,
        class: ItemId,
        call: CallExpression<'c>,
    ) -> Lowered<Option<Val>> {
        let (frame, target) = self.resolved(this, item, class)?;
        self.call_routine(&frame, call, |me| me.emit_call(&target))
    }

    /// The frame of a member's routine, and how it is called.
    pub(super) fn resolved(&mut self, this: &Spot, item: ItemId, class: ItemId) -> Lowered<(Rc<Frame>, Target)> {
        let referent = matches!(this.location.base, Base::Referent(_));
        match &this.type_ {
            Type::Interface { item: interface, .. } => {
                let frame = self.frame(item, Some(*interface))?;
                let dispatch = self.dispatch(item, *interface, Rc::clone(&frame));
                Ok((frame, Target::Dispatch(dispatch, this.read())))
            }
            Type::Instance { item: dynamic, .. } if referent && self.may_be_derived(*dynamic) => {
                let frame = self.frame(item, Some(*dynamic))?;
                let dispatch = self.dispatch(item, *dynamic, Rc::clone(&frame));
                Ok((frame, Target::Dispatch(dispatch, this.address())))
            }
            type_ => {
                let dynamic = if let Type::Instance { item, .. } = type_ { *item } else { class };
                let frame = self.frame(item, Some(dynamic))?;
                let routine = self.routine(RoutineKey::Code(item, Some(dynamic)));
                let location = self.frozen(this.location.clone());
                Ok((frame, Target::Routine(routine, location)))
            }
        }
    }

    pub(super) fn emit_call(&mut self, target: &Target) {
        match target {
            Target::Routine(routine, location) => {
                self.emit(StatementKind::Call { routine: *routine, this: Some(location.clone()) });
            }
            Target::Dispatch(dispatch, this) => self.emit_dispatch(*dispatch, this.clone()),
        }
    }

    /// Arguments into the frame, the call, outputs out of the frame; the result.
    fn call_routine(
        &mut self,
        frame: &Frame,
        call: CallExpression<'c>,
        emit: impl FnOnce(&mut Self),
    ) -> Lowered<Option<Val>> {
        let parameters: Vec<(String, Section)> =
            frame.parameters.iter().map(|parameter| (parameter.key.clone(), parameter.section)).collect();
        let callee = call.callee().map_or("", |callee| callee.node().text()).to_owned();
        let arguments = self.arguments(call, &parameters, &super::types::short(&callee))?;
        let node = call.node();
        let (enable, enabled) = (arguments.enable, arguments.enabled);
        let lower = |me: &mut Self| -> Lowered<()> {
            me.pass_all(&frame.parameters, &arguments.given, node)?;
            emit(me);
            for (number, target, negated) in &arguments.outputs {
                me.take_output(&frame.parameters[*number].spot, *target, *negated)?;
            }
            Ok(())
        };
        match (enable, enabled) {
            (None, None) => lower(self)?,
            (enable, enabled) => self.enabled(enable, enabled, lower)?,
        }
        Ok(frame.result.as_ref().map(|result| {
            let spot = self.followed(result.clone());
            self.read(spot, node)
        }))
    }
}

/// How a member's routine is called.
pub(super) enum Target {
    /// As it is, on an instance.
    Routine(crate::machine::program::RoutineId, Location),
    /// By the class of the instance.
    Dispatch(usize, crate::machine::program::Value),
}
