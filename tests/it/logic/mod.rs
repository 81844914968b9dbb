//! The room of terms, graphs and solvers, seen from outside.

mod system;
mod written;
