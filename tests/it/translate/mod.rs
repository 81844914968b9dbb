//! The two meanings of expressions and programs against each other: on values and as terms.

mod agree;
mod choices;
mod expressions;
mod layout;
mod programs;
mod statements;
