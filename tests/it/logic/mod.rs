//! The room of terms, graphs and solvers, seen from outside.

mod simplified;
mod system;
mod written;
