//! Initial values: of declarations, with structures, arrays and repetitions; and what must be calculated when the program
//! starts, because it is not constant: addresses, calls, `FB_Init`.

use std::rc::Rc;
use std::sync::Arc;

use super::access::Spot;
use super::classes::{Field, Layout, LayoutKey, layout_key};
use super::constants::{bits_of, is_constant};
use super::world::Decl;
use super::{Elaborator, Lowered};
use crate::library::{ItemId, ItemKind};
use crate::machine::program::Location;
use crate::semantics::typing::convert::assigned;
use crate::semantics::typing::literal::{self, Constant};
use crate::semantics::typing::{Array, Type};
use crate::syntax::ast::{self, AstNode, Expression};

/// The values of all slots of a type, and whether a part of them is calculated at the start.
#[derive(Clone, Debug, Default)]
pub(super) struct Defaults {
    pub(super) values: Vec<u64>,
    pub(super) dynamic: bool,
}

impl<'c> Elaborator<'c> {
    /// The values of a variable without an initial value of its own.
    pub(super) fn defaults(&mut self, type_: &Type) -> Lowered<Defaults> {
        Ok(match type_ {
            Type::Array(array) => {
                let element = self.defaults(&array.element)?;
                let size = element.values.len().max(1);
                let count = self.known_size(type_)? as usize / size;
                Defaults { values: element.values.repeat(count), dynamic: element.dynamic }
            }
            Type::Structure { .. } | Type::Instance { .. } => {
                let Some(key) = layout_key(type_) else { return Ok(Defaults::default()) };
                (*self.layout_defaults(key)?).clone()
            }
            Type::Text { capacity, .. } => Defaults { values: vec![0; *capacity as usize + 1], dynamic: false },
            _ => Defaults { values: vec![self.scalar_default(type_)?], dynamic: false },
        })
    }

    /// Zero, the first value of an enumeration, the least number of a subrange that does not hold zero.
    pub(super) fn scalar_default(&mut self, type_: &Type) -> Lowered<u64> {
        Ok(match type_ {
            Type::Enumeration { item: Some(item), base, .. } => {
                if let Some(initial) = self.world.type_initial(*item)
                    && let Some(value) = self.constant_operand(initial, *item)?
                {
                    return Ok(bits_of(&assigned(value, type_)?.expr).unwrap_or(0));
                }
                self.enum_values(*item)?.first().map_or(0, |(_, number)| base.bits(*number))
            }
            Type::Subrange { base, low, high } if *low > 0 || *high < 0 => base.bits(*low),
            _ => 0,
        })
    }

    fn layout_defaults(&mut self, key: LayoutKey) -> Lowered<Rc<Defaults>> {
        if let Some(known) = self.defaults.get(&key) {
            return Ok(Rc::clone(known));
        }
        let layout = self.layout(key)?;
        let mut all = Defaults { values: vec![0; layout.size as usize], dynamic: false };
        if let LayoutKey::Class(item) = key {
            all.dynamic = self.find_method(item, "FB_Init").is_some();
        }
        let outer = self.body.class;
        if let LayoutKey::Class(item) = key {
            self.body.class = Some(item);
        }
        let filled = self.fill_fields(&layout, &mut all);
        self.body.class = outer;
        filled?;
        let all = Rc::new(all);
        self.defaults.insert(key, Rc::clone(&all));
        Ok(all)
    }

    fn fill_fields(&mut self, layout: &Layout<'c>, all: &mut Defaults) -> Lowered<()> {
        for field in &layout.fields {
            let part = match &field.decl {
                Some(decl) => self.initial_values(field.owner, decl, &field.type_)?,
                None => self.defaults(&field.type_)?,
            };
            let from = field.offset as usize;
            for (slot, value) in all.values.iter_mut().skip(from).zip(part.values) {
                *slot = value;
            }
            all.dynamic |= part.dynamic;
        }
        Ok(())
    }

    /// The initial values of a declared variable.
    pub(super) fn initial_values(&mut self, scope: ItemId, decl: &Decl<'c>, type_: &Type) -> Lowered<Defaults> {
        let mut all = match self.alias_initial(decl, scope) {
            Some((initial, item)) if decl.var.initial().is_none() => {
                let mut all = self.defaults(type_)?;
                all.dynamic |= !self.fill(type_, initial, item, &mut all.values)?;
                return Ok(all);
            }
            _ => self.defaults(type_)?,
        };
        if matches!(type_, Type::Reference { implicit: true, .. }) && decl.section == crate::library::Section::InOut {
            return Ok(all);
        }
        if let Some(initial) = decl.var.initial() {
            let reference = decl.var.is_reference_assignment();
            all.dynamic |= reference || !self.fill(type_, initial, scope, &mut all.values)?;
        }
        Ok(all)
    }

