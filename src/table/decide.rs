//! Questions about the values that cells admit, decided by a SAT solver over the variables' types.
//!
//! Each variable has a term for each cycle that is spoken of; inputs of an enumeration hold declared values, subranges keep to
//! their range, global variables satisfy their `with`. A cell that faults is not satisfied.

pub mod free;
pub mod lint;

use std::collections::{BTreeMap, BTreeSet};

use super::bind::{BoundTable, Leaf, Role, Term as Cell};
use crate::logic::blast::Blaster;
use crate::logic::sat::Solver;
use crate::logic::sat::cadi::Cadical;
use crate::logic::sat::encode::Encoder;
use crate::logic::term::{Pool, Term};
use crate::semantics::encode::encode;
use crate::semantics::scalar::Scalar;
use crate::semantics::show::{self, Kind};

/// A value in a cycle: of a variable at its end, or, of an in-out in an assumption, at its beginning; cycles before the first
/// one are negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Moment {
    Variable { index: usize, cycle: i64, begins: bool },
    Global(usize),
}

/// Terms over the variables of a table, not yet handed to a solver.
pub(super) struct Puzzle<'b> {
    pub(super) bound: &'b BoundTable,
    pub(super) pool: Pool,
    pub(super) terms: BTreeMap<Moment, Term>,
    /// Holds in any case: domains, and what global variables satisfy.
    facts: Vec<Term>,
    /// Whether values before the first cycle are the declared initial ones; else they are any.
    from_start: bool,
    /// Where stretches of cycles begin in which no value changes; without any, each cycle is one.
    pub(super) stretches: Vec<i64>,
}

impl<'b> Puzzle<'b> {
    pub(super) fn new(bound: &'b BoundTable, from_start: bool) -> Self {
        let mut puzzle = Self {
            bound,
            pool: Pool::default(),
            terms: BTreeMap::new(),
            facts: Vec::new(),
            from_start,
            stretches: Vec::new(),
        };
        for index in 0..bound.globals.len() {
            let global = puzzle.moment(Moment::Global(index));
            let labels = bound.globals[index].labels.clone();
            puzzle.declared(global, &labels);
            if let Some(constraint) = &bound.globals[index].constraint
                && let Some(term) = puzzle.holds(constraint, 0, true)
            {
                puzzle.facts.push(term);
            }
        }
        puzzle
    }

    /// The term of a value.
    pub(super) fn moment(&mut self, moment: Moment) -> Term {
        if let Some(known) = self.terms.get(&moment) {
            return *known;
        }
        let bound = self.bound;
        let term = match moment {
            Moment::Global(index) => self.pool.variable(bound.globals[index].scalar.width(), "global"),
            Moment::Variable { index, cycle, .. } if cycle < 0 && self.from_start => {
                let variable = &bound.variables[index];
                self.pool.constant(variable.scalar.width(), variable.initial)
            }
            Moment::Variable { index, .. } => {
                let variable = &bound.variables[index];
                let term = self.pool.variable(variable.scalar.width(), variable.path.clone());
                if self.from_start {
                    self.finite(term, variable.scalar);
                }
                self.declared(term, &variable.labels);
                if let Some((low, high)) = variable.range {
                    self.within(term, variable.scalar, low, high);
                }
                term
            }
        };
        self.terms.insert(moment, term);
        term
    }

    /// One of the values of an enumeration.
    fn declared(&mut self, term: Term, labels: &[(u64, String)]) {
        if labels.is_empty() {
            return;
        }
        let width = self.pool.width(term);
        let mut any = self.pool.truth(false);
        for (bits, _) in labels {
            let bits = self.pool.constant(width, *bits);
            let same = self.pool.eq(term, bits);
            any = self.pool.or(any, same);
        }
        self.facts.push(any);
    }

    /// A number: neither infinite nor none.
    fn finite(&mut self, term: Term, scalar: Scalar) {
        let (high, low) = match scalar {
            Scalar::Real(32) => (30, 23),
            Scalar::Real(_) => (62, 52),
            _ => return,
        };
        let exponent = self.pool.extract(term, high, low);
        let ones = self.pool.constant(high - low + 1, u64::MAX);
        let finite = self.pool.ne(exponent, ones);
        self.facts.push(finite);
    }

    fn within(&mut self, term: Term, scalar: Scalar, low: i128, high: i128) {
        let width = scalar.width();
        let (low, high) = (self.pool.constant(width, scalar.bits(low)), self.pool.constant(width, scalar.bits(high)));
        let (above, below) = if scalar.is_signed() {
            (self.pool.sle(low, term), self.pool.sle(term, high))
        } else {
            (self.pool.ule(low, term), self.pool.ule(term, high))
        };
        self.facts.extend([above, below]);
    }

