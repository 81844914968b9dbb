//! The largest set of guesses that is inductive.

use std::collections::BTreeMap;

use super::super::asker::Asker;
use super::super::encode::Encoding;
use super::super::engine::{Budget, Reason};
use super::super::problem::Problem;
use super::super::simulate::{Random, Simulator};
use crate::logic::aig::{Lit, Model};

/// Work spent on one guess before it is dropped, and on all.
const PATIENCE: u64 = 2_000_000;
const ENOUGH: u64 = 500_000_000;
/// How many are asked about at once.
const BLOCK: usize = 64;

/// Guesses, and what is left of them.
pub(super) struct Houdini {
    model: Model,
    bad: Lit,
    clauses: Vec<Vec<Lit>>,
    later: Vec<Vec<Lit>>,
    /// For each clause, whether it fails in the next cycle.
    fails: Vec<Lit>,
    alive: Vec<bool>,
    encoding: Encoding,
    random: Random,
    work: u64,
}

impl Houdini {
    pub(super) fn new(problem: &mut Problem, clauses: Vec<Vec<Lit>>) -> Self {
        let lits: Vec<Lit> = clauses.iter().flatten().copied().collect();
        let nexts = problem.next_of(&lits);
        let map: BTreeMap<Lit, Lit> = lits.iter().copied().zip(nexts).collect();
        let later: Vec<Vec<Lit>> = clauses.iter().map(|c| c.iter().map(|l| map[l]).collect()).collect();
        let aig = &mut problem.model.aig;
        let fails: Vec<Lit> = later.iter().map(|c| c.iter().fold(Lit::TRUE, |all, &l| aig.and(all, !l))).collect();
        let mut roots = problem.roots();
        roots.extend(map.iter().flat_map(|(&a, &b)| [a, b]));
        roots.extend(&fails);
        let encoding = Encoding::new(&problem.model.aig, &roots);
        let alive = vec![true; clauses.len()];
        let (model, bad) = (problem.model.clone(), problem.bad);
        Self { model, bad, clauses, later, fails, alive, encoding, random: Random::new(2), work: 0 }
    }

    /// Drops guesses until the rest holds at first and is preserved.
    pub(super) fn settle(&mut self, budget: &Budget) -> Result<(), Reason> {
        self.drop_false_at_first(budget)?;
        while self.round(budget)? {}
        Ok(())
    }

    fn drop_false_at_first(&mut self, budget: &Budget) -> Result<(), Reason> {
        let mut first = Asker::new(&self.encoding, &[]);
        first.solver.stop = budget.stop();
        for latch in &self.model.latches {
            if let Some(value) = latch.initial {
                first.require(&self.encoding, &[latch.lit.invert_if(!value)]);
            }
        }
        for index in 0..self.clauses.len() {
            check(index, budget)?;
            let against: Vec<Lit> = self.clauses[index].iter().map(|&l| !l).collect();
            self.alive[index] = first.ask(&self.encoding, &against, None, PATIENCE) == Some(false);
        }
        Ok(())
    }

    fn assuming(&self) -> Asker {
        let mut asker = Asker::new(&self.encoding, &[]);
        for &constraint in &self.model.constraints {
            asker.require(&self.encoding, &[constraint]);
        }
        for (clause, _) in self.clauses.iter().zip(&self.alive).filter(|(_, alive)| **alive) {
            asker.require(&self.encoding, clause);
        }
        asker
    }

    /// Checks every guess that is left under the assumption of all; whether one had to go.
    fn round(&mut self, budget: &Budget) -> Result<bool, Reason> {
        let mut asker = self.assuming();
        asker.solver.stop = budget.stop();
        let start = asker.solver.ticks;
        let mut dropped = false;
        for block in (0..self.clauses.len()).collect::<Vec<usize>>().chunks(BLOCK) {
            budget.check()?;
            dropped |= self.check_block(block, &mut asker);
            if self.work + (asker.solver.ticks - start) > ENOUGH {
                return Err(Reason::Incomplete);
            }
        }
        self.work += asker.solver.ticks - start;
        Ok(dropped)
    }

    /// Drops those of a block that fail in the next cycle, asked for all at once; whether one had to go.
    fn check_block(&mut self, block: &[usize], asker: &mut Asker) -> bool {
        let mut dropped = false;
        loop {
            let alive: Vec<usize> = block.iter().copied().filter(|&index| self.alive[index]).collect();
            let any: Vec<Lit> = alive.iter().map(|&index| self.fails[index]).filter(|&l| l != Lit::FALSE).collect();
            if any.is_empty() || any.contains(&Lit::TRUE) {
                alive
                    .iter()
                    .filter(|&&index| self.fails[index] == Lit::TRUE)
                    .for_each(|&index| self.alive[index] = false);
                if any.is_empty() {
                    return dropped;
                }
                dropped = true;
                continue;
            }
            let answer = asker.ask(&self.encoding, &[], Some(&any), PATIENCE * 2);
            match answer {
                Some(false) => return dropped,
                Some(true) => self.drop_refuted(asker),
                None => {}
            }
            dropped = true;
            if answer.is_none() || alive.iter().all(|&index| self.alive[index]) {
                self.check_each(&alive, asker);
                return true;
            }
        }
    }

    /// Drops those that fail, or that take too long to ask about, one by one.
    fn check_each(&mut self, clauses: &[usize], asker: &mut Asker) {
        for &index in clauses {
            let against: Vec<Lit> = self.later[index].iter().map(|&l| !l).collect();
            if self.alive[index] && asker.ask(&self.encoding, &against, None, PATIENCE) != Some(false) {
                self.alive[index] = false;
            }
        }
    }

    /// Drops every guess that fails one cycle after the state that was found, for its inputs or some like them.
    fn drop_refuted(&mut self, asker: &Asker) {
        let mut run = Simulator::new(&self.model);
        let spread = |lit: Lit| if asker.solver.value(lit) == Some(true) { u64::MAX } else { 0 };
        run.start(|index| spread(self.model.latches[index].lit));
        let random = &mut self.random;
        let inputs: Vec<u64> =
            self.model.inputs.iter().map(|&i| spread(i) ^ (random.next() & random.next() & !1)).collect();
        run.evaluate(|index| inputs[index]);
        let valid = self.model.constraints.iter().fold(u64::MAX, |all, &c| all & run.value(c));
        for (clause, alive) in self.later.iter().zip(&mut self.alive).filter(|(_, alive)| **alive) {
            *alive = clause.iter().fold(valid, |fails, &l| fails & !run.value(l)) == 0;
        }
    }

    /// Where the surviving guesses imply the property, some of them that do and that are inductive.
    pub(super) fn imply_property(&self, budget: &Budget) -> Result<Option<Vec<Vec<Lit>>>, Reason> {
        let mut asker = self.assuming();
        asker.solver.stop = budget.stop();
        let mut work = 30_000_000;
        loop {
            match asker.ask(&self.encoding, &[self.bad], None, work) {
                Some(true) => return Ok(None),
                Some(false) => return Ok(Some(self.surviving())),
                None => budget.check()?,
            }
            work *= 2;
            if work > ENOUGH {
                return Ok(None);
            }
        }
    }

    pub(super) fn surviving(&self) -> Vec<Vec<Lit>> {
        self.clauses.iter().zip(&self.alive).filter(|(_, alive)| **alive).map(|(c, _)| c.clone()).collect()
    }
}

/// Looks at the clock every few guesses.
fn check(index: usize, budget: &Budget) -> Result<(), Reason> {
    if index.is_multiple_of(64) { budget.check() } else { Ok(()) }
}
