//! Properties, read and written by their accessors, and `FB_Init`.

use super::access::Spot;
use super::expressions::Val;
use super::routines::{Parameter, RoutineKey};
use super::{Elaborator, Lowered};
use crate::library::names::fold;
use crate::library::{ItemId, ItemKind, Section};
use crate::machine::program::{Base, Location, StatementKind};
use crate::semantics::typing::Operand;
use crate::syntax::Node;
use crate::syntax::ast::{Argument, Expression};

impl<'c> Elaborator<'c> {
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
