//! Random programs.

use rungbook::library::ItemId;
use rungbook::machine::program::{Program, Routine, SlotId};
use rungbook::semantics::scalar::Scalar;

use super::choices::Choices;
use super::layout::{Layout, ROUTINES, Scope};
use super::statements::Around;

/// A random program. Routines call only those with a higher number.
pub(super) fn program(choices: &mut Choices<'_>) -> Program {
    let layout = Layout::random(choices);
    let block = |choices: &mut Choices<'_>, depth, callable, has_this| {
        Scope { layout: &layout, has_this }.block(choices, Around { depth, loops: 0, callable })
    };
    let startup = if choices.once_in(3) { block(choices, 1, ROUTINES, false) } else { Vec::new() };
    let cycle = block(choices, 3, 0, true);
    let routines = (0..ROUTINES).map(|number| Routine {
        name: format!("routine {number}"),
        item: None,
        body: block(choices, 2, number + 1, true),
        locals: vec![(SlotId(layout.locals[number as usize].0), layout.locals[number as usize].1)],
    });
    let routines = routines.collect();
    let clocks = (0u32..)
        .zip(&layout.slots)
        .filter(|(_, slot)| slot.role == rungbook::machine::program::Role::State && slot.scalar == Scalar::Time(32))
        .map(|(at, _)| (SlotId(at), 10))
        .take(1)
        .collect();
    Program {
        name: "random".to_owned(),
        unit: ItemId(0),
        this: layout.instances[0].0,
        instances: layout.instances.clone(),
        slots: layout.slots,
        routines,
        startup,
        cycle,
        clocks,
        cycle_time: 10_000_000,
        assumptions: Vec::new(),
        cone: Vec::new(),
        enumerations: std::collections::BTreeMap::new(),
        variables: Vec::new(),
        enumerations: std::collections::BTreeMap::new(),
    }
}
