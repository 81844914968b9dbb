//! The disk, with links of every kind.

#![cfg(unix)]

use std::fs;
use std::os::unix::fs::symlink;

use rungbook::source::{Disk, Options, Tree, read_tree};

use super::codes_of;

fn read(root: &std::path::Path) -> Tree {
    read_tree(&Disk::new(root).expect("the folder is there"), &Options::default(), &|_| {})
}

fn unit_paths(tree: &Tree) -> Vec<&str> {
    tree.units.iter().map(|unit| tree.files.get(unit.file).path.as_str()).collect()
}

#[test]
#[expect(clippy::disallowed_methods, reason = "the test makes the folder that it reads")]
fn links_are_followed_once_and_loops_are_told() {
    let outside = tempfile::tempdir().unwrap();
    fs::create_dir_all(outside.path().join("deep")).unwrap();
    fs::write(outside.path().join("deep/o.st"), "O").unwrap();
    let root = tempfile::tempdir().unwrap();
    let at = |name: &str| root.path().join(name);
    fs::create_dir_all(at("a/b")).unwrap();
    fs::write(at("a/x.st"), "X").unwrap();
    symlink(root.path(), at("a/b/loop")).unwrap();
    symlink(at("a/self"), at("a/self")).unwrap();
    symlink("x.st", at("a/twin.st")).unwrap();
    symlink(at("a"), at("again")).unwrap();
    symlink(outside.path(), at("out1")).unwrap();
    symlink(outside.path().join("deep"), at("out2")).unwrap();
    symlink(outside.path().join("deep/o.st"), at("single.st")).unwrap();
    symlink(at("nowhere"), at("dangling.st")).unwrap();
    let tree = read(root.path());
    assert_eq!(unit_paths(&tree), ["a/x.st", "out1/deep/o.st", "single.st"]);
    assert_eq!(codes_of(&tree.findings), ["link-loop", "link-loop", "unreadable-path"]);
    let skipped: Vec<_> = tree.skipped.iter().map(|skipped| skipped.path.as_str()).collect();
    assert_eq!(skipped, ["a/b/loop", "a/self", "a/twin.st", "again", "dangling.st", "out2/"]);
}

#[test]
#[expect(clippy::disallowed_methods, reason = "the test makes the folder that it reads")]
fn names_that_are_strange_or_no_unicode() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let root = tempfile::tempdir().unwrap();
    fs::write(root.path().join("it's \"odd\" ..st.st"), "A").unwrap();
    fs::write(root.path().join("back\\slash.st"), "A").unwrap();
    let raw = root.path().join(OsStr::from_bytes(b"caf\xE9.st"));
    let allowed = fs::write(raw, "A").is_ok();
    let tree = read(root.path());
    assert_eq!(unit_paths(&tree), ["back\\slash.st", "it's \"odd\" ..st.st"]);
    assert_eq!(tree.findings.len(), usize::from(allowed));
}
