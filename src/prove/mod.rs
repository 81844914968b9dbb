//! Decides whether a block conforms to its table: obligations, engines, verdicts, certificates.

pub mod options;
pub mod verdict;
