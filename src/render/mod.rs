//! Book to bytes.
