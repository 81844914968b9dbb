//! What a proof may cost, and what it is asked for.

use std::time::Duration;

/// Options of the prover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The time for one table.
    pub timeout: Duration,
    /// The memory for one table in MiB; beyond it, the verdict is *bounded*.
    pub memory: u64,
    /// Whether every table is asked for strict conformance, also where it does not say so itself.
    pub strict: bool,
    /// How many threads one table gets, at most two of which are of use; verdict and certificate do not depend on it.
    pub threads: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self { timeout: Duration::from_secs(60), memory: 4096, strict: false, threads: 1 }
    }
}
