//! IC3, also called property-directed reachability: a chain of ever larger sets of clauses, each true in all states that
//! so many cycles reach, refined by one bad predecessor at a time until two neighbours are equal.
//!
//! Bradley, "SAT-based model checking without unrolling" (VMCAI 2011); Eén, Mishchenko and Brayton, "Efficient
//! implementation of property directed reachability" (FMCAD 2011): delta-encoded frames, obligations in a queue;
//! Hassan, Bradley and Somenzi, "Better generalization in IC3" (FMCAD 2013): counterexamples to generalization are
//! blocked themselves; Chockler, Ivrii, Matsliah, Moran and Nevo, "Incremental formal verification of hardware" (FMCAD
//! 2011): predecessors are lifted by an unsatisfiable core. Clauses may speak of predicates over latches as if they were
//! latches. Clauses that are inductive alone go to a frame that stands for all times.
//!
//! Left out: ternary simulation (the core does its work), abstraction, and pushing of obligations by may-proofs.

mod block;
mod frames;
mod generalize;
mod query;

use super::asker::Asker;
use super::cdcl::Solver;
use super::encode::Encoding;
use super::engine::{Answer, Budget, Engine, Progress, Reason, Search, bounded, drive};
use super::problem::Problem;
use crate::logic::aig::{Lit, Model, Trace};
use block::Queue;
use frames::{Cube, Frame};

/// The engine.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ic3;

impl Engine for Ic3 {
    fn name(&self) -> &'static str {
        "ic3"
    }

    fn run(&self, model: &Model, property: usize, budget: &Budget, progress: &dyn Fn(Progress)) -> Answer {
        let mut search = Ic3Search::new(Problem::new(model, property));
        drive(&mut search, budget, progress)
    }
}

/// Why a step of the search stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    /// The share of work is used up; the search goes on later.
    Pause,
    /// For good.
    End(Reason),
}

/// The state of a search.
pub(crate) struct Ic3Search {
    problem: Problem,
    encoding: Encoding,
    frames: Vec<Frame>,
    eternal: Vec<Cube>,
    /// Holds only clauses that are true at all times.
    forever: Asker,
    lifter: Asker,
    first: Asker,
    queue: Queue,
    activity: Vec<f64>,
    step: f64,
    /// No run of so many cycles is bad.
    safe: usize,
    /// Where pushing clauses has to go on, where it was interrupted.
    pushing: Option<usize>,
    /// Work done, and where to pause.
    work: u64,
    pause: u64,
    budget: Budget,
}

impl Ic3Search {
    pub(crate) fn new(problem: Problem) -> Self {
        let encoding = Encoding::new(&problem.model.aig, &problem.roots());
        let plain = || Asker::new(&encoding, &[]);
        let constrained = || {
            let mut asker = Asker::new(&encoding, &problem.facts);
            for &constraint in &problem.model.constraints {
                asker.require(&encoding, &[constraint]);
            }
            asker
        };
        let mut first = plain();
        let mut start = constrained();
        for signal in &problem.signals {
            if let (Some(value), true) = (signal.initial, signal.is_latch) {
                first.require(&encoding, &[signal.now.invert_if(!value)]);
                start.require(&encoding, &[signal.now.invert_if(!value)]);
            }
        }
        let (lifter, forever) = (plain(), constrained());
        let activity = vec![0.0; problem.signals.len()];
        Self {
            frames: vec![Frame { cubes: Vec::new(), asker: start }],
            eternal: Vec::new(),
            forever,
            lifter,
            first,
            queue: Queue::default(),
            activity,
            step: 1.0,
            safe: 0,
            pushing: None,
            work: 0,
            pause: 0,
            budget: Budget::default(),
            problem,
            encoding,
        }
    }

    /// The last frame.
    fn top(&self) -> usize {
        self.frames.len() - 1
    }

    /// Blocks what is queued, then looks for the next bad state, then opens a frame.
    fn proceed(&mut self, progress: &dyn Fn(Progress)) -> Result<Answer, Stop> {
        loop {
            if let Some(from) = self.pushing {
                if let Some(answer) = self.push_clauses(from)? {
                    return Ok(answer);
                }
                self.pushing = None;
            }
            if let Some(trace) = self.work_off()? {
                return Ok(Answer::Violated(trace));
            }
            if let Some((cube, inputs)) = self.bad_state()? {
                let top = self.top();
                self.queue.insert(top, cube, inputs, None);
                continue;
            }
            self.safe = self.frames.len();
            if let Some(reason) = self.budget.exhausted_with(Search::bytes(self)) {
                return Err(Stop::End(reason));
            }
            self.open_frame();
            let clauses = self.frames.iter().map(|f| f.cubes.len()).sum::<usize>() + self.eternal.len();
            progress(Progress { engine: "ic3", depth: self.safe, clauses });
            self.pushing = Some(1);
        }
    }

    fn open_frame(&mut self) {
        let mut asker = Asker::new(&self.encoding, &self.problem.facts);
        for &constraint in &self.problem.model.constraints {
            asker.require(&self.encoding, &[constraint]);
        }
        for cube in &self.eternal {
            let clause = negated(&self.problem, cube);
            asker.require(&self.encoding, &clause);
        }
        asker.solver.stop = self.budget.stop();
        self.frames.push(Frame { cubes: Vec::new(), asker });
        self.queue.forget_blocked();
    }

    /// The run from a first state inside `cube` along the obligations from `start`.
    fn trace(&mut self, start: usize) -> Result<Trace, Stop> {
        let cube = self.queue.cube(start).clone();
        let assumptions: Vec<Lit> = cube.lits().iter().map(|&l| now(&self.problem, l)).collect();
        self.ask_first(&assumptions)?;
        let solver: &Solver = &self.first.solver;
        let latches = self.problem.model.latches.iter().map(|l| solver.value(l.lit) == Some(true)).collect();
        Ok(Trace { latches, inputs: self.queue.inputs_from(start) })
    }
}

/// The literal of the graph for a literal of a cube, in the present cycle.
fn now(problem: &Problem, lit: Lit) -> Lit {
    problem.signals[lit.node() as usize].now.invert_if(lit.inverted())
}

/// The same in the next cycle.
fn next(problem: &Problem, lit: Lit) -> Lit {
    problem.signals[lit.node() as usize].next.invert_if(lit.inverted())
}

/// The clause that excludes a cube.
fn negated(problem: &Problem, cube: &Cube) -> Vec<Lit> {
    cube.lits().iter().map(|&l| !now(problem, l)).collect()
}

impl Search for Ic3Search {
    fn advance(&mut self, ticks: u64, budget: &Budget, progress: &dyn Fn(Progress)) -> Option<Answer> {
        self.pause = self.work.saturating_add(ticks);
        self.budget = budget.clone();
        let frames = self.frames.iter_mut().map(|f| &mut f.asker);
        for asker in frames.chain([&mut self.forever, &mut self.lifter, &mut self.first]) {
            asker.solver.stop = budget.stop();
        }
        match self.proceed(progress) {
            Ok(answer) => Some(answer),
            Err(Stop::Pause) => None,
            Err(Stop::End(reason)) => Some(bounded(self.safe, reason)),
        }
    }

    fn depth(&self) -> usize {
        self.safe
    }

    fn bytes(&self) -> usize {
        let beside = [&self.forever, &self.lifter, &self.first].into_iter();
        let askers = self.frames.iter().map(|f| &f.asker).chain(beside);
        askers.map(|asker| asker.solver.bytes()).sum::<usize>() + self.queue.bytes()
    }
}
