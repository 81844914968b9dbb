//! Statements without loops and calls.

use super::Unsupported;
use super::flow::Executor;
use super::memory;
use crate::logic::term::{Op, Term};
use crate::machine::program::{Arm, Location, Statement, StatementKind, Value};
use crate::semantics::encode::{self, Context};
use crate::semantics::expr::Fault;
use crate::semantics::scalar::Scalar;
use crate::text::Place;

impl<'p> Executor<'p> {
    /// Executes statements, as far as a path leads.
    pub(super) fn block(&mut self, statements: &'p [Statement]) -> Result<(), Unsupported> {
        for statement in statements {
            if self.is_dead() {
                return Ok(());
            }
            self.step(statement.place)?;
            self.statement(statement)?;
        }
        Ok(())
    }

    fn statement(&mut self, statement: &'p Statement) -> Result<(), Unsupported> {
        let place = statement.place;
        match &statement.kind {
            StatementKind::Assign { target, value, range } => self.assign(target, value, *range, place),
            StatementKind::Copy { target, source, length } => self.copy(target, source, *length, place),
            StatementKind::Reset { target, length } => self.reset(target, *length, place),
            StatementKind::If { condition, then, otherwise } => {
                let condition = encode::value(self, condition)?;
                self.branch(condition, then, otherwise)
            }
            StatementKind::Case { selector, arms, otherwise } => {
                let number = encode::value(self, selector)?;
                self.case(number, selector.scalar, arms, otherwise)
            }
            StatementKind::For { .. } => self.counted(statement),
            StatementKind::Loop { body, after } => self.endless(body, after, place),
            StatementKind::Exit => {
                self.jump(false);
                Ok(())
            }
            StatementKind::Continue => {
                self.jump(true);
                Ok(())
            }
            StatementKind::Return => {
                self.return_();
                Ok(())
            }
            StatementKind::Call { routine, this } => self.call(*routine, this.as_ref(), place),
            StatementKind::Dispatch { target, routines } => self.dispatch(target, routines, place),
            StatementKind::Text(operation) => self.text(operation, place),
            StatementKind::Fail(fault) => {
                self.fail(*fault, place);
                Ok(())
            }
        }
    }

    /// The present path ends with a fault.
    pub(super) fn fail(&mut self, fault: Fault, place: Option<Place>) {
        let yes = self.pool.truth(true);
        self.fault(yes, fault, place);
    }

    fn assign(
        &mut self,
        target: &'p Location,
        value: &'p Value,
        range: Option<(i128, i128)>,
        place: Option<Place>,
    ) -> Result<(), Unsupported> {
        let term = encode::value(self, value)?;
        let area = self.resolve(target, place)?;
        if let Some((low, high)) = range {
            let inside = self.in_range(term, value.scalar, low, high);
            let outside = self.not(inside);
            self.fault(outside, Fault::SubrangeViolation, place);
        }
        self.store(&area, 0, term);
        Ok(())
    }

    fn copy(
        &mut self,
        target: &'p Location,
        source: &'p Location,
        length: u32,
        place: Option<Place>,
    ) -> Result<(), Unsupported> {
        let source = self.resolve(source, place)?;
        let target = self.resolve(target, place)?;
        // All is read before anything is written, since the ranges may overlap.
        let values: Vec<Term> = (0..length)
            .map(|offset| {
                let scalar = self.scalar_at(&source, offset);
                self.load(&source, offset, scalar)
            })
            .collect();
        for (offset, value) in (0..length).zip(values) {
            self.store(&target, offset, value);
        }
        Ok(())
    }

    fn reset(&mut self, target: &'p Location, length: u32, place: Option<Place>) -> Result<(), Unsupported> {
        let area = self.resolve(target, place)?;
        for (guard, first) in self.alternatives(&area) {
            for slot in first..first.saturating_add(length) {
                if let (Some(before), Some(initial)) = (self.memory.get(slot), self.initial(slot)) {
                    let value = self.pool.apply(Op::Ite, &[guard, initial, before]);
                    self.memory.set(slot, value);
                }
            }
        }
        Ok(())
    }

