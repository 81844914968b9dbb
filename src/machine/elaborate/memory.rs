//! Slots: how many a type needs, of which scalar types, and where variables are put.

use super::classes::layout_key;
use super::world::Decl;
use super::{Elaborator, Lowered, Stub, Unsupported};
use crate::library::{ItemId, Section};
use crate::machine::program::{Base, Location, Role, Slot, SlotId};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::Type;
use crate::semantics::typing::types::name as scalar_name;
use crate::syntax::ast::{AstNode, VarDecl};
use crate::text::Place;

/// What a variable is put into memory as.
#[derive(Clone, Debug)]
pub(super) struct Placement {
    /// The full path.
    pub(super) name: String,
    pub(super) role: Role,
    pub(super) place: Option<Place>,
}

impl<'c> Elaborator<'c> {
    /// How many slots a type needs.
    pub(super) fn size(&mut self, type_: &Type, var: VarDecl<'c>) -> Lowered<u32> {
        let size = self.slots_of(type_)?;
        size.filter(|size| *size <= self.options.memory_limit).ok_or_else(|| {
            let message = format!("`{type_}` needs more than {} slots of memory", self.options.memory_limit);
            self.unsupported("more memory than the limit", var.node(), message)
        })
    }

    /// How many slots a type needs; `None` for more than can be counted.
    pub(super) fn slots_of(&mut self, type_: &Type) -> Lowered<Option<u32>> {
        Ok(match type_ {
            Type::Text { capacity, .. } => capacity.checked_add(1),
            Type::Array(array) => {
                let count = array.dimensions.iter().try_fold(1_u32, |product, (_, count)| product.checked_mul(*count));
                let element = self.slots_of(&array.element)?;
                count.zip(element).and_then(|(count, element)| count.checked_mul(element))
            }
            Type::Structure { .. } | Type::Instance { .. } => self.layout_of(type_)?.map(|layout| layout.size),
            _ => Some(1),
        })
    }

    /// The same, of a type that has been put into memory already.
    pub(super) fn known_size(&mut self, type_: &Type) -> Lowered<u32> {
        self.slots_of(type_)?.ok_or_else(|| {
            Unsupported::new("more memory than the limit", None, format!("`{type_}` has too many elements"))
        })
    }

    /// Puts a variable with these initial values into memory.
    pub(super) fn put(&mut self, type_: &Type, values: &[u64], placement: &Placement) -> Lowered<SlotId> {
        let first = SlotId(u32::try_from(self.slots.len()).unwrap_or(u32::MAX));
        if self.slots.len() + values.len() > self.options.memory_limit as usize {
            let message =
                format!("`{}` does not fit into {} slots of memory", placement.name, self.options.memory_limit);
            return Err(Unsupported::new("more memory than the limit", placement.place, message));
        }
        self.put_parts(type_, values, placement)?;
        Ok(first)
    }

    fn put_parts(&mut self, type_: &Type, values: &[u64], placement: &Placement) -> Lowered<()> {
        match type_ {
            Type::Text { wide, .. } => {
                let scalar = Scalar::Bits(if *wide { 16 } else { 8 });
                for (n, value) in values.iter().enumerate() {
                    self.push(format!("{}[{n}]", placement.name), scalar, *value, None, placement);
                }
            }
            Type::Array(array) => {
                let size = self.known_size(&array.element)? as usize;
                for (n, part) in values.chunks(size.max(1)).enumerate() {
                    let name = format!("{}{}", placement.name, subscript(&array.dimensions, n));
                    self.put_parts(&array.element, part, &Placement { name, ..placement.clone() })?;
                }
            }
            Type::Structure { .. } => self.put_fields(type_, values, placement)?,
            Type::Instance { item, .. } => {
                let header = self.push(placement.name.clone(), Scalar::Ref, 0, None, placement);
                self.instances.push((header, *item));
                self.put_fields(type_, values, placement)?;
            }
            _ => {
                let scalar = type_.scalar().unwrap_or(Scalar::Ref);
                let value = values.first().copied().unwrap_or(0);
                self.push(placement.name.clone(), scalar, value, type_.range(), placement);
            }
        }
        Ok(())
    }

    fn put_fields(&mut self, type_: &Type, values: &[u64], placement: &Placement) -> Lowered<()> {
        let Some(layout) = self.layout_of(type_)? else { return Ok(()) };
        let arbitrary = self.is_arbitrary(type_);
        let mut last = None;
        for field in &layout.fields {
            let size = self.known_size(&field.type_)? as usize;
            // The members of a union are one slot; a structure without members is none, and the next one begins where it does.
            if size == 0 || last == Some(field.offset) {
                continue;
            }
            last = Some(field.offset);
            let from = field.offset as usize;
            let part = values.get(from..from + size).unwrap_or_default();
            let name = format!("{}.{}", placement.name, field.name);
            let constant = field.decl.is_some_and(|decl| decl.constant);
            let role = match field.section {
                _ if constant => Role::Constant,
                Section::Output if arbitrary => Role::Arbitrary,
                _ => placement.role,
            };
            let slot = self.slots.len();
            self.put_parts(&field.type_, part, &Placement { name, role, place: placement.place })?;
            let elapsed = field.decl.is_some_and(|decl| decl.has_attribute("rungbook.elapsed"));
            if elapsed || (field.decl.is_none() && super::sfc::is_clock(&field.key)) {
                self.add_clock(slot, &field.type_);
            }
        }
        Ok(())
    }

