//! A block as a machine that runs: elaborated from the catalogue into a typed program over flat memory, which the
//! interpreter runs on values and the translator turns into a transition system over terms. Two meanings that must agree.

pub mod chart;
pub mod elaborate;
pub mod fixed;
pub mod interpret;
pub mod program;
pub mod standard;
pub mod trace;
pub mod translate;
