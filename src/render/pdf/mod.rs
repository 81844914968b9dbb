//! The manual as a PDF, set by typst.
