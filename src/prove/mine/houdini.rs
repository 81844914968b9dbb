//! The largest set of guesses that is inductive.

use std::collections::{BTreeMap, BTreeSet};

use super::super::asker::Asker;
use super::super::encode::Encoding;
use super::super::engine::{Budget, Reason};
use super::super::problem::Problem;
use super::super::simulate::{Random, Simulator};
use super::inputs::Inputs;
use crate::logic::aig::{Lit, Model};

/// Work spent on one guess before it is dropped, and on all.
const PATIENCE: u64 = 2_000_000;
const ENOUGH: u64 = 500_000_000;
/// For how many cycles a run without news is followed.
const IDLE: usize = 4;
/// How many are asked about at once.
const BLOCK: usize = 256;

/// What came of a block.
enum Reply {
    /// All that is left of it is preserved, given what these assumptions stand for.
    Preserved(Vec<Lit>),
    /// These had to go, of this block or others; there may be more.
    Dropped(Vec<usize>),
}

/// Guesses, and what is left of them.
pub(super) struct Houdini {
    model: Model,
    bad: Lit,
    clauses: Vec<Vec<Lit>>,
    /// For each clause, whether it fails in the next cycle.
    fails: Vec<Lit>,
    alive: Vec<bool>,
    encoding: Encoding,
    random: Random,
    inputs: Inputs,
    work: u64,
}

impl Houdini {
    pub(super) fn new(problem: &mut Problem, clauses: Vec<Vec<Lit>>, inputs: Inputs) -> Self {
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
        Self { model, bad, clauses, fails, alive, encoding, random: Random::new(2), inputs, work: 0 }
    }

