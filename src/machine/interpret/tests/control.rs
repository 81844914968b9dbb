//! Branches, loops, calls.

use super::build::{
    INT, USINT, apply, at, branch, call, count, number, once, program, read, referent, routine, set, statement, this,
    value,
};
use crate::library::ItemId;
use crate::machine::interpret::{Assigned, Interpreter};
use crate::machine::program::{Arm, RoutineId, SlotId, Statement, StatementKind, Value};
use crate::semantics::expr::{ExprKind, Fault, Op};
use crate::semantics::scalar::Scalar;
use crate::text::{FileId, Place, Span};

fn counted(scalar: Scalar, from: i128, to: Value, by: i128, body: Vec<Statement>) -> Statement {
    statement(StatementKind::For {
        control: at(0),
        scalar,
        from: number(scalar, from),
        to,
        by: number(scalar, by),
        body,
    })
}

fn endless(body: Vec<Statement>, after: Vec<Statement>) -> Statement {
    statement(StatementKind::Loop { body, after })
}

#[test]
fn for_ends_where_its_type_does() {
    let body = vec![count(1)];
    let unit = program(&[USINT, INT], vec![counted(USINT, 0, number(USINT, 255), 1, body)]);
    assert_eq!(once(&unit), Ok(vec![0, 256]));
    let unit = program(&[INT, INT], vec![counted(INT, 5, number(INT, 1), -2, vec![count(1)])]);
    assert_eq!(once(&unit), Ok(vec![INT.bits(-1), 3]));
    let unit = program(&[INT, INT], vec![counted(INT, 5, number(INT, 1), 1, vec![count(1)])]);
    assert_eq!(once(&unit), Ok(vec![5, 0]));
}

#[test]
fn the_bounds_of_for_are_evaluated_once() {
    let unit =
        program(&[INT, INT], vec![set(at(1), number(INT, 3)), counted(INT, 1, read(INT, at(1)), 1, vec![count(1)])]);
    assert_eq!(once(&unit), Ok(vec![4, 6]));
}

#[test]
fn a_step_of_zero_and_an_endless_loop_are_faults() {
    let unit = program(&[INT], vec![counted(INT, 1, number(INT, 3), 0, Vec::new())]);
    assert_eq!(once(&unit), Err(Fault::LoopLimit));
    assert_eq!(once(&program(&[INT], vec![endless(vec![count(0)], Vec::new())])), Err(Fault::LoopLimit));
    // A computed bound beyond the limit of 50 is a fault, a constant one is done.
    let unit = |to: Value| program(&[INT, INT, INT], vec![set(at(2), number(INT, 51)), counted(INT, 1, to, 1, vec![])]);
    assert_eq!(once(&unit(read(INT, at(2)))), Err(Fault::LoopLimit));
    assert_eq!(once(&unit(number(INT, 51))), Ok(vec![52, 0, 51]));
}

#[test]
fn continue_goes_to_what_follows_the_body() {
    let less = |slot, bound| apply(Op::Lt, Scalar::Bool, vec![read(INT, at(slot)), number(INT, bound)]);
    let body = vec![count(0), branch(less(0, 3), vec![statement(StatementKind::Continue)]), count(1)];
    let until = vec![branch(
        apply(Op::Le, Scalar::Bool, vec![number(INT, 5), read(INT, at(0))]),
        vec![statement(StatementKind::Exit)],
    )];
    let unit = program(&[INT, INT, INT], vec![endless(body, until), count(2)]);
    assert_eq!(once(&unit), Ok(vec![5, 3, 1]));
}

#[test]
fn case_takes_the_first_arm_that_fits() {
    let arm = |low, high, slot| Arm { labels: vec![(low, high)], body: vec![count(slot)] };
    let case = |selector: i128| {
        let kind = StatementKind::Case {
            selector: number(INT, selector),
            arms: vec![arm(-1, 3, 0), arm(3, 5, 1)],
            otherwise: vec![count(2)],
        };
        once(&program(&[INT, INT, INT], vec![statement(kind)]))
    };
    assert_eq!(case(-1), Ok(vec![1, 0, 0]));
    assert_eq!(case(3), Ok(vec![1, 0, 0]));
    assert_eq!(case(4), Ok(vec![0, 1, 0]));
    assert_eq!(case(-2), Ok(vec![0, 0, 1]));
}

#[test]
fn return_leaves_the_routine_and_not_its_caller() {
    let mut unit = program(&[INT, INT], vec![call(0, None), count(1)]);
    unit.routines =
        vec![routine(vec![endless(vec![count(0), statement(StatementKind::Return)], Vec::new()), count(0)], &[])];
    assert_eq!(once(&unit), Ok(vec![1, 1]));
}

