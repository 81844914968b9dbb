//! Evidence: formats for pipelines, allowances, baseline and gate, records and their store.

mod bundle;
mod diff;
mod formats;
mod outside;
mod policy;
mod records;
mod report;
mod samples;
mod trace;
mod walk;

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use tempfile::TempDir;

/// The tool, in a world without the surroundings of this run.
pub(crate) fn rungbook() -> Command {
    let mut command = Command::cargo_bin("rungbook").expect("the binary of this package");
    command.env("SOURCE_DATE_EPOCH", "1795305600").env("RUNGBOOK_AUTHOR", "A. Tester").env_remove("NO_COLOR");
    command
}

/// How many cases a property is tried on; more with `RUNGBOOK_CASES`.
pub(crate) fn cases(usual: u32) -> u32 {
    std::env::var("RUNGBOOK_CASES").ok().and_then(|value| value.parse().ok()).unwrap_or(usual)
}

/// A folder with `files`.
pub(crate) fn tree(files: &[(&str, &str)]) -> TempDir {
    let dir = TempDir::new().expect("a folder");
    for (path, text) in files {
        write(dir.path(), path, text);
    }
    dir
}

pub(crate) fn write(dir: &Path, path: &str, text: &str) {
    let path = dir.join(path);
    fs::create_dir_all(path.parent().expect("below the folder")).expect("a folder");
    fs::write(path, text).expect("a file");
}

pub(crate) fn stdout(command: &mut Command) -> String {
    String::from_utf8(command.output().expect("it runs").stdout).expect("UTF-8")
}

/// Says which part of `json` a schema refuses.
pub(crate) fn validate(schema: &str, json: &serde_json::Value) {
    let schema = serde_json::from_str(schema).expect("the schema is JSON");
    let validator = jsonschema::validator_for(&schema).expect("a schema");
    let errors: Vec<String> =
        validator.iter_errors(json).map(|error| format!("{}: {error}", error.instance_path())).collect();
    assert!(errors.is_empty(), "{}", errors.join("\n"));
}