    /// The initial value that the named type of a variable gives it.
    fn alias_initial(&mut self, decl: &Decl<'c>, scope: ItemId) -> Option<(Expression<'c>, ItemId)> {
        let Some(ast::Type::Named(named)) = decl.var.type_() else { return None };
        let path = named.path()?;
        let parts: Vec<&str> = path.segments().map(|segment| segment.text).collect();
        match self.world.path(&parts, scope)? {
            crate::library::names::Found::Item(item)
                if matches!(self.world.item(item).kind, ItemKind::Alias | ItemKind::Subrange) =>
            {
                Some((self.world.type_initial(item)?, item))
            }
            _ => None,
        }
    }

    /// Writes the values of an initializer; whether all of it is constant.
    fn fill(&mut self, type_: &Type, initial: Expression<'c>, scope: ItemId, out: &mut [u64]) -> Lowered<bool> {
        match (type_, initial.unwrapped()) {
            (Type::Array(array), Expression::Array(list)) => {
                let array = Arc::clone(array);
                self.fill_array(&array, list.elements().collect(), scope, out)
            }
            (Type::Array(array), Expression::Repeat(_)) => {
                let array = Arc::clone(array);
                self.fill_array(&array, vec![initial], scope, out)
            }
            (Type::Structure { .. } | Type::Instance { .. }, Expression::Struct(fields)) => {
                let layout = self.layout_of(type_)?;
                let mut constant = true;
                for argument in fields.fields() {
                    let name = argument.name().map_or("", |name| name.text());
                    let field = layout.as_ref().and_then(|layout| layout.field(name));
                    let (Some(field), Some(value)) = (field, argument.value()) else {
                        let message = format!("`{type_}` has no field `{name}`");
                        return Err(self.unsupported("an initial value of this form", argument.node(), message));
                    };
                    let size = self.known_size(&field.type_)? as usize;
                    let from = field.offset as usize;
                    let part = out.get_mut(from..from + size).unwrap_or_default();
                    constant &= self.fill(&field.type_, value, scope, part)?;
                }
                Ok(constant)
            }
            (Type::Text { capacity, .. }, Expression::Literal(value)) => {
                let value = literal::of(value);
                let Ok(Constant::Text(codes, _)) = value else {
                    return Err(self.unsupported("an initial value of this form", initial.node(), "no string"));
                };
                let codes = codes.iter().take(*capacity as usize);
                out.fill(0);
                out.iter_mut().zip(codes).for_each(|(slot, code)| *slot = u64::from(*code));
                Ok(true)
            }
            (Type::Array(_) | Type::Structure { .. } | Type::Instance { .. } | Type::Text { .. }, _) => Ok(false),
            (Type::Reference { .. } | Type::Interface { .. } | Type::Null, _) => {
                let value = self.constant_operand(initial, scope)?;
                Ok(value.is_some_and(|value| value.number() == Some(0)))
            }
            _ => {
                let Some(value) = self.constant_operand(initial, scope)?.filter(is_constant) else { return Ok(false) };
                let expr = assigned(value, type_)?.expr;
                let bits = bits_of(&expr);
                if let (Some(bits), Some(slot)) = (bits, out.first_mut()) {
                    *slot = bits;
                }
                Ok(bits.is_some())
            }
        }
    }

    /// The elements of an array in a row, nested lists and repetitions taken apart.
    fn fill_array(
        &mut self,
        array: &Array,
        elements: Vec<Expression<'c>>,
        scope: ItemId,
        out: &mut [u64],
    ) -> Lowered<bool> {
        let size = self.known_size(&array.element)? as usize;
        let inner: usize = array.dimensions.iter().skip(1).map(|(_, count)| *count as usize).product();
        let mut at = 0;
        let mut constant = true;
        for element in elements {
            let (count, values) = self.repeated(element, scope)?;
            for _ in 0..count {
                for value in &values {
                    if at >= out.len() {
                        return Ok(constant);
                    }
                    let nested = matches!(value, Expression::Array(_)) && array.dimensions.len() > 1;
                    if let (true, Expression::Array(list)) = (nested, value) {
                        let rest = Array { dimensions: array.dimensions[1..].to_vec(), element: array.element.clone() };
                        let end = (at + inner * size).min(out.len());
                        constant &= self.fill_array(&rest, list.elements().collect(), scope, &mut out[at..end])?;
                        at = end;
                    } else {
                        let end = (at + size).min(out.len());
                        constant &= self.fill(&array.element, *value, scope, &mut out[at..end])?;
                        at = end;
                    }
                }
            }
        }
        Ok(constant)
    }

