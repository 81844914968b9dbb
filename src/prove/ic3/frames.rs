//! Cubes and frames: which states are excluded, and until when.

use super::super::asker::Asker;
use super::super::engine::Answer;
use super::{Ic3Search, Stop, negated, now};
use crate::logic::aig::Lit;

/// A conjunction of literals over signals, sorted; a literal's node is the signal's number.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Cube {
    lits: Vec<Lit>,
    signature: u64,
}

impl Cube {
    pub(super) fn new(mut lits: Vec<Lit>) -> Self {
        lits.sort_unstable();
        lits.dedup();
        let signature = lits.iter().fold(0, |s, l| s | 1 << (l.0 % 64));
        Self { lits, signature }
    }

    pub(super) fn lits(&self) -> &[Lit] {
        &self.lits
    }

    /// Whether every state of `other` is one of this.
    pub(super) fn covers(&self, other: &Self) -> bool {
        if self.lits.len() > other.lits.len() || self.signature & !other.signature != 0 {
            return false;
        }
        let mut rest = other.lits.iter();
        self.lits.iter().all(|l| rest.by_ref().any(|o| o == l))
    }
}

/// A frame: the cubes that are excluded up to here and no further, and a solver that knows all that holds here.
pub(super) struct Frame {
    pub(super) cubes: Vec<Cube>,
    pub(super) asker: Asker,
}

impl Ic3Search {
    /// Whether the cube is excluded in this frame already.
    pub(super) fn is_excluded(&self, frame: usize, cube: &Cube) -> bool {
        self.frames[frame..].iter().any(|f| f.cubes.iter().any(|c| c.covers(cube)))
            || self.eternal.iter().any(|c| c.covers(cube))
    }

    /// Excludes the cube in all frames up to this one; it is known already in those before `from`.
    pub(super) fn exclude(&mut self, from: usize, frame: usize, cube: Cube) {
        for lit in cube.lits() {
            self.activity[lit.node() as usize] += self.step;
        }
        self.step *= 1.05;
        if self.step > 1e100 {
            self.activity.iter_mut().for_each(|a| *a *= 1e-100);
            self.step *= 1e-100;
        }
        let clause = negated(&self.problem, &cube);
        for at in 1..=frame {
            self.frames[at].cubes.retain(|c| !cube.covers(c));
            if at >= from {
                self.frames[at].asker.require(&self.encoding, &clause);
            }
        }
        self.frames[frame].cubes.push(cube);
    }

    fn exclude_for_ever(&mut self, cube: Cube) {
        let clause = negated(&self.problem, &cube);
        for frame in &mut self.frames {
            frame.cubes.retain(|c| !cube.covers(c));
            frame.asker.require(&self.encoding, &clause);
        }
        self.forever.require(&self.encoding, &clause);
        self.eternal.push(cube);
    }

    /// Moves clauses to later frames as far as they hold; the proof, where a frame has none of its own left.
    pub(super) fn push_clauses(&mut self, from: usize) -> Result<Option<Answer>, Stop> {
        let top = self.top();
        for frame in from..top {
            self.pushing = Some(frame);
            let mut cubes = self.frames[frame].cubes.clone();
            cubes.sort_by_key(|c| c.lits().len());
            for cube in cubes {
                if !self.frames[frame].cubes.contains(&cube) {
                    continue;
                }
                if frame + 1 == top && self.is_inductive_alone(&cube)? {
                    self.exclude_for_ever(cube);
                } else if let Some(smaller) = self.is_excluded_after(frame, &cube)? {
                    self.frames[frame].cubes.retain(|c| *c != cube);
                    let from = if smaller == cube { frame + 1 } else { 1 };
                    self.exclude(from, frame + 1, smaller);
                }
            }
            if self.frames[frame].cubes.is_empty() {
                return Ok(Some(self.invariant(frame)));
            }
        }
        Ok(None)
    }

    fn invariant(&self, frame: usize) -> Answer {
        let later = self.frames[frame + 1..].iter().flat_map(|f| &f.cubes);
        let clauses: Vec<Vec<Lit>> = later
            .chain(&self.eternal)
            .map(|cube| cube.lits().iter().map(|&l| !now(&self.problem, l)).collect())
            .collect();
        Answer::Proved(self.problem.proof(&clauses, 1, false))
    }
}
