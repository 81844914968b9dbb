//! From a program to its compact form.

use std::collections::BTreeMap;

use super::Options;
use super::code::{
    Address, Area, Arm, Binary, Body, Case, Code, Dispatch, Do, For, If, Loop, Make, Measure, Node, Number, PlaceId,
    Set, Start, Step, Stop, TextDo,
};
use crate::machine::program::{Base, Index, Location, Program, Statement, StatementKind, Text, TextOperation, Value};
use crate::semantics::eval::is_unary;
use crate::semantics::expr::{ExprKind, Op};
use crate::semantics::scalar::Scalar;
use crate::text::Place;

/// The compact form of `program`.
pub(super) fn code(program: &Program, options: &Options) -> Code {
    let mut compiler = Compiler { places: vec![None], known: BTreeMap::new(), loop_limit: options.loop_limit };
    let routine = |compiler: &mut Compiler, routine: &crate::machine::program::Routine| Body {
        statements: compiler.block(&routine.body),
        locals: routine.locals.iter().map(|(slot, count)| (slot.0, *count)).collect(),
    };
    let routines = program.routines.iter().map(|body| routine(&mut compiler, body)).collect();
    let startup = compiler.block(&program.startup);
    let cycle = compiler.block(&program.cycle);
    let scalar = |slot: u32| program.slots.get(slot as usize).map_or(Scalar::Bits(64), |slot| slot.scalar);
    Code {
        initial: program.slots.iter().map(|slot| slot.initial).collect(),
        scalars: program.slots.iter().map(|slot| slot.scalar).collect(),
        routines,
        startup,
        cycle,
        this: program.this.0,
        clocks: program.clocks.iter().map(|(slot, step)| (slot.0, *step, scalar(slot.0))).collect(),
        instances: program.instances.iter().map(|(slot, class)| (slot.0, *class)).collect(),
        places: compiler.places,
        loop_limit: options.loop_limit,
    }
}

struct Compiler {
    places: Vec<Option<Place>>,
    known: BTreeMap<Place, PlaceId>,
    loop_limit: u64,
}

impl Compiler {
    fn place(&mut self, place: Option<Place>) -> PlaceId {
        let Some(place) = place else { return 0 };
        let next = u32::try_from(self.places.len()).unwrap_or(0);
        let id = *self.known.entry(place).or_insert(next);
        if id == next {
            self.places.push(Some(place));
        }
        id
    }

    fn block(&mut self, statements: &[Statement]) -> Vec<Do> {
        statements.iter().map(|statement| self.statement(statement)).collect()
    }

    fn statement(&mut self, statement: &Statement) -> Do {
        let place = self.place(statement.place);
        match &statement.kind {
            StatementKind::Assign { target, value, range } => self.assignment(target, value, *range, place),
            StatementKind::Copy { target, source, length } => Do::Copy {
                target: Box::new(self.address(target)),
                source: Box::new(self.address(source)),
                length: *length,
                place,
            },
            StatementKind::Reset { target, length } => {
                Do::Reset { target: Box::new(self.address(target)), length: *length, place }
            }
            StatementKind::If { condition, then, otherwise } => Do::If(Box::new(If {
                condition: self.node(condition),
                then: self.block(then),
                otherwise: self.block(otherwise),
            })),
            StatementKind::Case { selector, arms, otherwise } => Do::Case(Box::new(Case {
                selector: self.number(selector),
                arms: arms.iter().map(|arm| Arm { labels: arm.labels.clone(), body: self.block(&arm.body) }).collect(),
                otherwise: self.block(otherwise),
            })),
            StatementKind::For { .. } | StatementKind::Loop { .. } => self.loop_statement(&statement.kind, place),
            StatementKind::Exit => Do::Exit,
            StatementKind::Continue => Do::Continue,
            StatementKind::Return => Do::Return,
            StatementKind::Call { routine, this } => {
                let this = this.as_ref().map(|location| Box::new(self.address(location)));
                Do::Call { routine: routine.0, this, place }
            }
            StatementKind::Dispatch { target, routines } => {
                let mut routines: Vec<_> = routines.iter().map(|(class, routine)| (*class, routine.0)).collect();
                routines.sort_by_key(|(class, _)| *class);
                Do::Dispatch(Box::new(Dispatch { target: self.node(target), routines, place }))
            }
            StatementKind::Text(operation) => Do::Text(Box::new(self.text(operation)), place),
            StatementKind::Fail(fault) => Do::Fail(Stop::new(*fault, place)),
        }
    }

    fn assignment(&mut self, target: &Location, value: &Value, range: Option<(i128, i128)>, place: PlaceId) -> Do {
        match &target.base {
            Base::Slot(slot) if range.is_none() && target.indices.is_empty() => {
                Do::SetSlot(slot.0.saturating_add(target.offset), self.node(value), place)
            }
            Base::This if range.is_none() && target.indices.is_empty() => {
                Do::SetMember(target.offset, self.node(value), place)
            }
            _ => {
                let target = self.address(target);
                Do::Set(Box::new(Set { target, value: self.number(value), range, place }))
            }
        }
    }

    fn loop_statement(&mut self, kind: &StatementKind, place: PlaceId) -> Do {
        match kind {
            StatementKind::For { control, scalar, from, to, by, body } => Do::For(Box::new(For {
                control: self.address(control),
                scalar: *scalar,
                limit: constant_count(from, to, by).map_or(self.loop_limit, |count| count.max(self.loop_limit)),
                from: self.number(from),
                to: self.number(to),
                by: self.number(by),
                body: self.block(body),
                place,
            })),
            StatementKind::Loop { body, after } => {
                Do::Loop(Box::new(Loop { body: self.block(body), after: self.block(after), place }))
            }
            _ => Do::Exit,
        }
    }

