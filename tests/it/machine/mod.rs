//! The machine.

mod chart;
mod standard;
