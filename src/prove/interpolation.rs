//! Interpolation: the states that are reached, over-approximated one cycle at a time by what is left of a proof that they
//! lead to nothing bad within `k` cycles.
//!
//! McMillan, "Interpolation and SAT-based model checking" (CAV 2003). What is asked: whether a state of the set so far leads
//! by one cycle, or none, (the first part) to a state from which `k` cycles are bad somewhere (the second). Where not, the
//! interpolant is the next set; when nothing new comes, the set is an inductive invariant. Where so, and the set is more
//! than the first states, it starts anew with a larger `k`. The parts share the latches between them and nothing else. Left
//! out: reinforcement by clauses of other engines beyond the facts of the problem, and rewriting of the interpolants.

use std::collections::BTreeSet;

use super::asker::Asker;
use super::cdcl::{Part, Solver};
use super::encode::Encoding;
use super::engine::{Answer, Budget, Engine, Progress, Reason, Search, bounded, drive};
use super::problem::Problem;
use super::unroll::Unrolling;
use crate::logic::aig::{self, Aig, Gate, Lit, Model, Trace};
use crate::logic::sat::Stop;

/// The engine.
#[derive(Clone, Copy, Debug, Default)]
pub struct Interpolation;

impl Engine for Interpolation {
    fn name(&self) -> &'static str {
        "interpolation"
    }

    fn run(&self, model: &Model, property: usize, budget: &Budget, progress: &dyn Fn(Progress)) -> Answer {
        drive(&mut InterpolationSearch::new(Problem::new(model, property)), budget, progress)
    }
}

/// Most nodes of the graph with all interpolants, beside those of the model.
const NODES: usize = 300_000;
/// Work for the question whether a set is new.
const PATIENCE: u64 = 100_000_000;
/// Work for a clause that is put into a solver.
const CLAUSE: u64 = 12;
/// Work for a gate of an interpolant.
const GATE: u64 = 60;

/// The state of a search.
pub(crate) struct InterpolationSearch {
    problem: Problem,
    /// The first states, and all states of the set, as literals over latches.
    first: Lit,
    reached: Lit,
    /// What follows the first cycle.
    later: Unrolling,
    k: usize,
    beginning: Option<Box<(Encoding, Asker)>>,
    query: Option<Query>,
    /// So many cycles are free of violations.
    safe: usize,
    work: u64,
    /// The graph without interpolants.
    plain: Aig,
}

/// A question that is asked of a solver, in as many turns as it takes.
struct Query {
    solver: Solver,
    /// Variables below are those of the first part alone; then come the shared ones, in the order of the latches.
    shared_from: u32,
    later_from: u32,
}

impl InterpolationSearch {
    pub(crate) fn new(mut problem: Problem) -> Self {
        let aig = &mut problem.model.aig;
        let known = problem.model.latches.iter().filter_map(|l| l.initial.map(|value| l.lit.invert_if(!value)));
        let first = known.fold(Lit::TRUE, |all, lit| aig.and(all, lit));
        let plain = aig.clone();
        let later = Unrolling::new(&problem.model, false);
        Self { first, reached: first, later, k: 0, beginning: None, query: None, safe: 0, work: 0, plain, problem }
    }

