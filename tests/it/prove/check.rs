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

/// Panics unless the proof, an invariant, is one.
pub(crate) fn check_invariant(model: &Model, proof: &Proof) {
    assert_eq!(proof.k, 1);
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
    let bad = step.lit(model.bad[0]);
    assert_eq!(step.solver.solve(&[bad]), Some(false), "a bad cycle is inside");
    let clauses = step.clauses(proof, &next);
    assert_eq!(step.some_is_false(&clauses), Some(false), "the invariant is left");
}
