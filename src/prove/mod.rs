//! Decides whether a block conforms to its table: obligations, engines, verdicts, certificates.
//!
//! Engines decide properties of transition systems bit by bit; each answer brings its evidence, an inductive invariant or a
//! run. None knows another; the portfolio shares the time over them.

pub mod bmc;
pub mod cover;
pub mod decide;
pub mod engine;
pub mod ic3;
pub mod induction;
pub mod interpolation;
mod meeting;
pub mod mine;
pub mod options;
pub mod portfolio;
pub mod product;
pub mod simulate;
pub mod strict;
pub mod verdict;

mod asker;
mod cdcl;
mod encode;
mod problem;
mod reduce;
mod unroll;
mod witness;
