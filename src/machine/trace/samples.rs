//! Values at points in time, as recording tools write them, made into one value for each cycle: what held when the
//! cycle began (sample and hold).

use super::Unreadable;

/// One signal's values over time, by ascending time.
pub(super) struct Samples<T> {
    pub(super) name: String,
    pub(super) values: Vec<(u64, T)>,
}

/// How many cycles lie between two points in time, both included.
pub(super) fn cycles(first: u64, last: u64, cycle_time: u64) -> usize {
    usize::try_from(last.saturating_sub(first) / cycle_time.max(1)).unwrap_or(usize::MAX).saturating_add(1)
}

/// The most cycles that a recorded file may have.
pub(super) const MOST: usize = 10_000_000;

impl<T: Clone> Samples<T> {
    /// One value for each of `cycles` cycles from `first` on.
    pub(super) fn held(&self, first: u64, cycle_time: u64, cycles: usize) -> Result<Vec<T>, Unreadable> {
        if cycles > MOST {
            return Err(Unreadable(format!("the file lasts {cycles} cycles, which is more than {MOST}")));
        }
        let mut out = Vec::with_capacity(cycles);
        let mut next = 0;
        for cycle in 0..cycles as u64 {
            let now = first.saturating_add(cycle.saturating_mul(cycle_time));
            while self.values.get(next).is_some_and(|(time, _)| *time <= now) {
                next += 1;
            }
            let Some((_, value)) = next.checked_sub(1).and_then(|at| self.values.get(at)) else {
                return Err(Unreadable(format!("`{}` has no value in cycle {}", self.name, cycle + 1)));
            };
            out.push(value.clone());
        }
        Ok(out)
    }
}
