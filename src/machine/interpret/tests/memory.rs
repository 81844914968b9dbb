//! Arrays, references, copies, clocks.

use super::build::{INT, at, element, number, once, program, read, referent, set, statement, value};
use crate::machine::interpret::Interpreter;
use crate::machine::program::{SlotId, StatementKind};
use crate::semantics::expr::{ExprKind, Fault};
use crate::semantics::scalar::Scalar;

#[test]
fn indices_count_from_their_lower_bound_and_are_checked() {
    let write = |index: i128| {
        let target = element(0, number(INT, index), -1, 2, 2);
        once(&program(&[INT; 4], vec![set(target, number(INT, 9))]))
    };
    assert_eq!(write(-1), Ok(vec![9, 0, 0, 0]));
    assert_eq!(write(0), Ok(vec![0, 0, 9, 0]));
    assert_eq!(write(1), Err(Fault::IndexOutOfBounds));
    assert_eq!(write(-2), Err(Fault::IndexOutOfBounds));
}

#[test]
fn references_are_addresses_and_null_is_a_fault() {
    let address = value(ExprKind::Address(at(1)), Scalar::Ref);
    let through = || referent(read(Scalar::Ref, at(0)));
    let unit = program(&[Scalar::Ref, INT], vec![set(at(0), address), set(through(), number(INT, 7))]);
    assert_eq!(once(&unit), Ok(vec![2, 7]));
    let unit = program(&[Scalar::Ref, INT], vec![set(through(), number(INT, 7))]);
    assert_eq!(once(&unit), Err(Fault::NullReference));
}

#[test]
fn a_value_outside_of_its_subrange_is_a_fault() {
    let assign = |bits: i128| {
        let kind = StatementKind::Assign { target: at(0), value: number(INT, bits), range: Some((-5, 5)) };
        once(&program(&[INT], vec![statement(kind)]))
    };
    assert_eq!(assign(-5), Ok(vec![INT.bits(-5)]));
    assert_eq!(assign(6), Err(Fault::SubrangeViolation));
}

#[test]
fn ranges_are_copied_and_reset_whole() {
    let copy = statement(StatementKind::Copy { target: at(1), source: at(0), length: 3 });
    let reset = statement(StatementKind::Reset { target: at(0), length: 2 });
    let mut unit = program(&[INT; 4], vec![copy, reset]);
    for (slot, initial) in unit.slots.iter_mut().zip([1, 2, 3, 4]) {
        slot.initial = initial;
    }
    let mut run = Interpreter::new(&unit);
    run.set(SlotId(0), 8);
    assert_eq!(run.cycle(), Ok(()));
    assert_eq!(run.memory(), [1, 2, 2, 3]);
    let outside = statement(StatementKind::Reset { target: at(2), length: 3 });
    assert_eq!(once(&program(&[INT; 4], vec![outside])), Err(Fault::NullReference));
}

#[test]
fn clocks_go_on_at_the_beginning_of_a_cycle_and_wrap() {
    let mut unit = program(&[Scalar::Time(32), Scalar::Time(32)], Vec::new());
    unit.clocks = vec![(SlotId(0), 10)];
    unit.slots[0].initial = u64::from(u32::MAX) - 14;
    unit.cycle = vec![set(at(1), read(Scalar::Time(32), at(0)))];
    let mut run = Interpreter::new(&unit);
    let mut seen = Vec::new();
    for _ in 0..3 {
        assert_eq!(run.cycle(), Ok(()));
        seen.push(run.get(SlotId(1)));
    }
    assert_eq!(seen, [u64::from(u32::MAX) - 4, 5, 15]);
}

#[test]
fn values_from_outside_are_cut_to_their_width() {
    let mut run = Interpreter::new(&program(&[INT], Vec::new()));
    run.set(SlotId(0), 0x1_FFFF);
    run.set(SlotId(9), 1);
    assert_eq!((run.get(SlotId(0)), run.get(SlotId(9))), (0xFFFF, 0));
}
