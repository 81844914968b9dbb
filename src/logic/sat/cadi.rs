//! CaDiCaL 1.9 (Biere, Fleury, Pollitt and others), through the crate `cadical`, which compiles it in.

use cadical::Callbacks;

use super::{Solver, Stop};

/// How many times CaDiCaL asks before the clock is read.
const PATIENCE: u32 = 16;

struct Watch {
    stop: Stop,
    asked: u32,
}

impl Callbacks for Watch {
    fn started(&mut self) {
        self.asked = 0;
    }

    fn terminate(&mut self) -> bool {
        self.asked += 1;
        self.asked.is_multiple_of(PATIENCE) && self.stop.reached()
    }
}

/// The solver.
pub struct Cadical {
    inner: cadical::Solver<Watch>,
    variables: i32,
    conflicts: Option<u32>,
    stop: Stop,
}

impl Default for Cadical {
    fn default() -> Self {
        Self { inner: cadical::Solver::new(), variables: 0, conflicts: None, stop: Stop::default() }
    }
}

impl Solver for Cadical {
    fn new_var(&mut self) -> i32 {
        self.variables += 1;
        self.variables
    }

    fn add_clause(&mut self, clause: &[i32]) {
        self.inner.add_clause(clause.iter().copied());
    }

    fn solve(&mut self, assumptions: &[i32]) -> Option<bool> {
        if self.stop.reached() {
            return None;
        }
        if let Some(limit) = self.conflicts {
            let limit = i32::try_from(limit).unwrap_or(i32::MAX);
            self.inner.set_limit("conflicts", limit).expect("CaDiCaL knows this limit");
        }
        self.inner.solve_with(assumptions.iter().copied())
    }

    fn value(&self, lit: i32) -> bool {
        if lit.abs() > self.inner.max_variable() {
            return lit < 0;
        }
        self.inner.value(lit) == Some(true)
    }

    fn failed(&self, lit: i32) -> bool {
        self.inner.failed(lit)
    }

    fn set_stop(&mut self, stop: Stop) {
        self.stop = stop.clone();
        self.inner.set_callbacks(Some(Watch { stop, asked: 0 }));
    }

    fn set_conflicts(&mut self, limit: Option<u32>) {
        self.conflicts = limit;
    }
}
