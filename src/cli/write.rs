//! Writing: the only place where the disk changes.
#![expect(clippy::disallowed_methods, reason = "cli is the only writer")]

use std::fs;
use std::path::{Component, Path};

use super::Failure;

/// Writes `bytes` to `path`, with the folders above it.
pub(crate) fn file(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    let failure = |error: std::io::Error| Failure(format!("cannot write `{}`: {error}", path.display()));
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(failure)?;
    }
    fs::write(path, bytes).map_err(failure)
}

/// Writes `files`, paths below `folder`, after taking away what an earlier run left there.
///
/// A folder that is not empty and was not written by this tool is left alone and refused.
pub(crate) fn folder<'a>(folder: &Path, files: impl Iterator<Item = (&'a str, &'a [u8])>) -> Result<(), Failure> {
    const MARK: &str = ".rungbook";
    let failure = |error: std::io::Error| Failure(format!("cannot write `{}`: {error}", folder.display()));
    if folder.is_dir() {
        let empty = fs::read_dir(folder).map_err(failure)?.next().is_none();
        if !empty && !folder.join(MARK).is_file() {
            let message = format!("`{}` is not empty and was not written by rungbook", folder.display());
            return Err(Failure(format!("{message}; choose another folder with `-o`, or empty it")));
        }
        fs::remove_dir_all(folder).map_err(failure)?;
    }
    file(&folder.join(MARK), b"Written by rungbook; the next build replaces this folder.\n")?;
    for (path, bytes) in files {
        let inside = Path::new(path).components().all(|part| matches!(part, Component::Normal(_)));
        if !inside {
            return Err(Failure(format!("a page would be written outside of the site: `{path}`")));
        }
        file(&folder.join(path), bytes)?;
    }
    Ok(())
}

/// Writes `bytes` to the new file `path`, which only its owner may read.
pub(crate) fn secret(path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    use std::io::Write;
    let failure = |error: std::io::Error| Failure(format!("cannot write `{}`: {error}", path.display()));
    let mut options = fs::OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options.open(path).and_then(|mut file| file.write_all(bytes)).map_err(failure)
}
