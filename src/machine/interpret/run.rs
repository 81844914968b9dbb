//! The walk over the compact form.

use super::Observer;
use super::code::{
    Address, Binary, Case, Code, Dispatch, Do, For, Loop, Node, Number, PlaceId, Set, Start, Step, Stop,
};
use crate::machine::program::SlotId;
use crate::semantics::eval;
use crate::semantics::expr::{Fault, Op};
use crate::semantics::scalar::Scalar;

/// How a statement ends. As wide as [`Stop`], so that both travel in registers.
#[repr(u64)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flow {
    Next,
    Exit,
    Continue,
    Return,
}

/// One walk.
pub(super) struct Walk<'c, O> {
    code: &'c Code,
    pub(super) memory: &'c mut [u64],
    observer: &'c mut O,
    /// Where the instance begins that the current routine is called on.
    this: u32,
    depth: usize,
}

impl<'c, O: Observer> Walk<'c, O> {
    pub(super) fn new(code: &'c Code, memory: &'c mut [u64], observer: &'c mut O) -> Self {
        Self { code, memory, observer, this: code.this, depth: 0 }
    }

    /// Does statements to their end.
    pub(super) fn whole(&mut self, statements: &'c [Do]) -> Result<(), Stop> {
        self.block(statements).map(|_| ())
    }

    fn block(&mut self, statements: &'c [Do]) -> Result<Flow, Stop> {
        for statement in statements {
            let flow = self.statement(statement)?;
            if flow != Flow::Next {
                return Ok(flow);
            }
        }
        Ok(Flow::Next)
    }

    fn statement(&mut self, statement: &'c Do) -> Result<Flow, Stop> {
        match statement {
            Do::SetSlot(slot, value, place) => {
                let value = self.value(value)?;
                self.store(*slot, value, *place)?;
            }
            Do::SetMember(offset, value, place) => {
                let value = self.value(value)?;
                self.store(self.this.wrapping_add(*offset), value, *place)?;
            }
            Do::If(branch) => {
                let taken = if self.value(&branch.condition)? == 0 { &branch.otherwise } else { &branch.then };
                return self.block(taken);
            }
            Do::Case(case) => return self.case(case),
            Do::Call { routine, this, place } => {
                let this = match this {
                    Some(address) => self.locate(address)?,
                    None => self.this,
                };
                self.call(*routine, this, *place)?;
            }
            Do::Exit => return Ok(Flow::Exit),
            Do::Continue => return Ok(Flow::Continue),
            Do::Return => return Ok(Flow::Return),
            Do::Set(set) => self.assign(set)?,
            Do::For(form) => return self.counted(form),
            Do::Loop(form) => return self.endless(form),
            Do::Dispatch(dispatch) => self.dispatch(dispatch)?,
            Do::Copy { target, source, length, place } => self.copy(target, source, *length, *place)?,
            Do::Reset { target, length, place } => {
                let first = self.locate(target)?;
                self.reset(first, *length, *place)?;
            }
            Do::Text(operation, place) => self.text(operation, *place)?,
            Do::Fail(stop) => return Err(*stop),
        }
        Ok(Flow::Next)
    }

    /// Sets a slot. No address that elaboration makes lies outside of memory; a made-up one is a null reference.
    #[inline]
    pub(super) fn store(&mut self, slot: u32, value: u64, place: PlaceId) -> Result<(), Stop> {
        let Some(cell) = self.memory.get_mut(slot as usize) else {
            return Err(Stop::new(Fault::NullReference, place));
        };
        *cell = value;
        if O::ACTIVE {
            let place = self.code.places.get(place as usize).copied().flatten();
            self.observer.assigned(place, SlotId(slot), value);
        }
        Ok(())
    }

    #[inline]
    fn load(&self, slot: u32) -> Result<u64, Stop> {
        self.memory.get(slot as usize).copied().ok_or_else(|| Stop::new(Fault::NullReference, 0))
    }

