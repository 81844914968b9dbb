//! The machine.

mod chart;
mod drawn;
mod standard;
