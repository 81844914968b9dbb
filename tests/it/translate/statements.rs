//! Random statements over a memory.

use rungbook::machine::program::{Arm, Base, Location, RoutineId, Statement, StatementKind, TextOperation, TextOrder};
use rungbook::semantics::expr::{Expr, ExprKind, Fault};
use rungbook::semantics::scalar::Scalar;

use super::choices::{Choices, int};
use super::expressions::{constant, expression};
use super::layout::{CLASSES, INSTANCE, POINTEE, ROUTINES, Scope, slot};

/// Where statements stand.
#[derive(Clone, Copy)]
pub(super) struct Around {
    /// How deep statements may still nest.
    pub(super) depth: u32,
    /// How many loops are around.
    pub(super) loops: u32,
    /// Routines from this number on may be called.
    pub(super) callable: u32,
}

impl Scope<'_> {
    pub(super) fn block(&self, choices: &mut Choices<'_>, around: Around) -> Vec<Statement> {
        (0..1 + choices.below(4)).map(|_| self.statement(choices, around)).collect()
    }

    fn statement(&self, choices: &mut Choices<'_>, around: Around) -> Statement {
        let place = choices.place();
        let kind = match choices.below(20) {
            6..=8 if around.depth > 0 => self.branch(choices, around),
            9 if around.depth > 0 => self.case(choices, around),
            10 | 11 if around.depth > 0 && around.loops < 2 => self.counted(choices, around),
            12 if around.depth > 0 && around.loops < 2 => self.endless(choices, around),
            13 if around.loops > 0 && choices.once_in(2) => {
                choices.one(&[StatementKind::Exit, StatementKind::Continue, StatementKind::Return].each_ref()).clone()
            }
            14 | 15 if around.callable < ROUTINES => self.call(choices, around),
            16 | 17 if !choices.integers_only => StatementKind::Text(Box::new(self.text_operation(choices))),
            18 => self.copy(choices),
            19 => self.reference_statement(choices),
            _ => self.assign(choices),
        };
        Statement { kind, place }
    }

    fn assign(&self, choices: &mut Choices<'_>) -> StatementKind {
        if choices.once_in(8) {
            let at = choices.one(&self.layout.references);
            let reference = Expr { kind: ExprKind::Read(slot(at)), scalar: Scalar::Ref, place: choices.place() };
            let target = Location { base: Base::Referent(Box::new(reference)), offset: 0, indices: Vec::new() };
            let value = expression(self, choices, POINTEE, 2);
            return StatementKind::Assign { target, value, range: None };
        }
        let usable: Vec<_> =
            self.layout.variables.iter().filter(|v| v.writable && (self.has_this || !v.member)).collect();
        let variable = choices.one(&usable);
        let value = match variable.range {
            Some((low, high)) if !choices.once_in(4) => {
                let number = low + i128::from(choices.next()) % (high - low + 1);
                constant(choices, variable.scalar, number)
            }
            _ => expression(self, choices, variable.scalar, 3),
        };
        let target = self.locate(choices, variable, 2);
        StatementKind::Assign { target, value, range: variable.range }
    }

    fn branch(&self, choices: &mut Choices<'_>, around: Around) -> StatementKind {
        let inner = Around { depth: around.depth - 1, ..around };
        let condition = expression(self, choices, Scalar::Bool, 2);
        let mut then = self.block(choices, inner);
        if choices.once_in(8) {
            let kind =
                if choices.once_in(20) { StatementKind::Fail(Fault::NullReference) } else { StatementKind::Return };
            then.push(Statement { kind, place: choices.place() });
        }
        let otherwise = if choices.once_in(2) { self.block(choices, inner) } else { Vec::new() };
        StatementKind::If { condition, then, otherwise }
    }

    fn case(&self, choices: &mut Choices<'_>, around: Around) -> StatementKind {
        let inner = Around { depth: around.depth - 1, ..around };
        let scalar = choices.one(&[POINTEE, int(false, 8), int(true, 64)]);
        let selector = expression(self, choices, scalar, 2);
        let arms = (0..choices.below(5))
            .map(|_| {
                let labels = (0..1 + choices.below(3)).map(|_| {
                    let low = scalar.number(choices.bits(scalar));
                    (low, low + i128::from(if choices.once_in(3) { choices.below(70_000) } else { 0 }))
                });
                Arm { labels: labels.collect(), body: self.block(choices, inner) }
            })
            .collect();
        let otherwise = if choices.once_in(2) { self.block(choices, inner) } else { Vec::new() };
        StatementKind::Case { selector, arms, otherwise }
    }

    fn counted(&self, choices: &mut Choices<'_>, around: Around) -> StatementKind {
        let whole: Vec<_> = self
            .layout
            .variables
            .iter()
            .filter(|v| v.writable && matches!(v.scalar, Scalar::Int { .. }) && (self.has_this || !v.member))
            .collect();
        let control = choices.one(&whole);
        let scalar = control.scalar;
        let inner = Around { depth: around.depth - 1, loops: around.loops + 1, ..around };
        let (from, to, by) = if choices.once_in(3) {
            let from = expression(self, choices, scalar, 1);
            let (to, by) = (expression(self, choices, scalar, 1), expression(self, choices, scalar, 1));
            (from, to, if choices.once_in(2) { by } else { constant(choices, scalar, 1) })
        } else {
            let first = if choices.once_in(4) { scalar.number(choices.bits(scalar)) } else { 0 };
            let step = i128::from(choices.one(&[1, 1, 2, -1, -3]));
            let last = first + step * i128::from(choices.below(4));
            let last = scalar.number(scalar.bits(last));
            let steps = int(true, 16);
            let from = constant(choices, scalar, first);
            (from, constant(choices, scalar, last), constant(choices, steps, step))
        };
        let control = self.locate(choices, control, 1);
        let body = self.block(choices, inner);
        StatementKind::For { control, scalar, from, to, by, body }
    }

    fn endless(&self, choices: &mut Choices<'_>, around: Around) -> StatementKind {
        let inner = Around { depth: around.depth - 1, loops: around.loops + 1, ..around };
        let leave = |choices: &mut Choices<'_>, scope: &Self| {
            let condition = expression(scope, choices, Scalar::Bool, 2);
            let then = vec![Statement { kind: StatementKind::Exit, place: choices.place() }];
            let kind = StatementKind::If { condition, then, otherwise: Vec::new() };
            Statement { kind, place: choices.place() }
        };
        let (mut body, mut after) = (self.block(choices, inner), Vec::new());
        if !choices.once_in(3) {
            body.insert(0, leave(choices, self));
        }
        if choices.once_in(2) {
            after.push(leave(choices, self));
            if choices.once_in(4) {
                after.extend(self.block(choices, Around { depth: 0, ..inner }));
            }
        }
        StatementKind::Loop { body, after }
    }

    fn call(&self, choices: &mut Choices<'_>, around: Around) -> StatementKind {
        let routine = RoutineId(around.callable + choices.below(ROUTINES - around.callable));
        match choices.below(4) {
            0 => StatementKind::Call { routine, this: Some(slot(choices.one(&self.layout.instances).0.0)) },
            1 => {
                let first = slot(self.layout.instances[0].0.0);
                let member = super::layout::Variable {
                    scalar: Scalar::Ref,
                    base: 0,
                    member: false,
                    dimensions: vec![(0, 3, INSTANCE)],
                    range: None,
                    writable: false,
                };
                let indices = self.locate(choices, &member, 2).indices;
                StatementKind::Call { routine, this: Some(Location { indices, ..first }) }
            }
            2 => {
                let target = self.reference(choices, true, 1);
                let other = RoutineId(around.callable + choices.below(ROUTINES - around.callable));
                let mut routines = vec![(CLASSES[0], routine)];
                if !choices.once_in(4) {
                    routines.push((CLASSES[1], other));
                }
                StatementKind::Dispatch { target, routines }
            }
            _ => StatementKind::Call { routine, this: None },
        }
    }

    fn copy(&self, choices: &mut Choices<'_>) -> StatementKind {
        if choices.once_in(3) {
            let usable: Vec<_> =
                self.layout.variables.iter().filter(|v| v.writable && (self.has_this || !v.member)).collect();
            let variable = choices.one(&usable);
            let target = self.locate(choices, variable, 1);
            return StatementKind::Reset { target, length: 1 };
        }
        // The members of one instance, or two of them with an overlap.
        let (from, to) = (choices.one(&self.layout.instances).0.0, choices.one(&self.layout.instances).0.0);
        let dimension = super::layout::Variable {
            scalar: Scalar::Ref,
            base: from,
            member: false,
            dimensions: vec![(0, 4, INSTANCE)],
            range: None,
            writable: false,
        };
        let mut source = slot(from + 1);
        if choices.once_in(2) {
            source = slot(self.layout.instances[0].0.0 + 1);
            source.indices = self.locate(choices, &dimension, 2).indices;
        }
        StatementKind::Copy { target: slot(to + 1), source, length: INSTANCE - 1 }
    }

    fn reference_statement(&self, choices: &mut Choices<'_>) -> StatementKind {
        let to_instance = choices.once_in(2);
        let own = if to_instance { &self.layout.interfaces } else { &self.layout.references };
        let target = slot(choices.one(own));
        StatementKind::Assign { target, value: self.reference(choices, to_instance, 2), range: None }
    }

    fn text_operation(&self, choices: &mut Choices<'_>) -> TextOperation {
        let wide = choices.once_in(3);
        let (target, first, second) = (self.text(choices, wide), self.text(choices, wide), self.text(choices, wide));
        let number = |choices: &mut Choices<'_>| {
            let scalar = choices.one(&[POINTEE, int(false, 8)]);
            match choices.once_in(2) {
                true => expression(self, choices, scalar, 2),
                false => {
                    let number = i128::from(choices.below(8)) - 1;
                    constant(choices, scalar, number)
                }
            }
        };
        let scalar_target = |choices: &mut Choices<'_>, scalar: Scalar| {
            let variable = self.variable(choices, scalar, true).cloned();
            variable.map(|variable| self.locate(choices, &variable, 1))
        };
        match choices.below(12) {
            0 => TextOperation::Assign(target, first),
            1 => {
                let codes = (0..choices.below(8)).map(|_| 0x41 + choices.below(3) as u16).collect();
                TextOperation::Literal(target, codes)
            }
            2 => TextOperation::Concat(target, first, second),
            3 => TextOperation::Left(target, first, number(choices)),
            4 => TextOperation::Right(target, first, number(choices)),
            5 => TextOperation::Mid(target, first, number(choices), number(choices)),
            6 => TextOperation::Insert(target, first, second, number(choices)),
            7 => TextOperation::Delete(target, first, number(choices), number(choices)),
            8 => TextOperation::Replace(target, first, second, number(choices), number(choices)),
            9 => match scalar_target(choices, Scalar::Bool) {
                Some(target) => {
                    let order = choices.one(&[TextOrder::Equal, TextOrder::Less, TextOrder::LessOrEqual]);
                    TextOperation::Compare { target, order, left: first, right: second }
                }
                None => TextOperation::Assign(target, first),
            },
            kind => match scalar_target(choices, POINTEE) {
                Some(number) if kind == 10 => TextOperation::Length(number, POINTEE, first),
                Some(number) => TextOperation::Find(number, POINTEE, first, second),
                None => TextOperation::Assign(target, first),
            },
        }
    }
}