    /// The value of an expression.
    pub(super) fn value(&self, node: &Node) -> Result<u64, Stop> {
        match node {
            Node::Const(value) => Ok(*value),
            Node::Slot(slot) => self.load(*slot),
            Node::Member(offset) => self.load(self.this.wrapping_add(*offset)),
            Node::Not(operand) => Ok(self.value(operand)? ^ 1),
            Node::Is(operand, value) => Ok(u64::from(self.value(operand)? == *value)),
            Node::Binary(binary) => self.binary(binary),
            Node::Unary(op, to, from, operand) => Ok(eval::unary(*op, *to, *from, self.value(operand)?)),
            Node::AndThen(pair) => match self.value(&pair[0])? {
                0 => Ok(0),
                _ => self.value(&pair[1]),
            },
            Node::OrElse(pair) => match self.value(&pair[0])? {
                0 => self.value(&pair[1]),
                value => Ok(value),
            },
            Node::If(parts) => match self.value(&parts[0])? {
                0 => self.value(&parts[2]),
                _ => self.value(&parts[1]),
            },
            Node::Select(parts) => {
                let (condition, then, otherwise) =
                    (self.value(&parts[0])?, self.value(&parts[1])?, self.value(&parts[2])?);
                Ok(if condition == 0 { otherwise } else { then })
            }
            Node::Load(address) => self.load(self.locate(address)?),
            Node::AddressOf(address) => Ok(u64::from(self.locate(address)?) + 1),
        }
    }

    #[inline]
    fn binary(&self, binary: &Binary) -> Result<u64, Stop> {
        let (left, right) = (self.value(&binary.left)?, self.value(&binary.right)?);
        match binary.op {
            Op::And => Ok(left & right),
            Op::Or => Ok(left | right),
            op => eval::binary(op, binary.of, left, right).map_err(|fault| Stop::new(fault, binary.place)),
        }
    }

    /// The value of an expression as a number.
    pub(super) fn number(&self, number: &Number) -> Result<i128, Stop> {
        Ok(number.scalar.number(self.value(&number.node)?))
    }

    /// The slot that an address means.
    pub(super) fn locate(&self, address: &Address) -> Result<u32, Stop> {
        let base = match &address.base {
            Start::Slot(slot) => *slot,
            Start::This => self.this,
            Start::Referent(value, place) => self.referent(value, *place)?,
        };
        let mut at = base.wrapping_add(address.offset);
        for step in &address.steps {
            at = at.wrapping_add(self.step(step)?);
        }
        Ok(at)
    }

    fn step(&self, step: &Step) -> Result<u32, Stop> {
        let element = self.number(&step.value)? - step.low;
        match u32::try_from(element) {
            Ok(element) if element < step.count => Ok(element.wrapping_mul(step.stride)),
            _ => Err(Stop::new(Fault::IndexOutOfBounds, step.place)),
        }
    }

    fn referent(&self, value: &Node, place: PlaceId) -> Result<u32, Stop> {
        let address = self.value(value)?.checked_sub(1).and_then(|address| u32::try_from(address).ok());
        let inside = address.filter(|address| (*address as usize) < self.memory.len());
        inside.ok_or_else(|| Stop::new(Fault::NullReference, place))
    }

    fn assign(&mut self, set: &Set) -> Result<(), Stop> {
        let value = self.value(&set.value.node)?;
        let target = self.locate(&set.target)?;
        if let Some((low, high)) = set.range {
            let number = set.value.scalar.number(value);
            if number < low || number > high {
                return Err(Stop::new(Fault::SubrangeViolation, set.place));
            }
        }
        self.store(target, value, set.place)
    }

    /// Whether the range of slots lies in memory.
    fn inside(&self, first: u32, length: u32, place: PlaceId) -> Result<std::ops::Range<usize>, Stop> {
        let range = first as usize..first as usize + length as usize;
        if range.end <= self.memory.len() { Ok(range) } else { Err(Stop::new(Fault::NullReference, place)) }
    }

    /// Shows a range of slots that was set.
    fn observe(&mut self, range: std::ops::Range<usize>, place: PlaceId) {
        if O::ACTIVE {
            let place = self.code.places.get(place as usize).copied().flatten();
            for (slot, value) in range.clone().zip(&self.memory[range]) {
                self.observer.assigned(place, SlotId(slot as u32), *value);
            }
        }
    }

