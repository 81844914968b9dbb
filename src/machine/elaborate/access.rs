//! What stands left of `:=` or is read: variables, fields, elements, bits, what references refer to, properties.

use super::classes::layout_key;
use super::{Elaborator, Lowered};
use crate::library::names::fold;
use crate::library::{ItemId, ItemKind};
use crate::machine::program::{Base, Location};
use crate::semantics::expr::{Expr, ExprKind};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::types::is_whole;
use crate::semantics::typing::{Operand, Type};
use crate::syntax::Node;
use crate::syntax::ast::{Expression, FieldExpression};

use super::expressions::Val;

/// A place in memory with its type.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Spot {
    pub(super) location: Location,
    pub(super) type_: Type,
    pub(super) constant: bool,
}

/// What an expression names.
#[derive(Clone, Debug)]
pub(super) enum Designated {
    /// A variable; a reference is not followed yet.
    Spot(Spot),
    /// A value.
    Value(Operand<Location>),
    /// A bit of a variable.
    Bit(Spot, u32),
    /// A method, property or action of an instance; `class` is from where it is looked up.
    Member { this: Spot, item: ItemId, class: ItemId },
    /// An item: a function, a program, a list of globals, a type.
    Item(ItemId),
    /// `SUPER^`.
    Super(ItemId),
    /// A path that means nothing yet: a namespace or a library.
    Path(Vec<String>),
    /// Characters.
    Text(Vec<u16>, bool),
}

impl<'c> Elaborator<'c> {
    /// What an expression names.
    pub(super) fn designate(&mut self, expression: Expression<'c>) -> Lowered<Designated> {
        let node = expression.node();
        match expression {
            Expression::Name(name) => {
                let found = if name.is_global() {
                    self.lookup_outside(name.text(), node)?
                } else {
                    self.lookup(name.text(), node)?
                };
                Ok(found.unwrap_or_else(|| Designated::Path(vec![name.text().to_owned()])))
            }
            Expression::Field(field) => self.field_of(field, node),
            Expression::Bit(bit) => self.bit_of(bit, node),
            Expression::Index(index) => self.element_of(index, node),
            Expression::Deref(_) => self.dereferenced(expression, node),
            Expression::Paren(_) => {
                let inner = expression.inner().ok_or_else(|| self.incomplete(node))?;
                self.designate(inner)
            }
            Expression::Address(token, _) => self.address(token.text(), None, node).map(Designated::Spot),
            Expression::EnumLiteral(literal) => {
                let mut parts: Vec<&str> = Vec::new();
                if let Some(Expression::Name(name)) = literal.qualifier() {
                    parts.push(name.text());
                }
                parts.push(literal.type_name());
                if let Some(Designated::Item(item)) = self.global_path(&parts)?
                    && let Some(value) = self.enum_value(item, literal.value())?
                {
                    return Ok(Designated::Value(value));
                }
                // `INT#N` with a constant: a conversion.
                Err(self.unknown(&format!("{}#{}", literal.type_name(), literal.value()), node))
            }
            _ => match self.value(expression)? {
                Val::Scalar(operand) => Ok(Designated::Value(operand)),
                Val::Memory(spot) => Ok(Designated::Spot(spot)),
                Val::Text(codes, wide) => Ok(Designated::Text(codes, wide)),
            },
        }
    }

    /// A variable that an expression names, references followed.
    pub(super) fn spot(&mut self, expression: Expression<'c>) -> Lowered<Spot> {
        let node = expression.node();
        match self.designate(expression)? {
            Designated::Spot(spot) => Ok(self.followed(spot)),
            Designated::Member { this, item, class } if self.world.item(item).kind == ItemKind::Property => {
                match self.get_property(&this, item, class, node)? {
                    Val::Memory(spot) => Ok(spot),
                    Val::Scalar(operand) => self.kept(operand),
                    Val::Text(..) => Err(self.incomplete(node)),
                }
            }
            Designated::Item(item) if self.world.item(item).kind == ItemKind::Program => self.program_instance(item),
            Designated::Item(item) if self.data_block(item)?.is_some() => {
                self.data_block(item)?.ok_or_else(|| self.incomplete(node))
            }
            Designated::Value(operand) => self.kept(operand),
            Designated::Path(path) => Err(self.unknown(&path.join("."), node)),
            _ => Err(self.unsupported("a value where a variable is needed", node, "this is no variable")),
        }
    }

    /// A value in a temporary slot, as a variable.
    pub(super) fn kept(&mut self, operand: Operand<Location>) -> Lowered<Spot> {
        let (expr, type_) = operand.settled()?;
        let location = self.spilled(expr);
        Ok(self.followed(Spot { location, type_, constant: false }))
    }

