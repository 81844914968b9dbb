//! Believes nothing of what `prove/` says: checks certificates by its own encoding and another solver, checks each conclusion
//! of that solver by unit propagation, and replays runs on the interpreter and the game of the table.
//!
//! Of `logic/` it uses the terms, the system over them and the certificate's definition, not the simplifier, not the
//! bit-blaster, not the solver. What it trusts, therefore: the translation of block and table into one system, which is
//! tested against the interpreter and the game, and this room.

mod cases;
mod cnf;
mod float;
mod gates;
pub mod invariant;
pub mod lasso;
pub mod replay;
mod rup;
pub mod strict;
