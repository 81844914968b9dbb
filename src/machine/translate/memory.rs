//! Memory that can be taken back: a vector of terms and a trail of what was overwritten.

use crate::logic::term::{Op, Pool, Term};

/// The memory.
#[derive(Debug)]
pub(super) struct Memory {
    cells: Vec<Term>,
    /// Slot and overwritten value, in the order of writing.
    trail: Vec<(u32, Term)>,
    written: Vec<bool>,
    /// When each slot was last seen by [`Memory::changes`].
    seen: Vec<u32>,
    epoch: u32,
}

/// A slot that changed since a mark.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change {
    slot: u32,
    /// At the mark.
    before: Term,
    /// Now.
    after: Term,
}

/// The changes since a mark, by slot.
pub(super) type Delta = Vec<Change>;

impl Memory {
    /// A memory that holds `cells`.
    pub(super) fn new(cells: Vec<Term>) -> Self {
        let (seen, written) = (vec![0; cells.len()], vec![false; cells.len()]);
        Self { cells, trail: Vec::new(), written, seen, epoch: 0 }
    }

    /// What a slot holds; `None` beyond the memory.
    pub(super) fn get(&self, slot: u32) -> Option<Term> {
        self.cells.get(slot as usize).copied()
    }

    /// Sets a slot; nothing happens beyond the memory.
    pub(super) fn set(&mut self, slot: u32, term: Term) {
        if let Some(cell) = self.cells.get_mut(slot as usize) {
            self.written[slot as usize] = true;
            if *cell != term {
                self.trail.push((slot, *cell));
                *cell = term;
            }
        }
    }

    /// Whether a slot has ever been set, on whatever path.
    pub(super) fn is_written(&self, slot: usize) -> bool {
        self.written[slot]
    }

    /// All the slots.
    pub(super) fn cells(&self) -> &[Term] {
        &self.cells
    }

    /// The present point, to come back to.
    pub(super) const fn mark(&self) -> usize {
        self.trail.len()
    }

    /// What has changed since the mark.
    pub(super) fn changes(&mut self, mark: usize) -> Delta {
        self.epoch += 1;
        let mut delta = Delta::new();
        for (slot, before) in &self.trail[mark..] {
            let seen = &mut self.seen[*slot as usize];
            if *seen != self.epoch {
                *seen = self.epoch;
                let after = self.cells[*slot as usize];
                if after != *before {
                    delta.push(Change { slot: *slot, before: *before, after });
                }
            }
        }
        delta.sort_unstable_by_key(|change| change.slot);
        delta
    }

    /// Goes back to the mark.
    pub(super) fn rewind(&mut self, mark: usize) {
        while self.trail.len() > mark {
            if let Some((slot, before)) = self.trail.pop() {
                self.cells[slot as usize] = before;
            }
        }
    }

    /// Goes back to the mark and makes the changes.
    pub(super) fn replace(&mut self, mark: usize, delta: &[Change]) {
        self.rewind(mark);
        for change in delta {
            self.set(change.slot, change.after);
        }
    }
}

/// What has changed since their common mark where two paths join: the first one was taken if the condition holds.
pub(super) fn merge(pool: &mut Pool, condition: Term, then: &[Change], otherwise: &[Change]) -> Delta {
    let mut merged = Delta::with_capacity(then.len().max(otherwise.len()));
    let (mut left, mut right) = (then.iter().peekable(), otherwise.iter().peekable());
    loop {
        let slot = match (left.peek(), right.peek()) {
            (None, None) => return merged,
            (Some(change), None) | (None, Some(change)) => change.slot,
            (Some(a), Some(b)) => a.slot.min(b.slot),
        };
        let (a, b) = (left.next_if(|change| change.slot == slot), right.next_if(|change| change.slot == slot));
        let Some(before) = a.or(b).map(|change| change.before) else { return merged };
        let (yes, no) = (a.map_or(before, |change| change.after), b.map_or(before, |change| change.after));
        let after = if yes == no { yes } else { pool.apply(Op::Ite, &[condition, yes, no]) };
        if after != before {
            merged.push(Change { slot, before, after });
        }
    }
}

/// Exclusive alternatives, and one for all the rest under `rest`: what has changed since their common mark.
pub(super) fn select(pool: &mut Pool, arms: &[(Term, Delta)], rest: Term, otherwise: &[Change]) -> Delta {
    // A slot that the rest does not change keeps its value in every arm that does not change it either, so that only the
    // arms that do are looked at. The others see the rest only where no arm is taken.
    let mut result = Delta::with_capacity(otherwise.len());
    for change in otherwise {
        let is_in = |delta: &Delta| delta.binary_search_by_key(&change.slot, |other| other.slot).is_ok();
        let everywhere = arms.iter().all(|(_, delta)| is_in(delta));
        let after = match everywhere {
            true => change.after,
            false => pool.apply(Op::Ite, &[rest, change.after, change.before]),
        };
        result.push(Change { after, ..*change });
    }
    for (condition, delta) in arms.iter().rev() {
        result = overlay(pool, *condition, delta, result);
    }
    result
}

/// The changes of an exclusive alternative over those of the others.
fn overlay(pool: &mut Pool, condition: Term, delta: &[Change], others: Delta) -> Delta {
    let mut result = Delta::with_capacity(delta.len() + others.len());
    let mut others = others.into_iter().peekable();
    for change in delta {
        while let Some(other) = others.next_if(|other| other.slot < change.slot) {
            result.push(other);
        }
        let no = others.next_if(|other| other.slot == change.slot).map_or(change.before, |other| other.after);
        let after = pool.apply(Op::Ite, &[condition, change.after, no]);
        result.push(Change { after, ..*change });
    }
    result.extend(others);
    result
}
