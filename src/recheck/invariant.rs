//! Checks a [`Certificate`] against its [`System`] by propositional queries, each in a solver of its own.

use std::sync::Arc;
use std::time::{Duration, Instant};

use super::cases;
use super::cnf::{self, Words};
use super::gates::{Gates, Word};
use crate::logic::certificate::{Certificate, Fact};
use crate::logic::system::System;
use batsat::Lit;

/// Says when to give up.
pub type Stop = Arc<dyn Fn() -> bool + Send + Sync>;

/// Gives up after so long, counted from now.
#[must_use]
pub fn within(patience: Duration) -> Stop {
    let start = Instant::now();
    Arc::new(move || start.elapsed() >= patience)
}

/// Why a certificate is not believed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rejection {
    /// It names a state or a bit that the system does not have, or its bound is zero.
    Malformed,
    /// A first state does not satisfy the invariant.
    NotInitial,
    /// The invariant is not kept by a step: the index of the clause.
    NotInductive(usize),
    /// The invariant admits a state in which an obligation fails, or the induction's step does.
    NotSafe,
    /// An obligation fails in one of the first cycles.
    Fails,
    /// The solver refuted a question, and what it concluded does not follow: an error in the solver.
    Unfounded,
    /// The time was over.
    OutOfTime,
}

/// How many clauses are asked about at once.
const BLOCK: usize = 64;

/// A system in clauses, cycle by cycle.
pub(super) struct Unrolled<'s> {
    pub(super) system: &'s System,
    pub(super) gates: Gates,
    cycles: Vec<Words>,
}

impl<'s> Unrolled<'s> {
    /// One cycle with free states.
    pub(super) fn new(system: &'s System, stop: &Stop) -> Self {
        Self::merged(system, stop, std::iter::empty())
    }

    /// One cycle in which each first state of a pair is the second one.
    pub(super) fn merged(system: &'s System, stop: &Stop, pairs: impl Iterator<Item = (usize, usize)>) -> Self {
        let stop = stop.clone();
        let mut out = Self { system, gates: Gates::new(Box::new(move || stop())), cycles: vec![Words::new()] };
        for (state, same) in pairs {
            let word = out.word(0, system.states[same].variable);
            out.cycles[0].insert(system.states[state].variable, word);
        }
        out.add_constraints(0);
        out
    }

    pub(super) fn word(&mut self, cycle: usize, term: crate::logic::term::Term) -> Word {
        cnf::word(&mut self.gates, &self.system.pool, &mut self.cycles[cycle], term)
    }

    fn add_constraints(&mut self, cycle: usize) {
        for constraint in &self.system.constraints {
            let word = self.word(cycle, constraint.term);
            self.gates.clause(&word);
        }
    }

    fn start(&mut self) {
        for state in &self.system.states {
            if let Some(initial) = state.initial {
                let (now, first) = (self.word(0, state.variable), self.word(0, initial));
                let same = self.gates.equal(&now, &first);
                self.gates.clause(&[same]);
            }
        }
    }

    fn step(&mut self) {
        let last = self.cycles.len() - 1;
        let next = self.system.states.iter().map(|state| (state.variable, self.word(last, state.next))).collect();
        self.cycles.push(next);
        self.add_constraints(last + 1);
    }

    pub(super) fn fact(&mut self, cycle: usize, gates: &[Lit], fact: Fact) -> Lit {
        let (lit, value) = match fact {
            Fact::Bit(literal) => {
                let word = self.word(cycle, self.system.states[literal.state as usize].variable);
                (word[literal.bit as usize], literal.value)
            }
            Fact::Gate(gate, value) => (gates[gate as usize], value),
        };
        if value { lit } else { !lit }
    }

    /// The clauses of the invariant in a cycle.
    fn invariant(&mut self, cycle: usize, certificate: &Certificate) -> Vec<Vec<Lit>> {
        let mut gates = Vec::with_capacity(certificate.gates.len());
        for [one, other] in &certificate.gates {
            let (one, other) = (self.fact(cycle, &gates, *one), self.fact(cycle, &gates, *other));
            gates.push(self.gates.and(one, other));
        }
        let clause = |this: &mut Self, clause: &[Fact]| {
            clause.iter().map(|fact| this.fact(cycle, &gates, *fact)).collect::<Vec<Lit>>()
        };
        certificate.clauses.iter().map(|facts| clause(self, facts)).collect()
    }

    pub(super) fn assume_invariant(&mut self, cycle: usize, certificate: &Certificate) {
        for clause in self.invariant(cycle, certificate) {
            self.gates.clause(&clause);
        }
    }

