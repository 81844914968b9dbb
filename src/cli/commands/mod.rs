//! The commands, one a file.

pub(crate) mod build;
pub(crate) mod check;
pub(crate) mod diff;
pub(crate) mod evidence;
pub(crate) mod explain;
pub(crate) mod export;
pub(crate) mod init;
pub(crate) mod print;
pub(crate) mod run;
pub(crate) mod table;
pub(crate) mod verify;
