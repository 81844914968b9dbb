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

/// A row of the list of cases: its kind, its files, and what is expected of it.
struct Case {
    id: String,
    kind: String,
    paths: Vec<String>,
}

fn cases() -> Vec<Case> {
    let list = std::env::var("RUNGBOOK_GETETA").expect("RUNGBOOK_GETETA names the list of cases");
    let text = std::fs::read_to_string(list).expect("the list is there");
    let one = |line: &str| {
        let fields: Vec<&str> = line.split('\t').collect();
        let paths = fields[4].split(';').map(str::to_owned).collect();
        Case { id: fields[0].to_owned(), kind: fields[1].to_owned(), paths }
    };
    text.lines().skip(1).filter(|line| !line.is_empty()).map(one).collect()
}

fn text_of(tree: &str, path: &str) -> String {
    let bytes = std::fs::read(root().join(tree).join(path)).unwrap_or_else(|_| panic!("{tree}/{path} is missing"));
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Each finding of a table file that is bound to the block beside it, but for what the lints say: `code "text" message`.
fn bound(tree: &str, sources: &[&String], table: &str) -> (Vec<rungbook::table::AttachedTable>, Vec<String>) {
    let name = if table.ends_with(".xml") { "case.gtt.xml" } else { "case.gtt" };
    let mut files: Vec<(String, String)> = vec![(name.to_owned(), text_of(tree, table))];
    for (at, source) in sources.iter().enumerate() {
        let name = if at == 0 { "case.st".to_owned() } else { format!("more{at}.st") };
        files.push((name, text_of(tree, source)));
    }
    let files: Vec<(&str, &str)> = files.iter().map(|(name, text)| (name.as_str(), text.as_str())).collect();
    let project = crate::support::project(&files, "[tables]\ncycle = \"4ms\"\n");
    let in_table = |f: &&rungbook::diagnostic::Finding| project.files.get(f.place.file).path == name;
    let lints =
        ["never", "once", "free", "blank", "early", "empty", "ambiguous", "unverified", "unattached", "overlap"];
    let shown = project.findings.iter().filter(in_table).filter(|f| !lints.iter().any(|l| f.code.name.contains(l)));
    let shown = shown.map(|f| {
        let text = f.place.span.of(&project.files.get(f.place.file).text);
        format!("{} {text:?} {}", f.code.name, f.message)
    });
    let shown = shown.collect();
    (project.tables, shown)
}

/// Every row of the list that is a table: it reads and binds as it says, with its errors at their places.
#[test]
#[ignore = "needs the trees of other projects and the list of cases"]
fn every_case_of_the_list_reads_as_it_says() {
    let mut seen = 0;
    for case in cases() {
        let tree = if case.kind == "exteta-xml" { "verifaps-old" } else { "verifaps-lib" };
        if !["gtt", "gtt-parse", "exteta-xml", "stvs-session"].contains(&case.kind.as_str()) {
            continue;
        }
        seen += 1;
        let sources: Vec<&String> = case.paths.iter().filter(|path| path.ends_with(".st")).collect();
        let tables: Vec<&String> =
            case.paths.iter().filter(|path| !path.ends_with(".st") && !path.contains("report")).collect();
        assert!(!tables.is_empty(), "{}", case.id);
        for path in tables {
            let (tables, findings) = bound(tree, &sources, path);
            assert!(!tables.is_empty(), "{} {path}", case.id);
            judge(&case, path, &tables, &findings);
        }
    }
    assert_eq!(seen, 19);
}

/// Whether a file of a case was read as the case says.
fn judge(case: &Case, path: &str, tables: &[rungbook::table::AttachedTable], findings: &[String]) {
    let is = |wanted: &[&str]| assert_eq!(findings, wanted, "{} {path}", case.id);
    let errors = tables.iter().map(|table| table.table.errors).sum::<usize>();
    match case.id.as_str() {
        "cycles_wrong" => {
            assert_eq!(findings.len(), 1, "{findings:?}");
            assert_eq!(findings[0], "table-declared-type \"INT\" the header says that `i` is `INT`, and it is `BOOL`");
            assert_eq!(errors, 0);
        }
        "detwait" | "detwait_wrong" | "enum" => {
            assert!(findings.iter().all(|f| f.starts_with("table-old-spelling")), "{} {findings:?}", case.id);
            assert!(!findings.is_empty() && errors == 0, "{} {findings:?}", case.id);
        }
        "parse_SimpleSystems" => {
            assert_eq!(tables.len(), 4);
            is(&[]);
        }
        // This file alone has a column for a variable that the code does not have; its sessions do not.
        "s_counterexample_1" if path.ends_with("/constraint_spec_counterexample_valid_1.xml") => {
            is(&["table-unknown-name \"neg_val\" `Monitor_Start_Stop` has no variable `neg_val`"]);
        }
        // What geteta is given has the prefix of another tool's names in it.
        "s_valid_1" | "s_counterexample_1" if path.contains("geteta_input") => {
            let prefixed = |f: &String| f.starts_with("table-unknown-name") && f.contains("no variable `var_");
            assert!(findings.iter().all(prefixed), "{path} {findings:?}");
        }
        "x_issue1" => {
            for name in ["var_A", "var_B", "var_C", "var_D"] {
                let told =
                    |f: &&String| f.starts_with("table-unknown-name") && f.contains(&format!("no variable `{name}`"));
                let told = findings.iter().find(told).unwrap_or_else(|| panic!("{name}: {findings:?}"));
                assert!(told.contains(name), "{told}");
            }
            assert_eq!(errors, findings.iter().filter(|f| f.starts_with("table-unknown-name")).count());
        }
        _ => {
            is(&[]);
            assert_eq!(errors, 0);
        }
    }
}