    /// Whether some first state is bad at once, as far as that is known after so much work.
    fn begin(&mut self, until: u64, budget: &Budget) -> Option<bool> {
        let mut roots = self.problem.roots();
        roots.push(self.first);
        let (encoding, asker) = self
            .beginning
            .get_or_insert_with(|| {
                let encoding = Encoding::new(&self.problem.model.aig, &roots);
                let asker = Asker::new(&encoding, &[]);
                Box::new((encoding, asker))
            })
            .as_mut();
        let mut lits = vec![self.first, self.problem.bad];
        lits.extend(&self.problem.model.constraints);
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

    /// The question for the set and `k`.
    fn pose(&mut self) -> Query {
        let bad_later = self.later_part();
        let second = Encoding::new(&self.later.aig, &[bad_later]);
        let latches = &self.problem.model.latches;
        let borders: Vec<Lit> = latches.iter().map(|latch| self.later.at(latch.lit, 0)).collect();
        let spoken: BTreeSet<u32> = second.clauses().flatten().chain([&bad_later]).map(|l| l.node()).collect();
        let linked: Vec<usize> = (0..latches.len()).filter(|&index| spoken.contains(&borders[index].node())).collect();
        let first = self.first_part(&linked);
        let (model, latches) = (&self.problem.model, &self.problem.model.latches);
        // Whether the state stays as it is: so the next set holds the present one, and need not be joined with it.
        let stays = Lit::of(model.aig.len() as u32);
        let shared_from = stays.node() + 1;
        let later_from = shared_from + latches.len() as u32;
        let mut solver = Solver::with_proof();
        solver.reserve(later_from as usize + self.later.aig.len());
        let border: std::collections::BTreeMap<u32, u32> =
            linked.iter().map(|&index| (borders[index].node(), shared_from + index as u32)).collect();
        let there = |lit: Lit| {
            let variable = border.get(&lit.node()).copied().unwrap_or(later_from + lit.node());
            Lit::of(variable).invert_if(lit.inverted())
        };
        let mut count = 0;
        let mut add = |part: Part, clause: &[Lit]| {
            solver.add_to(part, clause);
            count += CLAUSE;
        };
        first.clauses().for_each(|clause| add(Part::First, clause));
        second.clauses().for_each(|clause| {
            let clause: Vec<Lit> = clause.iter().map(|&lit| there(lit)).collect();
            add(Part::Second, &clause);
        });
        for &index in &linked {
            let (shared, next) = (Lit::of(shared_from + index as u32), latches[index].next);
            let now = latches[index].lit;
            for clause in
                [[stays, !shared, next], [stays, shared, !next], [!stays, !shared, now], [!stays, shared, !now]]
            {
                add(Part::First, &clause);
            }
        }
        add(Part::First, &[self.reached]);
        model.constraints.iter().for_each(|&held| add(Part::First, &[stays, held]));
        self.problem.facts.iter().for_each(|fact| add(Part::First, fact));
        add(Part::Second, &[there(bad_later)]);
        self.work += count;
        Query { solver, shared_from, later_from }
    }

    /// The set with the constraints, the facts, and the next values of the latches that the second part speaks of.
    fn first_part(&self, linked: &[usize]) -> Encoding {
        let model = &self.problem.model;
        let mut roots: Vec<Lit> = linked.iter().map(|&index| model.latches[index].next).collect();
        roots.push(self.reached);
        roots.extend(&model.constraints);
        roots.extend(self.problem.facts.iter().flatten());
        roots.extend(model.inputs.iter().chain(model.latches.iter().map(|l| &l.lit)));
        Encoding::new(&model.aig, &roots)
    }

    /// That one of `k` cycles is bad, and the constraints and facts hold up to it.
    fn later_part(&mut self) -> Lit {
        let (mut held, mut any) = (Lit::TRUE, Lit::FALSE);
        for cycle in 0..self.k {
            for &constraint in &self.problem.model.constraints {
                let now = self.later.at(constraint, cycle);
                held = self.later.aig.and(held, now);
            }
            for fact in &self.problem.facts {
                let lits: Vec<Lit> = fact.iter().map(|&lit| self.later.at(lit, cycle)).collect();
                let now = lits.into_iter().fold(Lit::FALSE, |any, lit| self.later.aig.or(any, lit));
                held = self.later.aig.and(held, now);
            }
            let bad = self.later.at(self.problem.bad, cycle);
            let both = self.later.aig.and(held, bad);
            any = self.later.aig.or(any, both);
        }
        any
    }

    /// The run that was found, which begins in a first state.
    fn trace(&mut self, query: &Query) -> Trace {
        let value = |lit: Lit| query.solver.value(lit) == Some(true);
        let latches = self.problem.model.latches.iter().map(|latch| value(latch.lit)).collect();
        let mut inputs: Vec<Vec<bool>> = Vec::new();
        if !value(Lit::of(query.shared_from - 1)) {
            inputs.push(self.problem.model.inputs.iter().map(|&input| value(input)).collect());
        }
        // The last cycles may be beyond the one that is bad; what is bad first ends the run.
        for cycle in 0..self.k {
            let at: Vec<Lit> = self.problem.model.inputs.iter().map(|&input| self.later.at(input, cycle)).collect();
            let there = |lit: Lit| value(Lit::of(query.later_from + lit.node()).invert_if(lit.inverted()));
            inputs.push(at.into_iter().map(there).collect());
        }
        let mut trace = Trace { latches, inputs };
        let model = Model { bad: vec![self.problem.bad], ..self.problem.model.clone() };
        let bad = model.simulate(&trace).iter().position(|cycle| cycle.bad[0]);
        trace.inputs.truncate(bad.map_or(trace.inputs.len(), |at| at + 1));
        trace
    }

    /// What the refutation says of the states that are one cycle further, in few gates.
    fn further(&mut self, query: &Query, stop: &Stop) -> Option<Lit> {
        let mut scratch = Aig::default();
        let latches: Vec<Lit> = self.problem.model.latches.iter().map(|_| scratch.leaf()).collect();
        let (from, to) = (query.shared_from, query.later_from);
        let shared = |variable: u32| (from..to).contains(&variable).then(|| latches[(variable - from) as usize]);
        let raw = query.solver.interpolant(&mut scratch, &shared, &|variable| variable < from)?;
        self.work += GATE * scratch.len() as u64;
        let whole = Model { aig: scratch, inputs: latches, bad: vec![raw], ..Model::default() };
        let small = aig::cone(&whole).then(|model| aig::sweep(model, stop));
        let mut map = vec![Lit::FALSE; small.model.aig.len()];
        for (lit, &old) in small.model.inputs.iter().zip(&small.inputs) {
            map[lit.node() as usize] = self.problem.model.latches[old].lit;
        }
        let on = |map: &[Lit], lit: Lit| map[lit.node() as usize].invert_if(lit.inverted());
        for node in 0..small.model.aig.len() as u32 {
            if let Gate::And(a, b) = small.model.aig.gate(node) {
                map[node as usize] = self.problem.model.aig.and(on(&map, a), on(&map, b));
            }
        }
        Some(on(&map, small.model.bad[0]))
    }

    /// Whether every state in `new` is in the set already; `None` where that is too hard to say.
    fn is_known(&mut self, new: Lit, budget: &Budget) -> Option<bool> {
        let mut roots = vec![new, self.reached];
        roots.extend(self.problem.facts.iter().flatten());
        let encoding = Encoding::new(&self.problem.model.aig, &roots);
        let mut asker = Asker::new(&encoding, &self.problem.facts);
        asker.solver.stop = budget.stop();
        let answer = asker.ask(&encoding, &[new, !self.reached], None, PATIENCE);
        self.work += asker.solver.ticks;
        answer.map(|yes| !yes)
    }

    /// Goes on with the set after a refutation.
    fn widen(&mut self, query: &Query, budget: &Budget) -> Option<Answer> {
        if self.reached == self.first {
            self.safe = self.k + 1;
        }
        let Some(new) = self.further(query, &budget.stop()) else { return Some(Answer::GaveUp(Reason::Incomplete)) };
        match self.is_known(new, budget) {
            Some(true) => return Some(Answer::Proved(self.problem.proof(&[vec![self.reached]], 1, false))),
            Some(false) => self.reached = new,
            None => return Some(bounded(self.safe, Reason::Incomplete)),
        }
        let too_large = self.problem.model.aig.len() > self.plain.len() + NODES;
        too_large.then(|| bounded(self.safe, Reason::Memory))
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
            let mut query = self.query.take().unwrap_or_else(|| self.pose());
            query.solver.stop = budget.stop();
            let before = query.solver.ticks;
            let answer = query.solver.solve(&[], None, None, until.saturating_sub(self.work).max(1));
            self.work += query.solver.ticks - before + 1;
            match answer {
                None => {
                    self.query = Some(query);
                    return budget.exhausted().map(|reason| bounded(self.safe, reason));
                }
                Some(true) if self.reached == self.first => return Some(Answer::Violated(self.trace(&query))),
                Some(true) => {
                    self.k += 1;
                    self.reached = self.first;
                    // The interpolants so far are of no use any more.
                    self.problem.model.aig = self.plain.clone();
                }
                Some(false) => {
                    if let Some(answer) = self.widen(&query, budget) {
                        return Some(answer);
                    }
                }
            }
            let clauses = self.problem.model.aig.len() - self.plain.len();
            progress(Progress { engine: "interpolation", depth: self.k + 1, clauses });
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
        let query = self.query.as_ref().map_or(0, |query| query.solver.bytes());
        query + self.later.bytes() + self.problem.model.aig.len() * 40
    }
}
