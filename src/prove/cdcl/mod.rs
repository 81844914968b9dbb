//! A small conflict-driven clause-learning solver for the engines that ask tens of thousands of tiny questions about
//! one circuit.
//!
//! After MiniSat (Eén and Sörensson, SAT 2003), with two things that a general solver does not have, both from GipSAT
//! (Su, Yang, Ci, Bu, Huang, "Deeply optimizing the SAT solver for the IC3 algorithm", CAV 2025):
//!
//! * a question names its **domain**, the variables that it is about; nothing else is decided, and clauses that lead
//!   out of it are passed over. It must be closed: with a gate its operands, with a clause that is no gate all its
//!   variables. What lies outside is then a function of what lies inside and cannot spoil an answer;
//! * a question may bring one **temporary clause**. It and all that was learnt from it are gone afterwards, so no
//!   activation variables pile up and the solver is never restarted.
//!
//! Left out: preprocessing, and the bucket queue of the paper. Proofs are kept only where an interpolant is wanted; there the
//! last variables are decided first, and as true, which was found to give interpolants that lead further. Limits are counted, not timed, so that the same
//! questions always get the same answers (the clock only ends everything); `ticks` is the measure of work that everything above shares.

mod clauses;
mod heap;
mod proof;
mod search;
#[cfg(test)]
mod tests;

use crate::logic::aig::Lit;
use crate::logic::sat::Stop;
use heap::Heap;
pub(crate) use proof::Part;

/// No clause.
const NONE: u32 = u32::MAX;

/// A clause that watches a literal, and another literal of it that often is true already.
#[derive(Clone, Copy, Debug)]
struct Watch {
    clause: u32,
    blocker: Lit,
}

/// The solver. Literals are those of the graph: a node's number is its variable's.
#[derive(Clone, Debug, Default)]
pub(crate) struct Solver {
    arena: Vec<u32>,
    originals: Vec<u32>,
    learnts: Vec<u32>,
    wasted: usize,
    watches: Vec<Vec<Watch>>,
    values: Vec<i8>,
    level: Vec<u32>,
    reason: Vec<u32>,
    trail: Vec<Lit>,
    levels: Vec<usize>,
    head: usize,
    settled: usize,
    activity: Vec<f64>,
    step: f64,
    phase: Vec<bool>,
    heap: Heap,
    inside: Vec<bool>,
    confined: bool,
    seen: Vec<bool>,
    stamps: Vec<u32>,
    stamp: u32,
    failed: Vec<Lit>,
    broken: bool,
    guard: Option<u32>,
    guarded: Vec<u32>,
    most_learnts: usize,
    log: Option<Box<proof::Log>>,
    /// When to give up at once.
    pub(crate) stop: Stop,
    look: u64,
    /// Work done so far.
    pub(crate) ticks: u64,
}

impl Solver {
    /// An empty solver.
    pub(crate) fn new() -> Self {
        Self { step: 1.0, most_learnts: 3000, ..Self::default() }
    }

    /// A new variable.
    pub(crate) fn variable(&mut self) -> u32 {
        let var = self.level.len() as u32;
        self.watches.push(Vec::new());
        self.watches.push(Vec::new());
        self.values.extend([0, 0]);
        self.level.push(0);
        self.reason.push(NONE);
        self.activity.push(0.0);
        self.phase.push(self.log.is_some());
        self.heap.grow();
        self.inside.push(false);
        self.seen.push(false);
        self.stamps.push(0);
        var
    }

    /// Makes sure that the first `count` variables exist.
    pub(crate) fn reserve(&mut self, count: usize) {
        while self.level.len() < count {
            self.variable();
        }
        self.stamps.resize(self.level.len() + 1, 0);
    }

    /// What it takes in memory, roughly, in bytes.
    pub(crate) fn bytes(&self) -> usize {
        let log = self.log.as_ref().map_or(0, |log| log.bytes());
        log + self.arena.capacity() * 4 + self.level.len() * 120 + self.originals.len() * 32 + self.learnts.len() * 32
    }

    /// Whether the clauses alone contradict each other.
    #[cfg(test)]
    pub(crate) fn is_broken(&self) -> bool {
        self.broken
    }