    /// Drops guesses until the rest holds at first and is preserved.
    pub(super) fn settle(&mut self, budget: &Budget) -> Result<(), Reason> {
        self.drop_false_at_first(budget)?;
        // Most go in the first round, and with them what was assumed there.
        self.round(budget)?;
        Blocks::new(self, budget).settle(budget)
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

    /// Checks every guess once under the assumption of all that are there when it begins.
    fn round(&mut self, budget: &Budget) -> Result<(), Reason> {
        let mut asker = self.assuming();
        asker.solver.stop = budget.stop();
        for block in (0..self.clauses.len()).collect::<Vec<usize>>().chunks(BLOCK) {
            budget.check()?;
            while let Reply::Dropped(_) = self.check_block(block, &[], &mut asker) {}
            self.is_enough(&asker)?;
        }
        self.work += asker.solver.ticks;
        Ok(())
    }

    fn is_enough(&self, asker: &Asker) -> Result<(), Reason> {
        if self.work + asker.solver.ticks > ENOUGH { Err(Reason::Incomplete) } else { Ok(()) }
    }

    /// Drops those of a block that fail in the next cycle, asked for all at once: first some, then more when asked again.
    fn check_block(&mut self, block: &[usize], assumed: &[Lit], asker: &mut Asker) -> Reply {
        let alive: Vec<usize> = block.iter().copied().filter(|&index| self.alive[index]).collect();
        let sure: Vec<usize> = alive.iter().copied().filter(|&index| self.fails[index] == Lit::TRUE).collect();
        if !sure.is_empty() {
            sure.iter().for_each(|&index| self.alive[index] = false);
            return Reply::Dropped(sure);
        }
        let any: Vec<Lit> = alive.iter().map(|&index| self.fails[index]).filter(|&l| l != Lit::FALSE).collect();
        if any.is_empty() {
            return Reply::Preserved(Vec::new());
        }
        let answer = asker.ask_assuming(&self.encoding, assumed, &any, PATIENCE * 2);
        let dropped = match answer {
            Some(false) => {
                let used = assumed.iter().copied().filter(|&act| asker.solver.failed(act));
                return Reply::Preserved(used.collect());
            }
            Some(true) => self.drop_refuted(asker),
            None => Vec::new(),
        };
        if alive.iter().any(|&index| !self.alive[index]) {
            return Reply::Dropped(dropped);
        }
        let mut dropped = dropped;
        self.check_each(&alive, assumed, asker, &mut dropped);
        if dropped.is_empty() { Reply::Preserved(assumed.to_vec()) } else { Reply::Dropped(dropped) }
    }

    /// Drops those that fail, or that take too long to ask about, one by one.
    fn check_each(&mut self, clauses: &[usize], assumed: &[Lit], asker: &mut Asker, dropped: &mut Vec<usize>) {
        for &index in clauses {
            if asker.ask_assuming(&self.encoding, assumed, &[self.fails[index]], PATIENCE) != Some(false) {
                self.alive[index] = false;
                dropped.push(index);
            }
        }
    }

    /// Drops every guess that fails behind the state that was found, in runs that begin there with its inputs or some like
    /// them; which. All that is left holds in every state on the way, so that each is as good as the one that was found.
    fn drop_refuted(&mut self, asker: &Asker) -> Vec<usize> {
        let mut run = Simulator::new(&self.model);
        let spread = |lit: Lit| if asker.solver.value(lit) == Some(true) { u64::MAX } else { 0 };
        run.start(|index| spread(self.model.latches[index].lit));
        let mut inputs: Vec<u64> = self.model.inputs.iter().map(|&i| spread(i)).collect();
        self.inputs.learn(|index| inputs[index] != 0);
        let (mut valid, mut dropped, mut idle) = (u64::MAX, Vec::new(), 0);
        while idle < IDLE && valid != 0 {
            self.inputs.vary(&mut inputs, 1, !1, &mut self.random);
            run.evaluate(|index| inputs[index]);
            valid = self.model.constraints.iter().fold(valid, |all, &c| all & run.value(c));
            run.step();
            run.evaluate(|index| inputs[index]);
            let before = dropped.len();
            for (index, clause) in self.clauses.iter().enumerate() {
                if self.alive[index] && clause.iter().fold(valid, |fails, &l| fails & !run.value(l)) != 0 {
                    self.alive[index] = false;
                    dropped.push(index);
                }
            }
            idle = if dropped.len() > before { 0 } else { idle + 1 };
        }
        dropped
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

/// Guesses that are assumed together, by one literal.
struct Block {
    clauses: Vec<usize>,
    assumed: Lit,
    /// Assumptions from which it was found to be preserved.
    rests_on: Option<Vec<Lit>>,
}

/// The blocks of guesses with one solver that knows them all: a block is asked about again only where one is gone that it
/// rests on.
struct Blocks<'h> {
    houdini: &'h mut Houdini,
    asker: Asker,
    blocks: Vec<Block>,
    block_of: Vec<usize>,
}

impl<'h> Blocks<'h> {
    fn new(houdini: &'h mut Houdini, budget: &Budget) -> Self {
        let mut asker = Asker::new(&houdini.encoding, &[]);
        for &constraint in &houdini.model.constraints {
            asker.require(&houdini.encoding, &[constraint]);
        }
        let alive: Vec<usize> = (0..houdini.clauses.len()).filter(|&index| houdini.alive[index]).collect();
        asker.focus(&houdini.encoding, alive.iter().flat_map(|&index| &houdini.clauses[index]));
        asker.focus(&houdini.encoding, alive.iter().map(|&index| &houdini.fails[index]));
        asker.solver.stop = budget.stop();
        let mut block_of = vec![0; houdini.clauses.len()];
        let mut blocks: Vec<Block> = Vec::new();
        for chunk in alive.chunks(BLOCK) {
            chunk.iter().for_each(|&index| block_of[index] = blocks.len());
            blocks.push(Block { clauses: chunk.to_vec(), assumed: Lit::FALSE, rests_on: None });
        }
        let mut made = Self { houdini, asker, blocks, block_of };
        (0..made.blocks.len()).for_each(|at| made.assume(at));
        made
    }

    /// Lets a new literal stand for what is left of the block.
    fn assume(&mut self, at: usize) {
        let block = &mut self.blocks[at];
        block.assumed = self.asker.switch();
        block.clauses.retain(|&index| self.houdini.alive[index]);
        for &index in &block.clauses {
            let mut clause = self.houdini.clauses[index].clone();
            clause.push(!block.assumed);
            self.asker.solver.add(&clause);
        }
    }

    fn settle(mut self, budget: &Budget) -> Result<(), Reason> {
        while let Some(at) = self.blocks.iter().position(|block| block.rests_on.is_none()) {
            for at in at..self.blocks.len() {
                while self.blocks[at].rests_on.is_none() {
                    budget.check()?;
                    self.houdini.is_enough(&self.asker)?;
                    self.check(at);
                }
            }
        }
        self.houdini.work += self.asker.solver.ticks;
        Ok(())
    }

    fn check(&mut self, at: usize) {
        let assumed: Vec<Lit> = self.blocks.iter().map(|block| block.assumed).collect();
        let clauses = self.blocks[at].clauses.clone();
        match self.houdini.check_block(&clauses, &assumed, &mut self.asker) {
            Reply::Preserved(used) => self.blocks[at].rests_on = Some(used),
            Reply::Dropped(dropped) => {
                let touched: BTreeSet<usize> = dropped.iter().map(|&index| self.block_of[index]).collect();
                for touched in touched {
                    let gone = self.blocks[touched].assumed;
                    self.asker.solver.add(&[!gone]);
                    self.assume(touched);
                    for block in &mut self.blocks {
                        if block.rests_on.as_ref().is_some_and(|used| used.contains(&gone)) {
                            block.rests_on = None;
                        }
                    }
                }
            }
        }
    }
}
