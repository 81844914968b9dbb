//! The standard function blocks as a library: complete, readable, documented, with tables.

use std::fs;
use std::path::PathBuf;

use assert_cmd::Command;
use rungbook::machine::standard;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("src/machine/standard")
}

#[test]
fn every_file_of_the_folder_is_listed() {
    let mut names: Vec<String> = fs::read_dir(folder())
        .expect("the folder")
        .flatten()
        .map(|entry| entry.path().file_stem().expect("a name").to_string_lossy().into_owned())
        .collect();
    names.sort();
    let mut listed: Vec<_> = standard::SOURCES.iter().map(|(name, _)| (*name).to_owned()).collect();
    listed.sort();
    assert_eq!(names, listed);
    for (name, text) in standard::SOURCES {
        assert!(text.contains(&format!("\nFUNCTION_BLOCK {name}\n")), "{name}");
        assert!(text.contains("\n@gtt "), "{name} has no table");
    }
    assert!(standard::source("ton").is_some_and(|text| text.contains(standard::ELAPSED)));
    assert_eq!(standard::source("TONE"), None);
}

/// Whether they are verified is the prover's business.
#[test]
fn the_folder_is_a_library_without_other_findings() {
    let mut command = Command::cargo_bin("rungbook").expect("the binary of this package");
    let output = command.args(["check", "--deny", "error"]).arg(folder()).output().expect("it runs");
    assert!(output.status.success());
    let text = String::from_utf8(output.stdout).expect("UTF-8");
    let findings =
        text.lines().filter(|line| ["error[", "warning[", "info["].iter().any(|kind| line.starts_with(kind)));
    let others: Vec<_> = findings.filter(|line| !line.contains("[unverified-table]")).collect();
    assert_eq!(others, Vec::<&str>::new());
}
