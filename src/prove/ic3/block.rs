//! Obligations: cubes that lead to a bad state and have to be excluded, the earliest frame first.

use std::collections::BTreeSet;

use super::frames::Cube;
use super::{Ic3Search, Stop};
use crate::logic::aig::Trace;

/// A cube from which `inputs` lead to the cube of `next`, or to a bad cycle.
struct Obligation {
    cube: Cube,
    inputs: Vec<bool>,
    next: Option<usize>,
    depth: usize,
    tries: usize,
}

/// All obligations; those that are open by frame, then depth.
#[derive(Default)]
pub(super) struct Queue {
    all: Vec<Obligation>,
    open: BTreeSet<(usize, usize, usize)>,
}

/// An obligation that was put off so often waits for the next frame.
const PATIENCE: usize = 20;

impl Queue {
    pub(super) fn insert(&mut self, frame: usize, cube: Cube, inputs: Vec<bool>, next: Option<usize>) {
        let depth = next.map_or(0, |n| self.all[n].depth + 1);
        self.all.push(Obligation { cube, inputs, next, depth, tries: 0 });
        self.open.insert((frame, depth, self.all.len() - 1));
    }

    pub(super) fn cube(&self, obligation: usize) -> &Cube {
        &self.all[obligation].cube
    }

    pub(super) fn inputs_from(&self, start: usize) -> Vec<Vec<bool>> {
        let chain = std::iter::successors(Some(start), |&o| self.all[o].next);
        chain.map(|o| self.all[o].inputs.clone()).collect()
    }

    /// All that is open is excluded: nothing needs to be kept.
    pub(super) fn forget_blocked(&mut self) {
        if self.open.is_empty() {
            self.all.clear();
        }
    }

    pub(super) fn bytes(&self) -> usize {
        self.all.iter().map(|o| 100 + o.cube.lits().len() * 4 + o.inputs.len()).sum()
    }
}

impl Ic3Search {
    /// Works off the queue; a trace, where an obligation reaches back to a first state.
    pub(super) fn work_off(&mut self) -> Result<Option<Trace>, Stop> {
        while let Some(&entry) = self.queue.open.first() {
            let (frame, _, obligation) = entry;
            let cube = self.queue.all[obligation].cube.clone();
            if self.meets_first(cube.lits())? {
                return self.trace(obligation).map(Some);
            }
            if self.is_excluded(frame, &cube) {
                self.put_off(entry);
                continue;
            }
            if let Some(core) = self.is_relatively_inductive(frame - 1, &cube)? {
                self.exclude_around(frame, core)?;
                self.put_off(entry);
            } else {
                let (before, inputs) = self.predecessor(frame - 1, &cube)?;
                self.queue.insert(frame - 1, before, inputs, Some(obligation));
            }
        }
        Ok(None)
    }

    /// The obligation holds at its frame: it comes again one frame later.
    fn put_off(&mut self, entry: (usize, usize, usize)) {
        self.queue.open.remove(&entry);
        let (frame, depth, obligation) = entry;
        let known = &mut self.queue.all[obligation];
        known.tries += 1;
        if frame < self.frames.len() - 1 && known.tries < PATIENCE {
            self.queue.open.insert((frame + 1, depth, obligation));
        }
    }

    fn exclude_around(&mut self, frame: usize, core: Cube) -> Result<(), Stop> {
        let mut cube = self.generalize(frame - 1, core, 0)?;
        let mut last = frame;
        while last < self.top() {
            let Some(smaller) = self.is_relatively_inductive(last, &cube)? else { break };
            cube = smaller;
            last += 1;
        }
        self.exclude(1, last, cube);
        Ok(())
    }
}
