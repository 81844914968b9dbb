//! The memory of a random program: variables of every kind of every type, arrays, structures in arrays, instances of two
//! classes, references, strings.

use rungbook::library::ItemId;
use rungbook::machine::program::{Base, Index, Location, Role, Slot, SlotId, Text, Value};
use rungbook::semantics::expr::{Expr, ExprKind, Op};
use rungbook::semantics::scalar::Scalar;

use super::choices::{Choices, int};
use super::expressions::{Vocabulary, constant, expression};

/// The scalar that the references of the program refer to.
pub(super) const POINTEE: Scalar = int(true, 16);

/// Something to name: a variable, or an element of an array.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    pub(super) scalar: Scalar,
    pub(super) base: u32,
    /// Relative to the instance.
    pub(super) member: bool,
    /// Lowest index, count, stride.
    pub(super) dimensions: Vec<(i64, u32, u32)>,
    pub(super) range: Option<(i128, i128)>,
    pub(super) writable: bool,
}

#[derive(Debug, Default)]
pub(super) struct Layout {
    pub(super) slots: Vec<Slot>,
    pub(super) variables: Vec<Variable>,
    /// References to [`POINTEE`]s.
    pub(super) references: Vec<u32>,
    /// References to instances.
    pub(super) interfaces: Vec<u32>,
    pub(super) instances: Vec<(SlotId, ItemId)>,
    /// First slot and capacity.
    pub(super) texts: Vec<(u32, u32)>,
    /// First and count of the locals of each routine.
    pub(super) locals: Vec<(u32, u32)>,
}

/// How many slots an instance has.
pub(super) const INSTANCE: u32 = 4;
pub(super) const CLASSES: [ItemId; 2] = [ItemId(1), ItemId(2)];
pub(super) const ROUTINES: u32 = 4;

impl Layout {
    fn slot(&mut self, choices: &mut Choices<'_>, scalar: Scalar, role: Role) -> u32 {
        let at = self.slots.len() as u32;
        let initial = if scalar == Scalar::Ref { 0 } else { choices.bits(scalar) };
        let name = format!("v{at}");
        self.slots.push(Slot { name, scalar, initial, role, range: None, place: None });
        at
    }

    fn variable(&mut self, scalar: Scalar, base: u32, dimensions: Vec<(i64, u32, u32)>) {
        let member = false;
        self.variables.push(Variable { scalar, base, member, dimensions, range: None, writable: true });
    }

    fn scalars(&mut self, choices: &mut Choices<'_>, vocabulary: &[Scalar]) {
        for _ in 0..3 + choices.below(8) {
            let scalar = choices.one(vocabulary);
            let roles = [Role::State, Role::Input, Role::Output, Role::Temporary, Role::Arbitrary, Role::Constant];
            let role = choices.one(&roles);
            let base = self.slot(choices, scalar, role);
            self.variable(scalar, base, Vec::new());
            let last = self.variables.len() - 1;
            self.variables[last].writable = role != Role::Constant;
            if matches!(scalar, Scalar::Int { .. }) && choices.once_in(3) && role != Role::Constant {
                let low = scalar.number(choices.bits(scalar)).min(50);
                let high = low + i128::from(choices.below(20));
                let high = high.min(scalar.number(scalar.bits(-1)).max((1 << (scalar.width() - 1)) - 1));
                let slot = &mut self.slots[base as usize];
                slot.range = Some((low, high));
                slot.initial = scalar.bits(low);
                self.variables[last].range = Some((low, high));
            }
        }
    }

    fn arrays(&mut self, choices: &mut Choices<'_>, vocabulary: &[Scalar]) {
        for _ in 0..1 + choices.below(2) {
            let (scalar, count) = (choices.one(vocabulary), 1 + choices.below(5));
            let low = i64::from(choices.below(4)) - 1;
            let base = self.slots.len() as u32;
            for _ in 0..count {
                self.slot(choices, scalar, Role::State);
            }
            self.variable(scalar, base, vec![(low, count, 1)]);
        }
        // ARRAY [1..2, 0..2] OF a structure of two.
        let (first, second) = (choices.one(vocabulary), choices.one(vocabulary));
        let base = self.slots.len() as u32;
        for _ in 0..6 {
            self.slot(choices, first, Role::State);
            self.slot(choices, second, Role::State);
        }
        self.variable(first, base, vec![(1, 2, 6), (0, 3, 2)]);
        self.variable(second, base + 1, vec![(1, 2, 6), (0, 3, 2)]);
    }