    /// An element of a list: how often, and what.
    fn repeated(&mut self, element: Expression<'c>, scope: ItemId) -> Lowered<(usize, Vec<Expression<'c>>)> {
        let (count, values) = match element {
            Expression::Repeat(repeat) => {
                let count = repeat.count().ok_or_else(|| self.incomplete(element.node()))?;
                (count, repeat.values().collect())
            }
            // `N(0)` with a constant: it reads like a call.
            Expression::Call(call) => match call.callee() {
                Some(count @ Expression::Name(name)) if self.is_constant_name(name.text(), scope) => {
                    (count, call.arguments().filter_map(|argument| argument.value()).collect())
                }
                _ => return Ok((1, vec![element])),
            },
            _ => return Ok((1, vec![element])),
        };
        let number = self.constant_number(count, scope)?;
        Ok((usize::try_from(number).unwrap_or(0).min(self.options.memory_limit as usize), values))
    }

    /// Statements that calculate at the start what is not constant in a variable.
    pub(super) fn start(&mut self, scope: ItemId, decl: &Decl<'c>, spot: &Spot) -> Lowered<()> {
        if let Some(initial) = decl.var.initial() {
            if decl.var.is_reference_assignment() {
                self.bind_reference(spot, initial)?;
            } else {
                let mut values = vec![0; self.known_size(&spot.type_)? as usize];
                if !self.fill(&spot.type_, initial, scope, &mut values)? {
                    self.start_from(spot, initial)?;
                }
            }
        }
        let arguments: Vec<ast::Argument<'c>> = decl.var.constructor_arguments().collect();
        self.start_parts(spot, &arguments)
    }

    /// Assigns an initializer, part by part.
    fn start_from(&mut self, spot: &Spot, initial: Expression<'c>) -> Lowered<()> {
        match (&spot.type_, initial.unwrapped()) {
            (Type::Structure { .. } | Type::Instance { .. }, Expression::Struct(fields)) => {
                let layout = self.layout_of(&spot.type_)?;
                for argument in fields.fields() {
                    let name = argument.name().map_or("", |name| name.text());
                    let field = layout.as_ref().and_then(|layout| layout.field(name)).cloned();
                    let (Some(field), Some(value)) = (field, argument.value()) else { continue };
                    let part = spot.field(&field);
                    self.start_from(&part, value)?;
                }
                Ok(())
            }
            (Type::Array(_), Expression::Array(list)) => {
                let elements: Vec<Expression<'c>> = list.elements().collect();
                for (n, element) in elements.into_iter().enumerate() {
                    let part = self.element(spot, n)?;
                    self.start_from(&part, element)?;
                }
                Ok(())
            }
            _ => self.assign_value(spot, initial),
        }
    }

    /// `FB_Init` and the dynamic parts of instances in a variable.
    fn start_parts(&mut self, spot: &Spot, arguments: &[ast::Argument<'c>]) -> Lowered<()> {
        match &spot.type_ {
            Type::Array(_) => {
                let Defaults { dynamic: true, .. } = self.defaults(&spot.type_)? else { return Ok(()) };
                let size = self.known_size(&spot.type_)?;
                let Type::Array(array) = &spot.type_ else { return Ok(()) };
                let count = size / self.known_size(&array.element)?.max(1);
                for n in 0..count as usize {
                    let part = self.element(spot, n)?;
                    self.start_parts(&part, arguments)?;
                }
                Ok(())
            }
            Type::Structure { .. } => {
                let Defaults { dynamic: true, .. } = self.defaults(&spot.type_)? else { return Ok(()) };
                let layout = self.layout_of(&spot.type_)?;
                for field in layout.iter().flat_map(|layout| &layout.fields) {
                    if let Some(decl) = field.decl {
                        self.start(field.owner, &decl, &spot.field(field))?;
                    }
                }
                Ok(())
            }
            Type::Instance { item, .. } => self.start_instance(*item, spot, arguments),
            _ => Ok(()),
        }
    }

    fn start_instance(&mut self, item: ItemId, spot: &Spot, arguments: &[ast::Argument<'c>]) -> Lowered<()> {
        if !self.layout_defaults(LayoutKey::Class(item))?.dynamic {
            return Ok(());
        }
        self.call_start(item, &spot.location);
        if let Some(method) = self.find_method(item, "FB_Init") {
            self.call_constructor(item, method, &spot.location, arguments)?;
        }
        Ok(())
    }

    /// The body of the routine that starts an instance: its fields in their order.
    pub(super) fn start_fields(&mut self, class: ItemId) -> Lowered<()> {
        let layout = self.layout(LayoutKey::Class(class))?;
        let this = Spot::this(self.instance_type(class));
        for field in &layout.fields {
            let Some(decl) = field.decl else { continue };
            let outer = std::mem::replace(&mut self.body.item, field.owner);
            let started = self.start(field.owner, &decl, &this.field(field));
            self.body.item = outer;
            self.tell(started);
        }
        Ok(())
    }
}

impl Spot {
    /// A field of a structure or an instance.
    pub(super) fn field(&self, field: &Field<'_>) -> Self {
        let mut location: Location = self.location.clone();
        location.offset += field.offset;
        let constant = self.constant || field.decl.is_some_and(|decl| decl.constant);
        Self { location, type_: field.type_.clone(), constant }
    }
}
