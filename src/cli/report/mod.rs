//! How findings and totals are printed.

pub(crate) mod json;
pub(crate) mod progress;
pub(crate) mod summary;
pub(crate) mod text;