    fn all_instances(&mut self, choices: &mut Choices<'_>, vocabulary: &[Scalar]) {
        let members = [POINTEE, Scalar::Bool, choices.one(vocabulary)];
        for number in 0..4 {
            let header = self.slot(choices, Scalar::Ref, Role::Constant);
            let class = if number == 3 { CLASSES[1] } else { CLASSES[0] };
            self.instances.push((SlotId(header), class));
            for scalar in members {
                self.slot(choices, scalar, Role::State);
            }
        }
        let first = self.instances[0].0.0;
        for (offset, scalar) in (1..).zip(members) {
            self.variable(scalar, first + offset, vec![(0, 4, INSTANCE)]);
            let (dimensions, range) = (Vec::new(), None);
            self.variables.push(Variable { scalar, base: offset, member: true, dimensions, range, writable: true });
        }
    }

    /// A random memory.
    pub(super) fn random(choices: &mut Choices<'_>) -> Self {
        let mut layout = Self::default();
        let mut vocabulary = vec![Scalar::Bool, POINTEE];
        for _ in 0..3 {
            vocabulary.push(choices.scalar());
        }
        layout.scalars(choices, &vocabulary);
        layout.arrays(choices, &vocabulary);
        layout.all_instances(choices, &vocabulary);
        for _ in 0..2 {
            let reference = layout.slot(choices, Scalar::Ref, Role::State);
            layout.references.push(reference);
            let interface = layout.slot(choices, Scalar::Ref, Role::State);
            layout.interfaces.push(interface);
            if !choices.once_in(4) {
                let instance = choices.one(&layout.instances).0.0;
                layout.slots[reference as usize].initial = u64::from(instance) + 2;
                layout.slots[interface as usize].initial = u64::from(instance) + 1;
            }
        }
        for number in 0..4 {
            let (first, capacity) = (layout.slots.len() as u32, choices.below(6));
            let (width, input) = (if number >= 2 { 16 } else { 8 }, choices.once_in(3));
            for _ in 0..=capacity {
                let at = layout.slot(choices, Scalar::Bits(width), if input { Role::Input } else { Role::State });
                layout.slots[at as usize].initial = u64::from(choices.below(3) * 0x41);
            }
            layout.texts.push((first, capacity));
        }
        for _ in 0..ROUTINES {
            let first = layout.slots.len() as u32;
            for _ in 0..2 {
                let scalar = choices.one(&vocabulary);
                let local = layout.slot(choices, scalar, Role::Temporary);
                layout.variable(scalar, local, Vec::new());
            }
            layout.locals.push((first, 2));
        }
        layout
    }
}

/// What a body may name: members of its instance or not.
pub(super) struct Scope<'a> {
    pub(super) layout: &'a Layout,
    pub(super) has_this: bool,
}

