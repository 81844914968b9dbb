//! Book to bytes.

#[cfg(feature = "pdf")]
pub mod pdf;
