//! The two meanings of expressions and programs against each other: on values and as terms.

mod agree;
mod choices;
mod compiled;
mod corpus;
mod expressions;
mod layout;
mod programs;
mod render;
mod sources;
mod statements;
mod system;
