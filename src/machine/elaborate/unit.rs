//! The unit under test: its own instance or frame, what its slots are for, and the program around it.

use std::sync::Arc;

use super::access::Spot;
use super::classes::{Field, LayoutKey};
use super::memory::{Placement, at};
use super::routines::RoutineKey;
use super::{Elaborator, Lowered, Unsupported};
use crate::library::{ItemId, ItemKind, Section};
use crate::machine::program::{Base, NamedVariable, Program, Role, SlotId, Statement, StatementKind};
use crate::semantics::scalar::Scalar;
use crate::semantics::typing::Type;

/// The unit in memory.
struct Unit {
    this: SlotId,
    cycle: Vec<Statement>,
    /// Its variables by name, for tables.
    variables: Vec<(String, Spot, Role)>,
}

impl Elaborator<'_> {
    /// The program of the unit.
    pub(super) fn program(mut self, item: ItemId) -> Result<Program, Vec<Unsupported>> {
        let built = self.unit(item);
        let unit = self.tell(built);
        self.work();
        while self.relays() {
            self.work();
        }
        let Some(unit) = unit else { return Err(self.all_errors()) };
        let mut variables = Vec::new();
        for (path, spot, role) in &unit.variables {
            self.name_variables(path, spot, *role, &mut variables);
        }
        self.finish(item, unit.this, unit.cycle, variables)
    }

    fn unit(&mut self, item: ItemId) -> Lowered<Unit> {
        match self.world.item(item).kind {
            ItemKind::FunctionBlock | ItemKind::Class | ItemKind::Program => self.block_unit(item),
            ItemKind::Function => self.function_unit(item),
            _ => {
                let declared = self.world.item(item);
                let message = format!("`{}` is no unit that runs", declared.name);
                let error = Unsupported::new("a unit of this kind", self.world.place_of(item), message);
                Err(error.help("test a function block, a class, a program or a function"))
            }
        }
    }

    fn block_unit(&mut self, item: ItemId) -> Lowered<Unit> {
        let declared = self.world.item(item);
        if declared.is_abstract {
            let message = format!("`{}` is abstract: there is no instance of it", declared.name);
            let error = Unsupported::new("an abstract block", self.world.place_of(item), message);
            return Err(error.help("test a block that extends it"));
        }
        let type_ = self.instance_type(item);
        let defaults = self.defaults(&type_)?;
        let placement = Placement { name: declared.name.clone(), role: Role::State, place: self.world.place_of(item) };
        let this = self.put(&type_, &defaults.values, &placement)?;
        if declared.kind == ItemKind::Program {
            self.program_instances.insert(item, this);
        }
        let layout = self.layout(LayoutKey::Class(item))?;
        let whole = Spot { location: at(this), type_, constant: false };
        let mut variables = Vec::new();
        for field in layout.fields.iter().filter(|field| field.decl.is_some()) {
            let spot = whole.field(field);
            let entry = self.unit_field(item, field, spot)?;
            variables.extend(entry);
        }
        if defaults.dynamic {
            let start = at(this);
            self.at_start(item, Some(item), |me| {
                me.call_start(item, &start);
                match me.find_method(item, "FB_Init") {
                    Some(method) => me.call_constructor(item, method, &start, &[]),
                    None => Ok(()),
                }
            })?;
        }
        let routine = self.routine(RoutineKey::Code(item, Some(item)));
        let kind = StatementKind::Call { routine, this: Some(at(this)) };
        Ok(Unit { this, cycle: vec![Statement { kind, place: None }], variables })
    }

    /// Sets what the slots of a variable of the unit are for. An in-out gets a variable that it refers to.
    fn unit_field(&mut self, item: ItemId, field: &Field<'_>, spot: Spot) -> Lowered<Option<(String, Spot, Role)>> {
        let address = field.decl.as_ref().and_then(|decl| decl.address()).map(str::to_ascii_uppercase);
        let role = match (field.section, address.as_deref()) {
            (Section::Input, _) => Role::Input,
            (Section::Output, _) => Role::Output,
            (_, Some(address)) if address.starts_with("%I") => Role::Input,
            (_, Some(address)) if address.starts_with("%Q") => Role::Output,
            (Section::InOut, _) => {
                let target = self.in_out_target(&format!("{}.{}", self.world.item(item).name, field.name), &spot)?;
                return Ok(target.map(|target| (field.name.clone(), target, Role::Input)));
            }
            _ if field.key.contains('$') => return Ok(None),
            _ if spot.constant => Role::Constant,
            _ => Role::State,
        };
        if matches!(role, Role::Input | Role::Output) {
            self.set_role(&spot, role)?;
        }
        Ok(Some((field.name.clone(), spot, role)))
    }

    /// The variable that an in-out of the unit refers to.
    fn in_out_target(&mut self, name: &str, spot: &Spot) -> Lowered<Option<Spot>> {
        let (Type::Reference { target, .. }, Base::Slot(slot)) = (&spot.type_, &spot.location.base) else {
            return Ok(None);
        };
        let type_ = target.as_ref().clone();
        let values = self.defaults(&type_)?.values;
        let placement = Placement { name: name.to_owned(), role: Role::Input, place: None };
        let first = self.put(&type_, &values, &placement)?;
        let reference = (slot.0 + spot.location.offset) as usize;
        if let Some(reference) = self.slots.get_mut(reference) {
            reference.initial = u64::from(first.0) + 1;
        }
        Ok(Some(Spot { location: at(first), type_, constant: false }))
    }

    fn set_role(&mut self, spot: &Spot, role: Role) -> Lowered<()> {
        let Base::Slot(slot) = spot.location.base else { return Ok(()) };
        let size = self.known_size(&spot.type_)? as usize;
        let from = (slot.0 + spot.location.offset) as usize;
        // Blocks that are inputs keep what they are.
        if matches!(spot.type_, Type::Instance { .. }) {
            return Ok(());
        }
        self.slots.iter_mut().skip(from).take(size).for_each(|slot| slot.role = role);
        Ok(())
    }

    fn function_unit(&mut self, item: ItemId) -> Lowered<Unit> {
        let name = self.world.item(item).name.clone();
        let frame = self.frame(item, None)?;
        let placement = Placement { name: name.clone(), role: Role::State, place: self.world.place_of(item) };
        let this = self.put(&Type::Null, &[0], &placement)?;
        let mut variables = Vec::new();
        for parameter in &frame.parameters {
            let spot = parameter.spot.clone();
            let slot = match spot.location.base {
                Base::Slot(slot) => slot.0 as usize,
                _ => continue,
            };
            let path = self.slots.get(slot).map_or("", |slot| slot.name.rsplit('.').next().unwrap_or("")).to_owned();
            match parameter.section {
                Section::InOut => {
                    if let Some(target) = self.in_out_target(&format!("{name}.{path}"), &spot)? {
                        variables.push((path, target, Role::Input));
                    }
                }
                section => {
                    let role = if section == Section::Output { Role::Output } else { Role::Input };
                    self.set_role(&spot, role)?;
                    variables.push((path, spot, role));
                }
            }
        }
        if let Some(result) = &frame.result {
            self.set_role(result, Role::Output)?;
            variables.push((name, result.clone(), Role::Output));
        }
        let routine = self.routine(RoutineKey::Code(item, None));
        let kind = StatementKind::Call { routine, this: None };
        Ok(Unit { this, cycle: vec![Statement { kind, place: None }], variables })
    }

    /// The scalars of a variable by their paths. Strings and references are none that a table could name.
    pub(super) fn name_variables(&mut self, path: &str, spot: &Spot, role: Role, out: &mut Vec<NamedVariable>) {
        match &spot.type_ {
            Type::Array(array) => {
                let array = Arc::clone(array);
                let size = self.known_size(&array.element).unwrap_or(1).max(1);
                let count = self.known_size(&spot.type_).unwrap_or(0) / size;
                for n in 0..count as usize {
                    let Ok(part) = self.element(spot, n) else { return };
                    let path = format!("{path}{}", super::memory::subscript(&array.dimensions, n));
                    self.name_variables(&path, &part, role, out);
                }
            }
            Type::Structure { .. } | Type::Instance { .. } => {
                let Ok(Some(layout)) = self.layout_of(&spot.type_) else { return };
                for field in layout.fields.iter().filter(|field| !field.key.contains('$')) {
                    let path = format!("{path}.{}", field.name);
                    self.name_variables(&path, &spot.field(field), role, out);
                }
            }
            Type::Text { .. } | Type::Reference { .. } | Type::Interface { .. } | Type::Null => {}
            type_ => {
                let Base::Slot(slot) = spot.location.base else { return };
                let enumeration = match type_ {
                    Type::Enumeration { item, .. } => *item,
                    _ => None,
                };
                let slot = SlotId(slot.0 + spot.location.offset);
                let scalar = type_.scalar().unwrap_or(Scalar::Bool);
                // What a nested instance's own outputs are for is said by their slots.
                let role = self.slots.get(slot.0 as usize).map_or(role, |slot| slot.role);
                out.push(NamedVariable { path: path.to_owned(), slot, scalar, enumeration, role });
            }
        }
    }
}
