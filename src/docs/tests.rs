//! Tests of the room as a whole, on catalogues made by hand.

mod conventions;
mod links;
mod pages;
mod placement;
mod properties;
mod sample;