    /// Whether an instance is one of a stub whose outputs have any value.
    fn is_arbitrary(&mut self, type_: &Type) -> bool {
        let Type::Instance { item, .. } = type_ else { return false };
        self.stub(*item).is_some_and(|stub| stub.arbitrary)
    }

    /// The stub that stands for an item, which is assumed from now on.
    pub(super) fn stub(&mut self, item: ItemId) -> Option<&'c Stub> {
        let stub = self.options.stubs.get(self.world.stub(item)?)?;
        let name = &self.world.item(self.owner(item)).name;
        self.assumptions.insert(match stub.arbitrary {
            true => format!("the outputs of `{name}` are arbitrary"),
            false => format!("`{name}` is a stub"),
        });
        Some(stub)
    }

    /// A variable to which the cycle time is added in each cycle.
    fn add_clock(&mut self, slot: usize, type_: &Type) {
        let unit = if type_.scalar().is_some_and(|scalar| scalar.width() == 64) { 1 } else { 1_000_000 };
        let slot = SlotId(u32::try_from(slot).unwrap_or(u32::MAX));
        self.clocks.push((slot, self.options.cycle_time / unit));
    }

    fn push(
        &mut self,
        name: String,
        scalar: Scalar,
        initial: u64,
        range: Option<(i128, i128)>,
        placement: &Placement,
    ) -> SlotId {
        let id = SlotId(u32::try_from(self.slots.len()).unwrap_or(u32::MAX));
        self.slots.push(Slot { name, scalar, initial, role: placement.role, range, place: placement.place });
        id
    }

    /// A slot of a scalar type for what is in the middle of a calculation.
    pub(super) fn temporary(&mut self, scalar: Scalar) -> Location {
        let name = format!("${}{}", scalar_name(scalar).to_lowercase(), self.slots.len());
        let placement = Placement { name: name.clone(), role: Role::Temporary, place: None };
        at(self.push(name, scalar, 0, None, &placement))
    }

    /// A string for what is in the middle of a calculation.
    pub(super) fn temporary_text(&mut self, capacity: u32, wide: bool) -> Lowered<Location> {
        let name = format!("$text{}", self.slots.len());
        let type_ = Type::Text { capacity, wide };
        let placement = Placement { name, role: Role::Temporary, place: None };
        let values = vec![0; capacity as usize + 1];
        self.put(&type_, &values, &placement).map(at)
    }

    /// Puts a variable that is declared in an item but in no instance.
    pub(super) fn put_declared(
        &mut self,
        item: ItemId,
        n: usize,
        decl: &Decl<'c>,
        role: Role,
    ) -> Lowered<(SlotId, Type)> {
        let type_ = self.type_of(item, n)?;
        self.size(&type_, decl.var)?;
        let values = self.initial_values(item, decl, &type_)?;
        let name = format!("{}.{}", self.world.qualified_name(item), decl.name);
        let role = if decl.constant { Role::Constant } else { role };
        let placement = Placement { name, role, place: self.place(decl.var.node()) };
        let slot = self.put(&type_, &values.values, &placement)?;
        if decl.has_attribute("rungbook.elapsed") {
            self.add_clock(slot.0 as usize, &type_);
        }
        Ok((slot, type_))
    }

    /// The scalar types of the slots of a type, up to the first that is not the same as the ones before: what a pointer sees.
    pub(super) fn leading_scalar(&mut self, type_: &Type) -> Lowered<Option<Scalar>> {
        Ok(match type_ {
            Type::Text { wide, .. } => Some(Scalar::Bits(if *wide { 16 } else { 8 })),
            Type::Array(array) => self.leading_scalar(&array.element)?,
            Type::Structure { .. } => {
                let layout = layout_key(type_).map(|key| self.layout(key)).transpose()?;
                let mut scalars = Vec::new();
                for field in layout.iter().flat_map(|layout| &layout.fields) {
                    scalars.push(self.leading_scalar(&field.type_)?.map(Scalar::width));
                }
                let first = layout.and_then(|layout| layout.fields.first().map(|field| field.type_.clone()));
                match first {
                    Some(first) if scalars.windows(2).all(|pair| pair[0] == pair[1]) => self.leading_scalar(&first)?,
                    _ => None,
                }
            }
            Type::Instance { .. } => None,
            _ => type_.scalar(),
        })
    }
}

/// A location that begins at a slot.
pub(super) const fn at(slot: SlotId) -> Location {
    Location { base: Base::Slot(slot), offset: 0, indices: Vec::new() }
}

/// The subscript of the `n`th element in memory.
pub(super) fn subscript(dimensions: &[(i64, u32)], n: usize) -> String {
    let mut rest = n as u64;
    let mut parts = Vec::new();
    for (low, count) in dimensions.iter().rev() {
        let count = u64::from((*count).max(1));
        let index = low.saturating_add_unsigned(rest % count);
        parts.push(index.to_string());
        rest /= count;
    }
    parts.reverse();
    format!("[{}]", parts.join(","))
}
