//! The room of terms, graphs and solvers, seen from outside.

mod read;
mod simplified;
mod system;
mod written;
