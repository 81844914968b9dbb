//! Calls through references and interfaces: the class of the instance decides.
//!
//! All implementations of a method share one frame, that of the method as it is declared where the call sees it. For each
//! class of which there is an instance, a relay copies the arguments into the frame of the class's own method, calls that, and
//! copies the results back.

use std::collections::BTreeMap;
use std::rc::Rc;

use super::access::Spot;
use super::routines::{Frame, RoutineKey};
use super::{Elaborator, Lowered, Unsupported};
use crate::library::{ItemId, ItemKind, Section};
use crate::machine::program::{Routine, RoutineId, Statement, StatementKind, Value};

/// The number that stands in a call until all classes are known.
const OPEN: ItemId = ItemId(u32::MAX);

/// A method that is called by class.
#[derive(Debug)]
pub(super) struct Pending {
    /// The method or accessor as it is declared; for a body, the block.
    item: ItemId,
    /// The class or interface of the reference.
    base: ItemId,
    frame: Rc<Frame>,
    /// The relays of the classes that were met.
    relays: BTreeMap<ItemId, RoutineId>,
}

impl Elaborator<'_> {
    /// Whether an instance behind a reference may be of a class that extends this one.
    pub(super) fn may_be_derived(&mut self, class: ItemId) -> bool {
        let known = self.extended.get_or_insert_with(|| self.world.extended());
        known.contains(&class)
    }

    /// The number of a method that is called by class.
    pub(super) fn dispatch(&mut self, item: ItemId, base: ItemId, frame: Rc<Frame>) -> usize {
        let known = self.dispatches.iter().position(|pending| pending.item == item && pending.base == base);
        known.unwrap_or_else(|| {
            self.dispatches.push(Pending { item, base, frame, relays: BTreeMap::new() });
            self.dispatches.len() - 1
        })
    }

    pub(super) fn emit_dispatch(&mut self, dispatch: usize, target: Value) {
        let number = RoutineId(u32::try_from(dispatch).unwrap_or(u32::MAX));
        self.emit(StatementKind::Dispatch { target, routines: vec![(OPEN, number)] });
    }

    /// Asks for the relays of all classes of which there are instances; whether there were new ones.
    pub(super) fn relays(&mut self) -> bool {
        let mut classes: Vec<ItemId> = self.instances.iter().map(|(_, class)| *class).collect();
        classes.sort_unstable();
        classes.dedup();
        let mut grown = false;
        for dispatch in 0..self.dispatches.len() {
            for class in &classes {
                let (base, known) = {
                    let pending = &self.dispatches[dispatch];
                    (pending.base, pending.relays.contains_key(class))
                };
                if !known && self.world.conforms(*class, base) {
                    let routine = self.routine(RoutineKey::Relay(dispatch, *class));
                    self.dispatches[dispatch].relays.insert(*class, routine);
                    grown = true;
                }
            }
        }
        grown
    }

    /// The routine that hands a call to the method of a class.
    pub(super) fn lower_relay(&mut self, dispatch: usize, class: ItemId) -> Lowered<Routine> {
        let (item, outer) = {
            let pending = &self.dispatches[dispatch];
            (pending.item, Rc::clone(&pending.frame))
        };
        let name = format!("{}.$relay", self.world.item(class).name);
        let this = Some(Spot::this(self.instance_type(class)).location);
        let own = self.implementation(item, class)?;
        let routine = self.routine(RoutineKey::Code(own, Some(class)));
        let call = Statement { kind: StatementKind::Call { routine, this }, place: None };
        if self.world.item(item).parent.is_none() {
            return Ok(Routine { name, item: None, body: vec![call], locals: Vec::new() });
        }
        let inner = self.frame(own, Some(class))?;
        let mut body = Vec::new();
        for (from, to) in outer.parameters.iter().zip(&inner.parameters) {
            if from.section != Section::Output {
                body.push(self.copied(&from.spot, &to.spot)?);
            }
        }
        body.push(call);
        for (to, from) in outer.parameters.iter().zip(&inner.parameters) {
            if to.section == Section::Output {
                body.push(self.copied(&from.spot, &to.spot)?);
            }
        }
        if let (Some(to), Some(from)) = (&outer.result, &inner.result) {
            body.push(self.copied(from, to)?);
        }
        Ok(Routine { name, item: None, body, locals: Vec::new() })
    }

    fn copied(&mut self, from: &Spot, to: &Spot) -> Lowered<Statement> {
        let length = self.known_size(&to.type_)?.min(self.known_size(&from.type_)?);
        let kind = StatementKind::Copy { target: to.location.clone(), source: from.location.clone(), length };
        Ok(Statement { kind, place: None })
    }

    /// What a class has for a method, an accessor, or a body.
    fn implementation(&self, item: ItemId, class: ItemId) -> Lowered<ItemId> {
        let declared = self.world.item(item);
        let found = match declared.kind {
            ItemKind::Getter | ItemKind::Setter => {
                let property = self.world.parent(item).unwrap_or(item);
                let name = &self.world.item(property).name;
                self.world.lineage(class).into_iter().find_map(|at| {
                    let own = self.world.child(at, name, &[ItemKind::Property])?;
                    self.world.children(own).find(|child| self.world.item(*child).kind == declared.kind)
                })
            }
            _ if declared.parent.is_none() => Some(class),
            _ => self.find_method(class, &declared.name),
        };
        found.ok_or_else(|| {
            let message = format!("`{}` has no `{}`", self.world.item(class).name, declared.name);
            Unsupported::new("types that do not fit", self.world.place_of(class), message)
        })
    }

    /// Fills the classes into the calls.
    pub(super) fn fill_dispatches(&self, statements: &mut [Statement]) {
        super::finish::each_mut(statements, &mut |statement| {
            if let StatementKind::Dispatch { routines, .. } = &mut statement.kind
                && let [(OPEN, number)] = routines.as_slice()
                && let Some(pending) = self.dispatches.get(number.0 as usize)
            {
                *routines = pending.relays.iter().map(|(class, routine)| (*class, *routine)).collect();
            }
        });
    }
}
