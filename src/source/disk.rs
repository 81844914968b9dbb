//! The disk below one folder.
//!
//! Links: a link to a file outside the tree is that file; a link to a folder outside is walked, once;
//! a link into the tree is not followed, because what it leads to is found at its own place. So a
//! walk ends, and no block is documented twice.

use std::fs::{self, DirEntry};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use super::{Entry, EntryKind, Failure, FileSystem};

/// The files below a folder of the disk.
#[derive(Clone, Debug)]
pub struct Disk {
    root: PathBuf,
    canonical: PathBuf,
}

impl Disk {
    /// The tree below `root`.
    ///
    /// # Errors
    /// If `root` is no folder that can be found.
    pub fn new(root: impl Into<PathBuf>) -> Result<Self, Failure> {
        let root = root.into();
        let canonical = root.canonicalize().map_err(|error| failure(&error))?;
        if !canonical.is_dir() {
            return Err(Failure::Denied("not a folder".to_owned()));
        }
        Ok(Self { root, canonical })
    }

    /// The folder, as it was given.
    #[must_use]
    pub fn root(&self) -> &Path {
        &self.root
    }

    fn kind(&self, entry: &DirEntry) -> Result<EntryKind, Failure> {
        let path = entry.path();
        let own = entry.file_type().map_err(|error| failure(&error))?;
        if own.is_dir() {
            return Ok(EntryKind::Folder);
        }
        if !own.is_symlink() {
            let size = entry.metadata().map_err(|error| failure(&error))?.len();
            return Ok(if own.is_file() {
                EntryKind::File(size)
            } else {
                EntryKind::Odd("neither a file nor a folder")
            });
        }
        self.link(&path)
    }

    fn link(&self, path: &Path) -> Result<EntryKind, Failure> {
        let target = match path.canonicalize() {
            Ok(target) => target,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Ok(EntryKind::Odd("a link that leads nowhere"));
            }
            Err(_) => return Ok(EntryKind::Loop),
        };
        let about = fs::metadata(&target).map_err(|error| failure(&error))?;
        let holds_the_link = path
            .parent()
            .and_then(|folder| folder.canonicalize().ok())
            .is_some_and(|folder| folder.starts_with(&target));
        Ok(match () {
            () if about.is_dir() && holds_the_link => EntryKind::Loop,
            () if target.starts_with(&self.canonical) => EntryKind::InsideLink,
            () if about.is_dir() => EntryKind::OutsideFolder(target.to_string_lossy().into_owned()),
            () if about.is_file() => EntryKind::File(about.len()),
            () => EntryKind::Odd("neither a file nor a folder"),
        })
    }
}

impl FileSystem for Disk {
    #[expect(clippy::disallowed_methods, reason = "this is the one reader of the disk")]
    fn entries(&self, folder: &str) -> Result<Vec<Entry>, Failure> {
        let mut entries = Vec::new();
        for entry in fs::read_dir(self.root.join(folder)).map_err(|error| failure(&error))? {
            let Ok(entry) = entry else { continue };
            let name = entry.file_name();
            let Some(unicode) = name.to_str() else {
                let name = name.to_string_lossy().into_owned();
                entries.push(Entry { name, kind: EntryKind::Odd("its name is not Unicode") });
                continue;
            };
            let kind = self.kind(&entry).unwrap_or(EntryKind::Odd("gone while the tree was read"));
            entries.push(Entry { name: unicode.to_owned(), kind });
        }
        Ok(entries)
    }

    #[expect(clippy::disallowed_methods, reason = "this is the one reader of the disk")]
    fn read(&self, path: &str, limit: u64) -> Result<Vec<u8>, Failure> {
        let file = fs::File::open(self.root.join(path)).map_err(|error| failure(&error))?;
        let size = file.metadata().map_or(0, |about| about.len());
        if size > limit {
            return Err(Failure::TooLarge);
        }
        let mut bytes = Vec::with_capacity(usize::try_from(size).unwrap_or(0) + 1);
        // One byte more than the limit tells a file that grew meanwhile.
        file.take(limit.saturating_add(1)).read_to_end(&mut bytes).map_err(|error| failure(&error))?;
        if bytes.len() as u64 > limit { Err(Failure::TooLarge) } else { Ok(bytes) }
    }
}

/// The kind alone: the system's own message differs between systems and languages.
fn failure(error: &io::Error) -> Failure {
    Failure::Denied(error.kind().to_string())
}
