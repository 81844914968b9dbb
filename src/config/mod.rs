//! `rungbook.toml` to each room's own options.
//!
//! [`file::ConfigFile`] is what was typed; [`Settings`] is what it means, with the defaults filled
//! in. Nobody below this room imports it.

pub mod file;
pub mod gate;
#[cfg(feature = "pdf")]
mod pdf;
pub mod settings;
pub mod tables;
pub mod template;
pub mod verify;

pub use file::ConfigFile;
pub use settings::{Levels, Settings};
pub use template::TEMPLATE;
