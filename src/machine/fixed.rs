//! A program in a fixed-point reading: its reals are numbers that count 10^-digits, in memory and in every expression.

use super::program::{Arm, Base, Location, Program, Statement, StatementKind, Text, TextOperation, Value};
pub use crate::semantics::fixed::Reading;
use crate::semantics::scalar::Scalar;

/// Reads `program` so. Where it has reals at all, the reading is one of its assumptions.
pub fn read(program: &mut Program, reading: Reading) {
    let real = |scalar: Scalar| matches!(scalar, Scalar::Real(_));
    let mut reads = Reads { reading, seen: program.slots.iter().any(|slot| real(slot.scalar)) };
    for slot in &mut program.slots {
        slot.initial = reading.value(slot.scalar, slot.initial);
        slot.scalar = reading.scalar(slot.scalar);
    }
    for variable in &mut program.variables {
        variable.scalar = reading.scalar(variable.scalar);
    }
    let routines = program.routines.iter_mut().map(|routine| &mut routine.body);
    for body in routines.chain([&mut program.startup, &mut program.cycle]) {
        reads.block(body);
    }
    if reads.seen {
        program.assumptions.push(reading.assumption());
    }
}

struct Reads {
    reading: Reading,
    /// Whether there was a real.
    seen: bool,
}

impl Reads {
    fn block(&mut self, statements: &mut [Statement]) {
        statements.iter_mut().for_each(|statement| self.statement(&mut statement.kind));
    }

    fn statement(&mut self, kind: &mut StatementKind) {
        match kind {
            StatementKind::Assign { target, value, .. } => {
                self.location(target);
                self.value(value);
            }
            StatementKind::Copy { target, source, .. } => {
                self.location(target);
                self.location(source);
            }
            StatementKind::Reset { target, .. } => self.location(target),
            StatementKind::If { condition, then, otherwise } => {
                self.value(condition);
                self.block(then);
                self.block(otherwise);
            }
            StatementKind::Case { selector, arms, otherwise } => {
                self.value(selector);
                arms.iter_mut().for_each(|arm: &mut Arm| self.block(&mut arm.body));
                self.block(otherwise);
            }
            StatementKind::For { control, from, to, by, body, .. } => {
                self.location(control);
                [from, to, by].into_iter().for_each(|value| self.value(value));
                self.block(body);
            }
            StatementKind::Loop { body, after } => {
                self.block(body);
                self.block(after);
            }
            StatementKind::Call { this, .. } => this.iter_mut().for_each(|this| self.location(this)),
            StatementKind::Dispatch { target, .. } => self.value(target),
            StatementKind::Text(operation) => self.text_operation(operation),
            StatementKind::Exit | StatementKind::Continue | StatementKind::Return | StatementKind::Fail(_) => {}
        }
    }

    fn value(&mut self, value: &mut Value) {
        let reading = self.reading;
        self.seen |= matches!(value.scalar, Scalar::Real(_));
        reading.read(value, &mut |location| self.location(location));
    }

    fn location(&mut self, location: &mut Location) {
        if let Base::Referent(reference) = &mut location.base {
            self.value(reference);
        }
        location.indices.iter_mut().for_each(|index| self.value(&mut index.value));
    }

    fn text_operation(&mut self, operation: &mut TextOperation) {
        let (locations, texts, values): (Vec<&mut Location>, Vec<&mut Text>, Vec<&mut Value>) = match operation {
            TextOperation::Literal(a, _) => (vec![], vec![a], vec![]),
            TextOperation::Assign(a, b) => (vec![], vec![a, b], vec![]),
            TextOperation::Concat(a, b, c) => (vec![], vec![a, b, c], vec![]),
            TextOperation::Compare { target, left, right, .. } | TextOperation::Find(target, _, left, right) => {
                (vec![target], vec![left, right], vec![])
            }
            TextOperation::Length(target, _, a) => (vec![target], vec![a], vec![]),
            TextOperation::Left(a, b, n) | TextOperation::Right(a, b, n) => (vec![], vec![a, b], vec![n]),
            TextOperation::Mid(a, b, n, m) | TextOperation::Delete(a, b, n, m) => (vec![], vec![a, b], vec![n, m]),
            TextOperation::Insert(a, b, c, n) => (vec![], vec![a, b, c], vec![n]),
            TextOperation::Replace(a, b, c, n, m) => (vec![], vec![a, b, c], vec![n, m]),
        };
        locations.into_iter().for_each(|location| self.location(location));
        texts.into_iter().for_each(|text| self.location(&mut text.location));
        values.into_iter().for_each(|value| self.value(value));
    }
}
