//! The tree that a command works on: its folder, its settings, and what was read of it.
#![expect(clippy::disallowed_methods, reason = "cli reads the configuration")]

use std::fs;
use std::path::{Path, PathBuf};

use super::Failure;
use super::args::TreeArgs;
use super::report::progress::Progress;
use crate::config::{ConfigFile, Settings};
use crate::pipeline::{self, Project};
use crate::source::{Disk, FileSystem};

/// Settings from `--config`, or from `rungbook.toml` in the folder, or the defaults.
pub(crate) fn settings(dir: &Path, config: Option<&Path>) -> Result<Settings, Failure> {
    let default = dir.join("rungbook.toml");
    let path = config.map_or_else(|| default.is_file().then_some(default), |path| Some(path.to_owned()));
    let Some(path) = path else {
        return Settings::new(ConfigFile::default()).map_err(|error| Failure(error.message));
    };
    let text = fs::read_to_string(&path).map_err(|error| Failure(format!("`{}`: {error}", path.display())))?;
    let file = ConfigFile::parse(&text).and_then(Settings::new);
    file.map_err(|error| Failure(format!("`{}`: {}", path.display(), error.message)))
}

/// The folder, if it is one.
pub(crate) fn folder(dir: &Path) -> Result<PathBuf, Failure> {
    let there = dir.canonicalize().map_err(|error| Failure(format!("`{}`: {error}", dir.display())))?;
    if !there.is_dir() {
        return Err(Failure(format!("`{}` is not a folder", dir.display())));
    }
    Ok(there)
}

/// Reads the tree of `args`.
pub(crate) fn read(
    args: &TreeArgs,
    output: Option<&Path>,
    progress: &Progress,
) -> Result<(Project, Settings), Failure> {
    let dir = folder(&args.dir)?;
    let mut settings = settings(&dir, args.config.as_deref())?;
    if let Some(inside) = output.and_then(|output| output.strip_prefix(&dir).ok()) {
        settings.leave_out(&inside.to_string_lossy());
    }
    let name = dir.file_name().map_or_else(|| "manual".to_owned(), |name| name.to_string_lossy().into_owned());
    let fs = Disk::new(&dir).map_err(|error| Failure(format!("`{}`: {error}", dir.display())))?;
    let today = super::stamp::stamp(&dir).date;
    Ok((read_from(&fs, &name, &settings, &today, progress), settings))
}

/// Reads the tree of `fs`, with what stands beside it and what its source allows on the day `today`.
pub(crate) fn read_from(
    fs: &dyn FileSystem,
    name: &str,
    settings: &Settings,
    today: &str,
    progress: &Progress,
) -> Project {
    let mut project = pipeline::read(fs, name, settings, &|event| progress.event(event));
    pipeline::read_beside(fs, settings, &mut project);
    pipeline::allow(&mut project, settings, today);
    project
}