    /// Whether every obligation holds.
    pub(super) fn safe(&mut self, cycle: usize) -> Lit {
        let words: Vec<Lit> =
            self.system.obligations.iter().flat_map(|obligation| self.word(cycle, obligation.term)).collect();
        self.gates.all(&words)
    }

    /// Whether no model has all of `lits`.
    pub(super) fn refute(&mut self, lits: &[Lit], otherwise: Rejection) -> Result<(), Rejection> {
        if self.gates.satisfiable(lits)? { Err(otherwise) } else { Ok(()) }
    }

    /// Whether no model violates any of the clauses, asked for some at a time; what is said where one does.
    fn refute_all(&mut self, clauses: &[Vec<Lit>], otherwise: impl Fn(usize) -> Rejection) -> Result<(), Rejection> {
        for (at, block) in clauses.chunks(BLOCK).enumerate() {
            let violated: Vec<Vec<Lit>> = block.iter().map(|clause| clause.iter().map(|&lit| !lit).collect()).collect();
            let each: Vec<Lit> = violated.iter().map(|lits| self.gates.all(lits)).collect();
            let any = self.gates.any(&each);
            if self.gates.satisfiable(&[any]) == Ok(false) {
                continue;
            }
            for (index, lits) in violated.iter().enumerate() {
                self.refute(lits, otherwise(at * BLOCK + index))?;
            }
        }
        Ok(())
    }

    fn states_differ(&mut self, one: usize, other: usize) -> Lit {
        let mut differences = Vec::new();
        for state in &self.system.states {
            let (a, b) = (self.word(one, state.variable), self.word(other, state.variable));
            differences.push(!self.gates.equal(&a, &b));
        }
        self.gates.any(&differences)
    }
}

/// Checks that `certificate` proves every obligation of `system`.
///
/// # Errors
/// The first reason for which it does not.
pub fn check(system: &System, certificate: &Certificate, stop: &Stop) -> Result<(), Rejection> {
    if !well_formed(system, certificate) {
        return Err(Rejection::Malformed);
    }
    initial(system, certificate, stop)?;
    inductive(system, certificate, stop)?;
    safe(system, certificate, stop)
}

fn well_formed(system: &System, certificate: &Certificate) -> bool {
    let fact = |fact: &Fact, gates: usize| match fact {
        Fact::Bit(literal) => {
            let state = system.states.get(literal.state as usize);
            state.is_some_and(|state| literal.bit < system.pool.width(state.variable))
        }
        Fact::Gate(gate, _) => (*gate as usize) < gates,
    };
    let gates = certificate.gates.len();
    certificate.k > 0
        && certificate.gates.iter().enumerate().all(|(index, operands)| operands.iter().all(|f| fact(f, index)))
        && certificate.clauses.iter().flatten().all(|f| fact(f, gates))
}

fn initial(system: &System, certificate: &Certificate, stop: &Stop) -> Result<(), Rejection> {
    let mut first = Unrolled::new(system, stop);
    first.start();
    let clauses = first.invariant(0, certificate);
    first.refute_all(&clauses, |_| Rejection::NotInitial)
}

fn inductive(system: &System, certificate: &Certificate, stop: &Stop) -> Result<(), Rejection> {
    let mut pair = Unrolled::new(system, stop);
    pair.assume_invariant(0, certificate);
    pair.step();
    let clauses = pair.invariant(1, certificate);
    pair.refute_all(&clauses, Rejection::NotInductive)
}

fn safe(system: &System, certificate: &Certificate, stop: &Stop) -> Result<(), Rejection> {
    if certificate.k == 1 && cases::are_worthwhile(system) {
        return cases::safe(system, certificate, stop);
    }
    let k = certificate.k as usize;
    let steps = if k == 1 { 0 } else { k };
    let mut path = Unrolled::new(system, stop);
    path.assume_invariant(0, certificate);
    for step in 1..=steps {
        let safe = path.safe(step - 1);
        path.gates.clause(&[safe]);
        path.step();
        path.assume_invariant(step, certificate);
        for earlier in (0..step).filter(|_| certificate.simple_path) {
            let differ = path.states_differ(earlier, step);
            path.gates.clause(&[differ]);
        }
    }
    let good = path.safe(steps);
    path.refute(&[!good], Rejection::NotSafe)?;
    let mut base = Unrolled::new(system, stop);
    base.start();
    for cycle in 0..steps {
        if cycle > 0 {
            base.step();
        }
        let good = base.safe(cycle);
        base.refute(&[!good], Rejection::Fails)?;
    }
    Ok(())
}
