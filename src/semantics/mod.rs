//! What the types and operators of IEC 61131-3 mean, given twice: on values and as bit-vector terms. Cells of tables and
//! bodies of blocks are both made of these typed expressions, so that a table and a block cannot mean different sums.

pub mod encode;
pub mod eval;
pub mod expr;
pub mod fixed;
pub mod scalar;
pub mod show;
pub mod typing;