    /// What a reference that is followed by itself refers to.
    pub(super) fn followed(&self, spot: Spot) -> Spot {
        match &spot.type_ {
            Type::Reference { target, implicit: true } => {
                let target = target.as_ref().clone();
                let referent = Spot { location: referent(spot.read()), type_: target, constant: false };
                self.followed(referent)
            }
            _ => spot,
        }
    }

    fn dereferenced(&mut self, expression: Expression<'c>, node: Node<'c>) -> Lowered<Designated> {
        let inner = expression.inner().ok_or_else(|| self.incomplete(node))?;
        match inner.unwrapped() {
            Expression::This(_) => match self.body.class {
                Some(class) => Ok(Designated::Spot(Spot::this(self.instance_type(class)))),
                None => Err(self.unsupported("a name that means nothing here", node, "`THIS` outside of a block")),
            },
            Expression::Super(_) => self.super_class(node).map(Designated::Super),
            _ => {
                let operand = self.operand(inner)?;
                let (expr, type_) = operand.settled()?;
                match type_ {
                    Type::Reference { target, .. } => {
                        let location = referent(expr);
                        Ok(Designated::Spot(Spot { location, type_: target.as_ref().clone(), constant: false }))
                    }
                    other => {
                        let message = format!("`^` behind a value of type `{other}`");
                        Err(self.unsupported("types that do not fit", node, message))
                    }
                }
            }
        }
    }

    /// The block that the one whose text this is extends.
    pub(super) fn super_class(&self, node: Node<'c>) -> Lowered<ItemId> {
        let owner = self.owner(self.body.item);
        match self.world.base(owner) {
            Some(Ok(base)) => Ok(base),
            Some(Err(name)) => Err(self.without_source(owner, &name)),
            None => {
                Err(self.unsupported("a name that means nothing here", node, "`SUPER` in a block that extends none"))
            }
        }
    }

    fn field_of(&mut self, field: FieldExpression<'c>, node: Node<'c>) -> Lowered<Designated> {
        let base = field.base().ok_or_else(|| self.incomplete(node))?;
        let name = field.field();
        let designated = match base.unwrapped() {
            Expression::Super(_) => Designated::Super(self.super_class(node)?),
            Expression::This(_) => match self.body.class {
                Some(class) => Designated::Spot(Spot::this(self.instance_type(class))),
                None => {
                    return Err(self.unsupported("a name that means nothing here", node, "`THIS` outside of a block"));
                }
            },
            _ => self.designate(base)?,
        };
        self.field_of_designated(designated, name, node)
    }

    /// The field of this name of what was designated.
    pub(super) fn field_of_designated(
        &mut self,
        designated: Designated,
        name: &str,
        node: Node<'c>,
    ) -> Lowered<Designated> {
        match designated {
            Designated::Path(mut path) => {
                if let Some(step) = self.step_field(&path, name)? {
                    return Ok(step);
                }
                path.push(name.to_owned());
                let parts: Vec<&str> = path.iter().map(String::as_str).collect();
                Ok(self.global_path(&parts)?.unwrap_or(Designated::Path(path)))
            }
            Designated::Item(item) => self.field_of_item(item, name, node),
            Designated::Super(class) => match self.member(class, name) {
                Some(item) => {
                    let this = Spot::this(self.instance_type(self.body.class.unwrap_or(class)));
                    Ok(Designated::Member { this, item, class })
                }
                None => self.lookup(name, node)?.ok_or_else(|| self.unknown(name, node)),
            },
            Designated::Spot(spot) => {
                let spot = self.followed(spot);
                self.field_of_spot(&spot, name, node)
            }
            Designated::Member { .. } | Designated::Value(_) => {
                let spot = self.spot_of(designated, node)?;
                self.field_of_spot(&spot, name, node)
            }
            Designated::Bit(..) | Designated::Text(..) => {
                Err(self.unsupported("types that do not fit", node, format!("no field `{name}` here")))
            }
        }
    }

    pub(super) fn spot_of(&mut self, designated: Designated, node: Node<'c>) -> Lowered<Spot> {
        let spot = match designated {
            Designated::Member { this, item, class } => match self.get_property(&this, item, class, node)? {
                Val::Memory(spot) => spot,
                Val::Scalar(operand) => return self.kept(operand),
                Val::Text(..) => return Err(self.incomplete(node)),
            },
            Designated::Value(operand) => return self.kept(operand),
            Designated::Spot(spot) => spot,
            _ => return Err(self.unsupported("a value where a variable is needed", node, "this is no variable")),
        };
        Ok(self.followed(spot))
    }