    fn number(&mut self, value: &Value) -> Number {
        Number { node: self.node(value), scalar: value.scalar }
    }

    fn pair(&mut self, first: &Value, second: &Value) -> Box<[Node; 2]> {
        Box::new([self.node(first), self.node(second)])
    }

    fn triple(&mut self, first: &Value, second: &Value, third: &Value) -> Box<[Node; 3]> {
        Box::new([self.node(first), self.node(second), self.node(third)])
    }

    fn node(&mut self, value: &Value) -> Node {
        match &value.kind {
            ExprKind::Const(bits) => Node::Const(*bits),
            ExprKind::Read(location) => match &location.base {
                Base::Slot(slot) if location.indices.is_empty() => Node::Slot(slot.0.saturating_add(location.offset)),
                Base::This if location.indices.is_empty() => Node::Member(location.offset),
                _ => Node::Load(Box::new(self.address(location))),
            },
            ExprKind::Address(location) => Node::AddressOf(Box::new(self.address(location))),
            ExprKind::AndThen(first, second) => Node::AndThen(self.pair(first, second)),
            ExprKind::OrElse(first, second) => Node::OrElse(self.pair(first, second)),
            ExprKind::If(condition, then, otherwise) => Node::If(self.triple(condition, then, otherwise)),
            ExprKind::Apply(op, operands) => self.apply(*op, operands, value),
        }
    }

    fn apply(&mut self, op: Op, operands: &[Value], value: &Value) -> Node {
        match operands {
            [condition, then, otherwise] if op == Op::Select => Node::Select(self.triple(condition, then, otherwise)),
            [operand] if op == Op::Not && value.scalar == Scalar::Bool => Node::Not(Box::new(self.node(operand))),
            [operand] if is_unary(op) => Node::Unary(op, value.scalar, operand.scalar, Box::new(self.node(operand))),
            [left, right] if op == Op::Eq && !matches!(left.scalar, Scalar::Real(_)) => match (&left.kind, &right.kind)
            {
                (_, ExprKind::Const(bits)) => Node::Is(Box::new(self.node(left)), *bits),
                (ExprKind::Const(bits), _) => Node::Is(Box::new(self.node(right)), *bits),
                _ => self.binary(op, operands, value),
            },
            _ => self.binary(op, operands, value),
        }
    }

    /// Two operands, or more of an operator that goes from left to right.
    fn binary(&mut self, op: Op, operands: &[Value], value: &Value) -> Node {
        let place = self.place(value.place);
        let mut operands = operands.iter();
        let Some(first) = operands.next() else { return Node::Const(0) };
        let of = first.scalar;
        let mut left = self.node(first);
        for operand in operands {
            let right = self.node(operand);
            left = Node::Binary(Box::new(Binary { op, of, left, right, place }));
        }
        left
    }

    fn address(&mut self, location: &Location) -> Address {
        let base = match &location.base {
            Base::Slot(slot) => Start::Slot(slot.0),
            Base::This => Start::This,
            Base::Referent(value) => Start::Referent(self.node(value), self.place(value.place)),
        };
        Address { base, offset: location.offset, steps: location.indices.iter().map(|i| self.step(i)).collect() }
    }

    fn step(&mut self, index: &Index) -> Step {
        Step {
            value: self.number(&index.value),
            low: i128::from(index.low),
            count: index.count,
            stride: index.stride,
            place: self.place(index.value.place),
        }
    }

    fn area(&mut self, text: &Text) -> Area {
        Area { first: self.address(&text.location), capacity: text.capacity }
    }

    fn text(&mut self, operation: &TextOperation) -> TextDo {
        let (target, make) = match operation {
            TextOperation::Compare { target, order, left, right } => {
                let compare = Measure::Compare(*order, self.area(left), self.area(right));
                return TextDo::Measure(self.address(target), Scalar::Bool, compare);
            }
            TextOperation::Length(target, scalar, text) => {
                return TextDo::Measure(self.address(target), *scalar, Measure::Length(self.area(text)));
            }
            TextOperation::Find(target, scalar, text, needle) => {
                let find = Measure::Find(self.area(text), self.area(needle));
                return TextDo::Measure(self.address(target), *scalar, find);
            }
            TextOperation::Assign(to, from) => (to, Make::Assign(self.area(from))),
            TextOperation::Literal(to, characters) => {
                (to, Make::Literal(characters.iter().map(|c| u64::from(*c)).collect()))
            }
            TextOperation::Concat(to, a, b) => (to, Make::Concat(self.area(a), self.area(b))),
            TextOperation::Left(to, a, count) => (to, Make::Left(self.area(a), self.number(count))),
            TextOperation::Right(to, a, count) => (to, Make::Right(self.area(a), self.number(count))),
            TextOperation::Mid(to, a, count, at) => (to, Make::Mid(self.area(a), self.number(count), self.number(at))),
            TextOperation::Insert(to, a, b, at) => (to, Make::Insert(self.area(a), self.area(b), self.number(at))),
            TextOperation::Delete(to, a, count, at) => {
                (to, Make::Delete(self.area(a), self.number(count), self.number(at)))
            }
            TextOperation::Replace(to, a, b, count, at) => {
                (to, Make::Replace(self.area(a), self.area(b), self.number(count), self.number(at)))
            }
        };
        TextDo::Make(self.area(target), make)
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