#[test]
fn locals_are_new_at_each_call_and_this_is_where_it_is_called_on() {
    let mut unit = program(&[INT; 4], vec![call(0, Some(at(0))), call(0, Some(at(2))), call(0, Some(at(2)))]);
    unit.slots[3].initial = 10;
    let sum = apply(Op::Add, INT, vec![read(INT, this(0)), read(INT, at(3))]);
    unit.routines = vec![routine(vec![count(3), set(this(0), sum)], &[(3, 1)])];
    assert_eq!(once(&unit), Ok(vec![11, 0, 22, 11]));
}

#[test]
fn a_routine_that_calls_itself_is_stopped() {
    let mut unit = program(&[INT], vec![call(0, None)]);
    unit.routines = vec![routine(vec![call(0, None)], &[])];
    assert_eq!(once(&unit), Err(Fault::LoopLimit));
}

#[test]
fn dispatch_goes_by_the_class_of_the_instance() {
    let dispatch = |slot: u32| {
        statement(StatementKind::Dispatch {
            target: read(Scalar::Ref, at(slot)),
            routines: vec![(ItemId(7), RoutineId(0)), (ItemId(3), RoutineId(1))],
        })
    };
    let address = |slot| value(ExprKind::Address(at(slot)), Scalar::Ref);
    let mut unit = program(&[Scalar::Ref, INT, Scalar::Ref, INT, Scalar::Ref], Vec::new());
    unit.instances = vec![(SlotId(0), ItemId(7)), (SlotId(2), ItemId(3))];
    let add = |by| set(this(1), apply(Op::Add, INT, vec![read(INT, this(1)), number(INT, by)]));
    unit.routines = vec![routine(vec![add(1)], &[]), routine(vec![add(100)], &[])];
    unit.cycle = vec![set(at(4), address(0)), dispatch(4), set(at(4), address(2)), dispatch(4)];
    assert_eq!(once(&unit), Ok(vec![0, 1, 0, 100, 3]));
    unit.cycle = vec![dispatch(4)];
    assert_eq!(once(&unit), Err(Fault::NullReference));
    unit.cycle = vec![set(at(4), address(1)), dispatch(4)];
    assert_eq!(once(&unit), Err(Fault::NullReference));
}

#[test]
fn a_fault_ends_the_run_and_says_where() {
    let place = Place::new(FileId(0), Span::new(3, 8));
    let mut quotient = apply(Op::Div, INT, vec![number(INT, 1), read(INT, at(0))]);
    quotient.place = Some(place);
    let mut run = Interpreter::new(&program(&[INT, INT], vec![set(at(1), quotient)]));
    run.set(SlotId(0), 2);
    assert_eq!(run.cycle(), Ok(()));
    run.set(SlotId(0), 0);
    let fault = run.cycle().expect_err("a division by zero");
    assert_eq!((fault.fault, fault.place), (Fault::DivisionByZero, Some(place)));
    run.set(SlotId(0), 2);
    assert_eq!(run.cycle(), Err(fault));
    assert_eq!(run.cycles(), 1);
    run.cold_start();
    run.set(SlotId(0), 2);
    assert_eq!(run.cycle(), Ok(()));
}

#[test]
fn a_fault_of_the_startup_is_told_by_the_first_cycle() {
    let mut unit = program(&[INT], vec![count(0)]);
    unit.startup = vec![statement(StatementKind::Fail(Fault::NullReference))];
    assert_eq!(once(&unit), Err(Fault::NullReference));
    unit.startup = vec![count(0)];
    assert_eq!(once(&unit), Ok(vec![2]));
}

#[test]
fn the_observer_sees_every_assignment() {
    let mut run = Interpreter::new(&program(&[INT, INT], vec![count(1), set(at(0), read(INT, at(1)))]));
    let mut seen: Vec<Assigned> = Vec::new();
    assert_eq!(run.cycle_observed(&mut seen), Ok(()));
    let seen: Vec<_> = seen.iter().map(|assigned| (assigned.slot.0, assigned.value)).collect();
    assert_eq!(seen, [(1, 1), (0, 1)]);
}

#[test]
fn a_made_up_address_is_a_null_reference() {
    let far = value(ExprKind::Const(1000), Scalar::Ref);
    assert_eq!(once(&program(&[INT], vec![set(referent(far), number(INT, 1))])), Err(Fault::NullReference));
    assert_eq!(once(&program(&[INT], vec![set(at(9), number(INT, 1))])), Err(Fault::NullReference));
    assert_eq!(once(&program(&[INT], vec![call(3, None)])), Err(Fault::NullReference));
}
