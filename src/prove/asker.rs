//! A solver of a transition relation, asked about parts of it at a time.

use super::cdcl::Solver;
use super::encode::Encoding;
use crate::logic::aig::Lit;

/// A solver of the transition relation, and the variables that its clauses speak of beside the gates.
pub(crate) struct Asker {
    pub(crate) solver: Solver,
    base: Vec<u32>,
    marked: Vec<bool>,
}

impl Asker {
    pub(crate) fn new(encoding: &Encoding, facts: &[Vec<Lit>]) -> Self {
        let mut solver = Solver::new();
        solver.reserve(encoding.variables);
        for clause in encoding.clauses() {
            solver.add(clause);
        }
        let mut asker = Self { solver, base: Vec::new(), marked: vec![false; encoding.variables] };
        for fact in facts {
            asker.require(encoding, fact);
        }
        asker
    }

    /// Adds a clause for good.
    pub(crate) fn require(&mut self, encoding: &Encoding, clause: &[Lit]) {
        self.solver.add(clause);
        encoding.close(clause.iter().map(|l| l.node()), &mut self.base, &mut self.marked);
    }

    /// One question about what the assumptions and the extra clause rest on.
    pub(crate) fn ask(
        &mut self,
        encoding: &Encoding,
        assumptions: &[Lit],
        extra: Option<&[Lit]>,
        budget: u64,
    ) -> Option<bool> {
        let about = assumptions.iter().chain(extra.unwrap_or(&[]));
        self.ask_about(encoding, about, (assumptions, extra), budget)
    }

    /// One question, under switches, about what the extra clause rests on.
    pub(crate) fn ask_assuming(
        &mut self,
        encoding: &Encoding,
        switches: &[Lit],
        extra: &[Lit],
        budget: u64,
    ) -> Option<bool> {
        self.ask_about(encoding, extra.iter(), (switches, Some(extra)), budget)
    }

    fn ask_about<'l>(
        &mut self,
        encoding: &Encoding,
        about: impl Iterator<Item = &'l Lit>,
        (assumptions, extra): (&[Lit], Option<&[Lit]>),
        budget: u64,
    ) -> Option<bool> {
        let base = self.base.len();
        encoding.close(about.map(|l| l.node()), &mut self.base, &mut self.marked);
        let answer = self.solver.solve(assumptions, extra, Some(&self.base), budget);
        for variable in self.base.drain(base..) {
            self.marked[variable as usize] = false;
        }
        answer
    }

    /// Lets all questions be about these, too.
    pub(crate) fn focus<'l>(&mut self, encoding: &Encoding, lits: impl Iterator<Item = &'l Lit>) {
        encoding.close(lits.map(|l| l.node()), &mut self.base, &mut self.marked);
    }

    /// A literal that no gate stands for, to switch clauses on by assuming it.
    pub(crate) fn switch(&mut self) -> Lit {
        let variable = self.solver.variable();
        self.solver.reserve(variable as usize + 1);
        Lit::of(variable)
    }
}
