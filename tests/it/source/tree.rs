//! Every file of a tree is accounted for, and its order does not depend on the order of the listing.

use std::sync::atomic::{AtomicUsize, Ordering};

use rungbook::source::{Disk, EntryKind, Filter, Memory, Options, Progress, read_tree};

use super::{codes_of, read};

fn paths(tree: &rungbook::source::Tree) -> Vec<&str> {
    tree.files.iter().map(|(_, file)| file.path.as_str()).collect()
}

#[test]
fn files_are_units_tables_projects_or_skipped_with_a_reason() {
    let memory = Memory::new()
        .with("FB.st", "A")
        .with("FB.gtt", "table")
        .with("FB.gtt.md", "table")
        .with("FB.gtt.xlsx", b"PK\x03\x04\0")
        .with("FB.tt.txt", "table")
        .with("readme.md", "text")
        .with("x.plcproj", "<Project/>")
        .with("x.tsproj", "<TcSmProject/>")
        .with("x.project", b"\0\0")
        .with("picture.png", b"\x89PNG");
    let tree = read(&memory);
    assert_eq!(paths(&tree), ["FB.gtt", "FB.gtt.md", "FB.gtt.xlsx", "FB.st", "FB.tt.txt", "x.plcproj", "x.project"]);
    assert_eq!((tree.units.len(), tree.projects.len(), tree.tables.len()), (1, 1, 4));
    assert_eq!(tree.tables[2].bytes.as_ref(), b"PK\x03\x04\0");
    let skipped: Vec<_> = tree.skipped.iter().map(|skipped| (skipped.path.as_str(), skipped.reason.as_ref())).collect();
    let expected = [
        ("picture.png", "not a PLC source"),
        ("readme.md", "not a PLC source"),
        ("x.project", "a project that only its tool can read"),
        ("x.tsproj", "a TwinCAT solution or system: no program text"),
    ];
    assert_eq!(skipped, expected);
    assert_eq!(codes_of(&tree.findings), ["binary-project"]);
    assert_eq!(tree.findings[0].help.len(), 1, "the export that would help is named");
}

#[test]
fn hidden_and_generated_folders_are_left_alone_and_told() {
    let memory = Memory::new()
        .with(".git/a.st", "A")
        .with("node_modules/a.st", "A")
        .with("target/CACHEDIR.TAG", "tag")
        .with("target/a.st", "A")
        .with("manual/a.st", "A")
        .with("Target/a.st", "A");
    let options = Options { output: Some("manual/".to_owned()), ..Options::default() };
    let tree = read_tree(&memory, &options, &|_| {});
    assert_eq!(paths(&tree), ["Target/a.st"]);
    let skipped: Vec<_> = tree.skipped.iter().map(|skipped| skipped.path.as_str()).collect();
    assert_eq!(skipped, [".git/", "manual/", "node_modules/", "target/"]);
}

#[test]
fn globs_choose_files() {
    let memory =
        Memory::new().with("a/x.st", "A").with("a/old/x.st", "A").with("b/x.st", "A").with("b/y.TcPOU", "<x/>");
    let list = |globs: &[&str]| globs.iter().map(|glob| (*glob).to_owned()).collect::<Vec<_>>();
    let chosen = |include: &[&str], exclude: &[&str]| {
        let filter = Filter::new(&list(include), &list(exclude)).expect("the globs are sound");
        let tree = read_tree(&memory, &Options { filter, ..Options::default() }, &|_| {});
        paths(&tree).join(" ")
    };
    assert_eq!(chosen(&[], &["old/"]), "a/x.st b/x.st b/y.TcPOU");
    assert_eq!(chosen(&["*.st"], &["/b"]), "a/old/x.st a/x.st");
    assert_eq!(chosen(&["/a/"], &[]), "a/old/x.st a/x.st");
    assert!(Filter::new(&list(&["a{b"]), &[]).is_err());
}

#[test]
fn what_cannot_be_read_is_a_finding_at_its_path() {
    let memory = Memory::new()
        .with("gone.st", "A")
        .denying("gone.st", "entity not found")
        .with("shut/a.st", "A")
        .denying("shut", "permission denied")
        .with_entry("pipe.st", EntryKind::Odd("neither a file nor a folder"))
        .with_entry("up", EntryKind::Loop)
        .with("we're \"here\".st", "A");
    let tree = read(&memory);
    assert_eq!(codes_of(&tree.findings), ["unreadable-path", "unreadable-path", "unreadable-path", "link-loop"]);
    assert_eq!(paths(&tree), ["gone.st", "pipe.st", "shut/", "up", "we're \"here\".st"]);
    assert_eq!(tree.units.len(), 1);
    assert_eq!(tree.skipped.len(), 4);
}

#[test]
fn a_file_above_the_limit_is_a_finding() {
    let options = Options { max_file_size: 10, ..Options::default() };
    let tree = read_tree(&Memory::new().with("big.st", "0123456789A").with("fit.st", "0123456789"), &options, &|_| {});
    assert_eq!(codes_of(&tree.findings), ["file-too-large"]);
    assert_eq!(tree.units.len(), 1);
}

#[test]
fn progress_tells_of_every_file_that_is_read() {
    let (walked, read) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let memory = Memory::new().with("a.st", "A").with("b.st", "B").with("c.png", "C");
    read_tree(&memory, &Options::default(), &|progress| match progress {
        Progress::Walked(files) => walked.store(files, Ordering::Relaxed),
        Progress::Read { total } => {
            assert_eq!(total, 2);
            read.fetch_add(1, Ordering::Relaxed);
        }
    });
    assert_eq!((walked.into_inner(), read.into_inner()), (3, 2));
}

#[test]
fn folders_that_nest_without_end_are_a_finding() {
    let path = format!("{}a.st", "d/".repeat(5000));
    let tree = read(&Memory::new().with(&path, "A"));
    assert_eq!(codes_of(&tree.findings), ["unreadable-path"]);
    assert!(tree.units.is_empty());
}

#[test]
fn a_root_that_is_no_folder_is_an_error() {
    assert!(Disk::new("/no such folder").is_err());
    assert!(Disk::new("Cargo.toml").is_err());
}
