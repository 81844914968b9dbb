//! Generalized test tables: read, bound, printed, unrolled to automata.
//!
//! A table says, row by row, what the environment of a block does (its input columns, assumptions) and what the block
//! answers (its output columns, assertions), for how long. After Weigl et al., *Generalized Test Tables* (INDIN 2017)
//! and Beckert et al., *Generalised Test Tables* (iFM 2017).

pub mod attach;
pub mod automaton;
pub mod bind;
pub mod cell;
pub mod codes;
pub mod decide;
pub mod duration;
pub mod eval;
pub mod explain;
pub mod form;
pub mod instances;
pub mod layout;
pub mod legend;
pub mod lint;
pub mod model;
pub mod piece;
pub mod read;
pub mod run;
pub mod write;

pub use attach::{AttachedTable, TableError};
pub use model::Table;
pub use piece::Piece;
