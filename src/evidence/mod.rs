//! Evidence: what was claimed of which source, proven how, by which tool, in a form that can be checked again.
//!
//! A [`record::Record`] is plain data that the pipeline fills. Everything here is a function over values and bytes: the
//! store, the release bundle, the gate and the comparison of two releases know neither disk nor clock.

pub mod bundle;
pub mod cache;
pub mod changelog;
pub mod codes;
pub mod coverage;
pub mod diff;
pub mod digest;
pub mod policy;
pub mod record;
pub mod report;
pub mod requirements;
pub mod results;
pub mod snapshot;
pub mod trace;