    fn branch(
        &mut self,
        condition: Term,
        then: &'p [Statement],
        otherwise: &'p [Statement],
    ) -> Result<(), Unsupported> {
        match self.pool.value(condition) {
            Some(0) => return self.block(otherwise),
            Some(_) => return self.block(then),
            None => {}
        }
        let (mark, before) = (self.memory.mark(), self.path());
        let opposite = self.not(condition);
        let (yes, no) = (self.and(before, condition), self.and(before, opposite));
        self.set_path(yes);
        self.block(then)?;
        let (then_path, then_dead) = (self.path(), self.is_dead());
        let changed = self.memory.changes(mark);
        self.memory.rewind(mark);
        self.set_path(no);
        self.block(otherwise)?;
        if then_dead {
            return Ok(());
        }
        if self.is_dead() {
            self.memory.replace(mark, &changed);
            self.set_path(then_path);
            return Ok(());
        }
        let unchanged = self.memory.changes(mark);
        let merged = memory::merge(&mut self.pool, condition, &changed, &unchanged);
        self.memory.replace(mark, &merged);
        let else_path = self.path();
        let path = if then_path == yes && else_path == no { before } else { self.or(then_path, else_path) };
        self.set_path(path);
        Ok(())
    }

    fn case(
        &mut self,
        number: Term,
        scalar: Scalar,
        arms: &'p [Arm],
        otherwise: &'p [Statement],
    ) -> Result<(), Unsupported> {
        if let Some(bits) = self.pool.value(number) {
            let number = scalar.number(bits);
            let taken = arms.iter().find(|arm| arm.labels.iter().any(|(low, high)| *low <= number && number <= *high));
            return self.block(taken.map_or(otherwise, |arm| &arm.body));
        }
        let mut alternatives = Vec::with_capacity(arms.len() + 1);
        let mut none = self.pool.truth(true);
        for (labels, arm) in exclusive(arms).into_iter().zip(arms) {
            let mut taken = self.pool.truth(false);
            for (low, high) in labels {
                let inside = self.in_range(number, scalar, low, high);
                taken = self.or(taken, inside);
            }
            let not = self.not(taken);
            none = self.and(none, not);
            alternatives.push((taken, arm.body.as_slice()));
        }
        alternatives.push((none, otherwise));
        self.alternatives_of(&alternatives, &mut |executor, body| executor.block(body))
    }

    /// Executes one of several things under exclusive conditions; the last one is the one for all the rest.
    pub(super) fn alternatives_of<T: Copy>(
        &mut self,
        alternatives: &[(Term, T)],
        execute: &mut dyn FnMut(&mut Self, T) -> Result<(), Unsupported>,
    ) -> Result<(), Unsupported> {
        let (mark, before) = (self.memory.mark(), self.path());
        let (mut arms, mut path, mut jumped) = (Vec::with_capacity(alternatives.len()), self.pool.truth(false), false);
        for (condition, what) in alternatives {
            if self.pool.value(*condition) == Some(0) {
                continue;
            }
            let taken = self.and(before, *condition);
            self.set_path(taken);
            execute(self, *what)?;
            let after = self.path();
            jumped |= after != taken;
            path = self.or(path, after);
            if !self.is_dead() {
                arms.push((*condition, self.memory.changes(mark)));
            }
            self.memory.rewind(mark);
        }
        let no = self.pool.truth(false);
        if let Some((condition, default)) = arms.pop() {
            let merged =
                if arms.is_empty() { default } else { memory::select(&mut self.pool, &arms, condition, &default) };
            self.memory.replace(mark, &merged);
        } else {
            path = no;
        }
        self.set_path(if jumped { path } else { before });
        Ok(())
    }
}

/// The labels of each arm without those of the arms before it.
fn exclusive(arms: &[Arm]) -> Vec<Vec<(i128, i128)>> {
    let mut taken: Vec<(i128, i128)> = Vec::new();
    let mut result = Vec::with_capacity(arms.len());
    for arm in arms {
        let mut own = Vec::new();
        for label in &arm.labels {
            let mut rest = if label.0 <= label.1 { vec![*label] } else { Vec::new() };
            for (low, high) in &taken {
                rest = rest.into_iter().flat_map(|range| without(range, (*low, *high))).collect();
            }
            own.extend(rest.iter().copied());
            taken.extend(rest);
        }
        result.push(own);
    }
    result
}

/// A range without another one.
fn without(range: (i128, i128), cut: (i128, i128)) -> Vec<(i128, i128)> {
    if cut.1 < range.0 || range.1 < cut.0 {
        return vec![range];
    }
    let below = (range.0, cut.0 - 1);
    let above = (cut.1 + 1, range.1);
    [below, above].into_iter().filter(|(low, high)| low <= high).collect()
}
