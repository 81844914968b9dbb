//! References: `ADR`, `REF=`, pointers and interface variables that are assigned.

use super::access::{Designated, Spot};
use super::expressions::Val;
use super::{Elaborator, Lowered};
use crate::library::ItemKind;
use crate::machine::program::{Location, StatementKind};
use crate::semantics::expr::Expr;
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::{Operand, Type, constant};
use crate::syntax::Node;
use crate::syntax::ast::Expression;

impl<'c> Elaborator<'c> {
    /// `ADR(x)`.
    pub(super) fn address_of(&mut self, expression: Expression<'c>, node: Node<'c>) -> Lowered<Val> {
        let spot = self.spot(expression)?;
        let mut address = spot.address();
        address.place = self.place(node);
        Ok(Val::Scalar(Operand::Typed(address, spot.pointer_type())))
    }

    /// `target REF= expression`, and what binds an in-out.
    pub(super) fn bind_reference(&mut self, target: &Spot, expression: Expression<'c>) -> Lowered<()> {
        let node = expression.node();
        let Type::Reference { target: inner, .. } = &target.type_ else {
            let message = format!("`REF=` on a variable of type `{}`", target.type_);
            return Err(self.unsupported("types that do not fit", node, message));
        };
        let inner = inner.as_ref().clone();
        let value = match self.designate(expression)? {
            Designated::Spot(spot) => {
                let spot = self.followed(spot);
                self.bound(&inner, spot, node)?
            }
            Designated::Value(operand) if operand.number() == Some(0) => constant(Scalar::Ref, 0, self.place(node)),
            Designated::Value(Operand::Typed(expr, Type::Reference { target, .. })) => {
                self.check_target(&inner, &target, node)?;
                expr
            }
            Designated::Path(path) => return Err(self.unknown(&path.join("."), node)),
            _ => return Err(self.unsupported("a value where a variable is needed", node, "this is no variable")),
        };
        self.emit(StatementKind::Assign { target: target.location.clone(), value, range: None });
        Ok(())
    }

    /// The reference to a variable, as one to `inner`. A pointer or an interface variable in an instance's place is followed.
    pub(super) fn bound(&mut self, inner: &Type, spot: Spot, node: Node<'c>) -> Lowered<Expr<Location>> {
        self.check_target(inner, &spot.type_, node)?;
        let mut address = spot.address();
        address.place = self.place(node);
        Ok(address)
    }

    /// Whether what a reference to `seen` sees is what lies there.
    fn check_target(&mut self, seen: &Type, there: &Type, node: Node<'c>) -> Lowered<()> {
        if seen == there || matches!(seen, Type::Null) || matches!(there, Type::Null) {
            return Ok(());
        }
        let fits = match (seen, there) {
            (Type::Instance { item: base, .. }, Type::Instance { item, .. }) => self.world.conforms(*item, *base),
            (Type::Text { capacity: a, wide: v }, Type::Text { capacity: b, wide: w }) => a <= b && v == w,
            (Type::Array(a), Type::Array(b)) if a.element == b.element => true,
            _ => {
                let (a, b) = (self.leading_scalar(seen)?, self.leading_scalar(there)?);
                matches!((a, b), (Some(a), Some(b)) if a.width() == b.width())
            }
        };
        if fits {
            return Ok(());
        }
        let message = format!("a reference to `{seen}` that refers to `{there}`");
        Err(self.unsupported("a reference that reinterprets memory", node, message))
    }

    /// The value of an expression for a variable of a reference or interface type.
    pub(super) fn reference_value(
        &mut self,
        type_: &Type,
        value: Designated,
        node: Node<'c>,
    ) -> Lowered<Expr<Location>> {
        match (type_, value) {
            (_, Designated::Value(operand)) if operand.number() == Some(0) => {
                Ok(constant(Scalar::Ref, 0, self.place(node)))
            }
            (Type::Interface { item: interface, .. }, Designated::Spot(spot)) => {
                let spot = self.followed(spot);
                match &spot.type_ {
                    Type::Instance { item, .. } if self.world.conforms(*item, *interface) => Ok(spot.address()),
                    // A query at run time whether a block implements it is not made: it is taken for granted.
                    Type::Interface { .. } | Type::Reference { .. } => Ok(spot.read()),
                    other => {
                        let message = format!("`{other}` does not implement `{type_}`");
                        Err(self.unsupported("types that do not fit", node, message))
                    }
                }
            }
            (Type::Interface { .. }, Designated::Value(Operand::Typed(expr, _))) if expr.scalar == Scalar::Ref => {
                Ok(expr)
            }
            (
                Type::Reference { target, .. },
                Designated::Value(Operand::Typed(expr, Type::Reference { target: there, .. })),
            ) => {
                self.check_target(target, &there, node)?;
                Ok(expr)
            }
            (Type::Reference { target, .. }, Designated::Spot(spot)) => match &self.followed(spot.clone()).type_ {
                Type::Reference { target: there, .. } => {
                    self.check_target(target, there, node)?;
                    Ok(self.followed(spot).read())
                }
                Type::Null => Ok(self.followed(spot).read()),
                other => {
                    let message = format!("a value of type `{other}` for a `{type_}`");
                    Err(self.unsupported("a reference that reinterprets memory", node, message))
                }
            },
            (_, Designated::Value(Operand::Typed(expr, _))) if expr.scalar == Scalar::Ref => Ok(expr),
            (_, Designated::Spot(spot)) => {
                let spot = self.followed(spot);
                match spot.type_.scalar() {
                    Some(Scalar::Ref) => Ok(spot.read()),
                    _ => Err(self.unsupported(
                        "a reference that reinterprets memory",
                        node,
                        format!("a value of type `{}` for a `{type_}`", spot.type_),
                    )),
                }
            }
            (_, Designated::Member { this, item, class }) if self.world.item(item).kind == ItemKind::Property => {
                match self.get_property(&this, item, class, node)? {
                    Val::Scalar(operand) => self.reference_value(type_, Designated::Value(operand), node),
                    Val::Memory(spot) => self.reference_value(type_, Designated::Spot(spot), node),
                    Val::Text(..) => Err(self.incomplete(node)),
                }
            }
            (_, Designated::Path(path)) => Err(self.unknown(&path.join("."), node)),
            _ => {
                let text = super::types::short(node.text());
                Err(self.unsupported("a reference that reinterprets memory", node, format!("`{text}` for a `{type_}`")))
            }
        }
    }
}
