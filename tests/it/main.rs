//! Integration tests, one module a room.

mod html;
mod pdf;
mod source;
mod syntax;
mod table;
