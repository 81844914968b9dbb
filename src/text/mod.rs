//! Files, places in them, and the way back from unwrapped text to the file it came from.
//!
//! Everything here is vocabulary that every other room shares: a [`Span`] of bytes, a
//! [`LineIndex`], the table of [`Files`], the result of decoding bytes, and the [`Unit`] that a
//! file becomes once its container (XML, an export, plain text) has been taken off.

pub mod decode;
pub mod files;
pub mod line_index;
pub mod near;
pub mod span;
pub mod unit;

pub use decode::{Decoded, Encoding};
pub use files::{FileId, Files, SourceFile};
pub use line_index::{LineColumn, LineIndex};
pub use span::{Place, Span};
pub use unit::{Body, Fragment, Language, Object, ObjectKind, Run, SpanMap, Unit, Vendor};
