//! The end: what globals are for, the classes of calls through references, no recursion; then the program is put together.

use std::collections::{BTreeMap, BTreeSet};

use super::access::Spot;
use super::memory::at;
use super::{Elaborator, Unsupported};
use crate::library::ItemId;
use crate::machine::program::{
    Base, Location, NamedVariable, Program, Role, Routine, SlotId, Statement, StatementKind, TextOperation, Value,
};
use crate::semantics::expr::ExprKind;
use crate::semantics::typing::Type;

/// What a global variable is, by its declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum GlobalKind {
    /// At `%I…`.
    Input,
    /// At `%Q…`.
    Output,
    /// At `%M…`.
    Memory,
    /// Of a list of globals.
    Variable,
}

/// A global variable in memory.
#[derive(Clone, Debug)]
pub(super) struct Global {
    pub(super) slot: SlotId,
    pub(super) length: u32,
    /// As a table names it.
    pub(super) path: String,
    pub(super) type_: Type,
    pub(super) kind: GlobalKind,
    pub(super) constant: bool,
}

/// Goes over statements and those in them.
pub(super) fn each_mut(statements: &mut [Statement], with: &mut impl FnMut(&mut Statement)) {
    for statement in statements {
        with(statement);
        match &mut statement.kind {
            StatementKind::If { then, otherwise, .. } => {
                each_mut(then, with);
                each_mut(otherwise, with);
            }
            StatementKind::Case { arms, otherwise, .. } => {
                arms.iter_mut().for_each(|arm| each_mut(&mut arm.body, with));
                each_mut(otherwise, with);
            }
            StatementKind::For { body, .. } => each_mut(body, with),
            StatementKind::Loop { body, after } => {
                each_mut(body, with);
                each_mut(after, with);
            }
            _ => {}
        }
    }
}

/// Goes over statements and those in them.
pub(super) fn each<'s>(statements: &'s [Statement], with: &mut impl FnMut(&'s Statement)) {
    for statement in statements {
        with(statement);
        match &statement.kind {
            StatementKind::If { then, otherwise, .. } => {
                each(then, with);
                each(otherwise, with);
            }
            StatementKind::Case { arms, otherwise, .. } => {
                arms.iter().for_each(|arm| each(&arm.body, with));
                each(otherwise, with);
            }
            StatementKind::For { body, .. } => each(body, with),
            StatementKind::Loop { body, after } => {
                each(body, with);
                each(after, with);
            }
            _ => {}
        }
    }
}

/// The slots, by the first one of a location, that statements write or take the address of.
fn written(statements: &[Statement], out: &mut BTreeSet<u32>) {
    each(statements, &mut |statement| match &statement.kind {
        StatementKind::Assign { target, value, .. } => {
            note(target, out);
            addresses(value, out);
        }
        StatementKind::Copy { target, .. } | StatementKind::Reset { target, .. } => note(target, out),
        StatementKind::For { control, .. } => note(control, out),
        StatementKind::Text(operation) => note(text_target(operation), out),
        StatementKind::Call { this: Some(this), .. } => note(this, out),
        StatementKind::Dispatch { target, .. } => addresses(target, out),
        _ => {}
    });
}

const fn text_target(operation: &TextOperation) -> &Location {
    match operation {
        TextOperation::Assign(text, _)
        | TextOperation::Literal(text, _)
        | TextOperation::Concat(text, ..)
        | TextOperation::Left(text, ..)
        | TextOperation::Right(text, ..)
        | TextOperation::Mid(text, ..)
        | TextOperation::Insert(text, ..)
        | TextOperation::Delete(text, ..)
        | TextOperation::Replace(text, ..) => &text.location,
        TextOperation::Compare { target, .. } | TextOperation::Length(target, ..) | TextOperation::Find(target, ..) => {
            target
        }
    }
}

fn note(location: &Location, out: &mut BTreeSet<u32>) {
    if let Base::Slot(slot) = location.base {
        out.insert(slot.0.saturating_add(location.offset));
    }
}

/// Variables whose addresses an expression takes: whoever has the address may write.
fn addresses(value: &Value, out: &mut BTreeSet<u32>) {
    match &value.kind {
        ExprKind::Address(location) => note(location, out),
        ExprKind::Apply(_, operands) => operands.iter().for_each(|operand| addresses(operand, out)),
        ExprKind::AndThen(a, b) | ExprKind::OrElse(a, b) => {
            addresses(a, out);
            addresses(b, out);
        }
        ExprKind::If(a, b, c) => [a, b, c].into_iter().for_each(|part| addresses(part, out)),
        ExprKind::Const(_) | ExprKind::Read(_) => {}
    }
}

