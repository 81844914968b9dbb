//! Bounded model checking: is there a bad run of so many cycles? One cycle more each time, in one solver.
//!
//! Biere, Cimatti, Clarke and Zhu, "Symbolic model checking without BDDs" (TACAS 1999), incremental as by Eén and Sörensson
//! ("Temporal induction by incremental SAT solving", BMC 2003), on an unrolled graph with structural hashing, so that what
//! follows from the first state is folded away. Left out: completeness thresholds.

use super::engine::{Answer, Budget, Engine, Progress, Reason, Search, bounded, drive};
use super::problem::Problem;
use super::unroll::Unrolling;
use crate::logic::aig::{Lit, Model, Trace};
use crate::logic::sat::Solver;
use crate::logic::sat::cadi::Cadical;
use crate::logic::sat::encode::Encoder;

/// The engine.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bmc;

impl Engine for Bmc {
    fn name(&self) -> &'static str {
        "bmc"
    }

    fn run(&self, model: &Model, property: usize, budget: &Budget, progress: &dyn Fn(Progress)) -> Answer {
        drive(&mut BmcSearch::new(Problem::new(model, property)), budget, progress)
    }
}

/// What work costs, in ticks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Price {
    /// A conflict of the solver, and so many nodes of the graph one tick more.
    conflict: u64,
    nodes: u64,
    /// A question, which the solver prepares for.
    question: u64,
}

impl Price {
    /// Where questions are few, and most of the work is in them.
    const FEW: Self = Self { conflict: 3_000, nodes: 16, question: 20_000 };
    /// Where one question follows another, in engines that take turns: a tick takes about 25 ns.
    pub(crate) const MANY: Self = Self { conflict: 500, nodes: 8, question: 100_000 };
}

/// Ticks for each node of the graph at each question.
const NODE: u64 = 4;

/// A solver with an unrolled graph, asked with limits that count.
pub(crate) struct Unrolled {
    pub(crate) graph: Unrolling,
    solver: Cadical,
    encoder: Encoder,
    price: Price,
}

/// What came of a question.
pub(crate) enum Reply {
    Yes,
    No,
    Stopped(Reason),
    Pause,
}

impl Unrolled {
    pub(crate) fn new(model: &Model, from_first: bool) -> Self {
        let (graph, solver) = (Unrolling::new(model, from_first), Cadical::default());
        Self { graph, solver, encoder: Encoder::default(), price: Price::FEW }
    }

    pub(crate) fn with_price(self, price: Price) -> Self {
        Self { price, ..self }
    }

    /// What graph and solver hold in memory, roughly, in bytes; the factor was measured.
    pub(crate) fn bytes(&self) -> usize {
        self.graph.bytes() * 10
    }

    pub(crate) fn require(&mut self, lits: &[Lit]) {
        let clause: Vec<i32> =
            lits.iter().map(|&l| self.encoder.encode(&self.graph.aig, l, &mut self.solver)).collect();
        self.solver.add_clause(&clause);
    }

    /// Lets the constraints of the model hold in the cycle.
    pub(crate) fn constrain(&mut self, model: &Model, cycle: usize) {
        for &constraint in &model.constraints {
            let holds = self.graph.at(constraint, cycle);
            self.require(&[holds]);
        }
    }

    /// Whether `lit` can be true, asked with more and more work until `ticks` are gone.
    pub(crate) fn ask(&mut self, lit: Lit, ticks: &mut u64, budget: &Budget) -> Reply {
        let assumption = self.encoder.encode(&self.graph.aig, lit, &mut self.solver);
        *ticks = ticks.saturating_sub(self.price.question + NODE * self.graph.aig.len() as u64);
        self.solver.set_stop(budget.stop());
        let mut conflicts = 100;
        loop {
            self.solver.set_conflicts(Some(conflicts));
            match self.solver.solve(&[assumption]) {
                Some(true) => return Reply::Yes,
                Some(false) => return Reply::No,
                None => {}
            }
            if let Some(reason) = budget.exhausted() {
                return Reply::Stopped(reason);
            }
            let size = self.graph.aig.len() as u64;
            *ticks = ticks.saturating_sub(u64::from(conflicts) * (self.price.conflict + size / self.price.nodes));
            if *ticks == 0 {
                return Reply::Pause;
            }
            conflicts = conflicts.saturating_mul(2);
        }
    }

    /// The run that was found, up to the cycle `last`.
    pub(crate) fn trace(&mut self, model: &Model, last: usize) -> Trace {
        let mut read = |lit: Lit, cycle: usize| {
            let at = self.graph.at(lit, cycle);
            self.value(at)
        };
        let latches = model.latches.iter().map(|latch| read(latch.lit, 0)).collect();
        let inputs = (0..=last).map(|cycle| model.inputs.iter().map(|&input| read(input, cycle)).collect()).collect();
        Trace { latches, inputs }
    }

    /// The value of a literal in the run that was found; false where it did not matter.
    pub(crate) fn value(&self, lit: Lit) -> bool {
        if lit.node() == 0 {
            return lit.inverted();
        }
        self.encoder.value(lit, &self.solver)
    }
}

/// The state of a search.
pub(crate) struct BmcSearch {
    problem: Problem,
    unrolled: Unrolled,
    depth: usize,
}

impl BmcSearch {
    pub(crate) fn new(problem: Problem) -> Self {
        Self { unrolled: Unrolled::new(&problem.model, true).with_price(Price::MANY), depth: 0, problem }
    }
}

impl Search for BmcSearch {
    fn advance(&mut self, ticks: u64, budget: &Budget, progress: &dyn Fn(Progress)) -> Option<Answer> {
        let mut left = ticks;
        while left > 0 {
            if let Some(reason) = budget.exhausted_with(self.unrolled.bytes()) {
                return Some(bounded(self.depth, reason));
            }
            self.unrolled.constrain(&self.problem.model, self.depth);
            let bad = self.unrolled.graph.at(self.problem.bad, self.depth);
            left = left.saturating_sub(Price::FEW.question / 10);
            if bad != Lit::FALSE {
                match self.unrolled.ask(bad, &mut left, budget) {
                    Reply::Yes => {
                        return Some(Answer::Violated(self.unrolled.trace(&self.problem.model, self.depth)));
                    }
                    Reply::No => self.unrolled.require(&[!bad]),
                    Reply::Stopped(reason) => return Some(bounded(self.depth, reason)),
                    Reply::Pause => return None,
                }
            }
            self.depth += 1;
            progress(Progress { engine: "bmc", depth: self.depth, clauses: 0 });
        }
        None
    }

    fn depth(&self) -> usize {
        self.depth
    }

    fn bytes(&self) -> usize {
        self.unrolled.bytes()
    }
}
