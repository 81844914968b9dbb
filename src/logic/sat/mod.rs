//! SAT solvers behind one trait, incremental, with assumptions, limits and interruption: CaDiCaL and BatSat, which share
//! no code. Literals are those of DIMACS: a variable's number from 1, negative where complemented.

pub mod bat;
pub mod cadi;
pub mod encode;
mod stop;
#[cfg(test)]
mod tests;

pub use stop::Stop;

/// An incremental solver.
pub trait Solver {
    /// A new variable.
    fn new_var(&mut self) -> i32;

    /// Adds a clause over variables made by [`Solver::new_var`], for good.
    fn add_clause(&mut self, clause: &[i32]);

    /// Whether the clauses have a model in which all assumptions are true; `None` where a limit came first.
    fn solve(&mut self, assumptions: &[i32]) -> Option<bool>;

    /// The value of a literal in the model of the last call of [`Solver::solve`], which gave `Some(true)`.
    fn value(&self, lit: i32) -> bool;

    /// Whether the assumption was needed in the last call of [`Solver::solve`], which gave `Some(false)`.
    fn failed(&self, lit: i32) -> bool;

    /// When to give up, from now on.
    fn set_stop(&mut self, stop: Stop);

    /// How many conflicts a call of [`Solver::solve`] may have, from now on; `None` for as many as it takes.
    fn set_conflicts(&mut self, limit: Option<u32>);
}
