//! Interpolation: the states that are reached, over-approximated one cycle at a time by what is left of a proof that they
//! lead to nothing bad within `k` cycles.
//!
//! McMillan, "Interpolation and SAT-based model checking" (CAV 2003). What is asked: whether a set of states leads by one
//! cycle (the first part) to a state from which `k` cycles are bad somewhere (the second). Where not, the interpolant is the
//! next set, an image of the one before; when one lies within what was reached already, all of them together are an inductive
//! invariant. Where so, and the set is not the first states, it starts anew with a larger `k`. The parts share the latches
//! between them and nothing else. Each image is followed alone, and not together with all before it, so that less has to
//! be refuted at once; and `k` grows by as many images as there were, as ABC's `int` does it. Left out: reinforcement by
//! clauses of other engines beyond the facts of the problem, containment over more than one cycle, and rewriting of the
//! interpolants.

mod query;
mod sets;

use super::asker::Asker;
use super::encode::Encoding;
use super::engine::{Answer, Budget, Engine, Progress, Reason, Search, bounded, drive};
use super::problem::Problem;
use super::unroll::Unrolling;
use crate::logic::aig::{Lit, Model, Trace};
use query::{Question, pose};
use sets::Sets;

/// The engine.
#[derive(Clone, Copy, Debug, Default)]
pub struct Interpolation;

impl Engine for Interpolation {
    fn name(&self) -> &'static str {
        "interpolation"
    }

    fn run(&self, model: &Model, property: usize, budget: &Budget, progress: &dyn Fn(Progress)) -> Answer {
        let mut search = InterpolationSearch::new(Problem::new(model, property));
        drive(&mut search, budget, progress)
    }
}

/// Most gates of all interpolants.
const GATES: usize = 300_000;
/// Work for a clause that is put into a solver, and for one that is copied there with all others.
const CLAUSE: u64 = 12;
const COPY: u64 = 2;
/// Work for a gate of an interpolant.
const GATE: u64 = 60;

/// The state of a search.
pub(crate) struct InterpolationSearch {
    problem: Problem,
    sets: Sets,
    /// How many images of the first states there were since `k` grew.
    images: usize,
    /// What follows the first cycle.
    later: Unrolling,
    k: usize,
    beginning: Option<Box<(Encoding, Asker)>>,
    /// The question for `k`, but for the set; and the one that is asked now, in as many turns as it takes.
    posed: Option<Box<Question>>,
    asked: Option<Box<Question>>,
    /// So many cycles are free of violations.
    safe: usize,
    work: u64,
}

impl InterpolationSearch {
    pub(crate) fn new(problem: Problem) -> Self {
        let (sets, later) = (Sets::new(&problem.model), Unrolling::new(&problem.model, false));
        Self { sets, later, images: 0, k: 0, beginning: None, posed: None, asked: None, safe: 0, work: 0, problem }
    }

    /// Whether some first state is bad at once, as far as that is known after so much work.
    fn begin(&mut self, until: u64, budget: &Budget) -> Option<bool> {
        let problem = &self.problem;
        let (encoding, asker) = self
            .beginning
            .get_or_insert_with(|| {
                let encoding = Encoding::new(&problem.model.aig, &problem.roots());
                let asker = Asker::new(&encoding, &[]);
                Box::new((encoding, asker))
            })
            .as_mut();
        let latches = problem.model.latches.iter();
        let mut lits: Vec<Lit> = latches.filter_map(|l| l.initial.map(|value| l.lit.invert_if(!value))).collect();
        lits.push(problem.bad);
        lits.extend(&problem.model.constraints);
        asker.solver.stop = budget.stop();
        let before = asker.solver.ticks;
        let answer = asker.ask(encoding, &lits, None, until.saturating_sub(self.work).max(1));
        self.work += asker.solver.ticks - before + 1;
        answer
    }

