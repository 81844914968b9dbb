//! What has been reached so far, and the runs that show it.

use super::super::decide::Choice;

/// Targets and the runs that reach them.
#[derive(Debug, Default)]
pub(super) struct Frontier {
    reached: Vec<Option<(usize, usize)>>,
    runs: Vec<Choice>,
}

impl Frontier {
    pub(super) fn new(targets: usize) -> Self {
        Self { reached: vec![None; targets], runs: Vec::new() }
    }

    /// Those that no run reaches yet.
    pub(super) fn open(&self) -> Vec<usize> {
        (0..self.reached.len()).filter(|target| self.reached[*target].is_none()).collect()
    }

    pub(super) fn is_open(&self, target: usize) -> bool {
        self.reached[target].is_none()
    }

    pub(super) fn is_done(&self) -> bool {
        self.reached.iter().all(Option::is_some)
    }

    /// A run reaches these in these cycles; the ones that are new count.
    pub(super) fn add(&mut self, mut run: Choice, hits: &[(usize, usize)]) {
        let new: Vec<(usize, usize)> = hits.iter().copied().filter(|(target, _)| self.is_open(*target)).collect();
        let Some(last) = new.iter().map(|(_, cycle)| *cycle).max() else { return };
        run.inputs.truncate(last + 1);
        for (target, cycle) in new {
            let place = &mut self.reached[target];
            if place.is_none_or(|(run, known)| run == self.runs.len() && cycle < known) {
                *place = Some((self.runs.len(), cycle));
            }
        }
        self.runs.push(run);
    }

    /// The targets with run and cycle, and the runs; a run that another one begins with is left out.
    pub(super) fn finish(self) -> (Vec<Option<(usize, usize)>>, Vec<Choice>) {
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
        let moved = |(run, cycle): (usize, usize)| (place[run], cycle);
        (self.reached.into_iter().map(|at| at.map(moved)).collect(), kept)
    }
}
