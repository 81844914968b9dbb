//! A program with probes: slots that say what a cycle has executed.
//!
//! Each straight stretch of statements sets a slot of its own, and every slot is put out at the beginning of a cycle, so that
//! none of them lasts and no new state comes of them. Interpreter and translation both execute a probe as the assignment
//! that it is: what one says of a run, the other can confirm. (As compilers instrument for coverage: Tikir and
//! Hollingsworth, *Efficient instrumentation for code coverage testing*, ISSTA 2002, one probe a stretch.)

use std::collections::{BTreeMap, BTreeSet};

use crate::library::ItemId;
use crate::machine::program::{
    Arm, Base, Location, Program, Role, Routine, RoutineId, Slot, SlotId, Statement, StatementKind,
};
use crate::semantics::expr::{Expr, ExprKind};
use crate::semantics::scalar::Scalar;
use crate::text::Place;

/// Which way a branch goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Way {
    /// The condition holds.
    True,
    /// The condition does not hold.
    False,
    /// The arm of a `CASE`, from 1.
    Arm(usize),
    /// The `ELSE` of a `CASE`.
    Else,
}

/// A program with its probes.
#[derive(Clone, Debug)]
pub struct Probed {
    /// The program; its new slots follow the old ones.
    pub program: Program,
    /// The first probe's slot; all that follow are probes.
    pub first: SlotId,
    /// Each statement, with the probes one of which is set where it is executed.
    pub statements: BTreeMap<Place, BTreeSet<u32>>,
    /// Each way of each branch, with its probes, by the place of the condition or the selector.
    pub branches: BTreeMap<(Place, Way), BTreeSet<u32>>,
}

impl Probed {
    /// The probes' slots.
    pub fn slots(&self) -> impl Iterator<Item = SlotId> {
        (self.first.0..u32::try_from(self.program.slots.len()).unwrap_or(u32::MAX)).map(SlotId)
    }
}

/// Puts probes into the routines that a cycle may run and that `counts` says yes to.
#[must_use]
pub fn probed(program: &Program, counts: &dyn Fn(ItemId) -> bool) -> Probed {
    let first = u32::try_from(program.slots.len()).unwrap_or(u32::MAX);
    let mut prober = Prober { first, next: 0, statements: BTreeMap::new(), branches: BTreeMap::new() };
    let mut made = program.clone();
    for id in run(program) {
        let routine: &mut Routine = &mut made.routines[id];
        if routine.item.is_some_and(counts) {
            let body = std::mem::take(&mut routine.body);
            routine.body = prober.block(body, None);
        }
    }
    let slot = Slot {
        name: "executed".to_owned(),
        scalar: Scalar::Bool,
        initial: 0,
        role: Role::Temporary,
        range: None,
        place: None,
    };
    made.slots.extend(std::iter::repeat_n(slot, prober.next as usize));
    if prober.next > 0 {
        let target = Location { base: Base::Slot(SlotId(first)), offset: 0, indices: Vec::new() };
        let reset = StatementKind::Reset { target, length: prober.next };
        made.cycle.insert(0, Statement { kind: reset, place: None });
    }
    Probed { program: made, first: SlotId(first), statements: prober.statements, branches: prober.branches }
}

/// The routines that a cycle may run, ascending.
pub(super) fn run(program: &Program) -> BTreeSet<usize> {
    let mut found = BTreeSet::new();
    let mut open = vec![program.cycle.as_slice()];
    while let Some(statements) = open.pop() {
        let mut called = Vec::new();
        statements.iter().for_each(|statement| callees(statement, &mut called));
        for routine in called {
            let at = routine.0 as usize;
            if at < program.routines.len() && found.insert(at) {
                open.push(&program.routines[at].body);
            }
        }
    }
    found
}

fn callees(statement: &Statement, out: &mut Vec<RoutineId>) {
    match &statement.kind {
        StatementKind::Call { routine, .. } => out.push(*routine),
        StatementKind::Dispatch { routines, .. } => out.extend(routines.iter().map(|(_, routine)| *routine)),
        _ => {}
    }
    for inner in inner(statement) {
        inner.iter().for_each(|statement| callees(statement, out));
    }
}

