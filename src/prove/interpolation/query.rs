//! The question whether a set of states leads to something bad, in two parts that share the latches between them.

use std::collections::{BTreeMap, BTreeSet};

use super::super::cdcl::{Part, Solver};
use super::super::encode::Encoding;
use super::super::engine::Budget;
use super::super::problem::Problem;
use super::super::unroll::Unrolling;
use super::GATES;
use super::sets::Sets;
use crate::logic::aig::{Aig, Lit, Model, Trace};

/// A question, asked of a solver that keeps its proof.
///
/// Its variables: those of the model's nodes; then the latches after the first cycle, in their order, which both parts speak
/// of; then the nodes of the later cycles; then those of the graph of sets.
#[derive(Clone)]
pub(super) struct Question {
    pub(super) solver: Solver,
    /// How many clauses it has.
    pub(super) clauses: u64,
    /// The latches in the first cycle.
    latches: Vec<Lit>,
    shared_from: u32,
    later_from: u32,
    sets_from: u32,
}

/// The question for `k` later cycles; it is yet to be said which states it begins in.
pub(super) fn pose(problem: &Problem, later: &mut Unrolling, k: usize) -> Question {
    let bad_later = later_part(problem, later, k);
    let second = Encoding::new(&later.aig, &[bad_later]);
    let latches = &problem.model.latches;
    let borders: Vec<Lit> = latches.iter().map(|latch| later.at(latch.lit, 0)).collect();
    let spoken: BTreeSet<u32> = second.clauses().flatten().chain([&bad_later]).map(|l| l.node()).collect();
    let linked: Vec<usize> = (0..latches.len()).filter(|&index| spoken.contains(&borders[index].node())).collect();
    let shared_from = problem.model.aig.len() as u32;
    let later_from = shared_from + latches.len() as u32;
    let sets_from = later_from + later.aig.len() as u32;
    let mut solver = Solver::with_proof();
    solver.reserve(sets_from as usize);
    let latches = latches.iter().map(|latch| latch.lit).collect();
    let mut question = Question { solver, clauses: 0, latches, shared_from, later_from, sets_from };
    question.add_first_cycle(problem, &linked);
    let border: BTreeMap<u32, u32> =
        linked.iter().map(|&index| (borders[index].node(), shared_from + index as u32)).collect();
    let there = |lit: Lit| {
        let variable = border.get(&lit.node()).copied().unwrap_or(later_from + lit.node());
        Lit::of(variable).invert_if(lit.inverted())
    };
    for clause in second.clauses() {
        let clause: Vec<Lit> = clause.iter().map(|&lit| there(lit)).collect();
        question.add(Part::Second, &clause);
    }
    question.add(Part::Second, &[there(bad_later)]);
    question
}

/// That one of `k` cycles is bad, and the constraints and facts hold up to it.
fn later_part(problem: &Problem, later: &mut Unrolling, k: usize) -> Lit {
    let (mut held, mut any) = (Lit::TRUE, Lit::FALSE);
    for cycle in 0..k {
        for &constraint in &problem.model.constraints {
            let now = later.at(constraint, cycle);
            held = later.aig.and(held, now);
        }
        for fact in &problem.facts {
            let lits: Vec<Lit> = fact.iter().map(|&lit| later.at(lit, cycle)).collect();
            let now = lits.into_iter().fold(Lit::FALSE, |any, lit| later.aig.or(any, lit));
            held = later.aig.and(held, now);
        }
        let bad = later.at(problem.bad, cycle);
        let both = later.aig.and(held, bad);
        any = later.aig.or(any, both);
    }
    any
}

impl Question {
    fn add(&mut self, part: Part, clause: &[Lit]) {
        self.solver.add_to(part, clause);
        self.clauses += 1;
    }

    /// The constraints, the facts, and the next values of the latches that the second part speaks of.
    fn add_first_cycle(&mut self, problem: &Problem, linked: &[usize]) {
        let model = &problem.model;
        let mut roots: Vec<Lit> = linked.iter().map(|&index| model.latches[index].next).collect();
        roots.extend(&model.constraints);
        roots.extend(problem.facts.iter().flatten());
        Encoding::new(&model.aig, &roots).clauses().for_each(|clause| self.add(Part::First, clause));
        for &index in linked {
            let (shared, next) = (Lit::of(self.shared_from + index as u32), model.latches[index].next);
            self.add(Part::First, &[!shared, next]);
            self.add(Part::First, &[shared, !next]);
        }
        model.constraints.iter().for_each(|&held| self.add(Part::First, &[held]));
        problem.facts.iter().for_each(|fact| self.add(Part::First, fact));
    }

    /// Lets it begin in a state of the set that is looked at.
    pub(super) fn begin_in(&mut self, sets: &Sets) {
        self.solver.reserve(self.sets_from as usize + sets.aig.len());
        let latch: BTreeMap<u32, Lit> =
            sets.latches.iter().zip(&self.latches).map(|(leaf, &latch)| (leaf.node(), latch)).collect();
        let there = |sets_from: u32, lit: Lit| {
            let at = latch.get(&lit.node()).copied().unwrap_or(Lit::of(sets_from + lit.node()));
            at.invert_if(lit.inverted())
        };
        for clause in Encoding::new(&sets.aig, &[sets.image]).clauses().chain([&[sets.image][..]]) {
            let clause: Vec<Lit> = clause.iter().map(|&lit| there(self.sets_from, lit)).collect();
            self.add(Part::First, &clause);
        }
    }

    /// Whether there is such a run, as far as that is known after so much work.
    pub(super) fn ask(&mut self, work: u64, budget: &Budget) -> Option<bool> {
        self.solver.stop = budget.stop();
        self.solver.solve(&[], None, None, work)
    }

    /// What the refutation says of the states that are one cycle further: the bad literal of a model whose inputs are the
    /// latches.
    pub(super) fn interpolant(&self, latches: usize) -> Option<Model> {
        let mut aig = Aig::default();
        let leaves: Vec<Lit> = (0..latches).map(|_| aig.leaf()).collect();
        let (from, to) = (self.shared_from, self.later_from);
        let shared = |variable: u32| (from..to).contains(&variable).then(|| leaves[(variable - from) as usize]);
        let is_first = |variable: u32| variable < from || variable >= self.sets_from;
        let raw = self.solver.interpolant(&mut aig, &shared, &is_first, GATES)?;
        Some(Model { aig, inputs: leaves, bad: vec![raw], ..Model::default() })
    }

    /// The run that was found, where it begins in a first state.
    pub(super) fn trace(&self, problem: &Problem, later: &mut Unrolling, k: usize) -> Trace {
        let value = |lit: Lit| self.solver.value(lit) == Some(true);
        let latches = problem.model.latches.iter().map(|latch| value(latch.lit)).collect();
        let mut inputs: Vec<Vec<bool>> = vec![problem.model.inputs.iter().map(|&input| value(input)).collect()];
        // The last cycles may be beyond the one that is bad; what is bad first ends the run.
        for cycle in 0..k {
            let at: Vec<Lit> = problem.model.inputs.iter().map(|&input| later.at(input, cycle)).collect();
            let there = |lit: Lit| value(Lit::of(self.later_from + lit.node()).invert_if(lit.inverted()));
            inputs.push(at.into_iter().map(there).collect());
        }
        let mut trace = Trace { latches, inputs };
        let model = Model { bad: vec![problem.bad], ..problem.model.clone() };
        let bad = model.simulate(&trace).iter().position(|cycle| cycle.bad[0]);
        trace.inputs.truncate(bad.map_or(trace.inputs.len(), |at| at + 1));
        trace
    }
}
