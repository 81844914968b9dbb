//! BatSat 0.6, a solver in Rust after MiniSat 2.2 (Eén and Sörensson, *An Extensible SAT-solver*, SAT 2003).

use std::cell::Cell;

use batsat::{Callbacks, ClauseKind, Lit, SolverInterface, SolverOpts, Var, lbool};

use super::{Solver, Stop};

/// How many times BatSat asks before the clock is read.
const PATIENCE: u32 = 256;

/// Limits. BatSat asks again after it has left its search, so that a limit once reached stays reached until the next call.
#[derive(Default)]
struct Watch {
    stop: Stop,
    limit: Option<u32>,
    conflicts: u32,
    asked: Cell<u32>,
    reached: Cell<bool>,
}

impl Callbacks for Watch {
    fn on_start(&mut self) {
        self.conflicts = 0;
        self.asked.set(0);
        self.reached.set(false);
    }

    fn on_new_clause(&mut self, _: &[Lit], kind: ClauseKind) {
        self.conflicts += u32::from(kind == ClauseKind::Learnt);
    }

    fn stop(&self) -> bool {
        self.asked.set(self.asked.get().wrapping_add(1));
        if self.limit.is_some_and(|limit| self.conflicts > limit)
            || (self.asked.get().is_multiple_of(PATIENCE) && self.stop.reached())
        {
            self.reached.set(true);
        }
        self.reached.get()
    }
}

/// The solver.
pub struct BatSat {
    inner: batsat::Solver<Watch>,
    lits: Vec<Lit>,
    variables: i32,
}

impl Default for BatSat {
    fn default() -> Self {
        Self { inner: batsat::Solver::new(SolverOpts::default(), Watch::default()), lits: Vec::new(), variables: 0 }
    }
}

impl BatSat {
    fn lit(&mut self, lit: i32) -> Lit {
        let var: Var = self.inner.var_of_int(lit.unsigned_abs() - 1);
        Lit::new(var, lit > 0)
    }

    fn known(&self, lit: i32) -> Option<Lit> {
        let number = lit.unsigned_abs() - 1;
        (number < self.inner.num_vars()).then(|| Lit::new(Var::unsafe_from_idx(number), lit > 0))
    }
}

impl Solver for BatSat {
    fn new_var(&mut self) -> i32 {
        self.variables += 1;
        self.variables
    }

    fn add_clause(&mut self, clause: &[i32]) {
        let mut lits = std::mem::take(&mut self.lits);
        lits.clear();
        lits.extend(clause.iter().map(|lit| self.lit(*lit)));
        self.inner.add_clause_reuse(&mut lits);
        self.lits = lits;
    }

    fn solve(&mut self, assumptions: &[i32]) -> Option<bool> {
        if self.inner.cb().stop.reached() {
            return None;
        }
        self.inner.cb_mut().on_start();
        let lits: Vec<Lit> = assumptions.iter().map(|lit| self.lit(*lit)).collect();
        match self.inner.solve_limited(&lits) {
            answer if answer == lbool::TRUE => Some(true),
            answer if answer == lbool::FALSE => Some(false),
            _ => None,
        }
    }

    fn value(&self, lit: i32) -> bool {
        self.known(lit).map_or(lit < 0, |lit| self.inner.value_lit(lit) == lbool::TRUE)
    }

    fn failed(&self, lit: i32) -> bool {
        // BatSat keeps the final conflict as a clause, that is of complements.
        self.known(lit).is_some_and(|lit| self.inner.unsat_core_contains_lit(!lit))
    }

    fn set_stop(&mut self, stop: Stop) {
        self.inner.cb_mut().stop = stop;
    }

    fn set_conflicts(&mut self, limit: Option<u32>) {
        self.inner.cb_mut().limit = limit;
    }
}
