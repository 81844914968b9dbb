//! A cylinder with one valve, a step variable and three on-delay timers, as the elaboration makes it of Structured Text.

use rungbook::library::ItemId;
use rungbook::machine::program::{
    Arm, Base, Location, Program, Role, Routine, RoutineId, Slot, SlotId, Statement, StatementKind, Value,
};
use rungbook::semantics::expr::{Expr, ExprKind, Op};
use rungbook::semantics::scalar::Scalar;

const STEP: Scalar = Scalar::Int { signed: true, width: 16 };
const TIME: Scalar = Scalar::Time(32);

pub(super) const EXTEND: SlotId = SlotId(1);
pub(super) const EXTENDED: SlotId = SlotId(3);
pub(super) const RETRACTED: SlotId = SlotId(4);
pub(super) const VALVE: SlotId = SlotId(5);
const STEP_AT: u32 = 6;
/// The timers, seven slots each: header, IN, PT, Q, ET, the last IN, the elapsed time.
const TIMERS: [u32; 3] = [7, 14, 21];
const LIMITS: [u32; 2] = [28, 29];

fn location(base: Base, offset: u32) -> Location {
    Location { base, offset, indices: Vec::new() }
}

fn slot(at: u32) -> Location {
    location(Base::Slot(SlotId(at)), 0)
}

fn member(offset: u32) -> Location {
    location(Base::This, offset)
}

fn read(scalar: Scalar, from: Location) -> Value {
    Expr { kind: ExprKind::Read(from), scalar, place: None }
}

fn constant(scalar: Scalar, bits: u64) -> Value {
    Expr { kind: ExprKind::Const(bits), scalar, place: None }
}

fn apply(op: Op, scalar: Scalar, operands: Vec<Value>) -> Value {
    Expr { kind: ExprKind::Apply(op, operands), scalar, place: None }
}

fn not(value: Value) -> Value {
    apply(Op::Not, Scalar::Bool, vec![value])
}

fn is(step: u64) -> Value {
    apply(Op::Eq, Scalar::Bool, vec![read(STEP, member(STEP_AT)), constant(STEP, step)])
}

fn set(target: Location, value: Value) -> Statement {
    Statement { kind: StatementKind::Assign { target, value, range: None }, place: None }
}

fn go(step: u64) -> Vec<Statement> {
    vec![set(member(STEP_AT), constant(STEP, step))]
}

fn branch(condition: Value, then: Vec<Statement>, otherwise: Vec<Statement>) -> Statement {
    Statement { kind: StatementKind::If { condition, then, otherwise }, place: None }
}

fn case(arms: Vec<(Vec<i128>, Vec<Statement>)>) -> Statement {
    let arm = |(labels, body): (Vec<i128>, _)| Arm { labels: labels.into_iter().map(|l| (l, l)).collect(), body };
    let selector = read(STEP, member(STEP_AT));
    let arms = arms.into_iter().map(arm).collect();
    Statement { kind: StatementKind::Case { selector, arms, otherwise: Vec::new() }, place: None }
}

/// `TON`, called on a timer.
fn timer() -> Routine {
    let bit = |offset| read(Scalar::Bool, member(offset));
    let rising = apply(Op::And, Scalar::Bool, vec![bit(1), not(bit(5))]);
    let elapsed = vec![set(member(4), read(TIME, member(6)))];
    let late = apply(Op::Le, Scalar::Bool, vec![read(TIME, member(2)), read(TIME, member(4))]);
    let full = branch(late.clone(), vec![set(member(4), read(TIME, member(2)))], Vec::new());
    let running = vec![
        branch(rising, vec![set(member(6), constant(TIME, 0))], Vec::new()),
        branch(not(bit(3)), elapsed, Vec::new()),
        full,
        set(member(3), late),
    ];
    let idle = vec![set(member(4), constant(TIME, 0)), set(member(3), constant(Scalar::Bool, 0))];
    let body = vec![branch(bit(1), running, idle), set(member(5), bit(1))];
    Routine { name: "TON".into(), item: None, body, locals: Vec::new() }
}

/// Calls a timer while the step is `step`; `late` is done when its time is over.
fn timed(index: usize, step: u64, limit: u32, late: Vec<Statement>) -> Vec<Statement> {
    let at = TIMERS[index];
    let this = Some(member(at));
    vec![
        set(member(at + 1), is(step)),
        set(member(at + 2), read(TIME, slot(limit))),
        Statement { kind: StatementKind::Call { routine: RoutineId(0), this }, place: None },
        branch(read(Scalar::Bool, member(at + 3)), late, Vec::new()),
    ]
}

fn body() -> Vec<Statement> {
    let bit = |at: SlotId| read(Scalar::Bool, member(at.0));
    let mut body = vec![case(vec![
        (vec![0, 1], vec![branch(bit(EXTEND), go(2), Vec::new())]),
        (vec![2, 3, 5], vec![branch(not(bit(EXTEND)), go(0), Vec::new())]),
    ])];
    body.extend(timed(0, 2, LIMITS[0], go(4)));
    body.extend(timed(1, 4, LIMITS[1], vec![branch(bit(RETRACTED), go(5), go(6))]));
    body.extend(timed(2, 0, LIMITS[1], go(6)));
    body.push(case(vec![
        (vec![0], vec![branch(bit(RETRACTED), go(1), Vec::new())]),
        (vec![1], vec![branch(not(bit(RETRACTED)), go(0), Vec::new())]),
        (vec![2], vec![branch(bit(EXTENDED), go(3), Vec::new())]),
        (vec![3], vec![branch(not(bit(EXTENDED)), go(2), Vec::new())]),
    ]));
    body.push(set(member(VALVE.0), apply(Op::Or, Scalar::Bool, vec![is(2), is(3)])));
    body.push(set(member(2), is(6)));
    body
}

/// The program.
pub(super) fn program() -> Program {
    let scalar = |at: u32| match at {
        6 => STEP,
        0 | 7 | 14 | 21 => Scalar::Ref,
        28 | 29 => TIME,
        7..28 if matches!((at - 7) % 7, 2 | 4 | 6) => TIME,
        _ => Scalar::Bool,
    };
    let initial = |at| match at {
        28 => 500,
        29 => 200,
        _ => 0,
    };
    let slots = (0..30).map(|at| Slot {
        name: format!("slot {at}"),
        scalar: scalar(at),
        initial: initial(at),
        role: Role::State,
        range: None,
        place: None,
    });
    let cylinder = Routine { name: "Cylinder".into(), item: None, body: body(), locals: Vec::new() };
    let call = StatementKind::Call { routine: RoutineId(1), this: Some(slot(0)) };
    Program {
        name: "Cylinder".into(),
        unit: ItemId(0),
        slots: slots.collect(),
        routines: vec![timer(), cylinder],
        startup: Vec::new(),
        cycle: vec![Statement { kind: call, place: None }],
        this: SlotId(0),
        instances: Vec::new(),
        clocks: TIMERS.iter().map(|at| (SlotId(at + 6), 10)).collect(),
        cycle_time: 10_000_000,
        assumptions: Vec::new(),
        cone: Vec::new(),
        enumerations: std::collections::BTreeMap::new(),
        variables: Vec::new(),
    }
}