impl Scope<'_> {
    /// A variable of the type.
    pub(super) fn variable(&self, choices: &mut Choices<'_>, scalar: Scalar, writable: bool) -> Option<&Variable> {
        let fits = |v: &&Variable| v.scalar == scalar && (self.has_this || !v.member) && (v.writable || !writable);
        let found: Vec<&Variable> = self.layout.variables.iter().filter(fits).collect();
        (!found.is_empty()).then(|| choices.one(&found))
    }

    /// A location in a variable, with random indices that are mostly inside.
    pub(super) fn locate(&self, choices: &mut Choices<'_>, variable: &Variable, depth: u32) -> Location {
        let base = if variable.member { Base::This } else { Base::Slot(SlotId(variable.base)) };
        let offset = if variable.member { variable.base } else { 0 };
        let indices = variable
            .dimensions
            .iter()
            .map(|(low, count, stride)| {
                let value = self.index(choices, *low, *count, depth);
                Index { value, low: *low, count: *count, stride: *stride }
            })
            .collect();
        Location { base, offset, indices }
    }

    fn index(&self, choices: &mut Choices<'_>, low: i64, count: u32, depth: u32) -> Value {
        let scalar = if choices.once_in(3) { int(true, 8) } else { POINTEE };
        let low = i128::from(low);
        if depth == 0 || choices.once_in(2) {
            let outside = u32::from(choices.once_in(40));
            let number = low + i128::from(choices.below(count + outside));
            return constant(choices, scalar, number);
        }
        if choices.once_in(8) {
            return expression(self, choices, scalar, depth - 1);
        }
        // A number MOD the count, and the lowest index.
        let byte = int(false, 8);
        let number = vec![expression(self, choices, byte, depth - 1), constant(choices, byte, count.into())];
        let number = Expr { kind: ExprKind::Apply(Op::Mod, number), scalar: byte, place: choices.place() };
        let number = Expr { kind: ExprKind::Apply(Op::Convert, vec![number]), scalar, place: choices.place() };
        let sum = vec![number, constant(choices, scalar, low)];
        Expr { kind: ExprKind::Apply(Op::Add, sum), scalar, place: choices.place() }
    }

    /// A reference, of the first or the second kind, as a value.
    pub(super) fn reference(&self, choices: &mut Choices<'_>, to_instance: bool, depth: u32) -> Value {
        let own = if to_instance { &self.layout.interfaces } else { &self.layout.references };
        let kind = match choices.below(5) {
            0 | 1 => ExprKind::Address(if to_instance {
                Location { base: Base::Slot(choices.one(&self.layout.instances).0), offset: 0, indices: Vec::new() }
            } else {
                match self.variable(choices, POINTEE, true).cloned() {
                    Some(variable) => self.locate(choices, &variable, depth.min(1)),
                    None => return self.null(choices),
                }
            }),
            2 | 3 => ExprKind::Read(slot(choices.one(own))),
            _ if depth > 0 => {
                let condition = Box::new(expression(self, choices, Scalar::Bool, depth - 1));
                let then = Box::new(self.reference(choices, to_instance, depth - 1));
                ExprKind::If(condition, then, Box::new(self.reference(choices, to_instance, depth - 1)))
            }
            _ => return self.null(choices),
        };
        Expr { kind, scalar: Scalar::Ref, place: choices.place() }
    }

    fn null(&self, choices: &mut Choices<'_>) -> Value {
        Expr { kind: ExprKind::Const(0), scalar: Scalar::Ref, place: choices.place() }
    }

    /// A string, of narrow or wide characters.
    pub(super) fn text(&self, choices: &mut Choices<'_>, wide: bool) -> Text {
        let of_width = if wide { &self.layout.texts[2..] } else { &self.layout.texts[..2] };
        let (first, capacity) = choices.one(of_width);
        Text { location: slot(first), capacity }
    }
}

/// The location of a slot.
pub(super) fn slot(at: u32) -> Location {
    Location { base: Base::Slot(SlotId(at)), offset: 0, indices: Vec::new() }
}

impl Vocabulary for Scope<'_> {
    type Leaf = Location;

    fn leaf(&self, choices: &mut Choices<'_>, scalar: Scalar, depth: u32) -> Option<ExprKind<Location>> {
        if scalar == POINTEE && choices.once_in(6) {
            let reference = if choices.once_in(4) && depth > 0 {
                self.reference(choices, false, depth - 1)
            } else {
                let at = choices.one(&self.layout.references);
                Expr { kind: ExprKind::Read(slot(at)), scalar: Scalar::Ref, place: choices.place() }
            };
            let base = Base::Referent(Box::new(reference));
            return Some(ExprKind::Read(Location { base, offset: 0, indices: Vec::new() }));
        }
        let variable = self.variable(choices, scalar, false)?.clone();
        Some(ExprKind::Read(self.locate(choices, &variable, depth.min(2))))
    }
}
