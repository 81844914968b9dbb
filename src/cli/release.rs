//! A release as it is named on the command line: a bundle, a folder, or a revision of git.
#![expect(clippy::disallowed_methods, reason = "cli reads bundles")]

use std::fs;
use std::io::{Cursor, Read};
use std::path::Path;
use std::process::Command;

use super::report::progress::Progress;
use super::{Failure, stamp, store, tree};
use crate::config::{ConfigFile, Settings};
use crate::evidence::bundle::archive;
use crate::evidence::snapshot::{self, Snapshot};
use crate::pipeline;
use crate::source::{Disk, FileSystem, Memory};

/// What the release `name` offers; revisions are those of the repository that holds `dir`, of that folder.
pub(crate) fn snapshot(name: &str, dir: &Path) -> Result<Snapshot, Failure> {
    let path = Path::new(name);
    if path.is_file() {
        return of_bundle(path);
    }
    if path.is_dir() {
        return of_folder(path);
    }
    of_revision(name, dir)
}

fn of_bundle(path: &Path) -> Result<Snapshot, Failure> {
    let failure = |message: String| Failure(format!("`{}`: {message}", path.display()));
    let bytes = fs::read(path).map_err(|error| failure(error.to_string()))?;
    let (files, faults) = archive::read(&bytes, &|_| 0);
    if let Some(fault) = faults.first() {
        return Err(failure(format!("{}: {}; `rungbook evidence verify` tells more", fault.part, fault.message)));
    }
    let found = files.get(snapshot::PATH).ok_or_else(|| failure("it is no bundle of evidence".to_owned()))?;
    Snapshot::parse(found).map_err(failure)
}

fn of_folder(path: &Path) -> Result<Snapshot, Failure> {
    let dir = tree::folder(path)?;
    let settings = tree::settings(&dir, None)?;
    let fs = Disk::new(&dir).map_err(|error| Failure(format!("`{}`: {error}", dir.display())))?;
    read(&fs, &dir, &settings, stamp::stamp(&dir))
}

fn of_revision(name: &str, dir: &Path) -> Result<Snapshot, Failure> {
    let dir = tree::folder(dir)?;
    let fs = revision(name, &dir)?;
    let config = fs.read("rungbook.toml", 1 << 20).ok();
    let file =
        config.map_or_else(|| Ok(ConfigFile::default()), |bytes| ConfigFile::parse(&String::from_utf8_lossy(&bytes)));
    let failure =
        |error: crate::config::file::ConfigError| Failure(format!("`rungbook.toml` of `{name}`: {}", error.message));
    let settings = file.and_then(Settings::new).map_err(failure)?;
    let stamp = pipeline::Stamp { commit: name.to_owned(), ..stamp::stamp(&dir) };
    read(&fs, &dir, &settings, stamp)
}

/// The folder as it was in a revision, through `git archive`.
fn revision(name: &str, dir: &Path) -> Result<Memory, Failure> {
    let failure = |message: String| Failure(format!("`{name}` is no bundle, no folder and no git revision: {message}"));
    if name.starts_with('-') {
        return Err(failure("it begins with `-`".to_owned()));
    }
    let output = Command::new("git").arg("-C").arg(dir).args(["archive", "--format=zip", name]).output();
    let output = output.map_err(|error| failure(format!("git does not run: {error}")))?;
    if !output.status.success() {
        return Err(failure(String::from_utf8_lossy(&output.stderr).trim().to_owned()));
    }
    let mut archive = zip::ZipArchive::new(Cursor::new(output.stdout)).map_err(|error| failure(error.to_string()))?;
    let mut memory = Memory::new();
    for index in 0..archive.len() {
        let mut file = archive.by_index(index).map_err(|error| failure(error.to_string()))?;
        if file.is_file() {
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes).map_err(|error| failure(error.to_string()))?;
            let path = file.name().to_owned();
            memory = memory.with(&path, bytes);
        }
    }
    Ok(memory)
}

/// Reads a tree. Verdicts come from the store of the folder `dir`: it knows them by what they are about.
fn read(fs: &dyn FileSystem, dir: &Path, settings: &Settings, stamp: pipeline::Stamp) -> Result<Snapshot, Failure> {
    let name = dir.file_name().map_or_else(|| "manual".to_owned(), |name| name.to_string_lossy().into_owned());
    let project = tree::read_from(fs, &name, settings, &stamp.date, &Progress::new(true));
    let records = store::known_of(fs, dir, &project, settings, &stamp);
    Ok(pipeline::snapshot::snapshot(&project, settings, &stamp, &records))
}
