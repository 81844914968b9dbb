//! Integration tests, one module a room.

mod html;
#[cfg(feature = "pdf")]
mod pdf;
mod source;
mod syntax;
mod table;