/// The lists of statements inside of one.
fn inner(statement: &Statement) -> Vec<&[Statement]> {
    match &statement.kind {
        StatementKind::If { then, otherwise, .. } => vec![then, otherwise],
        StatementKind::Case { arms, otherwise, .. } => {
            arms.iter().map(|arm| arm.body.as_slice()).chain([otherwise.as_slice()]).collect()
        }
        StatementKind::For { body, .. } => vec![body],
        StatementKind::Loop { body, after } => vec![body, after],
        _ => Vec::new(),
    }
}

/// Whether what follows the statement may be left out: said too often rather than not.
fn diverts(statement: &Statement) -> bool {
    let own = matches!(
        statement.kind,
        StatementKind::Exit | StatementKind::Continue | StatementKind::Return | StatementKind::Fail(_)
    );
    own || inner(statement).into_iter().flatten().any(diverts)
}

struct Prober {
    first: u32,
    next: u32,
    statements: BTreeMap<Place, BTreeSet<u32>>,
    branches: BTreeMap<(Place, Way), BTreeSet<u32>>,
}

impl Prober {
    /// A new probe, and the statement that sets it.
    fn probe(&mut self) -> (u32, Statement) {
        let number = self.next;
        self.next += 1;
        let slot = SlotId(self.first.saturating_add(number));
        let target = Location { base: Base::Slot(slot), offset: 0, indices: Vec::new() };
        let value = Expr { kind: ExprKind::Const(1), scalar: Scalar::Bool, place: None };
        (number, Statement { kind: StatementKind::Assign { target, value, range: None }, place: None })
    }

    /// The statements with their probes; `way` is the branch that they are the arm of.
    fn block(&mut self, statements: Vec<Statement>, way: Option<(Place, Way)>) -> Vec<Statement> {
        let mut out = Vec::with_capacity(statements.len() + 1);
        let mut current = None;
        if let Some(way) = way {
            let (probe, set) = self.probe();
            self.branches.entry(way).or_default().insert(probe);
            out.push(set);
            current = Some(probe);
        }
        for statement in statements {
            if let Some(place) = statement.place {
                let probe = current.unwrap_or_else(|| {
                    let (probe, set) = self.probe();
                    out.push(set);
                    probe
                });
                current = Some(probe);
                self.statements.entry(place).or_default().insert(probe);
            }
            if diverts(&statement) {
                current = None;
            }
            out.push(self.inside(statement));
        }
        out
    }

    fn inside(&mut self, statement: Statement) -> Statement {
        let place = statement.place;
        let kind = match statement.kind {
            StatementKind::If { condition, then, otherwise } => {
                let at = condition.place.or(place);
                let then = self.block(then, at.map(|at| (at, Way::True)));
                let otherwise = self.block(otherwise, at.map(|at| (at, Way::False)));
                StatementKind::If { condition, then, otherwise }
            }
            StatementKind::Case { selector, arms, otherwise } => {
                let at = selector.place.or(place);
                let arm = |(number, arm): (usize, Arm)| Arm {
                    labels: arm.labels,
                    body: self.block(arm.body, at.map(|at| (at, Way::Arm(number + 1)))),
                };
                let arms = arms.into_iter().enumerate().map(arm).collect();
                // Without `ELSE`, the numbers may well be all that there are.
                let way = at.filter(|_| !otherwise.is_empty()).map(|at| (at, Way::Else));
                let otherwise = self.block(otherwise, way);
                StatementKind::Case { selector, arms, otherwise }
            }
            StatementKind::For { control, scalar, from, to, by, body } => {
                StatementKind::For { control, scalar, from, to, by, body: self.block(body, None) }
            }
            StatementKind::Loop { body, after } => {
                StatementKind::Loop { body: self.block(body, None), after: self.block(after, None) }
            }
            other => other,
        };
        Statement { kind, place }
    }
}
