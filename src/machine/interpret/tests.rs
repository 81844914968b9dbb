//! Programs of a few statements, made by hand.

mod build;
mod control;
mod memory;
mod strings;
