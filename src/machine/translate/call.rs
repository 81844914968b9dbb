//! Calls: where the instance is one of several, each of them in turn under its condition.

use super::Unsupported;
use super::flow::Executor;
use crate::library::ItemId;
use crate::machine::program::{Location, RoutineId, SlotId, Value};
use crate::semantics::encode;
use crate::semantics::expr::Fault;
use crate::text::Place;

impl<'p> Executor<'p> {
    /// A call on an instance, on the present one if none is said.
    pub(super) fn call(
        &mut self,
        routine: RoutineId,
        this: Option<&'p Location>,
        place: Option<Place>,
    ) -> Result<(), Unsupported> {
        let Some(location) = this else {
            return self.invoke(routine, self.this, place);
        };
        let area = self.resolve(location, place)?;
        let instances = self.alternatives(&area);
        if let [(_, only)] = instances.as_slice() {
            return self.invoke(routine, *only, place);
        }
        self.alternatives_of(&instances, &mut |executor, instance| executor.invoke(routine, instance, place))
    }

    /// A call of the routine that belongs to the class of the instance.
    pub(super) fn dispatch(
        &mut self,
        target: &'p Value,
        routines: &'p [(ItemId, RoutineId)],
        place: Option<Place>,
    ) -> Result<(), Unsupported> {
        let address = encode::value(self, target)?;
        let instances = self.referents(address, target.place.or(place), place)?;
        if self.is_dead() {
            return Ok(());
        }
        self.alternatives_of(&instances, &mut |executor, instance| match executor.routine_of(instance, routines) {
            Some(routine) => executor.invoke(routine, instance, place),
            None => {
                executor.fail(Fault::NullReference, place);
                Ok(())
            }
        })
    }

    /// The routine for the class of an instance.
    fn routine_of(&self, instance: u32, routines: &[(ItemId, RoutineId)]) -> Option<RoutineId> {
        let instances = &self.program.instances;
        let at = instances.binary_search_by_key(&SlotId(instance), |(slot, _)| *slot).ok()?;
        let class = instances[at].1;
        routines.iter().find(|(other, _)| *other == class).map(|(_, routine)| *routine)
    }

    /// Executes a routine on an instance.
    fn invoke(&mut self, routine: RoutineId, this: u32, place: Option<Place>) -> Result<(), Unsupported> {
        let program = self.program;
        let Some(body) = program.routines.get(routine.0 as usize) else {
            self.fail(Fault::NullReference, place);
            return Ok(());
        };
        // As the interpreter: deeper than there are routines, one must have called itself.
        if self.depth > program.routines.len() {
            self.fail(Fault::LoopLimit, place);
            return Ok(());
        }
        self.enter(false);
        for (first, length) in &body.locals {
            for slot in first.0..first.0.saturating_add(*length) {
                if let Some(initial) = self.initial(slot) {
                    self.memory.set(slot, initial);
                }
            }
        }
        let before = std::mem::replace(&mut self.this, this);
        self.depth += 1;
        self.block(&body.body)?;
        self.depth -= 1;
        self.this = before;
        self.leave();
        Ok(())
    }
}
