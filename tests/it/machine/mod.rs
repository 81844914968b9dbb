//! The machine.

mod standard;