    /// The run of one cycle that [`Self::begin`] found.
    fn first_run(&self) -> Option<Trace> {
        let (_, asker) = self.beginning.as_deref()?;
        let value = |lit: Lit| asker.solver.value(lit) == Some(true);
        let latches = self.problem.model.latches.iter().map(|latch| value(latch.lit)).collect();
        let inputs = vec![self.problem.model.inputs.iter().map(|&input| value(input)).collect()];
        Some(Trace { latches, inputs })
    }

    /// The question for the set that is looked at.
    fn question(&mut self) -> Box<Question> {
        let posed = self.posed.get_or_insert_with(|| {
            let posed = pose(&self.problem, &mut self.later, self.k);
            self.work += CLAUSE * posed.clauses;
            Box::new(posed)
        });
        let mut asked = posed.clone();
        asked.begin_in(&self.sets);
        self.work += COPY * asked.clauses;
        asked
    }

    /// Goes on with the next set after a refutation.
    fn widen(&mut self, question: &Question, budget: &Budget) -> Option<Answer> {
        if self.images == 0 {
            self.safe = self.k + 1;
        }
        let Some(raw) = question.interpolant(self.sets.latches.len()) else {
            return Some(bounded(self.safe, Reason::Memory));
        };
        self.work += GATE * raw.aig.len() as u64;
        let before = self.sets.work();
        let is_new = self.sets.follow(&raw, budget);
        self.work += self.sets.work() - before;
        self.images += 1;
        match is_new {
            Some(true) if self.sets.aig.len() > GATES => Some(bounded(self.safe, Reason::Memory)),
            Some(true) => None,
            Some(false) => {
                let reached = self.sets.reached_in(&mut self.problem.model);
                Some(Answer::Proved(self.problem.proof(&[vec![reached]], 1, false)))
            }
            None => Some(bounded(self.safe, budget.exhausted().unwrap_or(Reason::Incomplete))),
        }
    }

    /// Starts anew and looks further ahead.
    fn deepen(&mut self) {
        self.k += self.images.clamp(1, self.k.max(1));
        self.images = 0;
        self.sets = Sets::new(&self.problem.model);
        self.posed = None;
    }

    fn proceed(&mut self, until: u64, budget: &Budget, progress: &dyn Fn(Progress)) -> Option<Answer> {
        while self.work < until {
            if let Some(reason) = budget.exhausted_with(self.bytes()) {
                return Some(bounded(self.safe, reason));
            }
            if self.k == 0 {
                match self.begin(until, budget) {
                    None => return budget.exhausted().map(|reason| bounded(0, reason)),
                    Some(true) => return self.first_run().map(Answer::Violated),
                    Some(false) => (self.beginning, self.k, self.safe) = (None, 1, 1),
                }
            }
            let mut question = self.asked.take().unwrap_or_else(|| self.question());
            let before = question.solver.ticks;
            let answer = question.ask(until.saturating_sub(self.work).max(1), budget);
            self.work += question.solver.ticks - before + 1;
            match answer {
                None => {
                    self.asked = Some(question);
                    return budget.exhausted().map(|reason| bounded(self.safe, reason));
                }
                Some(true) if self.images == 0 => {
                    return Some(Answer::Violated(question.trace(&self.problem, &mut self.later, self.k)));
                }
                Some(true) => self.deepen(),
                Some(false) => {
                    if let Some(answer) = self.widen(&question, budget) {
                        return Some(answer);
                    }
                }
            }
            progress(Progress { engine: "interpolation", depth: self.k + 1, clauses: self.sets.aig.len() });
        }
        None
    }
}

impl Search for InterpolationSearch {
    fn advance(&mut self, ticks: u64, budget: &Budget, progress: &dyn Fn(Progress)) -> Option<Answer> {
        let until = self.work.saturating_add(ticks);
        self.proceed(until, budget, progress)
    }

    fn depth(&self) -> usize {
        self.safe
    }

    fn bytes(&self) -> usize {
        let questions = [&self.posed, &self.asked].into_iter().flatten();
        questions.map(|question| question.solver.bytes()).sum::<usize>() + self.later.bytes() + self.sets.bytes()
    }
}
