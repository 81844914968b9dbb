//! Generalized test tables: read, bound, printed.
