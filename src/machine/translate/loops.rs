//! Loops, unrolled until no path is left in them. A further turn than the limit allows is a fault.

use super::Unsupported;
use super::address::Area;
use super::flow::Executor;
use crate::logic::term::{Op, Term};
use crate::machine::program::{Statement, StatementKind, Value};
use crate::semantics::encode::{self, Context};
use crate::semantics::expr::{ExprKind, Fault};
use crate::semantics::scalar::Scalar;
use crate::text::Place;

/// A number: a term and how to read it. One of 64 bits that went beyond them says so.
#[derive(Clone, Copy)]
struct Number {
    term: Term,
    signed: bool,
    /// Whether it is beyond what `term` holds, in the direction of the step.
    beyond: Option<Term>,
}

/// What a `FOR` works with.
struct Counter {
    control: Area,
    scalar: Scalar,
    to: Number,
    by: Number,
    /// Whether the step is negative.
    down: Term,
}

impl<'p> Executor<'p> {
    /// `FOR`.
    pub(super) fn counted(&mut self, statement: &'p Statement) -> Result<(), Unsupported> {
        let StatementKind::For { control, scalar, from, to, by, body } = &statement.kind else { return Ok(()) };
        let place = statement.place;
        let first = self.number(from)?;
        let (to_number, by_number) = (self.number(to)?, self.number(by)?);
        let zero = self.pool.constant(64, 0);
        let no_step = self.pool.apply(Op::Eq, &[by_number.term, zero]);
        self.fault(no_step, Fault::LoopLimit, place);
        if self.is_dead() {
            return Ok(());
        }
        let area = self.resolve(control, place)?;
        let start = self.resize(first.term, scalar.width(), false);
        self.store(&area, 0, start);
        let down = match by_number.signed {
            true => self.pool.apply(Op::Slt, &[by_number.term, zero]),
            false => self.pool.truth(false),
        };
        let counter = Counter { control: area, scalar: *scalar, to: to_number, by: by_number, down };
        let limit = constant_count(from, to, by).map_or(0, |count| count).max(self.options.loop_limit);
        self.enter(true);
        self.turns(&counter, first, body, limit, place)?;
        self.leave();
        Ok(())
    }

    /// The turns of a `FOR`, from its first number on.
    fn turns(
        &mut self,
        counter: &Counter,
        first: Number,
        body: &'p [Statement],
        limit: u64,
        place: Option<Place>,
    ) -> Result<(), Unsupported> {
        let mut number = first;
        let mut count = 0;
        loop {
            self.step(place)?;
            let passed = self.passed(counter, number);
            self.leave_loop_if(passed);
            if self.is_dead() {
                return Ok(());
            }
            count += 1;
            if count > limit {
                self.fail(Fault::LoopLimit, place);
                return Ok(());
            }
            self.block(body)?;
            self.join_continuing();
            if self.is_dead() {
                return Ok(());
            }
            number = self.advance(counter);
        }
    }

    /// `control := control + by`, and the number before it is cut to the type.
    fn advance(&mut self, counter: &Counter) -> Number {
        let (scalar, signed) = (counter.scalar, counter.scalar.is_signed());
        let control = self.load(&counter.control, 0, scalar);
        let before = self.resize(control, 64, signed);
        let sum = self.pool.apply(Op::Add, &[before, counter.by.term]);
        let cut = self.resize(sum, scalar.width(), false);
        self.store(&counter.control, 0, cut);
        if scalar.width() < 64 && counter.by.signed {
            return Number { term: sum, signed: true, beyond: None };
        }
        let less = if signed { Op::Slt } else { Op::Ult };
        let (fell, rose) = (self.pool.apply(less, &[sum, before]), self.pool.apply(less, &[before, sum]));
        let beyond = self.pool.apply(Op::Ite, &[counter.down, rose, fell]);
        Number { term: sum, signed, beyond: Some(beyond) }
    }

    /// Whether a number has passed the last one.
    fn passed(&mut self, counter: &Counter, number: Number) -> Term {
        let (above, below) = (self.is_less(counter.to, number), self.is_less(number, counter.to));
        let passed = self.pool.apply(Op::Ite, &[counter.down, below, above]);
        match number.beyond {
            Some(beyond) => self.or(passed, beyond),
            None => passed,
        }
    }

    /// Compares two numbers of 64 bits each, perhaps only one with a sign.
    fn is_less(&mut self, left: Number, right: Number) -> Term {
        let zero = self.pool.constant(64, 0);
        match (left.signed, right.signed) {
            (true, true) => self.pool.apply(Op::Slt, &[left.term, right.term]),
            (false, false) => self.pool.apply(Op::Ult, &[left.term, right.term]),
            (true, false) => {
                let negative = self.pool.apply(Op::Slt, &[left.term, zero]);
                let less = self.pool.apply(Op::Ult, &[left.term, right.term]);
                self.or(negative, less)
            }
            (false, true) => {
                let positive = self.pool.apply(Op::Sle, &[zero, right.term]);
                let less = self.pool.apply(Op::Ult, &[left.term, right.term]);
                self.and(positive, less)
            }
        }
    }

    /// The number that an expression gives, in 64 bits; a narrower one without a sign has one then.
    fn number(&mut self, value: &'p Value) -> Result<Number, Unsupported> {
        let term = encode::value(self, value)?;
        let term = self.resize(term, 64, value.scalar.is_signed());
        Ok(Number { term, signed: value.scalar.is_signed() || value.scalar.width() < 64, beyond: None })
    }

    /// A loop that only jumps leave.
    pub(super) fn endless(
        &mut self,
        body: &'p [Statement],
        after: &'p [Statement],
        place: Option<Place>,
    ) -> Result<(), Unsupported> {
        self.enter(true);
        for _ in 0..self.options.loop_limit {
            self.step(place)?;
            self.block(body)?;
            self.join_continuing();
            self.block(after)?;
            self.join_continuing();
            if self.is_dead() {
                break;
            }
        }
        if !self.is_dead() {
            self.fail(Fault::LoopLimit, place);
        }
        self.leave();
        Ok(())
    }
}

/// How often a `FOR` is done whose bounds are constants.
fn constant_count(from: &Value, to: &Value, by: &Value) -> Option<u64> {
    let number = |value: &Value| match value.kind {
        ExprKind::Const(bits) => Some(value.scalar.number(bits)),
        _ => None,
    };
    let (from, to, by) = (number(from)?, number(to)?, number(by)?);
    let steps = (to - from).checked_div(by)?;
    u64::try_from(steps.saturating_add(1).max(0)).ok()
}