    /// `Gvl.x`, `Enum.Value`, `Program.x`, `Block.CONSTANT`.
    fn field_of_item(&mut self, item: ItemId, name: &str, node: Node<'c>) -> Lowered<Designated> {
        let kind = self.world.item(item).kind;
        let found = match kind {
            ItemKind::GlobalVariables => match self.data_block(item)? {
                Some(block) => return self.field_of_spot(&block, name, node),
                None => self.global_named(item, name)?,
            },
            ItemKind::Enum => self.enum_value(item, name)?.map(Designated::Value),
            ItemKind::Program => {
                let spot = self.program_instance(item)?;
                return self.field_of_spot(&spot, name, node);
            }
            ItemKind::FunctionBlock | ItemKind::Class | ItemKind::Function => self.class_constant(item, name)?,
            _ => None,
        };
        found.ok_or_else(|| self.unknown(&format!("{}.{name}", self.world.item(item).name), node))
    }

    fn class_constant(&mut self, item: ItemId, name: &str) -> Lowered<Option<Designated>> {
        let key = fold(name);
        for scope in self.world.lineage(item) {
            let decls = self.decls(scope);
            if let Some(n) = decls.iter().position(|decl| decl.constant && fold(decl.name) == key)
                && let Some(value) = self.constant_variable(scope, n)?
            {
                return Ok(Some(Designated::Value(value)));
            }
        }
        Ok(None)
    }

    fn field_of_spot(&mut self, spot: &Spot, name: &str, node: Node<'c>) -> Lowered<Designated> {
        if layout_key(&spot.type_).is_some()
            && let Some(layout) = self.layout_of(&spot.type_)?
            && let Some(field) = layout.field(name)
        {
            return Ok(Designated::Spot(spot.field(field)));
        }
        match &spot.type_ {
            Type::Instance { item, .. } | Type::Interface { item, .. } => {
                if let Some(member) = self.member_of_type(*item, name) {
                    return Ok(Designated::Member { this: spot.clone(), item: member, class: *item });
                }
                let constant = self.class_constant(*item, name)?;
                let message = format!("`{}` has no member `{name}`", spot.type_);
                constant.ok_or_else(|| self.unsupported("a name without source", node, message))
            }
            type_ if type_.scalar().is_some_and(is_whole) => {
                let number = match self.lookup(name, node)? {
                    Some(Designated::Value(value)) => value.number(),
                    _ => None,
                };
                self.numbered_bit(spot, number, name, node)
            }
            type_ => {
                let message = format!("`{type_}` has no field `{name}`");
                Err(self.unsupported("types that do not fit", node, message))
            }
        }
    }

    /// The member of a block, or of an interface and those that it extends.
    fn member_of_type(&self, item: ItemId, name: &str) -> Option<ItemId> {
        if let Some(found) = self.member(item, name) {
            return Some(found);
        }
        let bases = self.world.targets(item, &self.world.item(item).extends);
        let interfaces = self.world.targets(item, &self.world.item(item).implements);
        bases.into_iter().chain(interfaces).flatten().filter(|base| *base != item).find_map(|base| {
            // Interfaces may extend several others; cycles among them are cut by the depth of what is declared.
            self.world.lineage(base).into_iter().find_map(|at| self.member(at, name))
        })
    }

    pub(super) fn numbered_bit(
        &mut self,
        spot: &Spot,
        number: Option<i128>,
        name: &str,
        node: Node<'c>,
    ) -> Lowered<Designated> {
        let width = spot.type_.scalar().map_or(0, Scalar::width);
        match number.and_then(|number| u32::try_from(number).ok()) {
            Some(number) if number < width => Ok(Designated::Bit(spot.clone(), number)),
            _ => Err(self.unsupported("types that do not fit", node, format!("`{}` has no bit `{name}`", spot.type_))),
        }
    }

    /// The location with every part that is calculated kept in a temporary slot, so that it stays the same.
    pub(super) fn frozen(&mut self, mut location: Location) -> Location {
        for index in &mut location.indices {
            if !matches!(index.value.kind, ExprKind::Const(_)) {
                let value = index.value.clone();
                index.value = self.spilled_read(value);
            }
        }
        if let Base::Referent(value) = &mut location.base {
            let kept = value.as_ref().clone();
            **value = self.spilled_read(kept);
        }
        location
    }

    fn spilled_read(&mut self, expr: Expr<Location>) -> Expr<Location> {
        let (scalar, place) = (expr.scalar, expr.place);
        let location = self.spilled(expr);
        Expr { kind: ExprKind::Read(location), scalar, place }
    }
}

/// What a reference refers to.
pub(super) fn referent(reference: Expr<Location>) -> Location {
    Location { base: Base::Referent(Box::new(reference)), offset: 0, indices: Vec::new() }
}
