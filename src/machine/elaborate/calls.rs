//! Calls: of instances, programs, functions, methods, actions and properties.

use std::rc::Rc;

use super::access::{Designated, Spot};
use super::classes::LayoutKey;
use super::expressions::Val;
use super::routines::{Frame, Parameter, RoutineKey};
use super::{Elaborator, Lowered};
use crate::library::names::fold;
use crate::library::{ItemId, ItemKind, Section};
use crate::machine::program::{Base, Location, StatementKind};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::convert::logical;
use crate::semantics::typing::{Operand, Type, constant, functions};
use crate::syntax::Node;
use crate::syntax::ast::{Argument, ArgumentKind, AstNode, CallExpression, Expression, UnaryOperator};

use super::texts;

/// The arguments of a call, by what they are for.
struct Arguments<'c> {
    /// Parameter and value, in the order of the text.
    given: Vec<(usize, Expression<'c>)>,
    /// Output parameter, target, and whether it is negated.
    outputs: Vec<(usize, Expression<'c>, bool)>,
    enable: Option<Expression<'c>>,
    enabled: Option<Expression<'c>>,
}

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

    /// Sorts the arguments of a call by the parameters of what is called.
    fn arguments(
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
    fn resolved(&mut self, this: &Spot, item: ItemId, class: ItemId) -> Lowered<(Rc<Frame>, Target)> {
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

    fn emit_call(&mut self, target: &Target) {
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

    /// All values first, then the assignments: the same function may be called in its own arguments.
    fn pass_all(&mut self, parameters: &[Parameter], given: &[(usize, Expression<'c>)], node: Node<'c>) -> Lowered<()> {
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
                    _ => {
                        let message = "an in-out that is given no variable";
                        return Err(self.unsupported("a value where a variable is needed", node, message));
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

    /// The value of a property.
    pub(super) fn get_property(&mut self, this: &Spot, item: ItemId, class: ItemId, node: Node<'c>) -> Lowered<Val> {
        let getter = self.accessor(item, ItemKind::Getter, node)?;
        let (frame, target) = self.resolved(this, getter, class)?;
        self.emit_call(&target);
        let result = frame.result.clone().ok_or_else(|| self.incomplete(node))?;
        let spot = self.followed(result);
        Ok(self.read(spot, node))
    }

    /// Assigns to a property.
    pub(super) fn set_property(
        &mut self,
        this: &Spot,
        item: ItemId,
        class: ItemId,
        value: Expression<'c>,
        node: Node<'c>,
    ) -> Lowered<()> {
        let setter = match self.accessor(item, ItemKind::Setter, node) {
            Ok(setter) => setter,
            // A property that gives a reference is assigned through it.
            Err(error) => match self.get_property(this, item, class, node)? {
                Val::Scalar(Operand::Typed(expr, type_))
                    if self.world.child(item, "Get", &[ItemKind::Getter]).is_some() =>
                {
                    return match expr.kind {
                        crate::semantics::expr::ExprKind::Read(location @ Location { base: Base::Referent(_), .. }) => {
                            self.assign_value(&Spot { location, type_, constant: false }, value)
                        }
                        _ => Err(error),
                    };
                }
                _ => return Err(error),
            },
        };
        let (frame, target) = self.resolved(this, setter, class)?;
        let parameter = frame.parameters.last().cloned().ok_or_else(|| self.incomplete(node))?;
        self.pass_all(std::slice::from_ref(&parameter), &[(0, value)], node)?;
        self.emit_call(&target);
        Ok(())
    }

    fn accessor(&self, property: ItemId, kind: ItemKind, node: Node<'c>) -> Lowered<ItemId> {
        let found = self.world.children(property).find(|child| self.world.item(*child).kind == kind);
        found.ok_or_else(|| {
            let name = &self.world.item(property).name;
            let what = if kind == ItemKind::Getter { "read" } else { "written" };
            self.unsupported("types that do not fit", node, format!("the property `{name}` cannot be {what}"))
        })
    }

    /// `FB_Init` with the arguments of a declaration.
    pub(super) fn call_constructor(
        &mut self,
        class: ItemId,
        method: ItemId,
        location: &Location,
        arguments: &[Argument<'c>],
    ) -> Lowered<()> {
        let frame = self.frame(method, Some(class))?;
        let inputs: Vec<Parameter> =
            frame.parameters.iter().filter(|parameter| parameter.section == Section::Input).cloned().collect();
        let mut given = Vec::new();
        for (n, argument) in arguments.iter().enumerate() {
            let key = argument.name().map(|name| fold(name.text()));
            let number = match &key {
                Some(key) => inputs.iter().position(|parameter| parameter.key == *key),
                None => Some(n + 2),
            };
            if let (Some(number), Some(value)) = (number.filter(|number| *number < inputs.len()), argument.value()) {
                given.push((number, value));
            }
        }
        if let Some(node) = self.world.node(method) {
            self.pass_all(&inputs, &given, node)?;
        }
        let routine = self.routine(RoutineKey::Code(method, Some(class)));
        self.emit(StatementKind::Call { routine, this: Some(location.clone()) });
        Ok(())
    }
}

/// How a member's routine is called.
enum Target {
    /// As it is, on an instance.
    Routine(crate::machine::program::RoutineId, Location),
    /// By the class of the instance.
    Dispatch(usize, crate::machine::program::Value),
}
