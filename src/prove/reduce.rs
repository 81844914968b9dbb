//! The part of a model that matters for one property, and the way back: the reductions of [`crate::logic::aig`], with what
//! they found out as clauses of the proof.

use super::engine::{Answer, Fact, Proof};
use super::problem::Problem;
use crate::logic::aig::{self, Lit, Model, Trace};
use crate::logic::sat::Stop;

/// A smaller model, with one property.
pub(crate) struct Reduced(aig::Reduced);

impl Reduced {
    /// What the property depends on, without latches that never change.
    pub(crate) fn cone(model: &Model, property: usize) -> Self {
        Self(aig::constants(&Model { bad: vec![model.bad[property]], ..model.clone() }))
    }

    /// What the property depends on, without latches that never change or that follow others. Where `stop` comes first,
    /// with them.
    pub(crate) fn new(model: &Model, property: usize, stop: &Stop) -> Self {
        Self(Self::cone(model, property).0.then(|model| aig::correspond(model, stop)))
    }

    pub(crate) fn model(&self) -> &Model {
        &self.0.model
    }

    /// What engines work on.
    pub(crate) fn problem(&self) -> Problem {
        Problem { is_whole: self.0.explains_all(), ..Problem::new(self.model(), 0) }
    }

    /// What became of words of the old model's latches; words without a bit that changes are gone.
    pub(crate) fn words(&self, old: &Model, words: &[Vec<Lit>]) -> Vec<Vec<Lit>> {
        let became: std::collections::BTreeMap<u32, Lit> =
            old.latches.iter().map(|latch| latch.lit.node()).zip(self.0.states.iter().copied()).collect();
        let bit = |lit: &Lit| became.get(&lit.node()).map_or(Lit::FALSE, |now| now.invert_if(lit.inverted()));
        let all = words.iter().map(|word| word.iter().map(bit).collect::<Vec<Lit>>());
        all.filter(|word| word.iter().any(|lit| lit.node() != 0)).collect()
    }

    /// The answer for the old model.
    pub(crate) fn lift(&self, model: &Model, answer: Answer) -> Answer {
        match answer {
            Answer::Proved(proof) => Answer::Proved(self.proof(model, proof)),
            Answer::Violated(trace) => Answer::Violated(self.trace(&trace)),
            other => other,
        }
    }

    /// The run of the old model.
    pub(crate) fn trace(&self, trace: &Trace) -> Trace {
        self.0.trace(trace)
    }

    fn proof(&self, model: &Model, proof: Proof) -> Proof {
        let (old, new) = (self.0.latches.len(), model.latches.len());
        let fact = |(f, v): Fact| (if f < old { self.0.latches[f] } else { f - old + new }, v);
        let mut clauses: Vec<Vec<Fact>> = proof.clauses.iter().map(|c| c.iter().map(|&f| fact(f)).collect()).collect();
        clauses.extend(self.0.facts.iter().cloned());
        clauses.iter_mut().for_each(|c| c.sort_unstable());
        clauses.sort();
        let gates = proof.gates.iter().map(|&(a, b)| (fact(a), fact(b))).collect();
        Proof { gates, clauses, ..proof }
    }
}
