//! The world as a value: a tree of files that can be listed and read.
//!
//! Paths are relative to the root of the tree, with `/` between their parts; the root itself is the empty path.

use std::fmt;

/// Something that can list folders and read files below one root.
pub trait FileSystem: Sync {
    /// What lies in `folder`, in any order.
    ///
    /// # Errors
    /// If the folder is gone or may not be listed.
    fn entries(&self, folder: &str) -> Result<Vec<Entry>, Failure>;

    /// The bytes of the file at `path`.
    ///
    /// # Errors
    /// If the file is gone, may not be read, or holds more than `limit` bytes.
    fn read(&self, path: &str, limit: u64) -> Result<Vec<u8>, Failure>;
}

/// One thing in a folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Its name, without the folder's path.
    pub name: String,
    /// What it is.
    pub kind: EntryKind,
}

/// What an entry of a folder is.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EntryKind {
    /// A file of so many bytes.
    File(u64),
    /// A folder.
    Folder,
    /// A link to a folder outside the tree, which is walked as if it lay here; the text is the folder's identity.
    OutsideFolder(String),
    /// A link to a file or folder that lies inside the tree and is found there.
    InsideLink,
    /// A link to a folder that holds the link itself.
    Loop,
    /// Something that cannot be read, and why.
    Odd(&'static str),
}

/// Why a file or a folder could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// It holds more bytes than the limit.
    TooLarge,
    /// The system said no; a few words in lower case, the same on every system.
    Denied(String),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLarge => f.write_str("larger than the limit"),
            Self::Denied(reason) => f.write_str(reason),
        }
    }
}

impl std::error::Error for Failure {}
