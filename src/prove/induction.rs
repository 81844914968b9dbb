//! Induction over `k` cycles: what holds in the first `k` cycles, and after every `k` cycles in which it held, holds always.
//!
//! Sheeran, Singh and Stålmarck, "Checking safety properties using induction and a SAT-solver" (FMCAD 2000); incremental as
//! by Eén and Sörensson (BMC 2003). That states along the step differ is required only of pairs that were found equal. Facts
//! hold in every cycle of the step. Left out: uniqueness over the lifted part of states only.

use super::bmc::{BmcSearch, Price, Reply, Unrolled};
use super::engine::{Answer, Budget, Engine, Progress, Search, bounded, drive};
use super::problem::Problem;
use crate::logic::aig::{Lit, Model};

/// The engine.
#[derive(Clone, Copy, Debug, Default)]
pub struct Induction;

impl Engine for Induction {
    fn name(&self) -> &'static str {
        "induction"
    }

    fn run(&self, model: &Model, property: usize, budget: &Budget, progress: &dyn Fn(Progress)) -> Answer {
        drive(&mut InductionSearch::new(Problem::new(model, property)), budget, progress)
    }
}

/// The state of a search: bounded checking for the first cycles, and the step.
pub(crate) struct InductionSearch {
    problem: Problem,
    base: BmcSearch,
    step: Unrolled,
    /// Cycles before the one in question.
    k: usize,
    /// How many cycles of the step have their constraints and facts.
    laid: usize,
    distinct: bool,
    /// The step succeeded with so many cycles; the base has to follow.
    wanted: Option<usize>,
}

impl InductionSearch {
    pub(crate) fn new(problem: Problem) -> Self {
        let (base, step) =
            (BmcSearch::new(problem.clone()), Unrolled::new(&problem.model, false).with_price(Price::MANY));
        Self { problem, base, step, k: 0, laid: 0, distinct: false, wanted: None }
    }

    /// Lets constraints and facts hold in the last cycle of the step.
    fn lay(&mut self) {
        while self.laid <= self.k {
            let constraints = self.problem.model.constraints.iter().map(|&c| vec![c]);
            for clause in constraints.chain(self.problem.facts.iter().cloned()) {
                let lits: Vec<Lit> = clause.iter().map(|&l| self.step.graph.at(l, self.laid)).collect();
                self.step.require(&lits);
            }
            self.laid += 1;
        }
    }

    /// Requires two states to differ that were found equal before the cycle in question; whether there were such.
    fn set_apart(&mut self) -> bool {
        let lits: Vec<Lit> = self.problem.model.latches.iter().map(|l| l.lit).collect();
        let mut states: Vec<(Vec<bool>, usize)> = Vec::new();
        for cycle in 0..self.k {
            let ats: Vec<Lit> = lits.iter().map(|&l| self.step.graph.at(l, cycle)).collect();
            states.push((ats.iter().map(|&l| self.step.value(l)).collect(), cycle));
        }
        states.sort();
        let equal: Vec<(usize, usize)> =
            states.windows(2).filter(|w| w[0].0 == w[1].0).map(|w| (w[0].1, w[1].1)).collect();
        for &(a, b) in &equal {
            let mut clause = Vec::new();
            for &lit in &lits {
                let (x, y) = (self.step.graph.at(lit, a), self.step.graph.at(lit, b));
                clause.push(self.step.graph.aig.xor(x, y));
            }
            self.step.require(&clause);
        }
        self.distinct |= !equal.is_empty();
        !equal.is_empty()
    }

    /// Works on the step; `Some` to stop.
    fn advance_step(&mut self, left: &mut u64, budget: &Budget) -> Option<Answer> {
        while *left > 0 {
            self.lay();
            let bad = self.step.graph.at(self.problem.bad, self.k);
            match self.step.ask(bad, left, budget) {
                Reply::No => {
                    self.wanted = Some(self.k);
                    return None;
                }
                Reply::Yes if self.problem.is_whole && self.set_apart() => {}
                Reply::Yes => {
                    self.step.require(&[!bad]);
                    self.k += 1;
                    if self.k > self.base.depth() {
                        return None;
                    }
                }
                Reply::Stopped(reason) => return Some(bounded(self.base.depth(), reason)),
                Reply::Pause => return None,
            }
        }
        None
    }

    /// The proof, where both halves are done.
    fn proof(&self) -> Option<Answer> {
        let k = match self.wanted? {
            0 => 1,
            1 => 2,
            k => k,
        };
        let done = k == 1 || self.base.depth() >= k;
        done.then(|| Answer::Proved(self.problem.proof(&[], k, self.distinct && k > 1)))
    }
}

impl Search for InductionSearch {
    fn advance(&mut self, ticks: u64, budget: &Budget, progress: &dyn Fn(Progress)) -> Option<Answer> {
        let mut left = ticks / 2;
        if self.wanted.is_none()
            && let Some(answer) = self.advance_step(&mut left, budget)
        {
            return Some(answer);
        }
        if let Some(proof) = self.proof() {
            return Some(proof);
        }
        if let Some(answer) = self.base.advance(ticks / 2, budget, progress) {
            return Some(answer);
        }
        self.proof()
    }

    fn depth(&self) -> usize {
        self.base.depth()
    }

    fn bytes(&self) -> usize {
        self.base.bytes() + self.step.bytes()
    }
}