    fn copy(&mut self, target: &Address, source: &Address, length: u32, place: PlaceId) -> Result<(), Stop> {
        let source = self.locate(source)?;
        let target = self.locate(target)?;
        let source = self.inside(source, length, place)?;
        let target = self.inside(target, length, place)?;
        self.memory.copy_within(source, target.start);
        self.observe(target, place);
        Ok(())
    }

    fn reset(&mut self, first: u32, length: u32, place: PlaceId) -> Result<(), Stop> {
        let range = self.inside(first, length, place)?;
        self.memory[range.clone()].copy_from_slice(&self.code.initial[range.clone()]);
        self.observe(range, place);
        Ok(())
    }

    fn case(&mut self, case: &'c Case) -> Result<Flow, Stop> {
        let selector = self.number(&case.selector)?;
        let within = |(low, high): &(i128, i128)| *low <= selector && selector <= *high;
        let chosen = case.arms.iter().find(|arm| arm.labels.iter().any(within));
        self.block(chosen.map_or(&case.otherwise, |arm| &arm.body))
    }

    fn counted(&mut self, form: &'c For) -> Result<Flow, Stop> {
        let (mut number, to, by) = (self.number(&form.from)?, self.number(&form.to)?, self.number(&form.by)?);
        let stop = || Stop::new(Fault::LoopLimit, form.place);
        if by == 0 {
            return Err(stop());
        }
        let control = self.locate(&form.control)?;
        self.store(control, form.scalar.bits(number), form.place)?;
        let mut count = 0;
        while if by > 0 { number <= to } else { number >= to } {
            count += 1;
            if count > form.limit {
                return Err(stop());
            }
            match self.block(&form.body)? {
                Flow::Exit => break,
                Flow::Return => return Ok(Flow::Return),
                Flow::Next | Flow::Continue => {}
            }
            number = form.scalar.number(self.load(control)?) + by;
            self.store(control, form.scalar.bits(number), form.place)?;
        }
        Ok(Flow::Next)
    }

    fn endless(&mut self, form: &'c Loop) -> Result<Flow, Stop> {
        for _ in 0..self.code.loop_limit {
            match self.block(&form.body)? {
                Flow::Exit => return Ok(Flow::Next),
                Flow::Return => return Ok(Flow::Return),
                Flow::Next | Flow::Continue => {}
            }
            match self.block(&form.after)? {
                Flow::Exit => return Ok(Flow::Next),
                Flow::Return => return Ok(Flow::Return),
                Flow::Next | Flow::Continue => {}
            }
        }
        Err(Stop::new(Fault::LoopLimit, form.place))
    }

    fn call(&mut self, routine: u32, this: u32, place: PlaceId) -> Result<(), Stop> {
        let code = self.code;
        let Some(routine) = code.routines.get(routine as usize) else {
            return Err(Stop::new(Fault::NullReference, place));
        };
        // No program calls deeper than it has routines, unless a routine calls itself.
        if self.depth > code.routines.len() {
            return Err(Stop::new(Fault::LoopLimit, place));
        }
        for (first, length) in &routine.locals {
            self.reset(*first, *length, 0)?;
        }
        let before = std::mem::replace(&mut self.this, this);
        self.depth += 1;
        self.block(&routine.statements)?;
        self.depth -= 1;
        self.this = before;
        Ok(())
    }

    fn dispatch(&mut self, dispatch: &Dispatch) -> Result<(), Stop> {
        let instance = self.referent(&dispatch.target, dispatch.place)?;
        let instances = &self.code.instances;
        let found = instances.binary_search_by_key(&instance, |(slot, _)| *slot).ok().and_then(|at| {
            let class = instances[at].1;
            dispatch.routines.binary_search_by_key(&class, |(class, _)| *class).ok()
        });
        match found {
            Some(at) => self.call(dispatch.routines[at].1, instance, dispatch.place),
            None => Err(Stop::new(Fault::NullReference, dispatch.place)),
        }
    }

    /// Sets a slot to a number of the type.
    pub(super) fn store_number(&mut self, at: u32, scalar: Scalar, number: i128, place: PlaceId) -> Result<(), Stop> {
        self.store(at, scalar.bits(number), place)
    }
}
