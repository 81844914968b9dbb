//! Reading and writing memory at an address that is not known: a tree of multiplexers over the bits of the index for a read,
//! an if-then-else for each element that may be meant for a write.

use super::address::{Area, Step};
use super::flow::Executor;
use crate::logic::term::{Op, Term};
use crate::machine::program::SlotId;
use crate::semantics::scalar::Scalar;

impl Executor<'_> {
    /// How many bits a slot has as a term.
    pub(super) fn slot_width(&self, slot: u32) -> Option<u32> {
        self.program.slots.get(slot as usize).map(|slot| slot.scalar.width())
    }

    /// What an area holds, so many slots further on.
    pub(super) fn load(&mut self, area: &Area, offset: u32, scalar: Scalar) -> Term {
        let width = scalar.width();
        self.over_bases(area, &mut |executor, slot| executor.load_cell(slot.wrapping_add(offset), width))
    }

    /// The address of an area, plus one.
    pub(super) fn address_of(&mut self, area: &Area) -> Term {
        self.over_bases(area, &mut |executor, slot| executor.pool.constant(32, u64::from(slot.wrapping_add(1))))
    }

    /// One cell in the width that is asked for; what lies beyond memory is zero.
    fn load_cell(&mut self, slot: u32, width: u32) -> Term {
        match self.memory.get(slot) {
            Some(term) => self.resize(term, width, false),
            None => self.pool.constant(width, 0),
        }
    }

    /// A term for each slot that an area may mean, and the choice of them.
    fn over_bases(&mut self, area: &Area, cell: &mut dyn FnMut(&mut Self, u32) -> Term) -> Term {
        let mut chosen = None;
        for (guard, slot) in area.bases.iter().rev() {
            let term = self.over_steps(*slot, &area.steps, cell);
            chosen = Some(match chosen {
                None => term,
                Some(other) => self.pool.apply(Op::Ite, &[*guard, term, other]),
            });
        }
        // Without a base no path leads here; any term of the right width will do.
        chosen.unwrap_or_else(|| cell(self, u32::MAX))
    }

    fn over_steps(&mut self, slot: u32, steps: &[Step], cell: &mut dyn FnMut(&mut Self, u32) -> Term) -> Term {
        let Some((step, rest)) = steps.split_first() else { return cell(self, slot) };
        let element = |number: u32| slot.wrapping_add(number.wrapping_mul(step.stride));
        let elements = (0..step.count).map(|number| self.over_steps(element(number), rest, cell)).collect();
        self.choose(step.index, elements)
    }

    /// The element with the number that the index says.
    pub(super) fn choose(&mut self, index: Term, mut elements: Vec<Term>) -> Term {
        for bit in 0..self.pool.width(index) {
            if elements.len() < 2 {
                break;
            }
            let is_odd = self.pool.apply(Op::Extract { high: bit, low: bit }, &[index]);
            elements = elements
                .chunks(2)
                .map(|pair| match pair {
                    [even, odd] => self.pool.apply(Op::Ite, &[is_odd, *odd, *even]),
                    _ => pair[0],
                })
                .collect();
        }
        elements[0]
    }

    /// Sets what an area means, so many slots further on.
    pub(super) fn store(&mut self, area: &Area, offset: u32, value: Term) {
        let alone = area.bases.len() == 1;
        for (guard, slot) in &area.bases {
            let guard = if alone { self.pool.truth(true) } else { *guard };
            self.store_steps(guard, slot.wrapping_add(offset), &area.steps, value);
        }
    }

    fn store_steps(&mut self, guard: Term, slot: u32, steps: &[Step], value: Term) {
        let Some((step, rest)) = steps.split_first() else {
            if let (Some(before), Some(width)) = (self.memory.get(slot), self.slot_width(slot)) {
                let value = self.resize(value, width, false);
                let value = self.pool.apply(Op::Ite, &[guard, value, before]);
                self.memory.set(slot, value);
            }
            return;
        };
        for number in 0..step.count {
            let constant = self.pool.constant(self.pool.width(step.index), u64::from(number));
            let is = self.pool.apply(Op::Eq, &[step.index, constant]);
            let guard = self.and(guard, is);
            self.store_steps(guard, slot.wrapping_add(number.wrapping_mul(step.stride)), rest, value);
        }
    }

    /// The slots that an area may mean, each under its condition.
    pub(super) fn alternatives(&mut self, area: &Area) -> Vec<(Term, u32)> {
        let mut found = area.bases.clone();
        if let [only] = found.as_mut_slice() {
            only.0 = self.pool.truth(true);
        }
        for step in &area.steps {
            let mut next = Vec::with_capacity(found.len() * step.count as usize);
            for (guard, slot) in found {
                for number in 0..step.count {
                    let constant = self.pool.constant(self.pool.width(step.index), u64::from(number));
                    let is = self.pool.apply(Op::Eq, &[step.index, constant]);
                    let guard = self.and(guard, is);
                    next.push((guard, slot.wrapping_add(number.wrapping_mul(step.stride))));
                }
            }
            found = next;
        }
        found
    }

    /// The type of a slot where an area may begin.
    pub(super) fn scalar_at(&self, area: &Area, offset: u32) -> Scalar {
        let slot = area.bases.first().map_or(SlotId(0), |(_, slot)| SlotId(slot.wrapping_add(offset)));
        self.program.slots.get(slot.0 as usize).map_or(Scalar::Bool, |slot| slot.scalar)
    }

    /// The initial value of a slot as a term.
    pub(super) fn initial(&mut self, slot: u32) -> Option<Term> {
        let found = self.program.slots.get(slot as usize)?;
        let (scalar, bits) = (found.scalar, found.initial);
        Some(self.pool.constant(scalar.width(), bits))
    }
}
