//! What has been reached so far, and the runs that show it.

use super::super::decide::Choice;
use crate::logic::certificate::Certificate;

/// What is known of a target so far.
#[derive(Debug)]
pub(super) enum Place {
    /// Nothing.
    Open,
    /// This run is there in this cycle.
    Reached { run: usize, cycle: usize },
    /// No run is ever there, says the proof.
    Never(Box<Certificate>),
}

/// Targets and the runs that reach them.
#[derive(Debug, Default)]
pub(super) struct Frontier {
    places: Vec<Place>,
    runs: Vec<Choice>,
}

impl Frontier {
    pub(super) fn new(targets: usize) -> Self {
        Self { places: (0..targets).map(|_| Place::Open).collect(), runs: Vec::new() }
    }

    /// Those that no run reaches yet, and that nothing shows not to be reached.
    pub(super) fn open(&self) -> Vec<usize> {
        (0..self.places.len()).filter(|target| self.is_open(*target)).collect()
    }

    pub(super) fn is_open(&self, target: usize) -> bool {
        matches!(self.places[target], Place::Open)
    }

    pub(super) fn is_done(&self) -> bool {
        !self.places.iter().any(|place| matches!(place, Place::Open))
    }

    /// No run is ever there.
    pub(super) fn close(&mut self, target: usize, proof: Certificate) {
        self.places[target] = Place::Never(Box::new(proof));
    }

    /// A run reaches these in these cycles; the ones that are new count.
    pub(super) fn add(&mut self, mut run: Choice, hits: &[(usize, usize)]) {
        let new: Vec<(usize, usize)> = hits.iter().copied().filter(|(target, _)| self.is_open(*target)).collect();
        let Some(last) = new.iter().map(|(_, cycle)| *cycle).max() else { return };
        run.inputs.truncate(last + 1);
        for (target, cycle) in new {
            match &mut self.places[target] {
                Place::Reached { cycle: known, .. } => *known = cycle.min(*known),
                place => *place = Place::Reached { run: self.runs.len(), cycle },
            }
        }
        self.runs.push(run);
    }

    /// What is known of each target, and the runs; a run that another one begins with is left out.
    pub(super) fn finish(self) -> (Vec<Place>, Vec<Choice>) {
        let mut order: Vec<usize> = (0..self.runs.len()).collect();
        order.sort_by_key(|run| (std::cmp::Reverse(self.runs[*run].inputs.len()), *run));
        let mut kept: Vec<Choice> = Vec::new();
        let mut place = vec![0; self.runs.len()];
        for run in order {
            let own = &self.runs[run];
            let begins = |other: &Choice| other.globals == own.globals && other.inputs.starts_with(&own.inputs);
            place[run] = kept.iter().position(begins).unwrap_or_else(|| {
                kept.push(own.clone());
                kept.len() - 1
            });
        }
        let moved = |at| match at {
            Place::Reached { run, cycle } => Place::Reached { run: place[run], cycle },
            other => other,
        };
        (self.places.into_iter().map(moved).collect(), kept)
    }
}
