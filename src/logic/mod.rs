//! Typed bit-vector terms, their evaluation and simplification; the transition system over them; and-inverter graphs,
//! bit-blasting, and the SAT solvers behind one trait. It knows neither tables nor programs.

pub mod aig;
pub mod blast;
pub mod build;
pub mod certificate;
pub mod cone;
pub mod eval;
pub mod hash;
pub mod read;
pub mod sat;
pub mod simplify;
pub mod simulate;
pub mod system;
pub mod term;
pub mod value;
pub mod write;
