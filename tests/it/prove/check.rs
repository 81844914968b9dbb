//! Proofs of models too large to enumerate, checked by separate questions to a solver that the engines do not use.

use rungbook::logic::aig::{Lit, Model};
use rungbook::logic::sat::Solver;
use rungbook::logic::sat::bat::BatSat;
use rungbook::logic::sat::encode::Encoder;
use rungbook::prove::engine::Proof;

struct Question<'m> {
    model: &'m Model,
    solver: BatSat,
    encoder: Encoder,
}

impl<'m> Question<'m> {
    fn new(model: &'m Model) -> Self {
        let mut question = Self { model, solver: BatSat::default(), encoder: Encoder::default() };
        for constraint in &model.constraints {
            question.require(*constraint);
        }
        question
    }

    fn lit(&mut self, lit: Lit) -> i32 {
        self.encoder.encode(&self.model.aig, lit, &mut self.solver)
    }

    fn require(&mut self, lit: Lit) {
        let lit = self.lit(lit);
        self.solver.add_clause(&[lit]);
    }

    /// The invariant over these literals for the latches: one literal for each clause.
    fn clauses(&mut self, proof: &Proof, latches: &[i32]) -> Vec<i32> {
        let mut known = latches.to_vec();
        let of = |known: &[i32], (f, v): (usize, bool)| if v { known[f] } else { -known[f] };
        for &(a, b) in &proof.gates {
            let (a, b, gate) = (of(&known, a), of(&known, b), self.solver.new_var());
            self.solver.add_clause(&[-gate, a]);
            self.solver.add_clause(&[-gate, b]);
            self.solver.add_clause(&[gate, -a, -b]);
            known.push(gate);
        }
        let mut out = Vec::new();
        for clause in &proof.clauses {
            let holds = self.solver.new_var();
            let mut long = vec![-holds];
            for &fact in clause {
                let lit = of(&known, fact);
                long.push(lit);
                self.solver.add_clause(&[holds, -lit]);
            }
            self.solver.add_clause(&long);
            out.push(holds);
        }
        out
    }

    fn some_is_false(&mut self, clauses: &[i32]) -> Option<bool> {
        let negated: Vec<i32> = clauses.iter().map(|c| -c).collect();
        self.solver.add_clause(&negated);
        self.solver.solve(&[])
    }
}

/// Panics unless the proof is one.
pub(crate) fn check_proof(model: &Model, proof: &Proof) {
    check_invariant(model, proof);
    if proof.k > 1 {
        check_induction(model, proof);
    }
}

/// A run of so many cycles: the solver, and what encodes each cycle.
fn run(model: &Model, cycles: usize) -> (BatSat, Vec<Encoder>) {
    let (mut solver, mut run) = (BatSat::default(), Vec::<Encoder>::new());
    for _ in 0..cycles {
        let mut encoder = Encoder::default();
        if let Some(before) = run.last_mut() {
            for latch in &model.latches {
                let next = before.encode(&model.aig, latch.next, &mut solver);
                encoder.bind(latch.lit, next);
            }
        }
        for &constraint in &model.constraints {
            let held = encoder.encode(&model.aig, constraint, &mut solver);
            solver.add_clause(&[held]);
        }
        run.push(encoder);
    }
    (solver, run)
}

/// The step and the base of an induction over more than one cycle.
fn check_induction(model: &Model, proof: &Proof) {
    let bad = model.bad[0];
    let (mut solver, mut cycles) = run(model, proof.k);
    for latch in &model.latches {
        let lit = cycles[0].encode(&model.aig, latch.lit, &mut solver);
        if let Some(value) = latch.initial {
            solver.add_clause(&[if value { lit } else { -lit }]);
        }
    }
    for cycle in &mut cycles {
        let bad = cycle.encode(&model.aig, bad, &mut solver);
        assert_eq!(solver.solve(&[bad]), Some(false), "a run from a first state is bad");
    }
    let (mut solver, mut cycles) = run(model, proof.k + 1);
    let mut states = Vec::new();
    for cycle in &mut cycles {
        let state: Vec<i32> = model.latches.iter().map(|l| cycle.encode(&model.aig, l.lit, &mut solver)).collect();
        let mut question = Question { model, solver, encoder: Encoder::default() };
        let clauses = question.clauses(proof, &state);
        solver = question.solver;
        clauses.iter().for_each(|clause| solver.add_clause(&[*clause]));
        states.push(state);
    }
    let bad: Vec<i32> = cycles.iter_mut().map(|cycle| cycle.encode(&model.aig, bad, &mut solver)).collect();
    bad[..proof.k].iter().for_each(|bad| solver.add_clause(&[-bad]));
    let pairs = (0..proof.k).flat_map(|one| (0..one).map(move |other| (one, other))).filter(|_| proof.simple_path);
    for (one, other) in pairs {
        let differ: Vec<i32> =
            states[one].iter().zip(&states[other]).map(|(&a, &b)| differs(&mut solver, a, b)).collect();
        solver.add_clause(&differ);
    }
    assert_eq!(solver.solve(&[bad[proof.k]]), Some(false), "the induction has no step");
}

/// A literal that is true only where the two differ.
fn differs(solver: &mut BatSat, a: i32, b: i32) -> i32 {
    let own = solver.new_var();
    solver.add_clause(&[-own, a, b]);
    solver.add_clause(&[-own, -a, -b]);
    own
}

/// Panics unless the clauses of the proof are inductive, and where it is an invariant alone, exclude what is bad.
fn check_invariant(model: &Model, proof: &Proof) {
    let mut first = Question::new(model);
    let latches: Vec<i32> = model.latches.iter().map(|l| first.lit(l.lit)).collect();
    for (latch, &lit) in model.latches.iter().zip(&latches) {
        if let Some(value) = latch.initial {
            first.solver.add_clause(&[if value { lit } else { -lit }]);
        }
    }
    let clauses = first.clauses(proof, &latches);
    assert_eq!(first.some_is_false(&clauses), Some(false), "a first state is outside");

    let mut step = Question::new(model);
    let now: Vec<i32> = model.latches.iter().map(|l| step.lit(l.lit)).collect();
    let next: Vec<i32> = model.latches.iter().map(|l| step.lit(l.next)).collect();
    for clause in step.clauses(proof, &now) {
        step.solver.add_clause(&[clause]);
    }
    if proof.k == 1 {
        let bad = step.lit(model.bad[0]);
        assert_eq!(step.solver.solve(&[bad]), Some(false), "a bad cycle is inside");
    }
    let clauses = step.clauses(proof, &next);
    assert_eq!(step.some_is_false(&clauses), Some(false), "the invariant is left");
}
