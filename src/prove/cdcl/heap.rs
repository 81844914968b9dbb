//! A binary heap of variables by activity that knows where each variable stands, so that a bump can lift it.

/// Where a variable is not in the heap.
const ABSENT: u32 = u32::MAX;

/// The heap; activities are kept outside.
#[derive(Clone, Debug, Default)]
pub(super) struct Heap {
    items: Vec<u32>,
    place: Vec<u32>,
}

impl Heap {
    pub(super) fn grow(&mut self) {
        self.place.push(ABSENT);
    }

    pub(super) fn clear(&mut self) {
        for item in self.items.drain(..) {
            self.place[item as usize] = ABSENT;
        }
    }

    pub(super) fn insert(&mut self, var: u32, activity: &[f64]) {
        if self.place[var as usize] != ABSENT {
            return;
        }
        self.place[var as usize] = self.items.len() as u32;
        self.items.push(var);
        self.up(self.items.len() - 1, activity);
    }

    pub(super) fn bumped(&mut self, var: u32, activity: &[f64]) {
        let place = self.place[var as usize];
        if place != ABSENT {
            self.up(place as usize, activity);
        }
    }

    pub(super) fn pop(&mut self, activity: &[f64]) -> Option<u32> {
        let top = *self.items.first()?;
        let last = self.items.pop()?;
        self.place[top as usize] = ABSENT;
        if last != top {
            self.items[0] = last;
            self.place[last as usize] = 0;
            self.down(0, activity);
        }
        Some(top)
    }

    fn up(&mut self, mut at: usize, activity: &[f64]) {
        let var = self.items[at];
        while at > 0 {
            let parent = (at - 1) / 2;
            let above = self.items[parent];
            if activity[above as usize] >= activity[var as usize] {
                break;
            }
            self.items[at] = above;
            self.place[above as usize] = at as u32;
            at = parent;
        }
        self.items[at] = var;
        self.place[var as usize] = at as u32;
    }

    fn down(&mut self, mut at: usize, activity: &[f64]) {
        let var = self.items[at];
        loop {
            let mut child = 2 * at + 1;
            if child >= self.items.len() {
                break;
            }
            let right = child + 1;
            if right < self.items.len() && activity[self.items[right] as usize] > activity[self.items[child] as usize] {
                child = right;
            }
            let below = self.items[child];
            if activity[below as usize] <= activity[var as usize] {
                break;
            }
            self.items[at] = below;
            self.place[below as usize] = at as u32;
            at = child;
        }
        self.items[at] = var;
        self.place[var as usize] = at as u32;
    }
}
