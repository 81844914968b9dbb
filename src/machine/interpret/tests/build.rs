//! Short words for programs made by hand.

use crate::library::ItemId;
use crate::machine::interpret::{Interpreter, Options};
use crate::machine::program::{
    Base, Index, Location, Program, Role, Routine, RoutineId, Slot, SlotId, Statement, StatementKind, Value,
};
use crate::semantics::expr::{ExprKind, Fault, Op};
use crate::semantics::scalar::Scalar;

pub(super) const INT: Scalar = Scalar::Int { signed: true, width: 16 };
pub(super) const USINT: Scalar = Scalar::Int { signed: false, width: 8 };

/// A program whose slots have these types and are zero at first.
pub(super) fn program(scalars: &[Scalar], cycle: Vec<Statement>) -> Program {
    let slot = |scalar: &Scalar| Slot {
        name: String::new(),
        scalar: *scalar,
        initial: 0,
        role: Role::State,
        range: None,
        place: None,
    };
    Program {
        name: "Unit".into(),
        unit: ItemId(0),
        slots: scalars.iter().map(slot).collect(),
        routines: Vec::new(),
        startup: Vec::new(),
        cycle,
        this: SlotId(0),
        instances: Vec::new(),
        clocks: Vec::new(),
        cycle_time: 10_000_000,
        assumptions: Vec::new(),
        cone: Vec::new(),
        enumerations: std::collections::BTreeMap::new(),
        variables: Vec::new(),
    }
}

pub(super) fn routine(body: Vec<Statement>, locals: &[(u32, u32)]) -> Routine {
    let locals = locals.iter().map(|(slot, count)| (SlotId(*slot), *count)).collect();
    Routine { name: String::new(), item: None, body, locals }
}

pub(super) fn at(slot: u32) -> Location {
    Location { base: Base::Slot(SlotId(slot)), offset: 0, indices: Vec::new() }
}

pub(super) fn this(offset: u32) -> Location {
    Location { base: Base::This, offset, indices: Vec::new() }
}

pub(super) fn referent(value: Value) -> Location {
    Location { base: Base::Referent(Box::new(value)), offset: 0, indices: Vec::new() }
}

pub(super) fn element(slot: u32, value: Value, low: i64, count: u32, stride: u32) -> Location {
    Location { indices: vec![Index { value, low, count, stride }], ..at(slot) }
}

pub(super) fn value(kind: ExprKind<Location>, scalar: Scalar) -> Value {
    Value { kind, scalar, place: None }
}

pub(super) fn number(scalar: Scalar, number: i128) -> Value {
    value(ExprKind::Const(scalar.bits(number)), scalar)
}

pub(super) fn read(scalar: Scalar, location: Location) -> Value {
    value(ExprKind::Read(location), scalar)
}

pub(super) fn apply(op: Op, scalar: Scalar, operands: Vec<Value>) -> Value {
    value(ExprKind::Apply(op, operands), scalar)
}

pub(super) fn statement(kind: StatementKind) -> Statement {
    Statement { kind, place: None }
}

pub(super) fn set(target: Location, value: Value) -> Statement {
    statement(StatementKind::Assign { target, value, range: None })
}

pub(super) fn branch(condition: Value, then: Vec<Statement>) -> Statement {
    statement(StatementKind::If { condition, then, otherwise: Vec::new() })
}

pub(super) fn call(routine: u32, this: Option<Location>) -> Statement {
    statement(StatementKind::Call { routine: RoutineId(routine), this })
}

/// `slot := slot + 1`, an INT.
pub(super) fn count(slot: u32) -> Statement {
    set(at(slot), apply(Op::Add, INT, vec![read(INT, at(slot)), number(INT, 1)]))
}

/// Does one cycle; the memory, or the fault.
pub(super) fn once(program: &Program) -> Result<Vec<u64>, Fault> {
    let mut run = Interpreter::with(program, &Options { loop_limit: 50 });
    run.cycle().map_err(|at| at.fault)?;
    Ok(run.memory().to_vec())
}
