//! What a release lets pass: allowances in the source, a baseline of old findings, a gate of numbers.
//!
//! The three do not know each other. An allowance is a decision about one finding, with a reason; a baseline is a
//! photograph of the day on which a team began; the gate is the bar that a release has to clear.

pub mod allow;
pub mod baseline;
pub mod gate;
