//! Decides whether a block conforms to its table: obligations, engines, verdicts, certificates.
//!
//! Engines decide properties of transition systems bit by bit; each answer brings its evidence, an inductive invariant or a
//! run. None knows another; the portfolio shares the time over them.

pub mod bmc;
pub mod engine;
pub mod ic3;
pub mod decide;
mod meeting;
pub mod mine;
pub mod options;
pub mod product;
pub mod induction;
pub mod mine;
pub mod options;
pub mod portfolio;
pub mod simulate;
pub mod verdict;

mod asker;
mod cdcl;
mod encode;
mod problem;
mod reduce;
mod unroll;
