//! Tables of other projects, read where they lie; nothing of them is in this repository.
//!
//! Run with `RUNGBOOK_CORPORA=/path cargo test -- --ignored table::corpora`.

#![allow(clippy::disallowed_methods, reason = "the test reads trees from the disk that are not part of it")]

use std::path::{Path, PathBuf};

use rungbook::diagnostic::Severity;

fn root() -> PathBuf {
    PathBuf::from(std::env::var("RUNGBOOK_CORPORA").expect("RUNGBOOK_CORPORA names the folder of the trees"))
}

fn files(below: &Path, accept: &dyn Fn(&Path) -> bool, out: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> =
        std::fs::read_dir(below).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    entries.sort();
    for entry in entries {
        if entry.is_dir() {
            files(&entry, accept, out);
        } else if accept(&entry) {
            out.push(entry);
        }
    }
}

/// Files that are wrong by themselves: a stray word, a misspelt keyword, a product without a sign, XML under this name.
const WRONG: [&str; 4] = ["region.tt.txt", "rtt_i.gtt", "NewFile.gtt", "rtt_inter.gtt"];

#[test]
#[ignore = "needs the trees of other projects"]
fn every_gtt_file_of_geteta_reads() {
    let mut found = Vec::new();
    let is_table = |path: &Path| {
        let name = path.to_string_lossy();
        name.ends_with(".gtt") || name.ends_with(".tt.txt")
    };
    files(&root().join("verifaps-lib"), &is_table, &mut found);
    assert!(found.len() > 30, "{} files", found.len());
    let mut bad = Vec::new();
    for path in found {
        let text = String::from_utf8_lossy(&std::fs::read(&path).expect("a listed file is there")).into_owned();
        let read = super::gtt(&text);
        let errors: Vec<_> = read.findings.iter().filter(|f| f.severity == Severity::Error).cloned().collect();
        let known = WRONG.iter().any(|name| path.to_string_lossy().contains(name));
        if !errors.is_empty() && !known || read.tables.is_empty() {
            bad.push(format!(
                "{}: {} tables\n{}",
                path.display(),
                read.tables.len(),
                super::shown(&text, &errors).join("\n")
            ));
        }
        for table in &read.tables {
            let laid = rungbook::table::layout::layout(table);
            assert_eq!(laid.rows.len(), table.rows().len());
        }
    }
    assert!(bad.is_empty(), "{}", bad.join("\n\n"));
}

/// Specifications and sessions of STVS, tables in exteta: those that are meant to be valid have no errors; none is a crash.
/// The random ones with many columns use the same names several times; one table
/// has a cell for a variable that it does not declare.
#[test]
#[ignore = "needs the trees of other projects"]
fn every_table_in_xml_reads() {
    let mut found = Vec::new();
    for tree in ["verifaps-lib", "verifaps-old", "stvs"] {
        files(&root().join(tree), &|path| path.extension().is_some_and(|e| e == "xml" || e == "gtt"), &mut found);
    }
    let (mut tables, mut bad) = (0, Vec::new());
    for path in found {
        let text = String::from_utf8_lossy(&std::fs::read(&path).expect("a listed file is there")).into_owned();
        let is_table =
            ["<test-table", "<session", "<specification", "<tabletestspec"].iter().any(|tag| text.contains(tag));
        if !is_table {
            continue;
        }
        let piece = rungbook::table::Piece::verbatim(rungbook::text::FileId(0), &text, 0);
        let read = rungbook::table::read::text(&piece, &Default::default());
        tables += read.tables.len();
        let errors: Vec<_> = read.findings.iter().filter(|f| f.severity == Severity::Error).cloned().collect();
        if !errors.is_empty()
            && !["invalid", "random_1000", "random_5000", "rtt_inter"]
                .iter()
                .any(|name| path.to_string_lossy().contains(name))
        {
            bad.push(format!("{}\n{}", path.display(), super::shown(&text, &errors[..errors.len().min(5)]).join("\n")));
        }
    }
    assert!(tables > 50, "{tables} tables");
    assert!(bad.is_empty(), "{} tables\n{}", tables, bad.join("\n\n"));
}
