//! Systems and models as files for other tools: BTOR2 and SMV by words, AIGER by bits.

mod aiger;
mod btor2;
mod lower;
mod names;
mod smv;

pub use aiger::{ascii, binary};
pub use btor2::btor2;
pub use lower::lower;
pub use names::Names;
pub use smv::smv;
