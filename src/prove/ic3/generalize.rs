//! From a cube that is excluded to a larger one: literals are dropped one by one, and what then stands in the way (a
//! counterexample to generalization) is excluded itself where that is cheap.

use std::collections::BTreeSet;

use super::frames::Cube;
use super::{Ic3Search, Stop};
use crate::logic::aig::Lit;

/// How many obstacles to one drop are excluded, and how deep that nests.
const OBSTACLES: usize = 3;
const NESTING: usize = 1;

impl Ic3Search {
    /// A larger cube that is excluded one cycle after `frame`.
    pub(super) fn generalize(&mut self, frame: usize, cube: Cube, nesting: usize) -> Result<Cube, Stop> {
        let mut order = cube.lits().to_vec();
        order.sort_by(|a, b| self.by_activity(*a, *b));
        let mut needed = BTreeSet::new();
        let mut at = 0;
        while at < order.len() && order.len() > 1 {
            if needed.contains(&order[at]) {
                at += 1;
                continue;
            }
            let mut smaller = order.clone();
            smaller.remove(at);
            if let Some(cube) = self.try_smaller(frame, Cube::new(smaller), &needed, nesting)? {
                order.retain(|l| cube.lits().contains(l));
                at = 0;
            } else {
                needed.insert(order[at]);
                at += 1;
            }
        }
        Ok(Cube::new(order))
    }

    /// The cube, or a larger one that keeps what is needed, if one is excluded one cycle after `frame`.
    fn try_smaller(
        &mut self,
        frame: usize,
        cube: Cube,
        needed: &BTreeSet<Lit>,
        nesting: usize,
    ) -> Result<Option<Cube>, Stop> {
        let mut cube = cube;
        let mut obstacles = 0;
        loop {
            if self.meets_first(cube.lits())? {
                return Ok(None);
            }
            if let Some(core) = self.is_relatively_inductive(frame, &cube)? {
                return Ok(Some(core));
            }
            if nesting < NESTING && obstacles < OBSTACLES && frame > 0 && self.remove_obstacle(frame, &cube, nesting)? {
                obstacles += 1;
                continue;
            }
            if nesting > 0 {
                return Ok(None);
            }
            obstacles = 0;
            let Some(joined) = self.join(frame, &cube, needed)? else { return Ok(None) };
            cube = joined;
        }
    }

    fn remove_obstacle(&mut self, frame: usize, cube: &Cube, nesting: usize) -> Result<bool, Stop> {
        let (obstacle, _) = self.predecessor(frame, cube)?;
        if self.meets_first(obstacle.lits())? {
            return Ok(false);
        }
        let Some(core) = self.is_relatively_inductive(frame - 1, &obstacle)? else { return Ok(false) };
        let mut at = frame - 1;
        while at + 1 < self.top() && self.is_relatively_inductive(at + 1, &core)?.is_some() {
            at += 1;
        }
        let cube = self.generalize(at, core, nesting + 1)?;
        self.exclude(1, at + 1, cube);
        Ok(true)
    }

    /// What the cube and its present predecessor agree on.
    fn join(&mut self, frame: usize, cube: &Cube, needed: &BTreeSet<Lit>) -> Result<Option<Cube>, Stop> {
        if self.is_relatively_inductive(frame, cube)?.is_some() {
            return Ok(Some(cube.clone()));
        }
        let state: BTreeSet<Lit> = self.raw_predecessor(frame).into_iter().collect();
        let (kept, dropped): (Vec<Lit>, Vec<Lit>) = cube.lits().iter().partition(|l| !state.contains(&!**l));
        let stuck = dropped.is_empty() || kept.is_empty() || dropped.iter().any(|l| needed.contains(l));
        Ok((!stuck).then(|| Cube::new(kept)))
    }
}