    /// Whether a constraint holds in a cycle; nothing where it has no term.
    pub(super) fn holds(&mut self, constraint: &Cell, cycle: i64, assumption: bool) -> Option<Term> {
        let bound = self.bound;
        let stretches = std::mem::take(&mut self.stretches);
        let place = |leaf: &Leaf| match *leaf {
            Leaf::Global(index) => Moment::Global(index),
            Leaf::Variable { index, ago } => {
                let begins = assumption && ago == 0 && bound.variables[index].role == Role::InOut;
                let cycle = cycle - i64::from(ago);
                // All cycles of a stretch are its first one.
                let cycle = match stretches.partition_point(|start| *start <= cycle) {
                    0 => cycle,
                    behind => stretches[behind - 1],
                };
                Moment::Variable { index, cycle, begins }
            }
        };
        let mut leaves = Vec::new();
        constraint.leaves(&mut |leaf| leaves.push(place(leaf)));
        for moment in leaves {
            self.moment(moment);
        }
        let terms = &self.terms;
        let encoded = encode(&mut self.pool, constraint, &mut |_, leaf| terms[&place(leaf)]);
        self.stretches = stretches;
        let encoded = encoded.ok()?;
        let fault = self.pool.any(encoded.faults.iter().map(|fault| fault.condition));
        let fine = self.pool.not(fault);
        Some(self.pool.and(encoded.value, fine))
    }

    /// Hands everything to a solver; `parts` can then be asked for together.
    pub(super) fn session(&self, parts: &[Term], effort: Effort) -> Session {
        let mut blaster = Blaster::new(&self.pool);
        blaster.blast(parts.iter().chain(&self.facts).chain(self.terms.values()).copied());
        let words: BTreeMap<Term, Vec<crate::logic::aig::Lit>> = parts
            .iter()
            .chain(&self.facts)
            .chain(self.terms.values())
            .map(|t| (*t, blaster.word(*t).to_vec()))
            .collect();
        let aig = blaster.finish();
        let mut solver = Cadical::default();
        solver.set_conflicts(Some(effort.conflicts));
        let mut encoder = Encoder::default();
        let mut literals = BTreeMap::new();
        for (term, word) in words {
            let word: Vec<i32> = word.into_iter().map(|lit| encoder.encode(&aig, lit, &mut solver)).collect();
            literals.insert(term, word);
        }
        for fact in &self.facts {
            solver.add_clause(&literals[fact][..1]);
        }
        let cost = literals.values().map(Vec::len).sum::<usize>() as u64;
        Session { solver, literals, misses: effort.misses, work: effort.work, cost }
    }
}

/// How long a session may think. It is counted in conflicts and not in seconds: what is found must not depend on the machine.
#[derive(Clone, Copy, Debug)]
pub(super) struct Effort {
    /// The most conflicts of a question.
    pub(super) conflicts: u32,
    /// After so many questions that took more, no more are answered.
    pub(super) misses: u32,
    /// How many literals are asked about in all: every question costs those of the whole puzzle.
    pub(super) work: u64,
}

/// A solver that knows a puzzle.
pub(super) struct Session {
    solver: Cadical,
    literals: BTreeMap<Term, Vec<i32>>,
    misses: u32,
    work: u64,
    cost: u64,
}

impl Session {
    /// Whether some values satisfy all of `parts`, and of the terms the bits that are said; `None` where that was not
    /// decided with the effort that is allowed.
    pub(super) fn ask(&mut self, parts: &[Term], bits: &[i32]) -> Option<bool> {
        if self.misses == 0 || self.work < self.cost {
            return None;
        }
        self.work -= self.cost;
        let assumptions: Vec<i32> =
            parts.iter().map(|part| self.literals[part][0]).chain(bits.iter().copied()).collect();
        let answer = self.solver.solve(&assumptions);
        self.misses -= u32::from(answer.is_none());
        answer
    }

    /// Whether a part was needed for the last answer, which was no.
    pub(super) fn needed(&self, part: Term) -> bool {
        self.solver.failed(self.literals[&part][0])
    }

    /// The literals of a term's bits, the lowest first.
    pub(super) fn bits(&self, term: Term) -> &[i32] {
        &self.literals[&term]
    }

    /// The literals of all terms' bits that are true in the last model.
    pub(super) fn model(&self) -> BTreeSet<i32> {
        let bits = self.literals.values().flatten();
        bits.map(|bit| if self.solver.value(*bit) { *bit } else { -*bit }).collect()
    }

    /// The value of a term in the last model.
    pub(super) fn value(&self, term: Term) -> u64 {
        let bits = self.bits(term).iter().enumerate();
        bits.map(|(at, lit)| u64::from(self.solver.value(*lit)) << at).sum()
    }
}

/// A value as a literal.
#[must_use]
pub fn literal(scalar: Scalar, labels: &[(u64, String)], bits: u64) -> String {
    show::literal(&Kind { scalar, labels: labels.to_vec() }, bits)
}
