//! Where a location lies: the slots where it may begin, each under a condition, and the steps into arrays from there.
//!
//! A reference holds one of finitely many addresses. Which ones, the term itself says: addresses are constants, and no
//! operator but if-then-else is applied to them; for what a reference keeps from cycle to cycle, see
//! [`rounds`](super::rounds).

use std::collections::BTreeSet;
use std::rc::Rc;

use super::Unsupported;
use super::flow::Executor;
use crate::logic::term::{Node, Op, Term};
use crate::machine::program::{Base, Index, Location};
use crate::semantics::encode::{self, Context};
use crate::semantics::expr::Fault;
use crate::semantics::scalar::Scalar;
use crate::text::Place;

/// Where a location may lie.
#[derive(Clone, Debug)]
pub(super) struct Area {
    /// The slots where it may begin, with exclusive conditions; none if no path leads here.
    pub(super) bases: Vec<(Term, u32)>,
    /// Steps whose index is not constant.
    pub(super) steps: Vec<Step>,
}

/// A step into an array.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// The number of the element, in just as many bits as it needs; two elements at least.
    pub(super) index: Term,
    pub(super) count: u32,
    pub(super) stride: u32,
}

impl Executor<'_> {
    /// Where a location lies; faults on the way are noted.
    pub(super) fn resolve(&mut self, location: &Location, place: Option<Place>) -> Result<Area, Unsupported> {
        let yes = self.pool.truth(true);
        let bases = match &location.base {
            Base::Slot(slot) => vec![(yes, slot.0)],
            Base::This => vec![(yes, self.this)],
            Base::Referent(value) => {
                let address = encode::value(self, value)?;
                self.referents(address, value.place.or(place), value.place)?
            }
        };
        let mut area = Area {
            bases: bases.into_iter().map(|(guard, slot)| (guard, slot.wrapping_add(location.offset))).collect(),
            steps: Vec::new(),
        };
        for index in &location.indices {
            self.step_into(&mut area, index)?;
        }
        Ok(area)
    }

    /// The slots that a reference may refer to; null is a fault at `fault_place`.
    pub(super) fn referents(
        &mut self,
        address: Term,
        place: Option<Place>,
        fault_place: Option<Place>,
    ) -> Result<Vec<(Term, u32)>, Unsupported> {
        let targets = self.targets_of(address, place)?;
        let slots = u32::try_from(self.program.slots.len()).unwrap_or(u32::MAX);
        let valid: Vec<u32> = targets.iter().copied().filter(|target| (1..=slots).contains(target)).collect();
        if valid.len() < targets.len() {
            let null = self.is_none_of(address, &valid);
            self.fault(null, Fault::NullReference, fault_place);
        }
        if let [only] = valid.as_slice() {
            return Ok(vec![(self.pool.truth(true), only - 1)]);
        }
        let guarded = valid.into_iter().map(|target| {
            let constant = self.pool.constant(32, u64::from(target));
            (self.pool.apply(Op::Eq, &[address, constant]), target - 1)
        });
        Ok(guarded.collect())
    }

    /// Whether the address is none of these.
    fn is_none_of(&mut self, address: Term, valid: &[u32]) -> Term {
        let mut none = self.pool.truth(true);
        for target in valid {
            let constant = self.pool.constant(32, u64::from(*target));
            let is = self.pool.apply(Op::Eq, &[address, constant]);
            let is_not = self.not(is);
            none = self.and(none, is_not);
        }
        none
    }

    /// The addresses that a term may be.
    pub(super) fn targets_of(&mut self, address: Term, place: Option<Place>) -> Result<Rc<BTreeSet<u32>>, Unsupported> {
        // The operands first, on a stack of our own: chains of if-then-elses are long.
        let mut stack = vec![address];
        while let Some(term) = stack.last().copied() {
            if self.targets.contains_key(&term) {
                stack.pop();
                continue;
            }
            let found = match self.pool.node(term) {
                Node::Const(value) => Rc::new(BTreeSet::from([u32::try_from(value).unwrap_or(0)])),
                Node::Var(var) => match self.addresses.get(&var) {
                    Some(known) => Rc::clone(known),
                    None => return Err(unknown_reference(place)),
                },
                Node::Apply(Op::Ite, [_, then, otherwise]) => {
                    match (self.targets.get(&then), self.targets.get(&otherwise)) {
                        (Some(a), Some(b)) if Rc::ptr_eq(a, b) || b.is_subset(a) => Rc::clone(a),
                        (Some(a), Some(b)) => Rc::new(a.union(b).copied().collect()),
                        _ => {
                            stack.extend([then, otherwise]);
                            continue;
                        }
                    }
                }
                Node::Apply(..) => return Err(unknown_reference(place)),
            };
            self.targets.insert(term, found);
            stack.pop();
        }
        Ok(Rc::clone(&self.targets[&address]))
    }

    /// A step into an array: constant ones move the bases.
    fn step_into(&mut self, area: &mut Area, index: &Index) -> Result<(), Unsupported> {
        let scalar = index.value.scalar;
        let value = encode::value(self, &index.value)?;
        let (low, high) = (i128::from(index.low), i128::from(index.low) + i128::from(index.count) - 1);
        let inside = self.in_range(value, scalar, low, high);
        let outside = self.not(inside);
        self.fault(outside, Fault::IndexOutOfBounds, index.value.place);
        if let Some(bits) = self.pool.value(value) {
            let element = u32::try_from(scalar.number(bits) - low).unwrap_or(0);
            let offset = element.wrapping_mul(index.stride);
            for (_, slot) in &mut area.bases {
                *slot = slot.wrapping_add(offset);
            }
            return Ok(());
        }
        if index.count > 1 {
            let bits = u32::BITS - (index.count - 1).leading_zeros();
            let value = self.resize(value, bits, scalar.is_signed());
            let low = self.pool.constant(bits, index.low.cast_unsigned());
            let element = self.pool.apply(Op::Sub, &[value, low]);
            area.steps.push(Step { index: element, count: index.count, stride: index.stride });
        }
        Ok(())
    }

    /// Whether a value of the type is a number from `low` to `high`.
    pub(super) fn in_range(&mut self, value: Term, scalar: Scalar, low: i128, high: i128) -> Term {
        let width = scalar.width();
        let (least, most) = if scalar.is_signed() {
            (-(1i128 << (width - 1)), (1i128 << (width - 1)) - 1)
        } else {
            (0, (1i128 << width) - 1)
        };
        if low > high || low > most || high < least {
            return self.pool.truth(false);
        }
        let le = if scalar.is_signed() { Op::Sle } else { Op::Ule };
        if low == high {
            let constant = self.pool.constant(width, scalar.bits(low));
            return self.pool.apply(Op::Eq, &[value, constant]);
        }
        let mut inside = self.pool.truth(true);
        if low > least {
            let constant = self.pool.constant(width, scalar.bits(low));
            inside = self.pool.apply(le, &[constant, value]);
        }
        if high < most {
            let constant = self.pool.constant(width, scalar.bits(high));
            let below = self.pool.apply(le, &[value, constant]);
            inside = self.and(inside, below);
        }
        inside
    }

    /// A term cut or extended to a width.
    pub(super) fn resize(&mut self, term: Term, width: u32, signed: bool) -> Term {
        encode::resize(&mut self.pool, term, width, signed)
    }
}

/// The error for a reference of which nobody knows where it leads.
fn unknown_reference(place: Option<Place>) -> Unsupported {
    Unsupported { what: "a reference that is calculated or set from outside".to_owned(), place }
}
