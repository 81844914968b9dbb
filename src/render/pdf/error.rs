//! What can go wrong while a PDF is made.

use std::fmt;

/// Why there is no PDF.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Error {
    /// The font with this index among the user's is none.
    Font(usize),
    /// The book could not be handed over.
    Data(String),
    /// The standards cannot be combined.
    Standard(String),
    /// A template failed: place and message of each error.
    Template(Vec<String>),
    /// The document does not meet the standard that was asked for.
    Export(Vec<String>),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Font(index) => write!(f, "font file {} is not a font", index + 1),
            Self::Data(message) => write!(f, "the book cannot be handed to the typesetter: {message}"),
            Self::Standard(message) => write!(f, "{message}"),
            Self::Template(list) => write!(f, "a PDF template failed: {}", list.join("; ")),
            Self::Export(list) => write!(f, "the PDF cannot be written: {}", list.join("; ")),
        }
    }
}

impl std::error::Error for Error {}