impl Elaborator<'_> {
    /// Everything that is not modelled, in the order of the places.
    pub(super) fn all_errors(mut self) -> Vec<Unsupported> {
        self.errors.sort();
        self.errors.dedup();
        self.errors
    }

    /// The program, unless something in it is not modelled.
    pub(super) fn finish(
        mut self,
        unit: ItemId,
        this: SlotId,
        cycle: Vec<Statement>,
        mut variables: Vec<NamedVariable>,
    ) -> Result<Program, Vec<Unsupported>> {
        let known = self.errors.is_empty();
        let mut routines: Vec<Routine> = Vec::new();
        for routine in std::mem::take(&mut self.routines) {
            // A routine that could not be lowered is among the errors.
            routines.push(routine.unwrap_or_else(|| Routine {
                name: String::new(),
                item: None,
                body: Vec::new(),
                locals: Vec::new(),
            }));
        }
        routines.iter_mut().for_each(|routine| self.fill_dispatches(&mut routine.body));
        let mut startup = std::mem::take(&mut self.startup);
        self.fill_dispatches(&mut startup);
        if known && let Some(name) = recursive(&routines) {
            let place = self.world.place_of(unit);
            let message = format!("`{name}` calls itself, perhaps through others");
            self.errors.push(Unsupported::new("a recursive call", place, message));
        }
        self.set_globals(&routines, &cycle, &mut variables);
        if !self.errors.is_empty() {
            return Err(self.all_errors());
        }
        let enumerations = self.enumerations(&variables)?;
        self.instances.sort_unstable();
        self.clocks.sort_unstable();
        let own: Vec<ItemId> = self.cone.iter().copied().filter(|id| self.world.is_own(*id)).collect();
        Ok(Program {
            name: self.world.qualified_name(unit),
            unit,
            slots: self.slots,
            routines,
            startup,
            cycle,
            this,
            instances: self.instances,
            clocks: self.clocks,
            cycle_time: self.options.cycle_time,
            assumptions: self.assumptions.into_iter().collect(),
            cone: own,
            enumerations,
            variables,
        })
    }

    /// A global that the unit only reads is an input, one that it writes is an output; addresses say it themselves.
    fn set_globals(&mut self, routines: &[Routine], cycle: &[Statement], variables: &mut Vec<NamedVariable>) {
        let mut slots = BTreeSet::new();
        routines.iter().for_each(|routine| written(&routine.body, &mut slots));
        written(cycle, &mut slots);
        let globals = std::mem::take(&mut self.globals);
        for global in globals {
            let range = global.slot.0..global.slot.0.saturating_add(global.length.max(1));
            let is_written = slots.range(range.clone()).next().is_some();
            let role = match global.kind {
                _ if global.constant => Role::Constant,
                _ if self.has_instance(range.clone()) => Role::State,
                GlobalKind::Input if !is_written => Role::Input,
                GlobalKind::Output => Role::Output,
                GlobalKind::Variable if !is_written => Role::Input,
                GlobalKind::Variable => Role::Output,
                _ => Role::State,
            };
            for slot in range.clone() {
                if let Some(slot) = self.slots.get_mut(slot as usize).filter(|slot| slot.role != Role::Constant) {
                    slot.role = role;
                }
            }
            let spot = Spot { location: at(global.slot), type_: global.type_, constant: global.constant };
            self.name_variables(&global.path, &spot, role, variables);
        }
    }

    /// The values, as bits, of the enumerations that variables have.
    fn enumerations(&mut self, variables: &[NamedVariable]) -> Result<BTreeMap<ItemId, Vec<u64>>, Vec<Unsupported>> {
        let mut found = BTreeMap::new();
        for variable in variables {
            let Some(item) = variable.enumeration.filter(|item| !found.contains_key(item)) else { continue };
            let values = self.enum_values(item).map_err(|error| vec![error])?;
            found.insert(item, values.iter().map(|(_, number)| variable.scalar.bits(*number)).collect());
        }
        Ok(found)
    }

    fn has_instance(&self, range: std::ops::Range<u32>) -> bool {
        self.instances.iter().any(|(header, _)| range.contains(&header.0))
    }
}

/// A routine that calls itself, if there is one.
fn recursive(routines: &[Routine]) -> Option<String> {
    let callees: Vec<BTreeSet<usize>> = routines
        .iter()
        .map(|routine| {
            let mut found = BTreeSet::new();
            each(&routine.body, &mut |statement| match &statement.kind {
                StatementKind::Call { routine, .. } => _ = found.insert(routine.0 as usize),
                StatementKind::Dispatch { routines, .. } => {
                    found.extend(routines.iter().map(|(_, routine)| routine.0 as usize));
                }
                _ => {}
            });
            found
        })
        .collect();
    // Routines whose callees are all done are taken away; what is left lies on a cycle or calls one.
    let mut done = vec![false; routines.len()];
    loop {
        let next: Vec<usize> = (0..routines.len())
            .filter(|n| !done[*n] && callees[*n].iter().all(|callee| done.get(*callee).copied().unwrap_or(true)))
            .collect();
        if next.is_empty() {
            break;
        }
        next.into_iter().for_each(|n| done[n] = true);
    }
    let on_cycle = |n: usize| reaches(&callees, n, n);
    (0..routines.len()).find(|n| !done[*n] && on_cycle(*n)).map(|n| routines[n].name.clone())
}

/// Whether calls lead from one routine to another.
fn reaches(callees: &[BTreeSet<usize>], from: usize, to: usize) -> bool {
    let mut seen = BTreeSet::new();
    let mut work = vec![from];
    while let Some(at) = work.pop() {
        for next in callees.get(at).into_iter().flatten() {
            if *next == to {
                return true;
            }
            if seen.insert(*next) {
                work.push(*next);
            }
        }
    }
    false
}