    /// Adds a clause for good.
    pub(crate) fn add(&mut self, clause: &[Lit]) {
        self.back_to(0);
        self.drop_guarded();
        if self.broken {
            return;
        }
        let mut lits: Vec<Lit> = clause.iter().copied().filter(|&l| self.value_of(l) >= 0).collect();
        lits.sort_unstable();
        lits.dedup();
        if lits.iter().any(|&l| self.value_of(l) > 0) || lits.windows(2).any(|w| w[0] == !w[1]) {
            return;
        }
        match lits[..] {
            [] => self.broken = true,
            [unit] => {
                self.assign(unit, NONE);
                self.settle();
            }
            _ => {
                let clause = self.store(&lits, false, 0);
                self.originals.push(clause);
            }
        }
    }

    /// The value in the assignment that the last question was answered with.
    pub(crate) fn value(&self, lit: Lit) -> Option<bool> {
        match self.value_of(lit) {
            0 => None,
            value => Some(value > 0),
        }
    }

    /// Whether this assumption was needed for the last *no*.
    pub(crate) fn failed(&self, assumption: Lit) -> bool {
        self.failed.contains(&assumption)
    }

    /// Is there an assignment under these assumptions, with `extra` as a clause? Only `domain` is looked at, where there is one. `None` when `budget` ticks are spent or it is to stop.
    pub(crate) fn solve(
        &mut self,
        assumptions: &[Lit],
        extra: Option<&[Lit]>,
        domain: Option<&[u32]>,
        budget: u64,
    ) -> Option<bool> {
        self.back_to(0);
        self.drop_guarded();
        self.failed.clear();
        self.settle();
        if self.broken {
            return Some(false);
        }
        self.tidy();
        let mut all = Vec::with_capacity(assumptions.len() + 1);
        if let Some(extra) = extra {
            all.push(self.guard_clause(extra));
        }
        all.extend_from_slice(assumptions);
        self.enter(domain, &all);
        self.search(&all, self.ticks.saturating_add(budget))
    }

    /// Propagates what holds for good through all clauses, also those that the last domain left out.
    fn settle(&mut self) {
        self.confined = false;
        self.head = self.settled;
        let conflict = self.propagate();
        if conflict != NONE {
            self.broken = true;
            self.note_end(conflict);
        }
        self.settled = self.trail.len();
    }

    fn guard_clause(&mut self, extra: &[Lit]) -> Lit {
        let var = if let Some(var) = self.guard {
            var
        } else {
            let var = self.variable();
            self.stamps.push(0);
            self.guard = Some(var);
            var
        };
        let guard = Lit::of(var);
        let mut lits: Vec<Lit> = extra.iter().copied().filter(|&l| self.value_of(l) >= 0).collect();
        if lits.iter().any(|&l| self.value_of(l) > 0) {
            return guard;
        }
        lits.push(!guard);
        if lits.len() == 1 {
            self.assign(!guard, NONE);
        } else {
            let clause = self.store(&lits, true, 0);
            self.guarded.push(clause);
        }
        guard
    }

    fn enter(&mut self, domain: Option<&[u32]>, assumptions: &[Lit]) {
        self.heap.clear();
        match domain {
            None => {
                self.confined = false;
                let keeps_proof = self.log.is_some();
                let count = self.level.len() as u32;
                for var in (0..count).map(|var| if keeps_proof { count - 1 - var } else { var }) {
                    if self.values[2 * var as usize] == 0 {
                        self.heap.insert(var, &self.activity);
                    }
                }
            }
            Some(vars) => {
                self.confined = true;
                self.inside.fill(false);
                for &var in vars {
                    self.inside[var as usize] = true;
                    if self.values[2 * var as usize] == 0 {
                        self.heap.insert(var, &self.activity);
                    }
                }
                for lit in assumptions {
                    self.inside[lit.node() as usize] = true;
                }
            }
        }
    }

    fn value_of(&self, lit: Lit) -> i8 {
        self.values[lit.0 as usize]
    }

    fn assign(&mut self, lit: Lit, reason: u32) {
        let var = lit.node() as usize;
        self.values[lit.0 as usize] = 1;
        self.values[(!lit).0 as usize] = -1;
        self.level[var] = self.levels.len() as u32;
        self.reason[var] = reason;
        self.trail.push(lit);
    }

    fn back_to(&mut self, level: usize) {
        if self.levels.len() <= level {
            return;
        }
        let start = self.levels[level];
        for at in (start..self.trail.len()).rev() {
            let lit = self.trail[at];
            let var = lit.node();
            self.values[lit.0 as usize] = 0;
            self.values[(!lit).0 as usize] = 0;
            self.phase[var as usize] = !lit.inverted();
            if !self.confined || self.inside[var as usize] {
                self.heap.insert(var, &self.activity);
            }
        }
        self.trail.truncate(start);
        self.levels.truncate(level);
        self.head = start;
    }
}
