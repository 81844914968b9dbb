//! The house rules that no compiler keeps: which room may import which, a header on every file, a
//! suite for every rule, a page for every code.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use rungbook::audit;

/// Open to all.
const OPEN: [&str; 2] = ["text", "diagnostic"];

/// A room and what it may import besides [`OPEN`] and itself.
const ARROWS: &[(&str, &[&str])] = &[
    ("text", &[]),
    ("diagnostic", &[]),
    ("source", &[]),
    ("syntax", &[]),
    ("library", &["syntax"]),
    ("docs", &["library"]),
    ("logic", &[]),
    ("semantics", &["library", "syntax", "logic"]),
    ("table", &["library", "syntax", "logic", "semantics"]),
    ("machine", &["library", "syntax", "logic", "semantics"]),
    ("prove", &["machine", "table", "logic", "semantics", "library"]),
    ("recheck", &["machine", "table", "logic", "semantics"]),
    ("evidence", &["table", "library", "syntax"]),
    ("audit", &["library", "docs", "table", "source", "syntax", "evidence"]),
    ("figure", &["library", "table", "machine", "prove"]),
    ("book", &["library", "docs", "table", "audit", "figure", "evidence", "machine"]),
    ("render", &["book", "figure"]),
    ("config", &["source", "docs", "audit", "table", "render", "evidence", "prove", "machine"]),
    (
        "pipeline",
        &[
            "source",
            "syntax",
            "library",
            "docs",
            "table",
            "audit",
            "figure",
            "book",
            "render",
            "config",
            "logic",
            "semantics",
            "machine",
            "prove",
            "recheck",
            "evidence",
        ],
    ),
    (
        "cli",
        &[
            "pipeline",
            "config",
            "audit",
            "book",
            "render",
            "source",
            "table",
            "docs",
            "library",
            "evidence",
            "prove",
            "recheck",
            "machine",
            "semantics",
            "logic",
            "figure",
        ],
    ),
];

fn rust_files(folder: &Path, out: &mut Vec<PathBuf>) {
    let mut entries: Vec<_> = fs::read_dir(folder).expect("a folder of this package").flatten().collect();
    entries.sort_by_key(fs::DirEntry::path);
    for entry in entries {
        let path = entry.path();
        if path.is_dir() {
            rust_files(&path, out);
        } else if path.extension().is_some_and(|e| e == "rs") {
            out.push(path);
        }
    }
}

fn files(below: &str) -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(below);
    let mut paths = Vec::new();
    rust_files(&root, &mut paths);
    paths.into_iter().map(|path| (path.clone(), fs::read_to_string(path).expect("readable"))).collect()
}

fn room(path: &Path) -> String {
    let below = path.strip_prefix(Path::new(env!("CARGO_MANIFEST_DIR")).join("src")).expect("a file of src");
    let first = below.components().next().expect("not empty").as_os_str().to_string_lossy();
    first.trim_end_matches(".rs").to_owned()
}

/// The rooms that `text` names behind `crate::`, grouped imports included.
fn imports(text: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
        for rest in line.split("crate::").skip(1) {
            let names = match rest.strip_prefix('{') {
                Some(group) => group.split(',').map(str::trim).collect(),
                None => vec![rest],
            };
            for name in names {
                let name: String = name.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                found.insert(name);
            }
        }
    }
    found
}

#[test]
fn rooms_import_only_what_their_charter_lists() {
    let rooms: BTreeSet<_> = ARROWS.iter().map(|(name, _)| *name).collect();
    let mut wrong = Vec::new();
    for (path, text) in files("src") {
        let here = room(&path);
        if matches!(here.as_str(), "lib" | "main") {
            continue;
        }
        let Some((_, allowed)) = ARROWS.iter().find(|(name, _)| *name == here) else {
            wrong.push(format!("{}: the room `{here}` is not in the table", path.display()));
            continue;
        };
        for name in imports(&text) {
            let open = OPEN.contains(&name.as_str()) || name == here || allowed.contains(&name.as_str());
            if rooms.contains(name.as_str()) && !open {
                wrong.push(format!("{}: {here} may not import {name}", path.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_scan_sees_grouped_and_plain_imports() {
    let seen = imports("use crate::{text::Span, library};\nlet x = crate::audit::code(y);\n// crate::cli\n");
    let expected: BTreeSet<String> = ["audit", "library", "text"].map(str::to_owned).into();
    assert_eq!(seen, expected);
}

#[test]
fn the_table_of_arrows_has_no_cycle() {
    // A room may only import rooms above it in the table, so that the order of the table is a proof.
    for (i, (name, allowed)) in ARROWS.iter().enumerate() {
        for other in *allowed {
            let j = ARROWS.iter().position(|(n, _)| n == other).expect("a room of the table");
            assert!(j < i, "{name} imports {other}, which stands below it");
        }
    }
}

#[test]
fn every_file_says_what_it_is_for() {
    let mut bare = Vec::new();
    for below in ["src", "tests/it", "benches"] {
        for (path, text) in files(below) {
            if !text.starts_with("//!") {
                bare.push(path.display().to_string());
            }
        }
    }
    assert!(bare.is_empty(), "without a `//!` at the top:\n{}", bare.join("\n"));
}

#[test]
fn main_only_hands_over() {
    let text = include_str!("../../src/main.rs");
    assert!(text.lines().count() < 40);
    assert!(!include_str!("../../src/lib.rs").contains("pub use"), "no re-exports at the root");
}

#[test]
fn every_rule_has_its_file_and_its_suite() {
    let rules = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/audit/rules");
    let suites = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/rules");
    for rule in audit::RULES {
        let file = format!("{}.rs", rule.code.name.replace('-', "_"));
        assert!(rules.join(&file).is_file(), "no src/audit/rules/{file}");
        assert!(suites.join(&file).is_file(), "no tests/it/rules/{file}");
    }
    let count = fs::read_dir(rules).expect("the rules").flatten().filter(|e| e.file_name() != "mod.rs").count();
    assert_eq!(count, audit::RULES.len(), "a file in src/audit/rules is not registered");
}

#[test]
fn every_code_has_a_page_with_an_example_and_a_cure() {
    let codes = audit::codes();
    let names: BTreeSet<_> = codes.iter().map(|code| code.name).collect();
    assert_eq!(names.len(), codes.len(), "two codes have one name");
    for code in codes {
        let text = code.text();
        assert!(text.starts_with("# "), "{}: the page has no title", code.name);
        assert!(text.contains("```"), "{}: the page has no example", code.name);
        assert!(text.lines().count() > 6, "{}: the page says too little", code.name);
    }
}
