//! The verdicts of geteta's own examples, in its repository at two commits: `tests/labels/geteta.tsv` lists what is known of
//! them. `RUNGBOOK_CORPORA=DIR cargo test --test it geteta -- --ignored --nocapture`, where `DIR/verifaps-lib` and
//! `DIR/verifaps-old` are the two trees.

use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde_json::Value;

const LABELS: &str = include_str!("../labels/geteta.tsv");

struct Case<'a> {
    id: &'a str,
    files: Vec<PathBuf>,
    options: Vec<&'a str>,
    /// Verdict, cycle, row, column; `-` where nothing is known.
    wanted: [&'a str; 4],
}

fn cases(root: &Path) -> Vec<Case<'static>> {
    let lines = LABELS.lines().filter(|line| !line.starts_with('#'));
    lines
        .map(|line| {
            let fields: Vec<&str> = line.split('\t').collect();
            let [id, tree, _commit, files, options, verdict, cycle, row, column] = fields[..] else {
                panic!("nine fields in {line}")
            };
            Case {
                id,
                files: files.split(';').map(|file| root.join(tree).join(file)).collect(),
                options: options.split(' ').filter(|option| *option != "-").collect(),
                wanted: [verdict, cycle, row, column],
            }
        })
        .collect()
}

/// The first table of the answer.
fn verify(case: &Case<'_>) -> Value {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rungbook"));
    let output = command.args(["verify", "--quiet", "--format", "json"]).args(&case.options).args(&case.files).output();
    let output = output.expect("it runs");
    let value: Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{}: {error}: {}", case.id, String::from_utf8_lossy(&output.stderr)));
    value["tables"][0].clone()
}

#[test]
#[ignore = "needs the trees of geteta"]
#[allow(clippy::print_stderr, reason = "a report")]
fn known_verdicts_are_found() {
    let Some(root) = std::env::var_os("RUNGBOOK_CORPORA") else {
        eprintln!("skipped: RUNGBOOK_CORPORA names no folder");
        return;
    };
    let mut wrong = Vec::new();
    for case in cases(Path::new(&root)) {
        let found = verify(&case);
        let shown = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_owned);
        let columns = found["columns"].as_array().map_or(Value::Null, |list| list[0].clone());
        let seen = [&found["verdict"], &found["cycle"], &found["row"], &columns].map(shown);
        let agree =
            case.wanted.iter().zip(&seen).all(|(wanted, seen)| *wanted == "-" || wanted.eq_ignore_ascii_case(seen));
        eprintln!(
            "{} {:<20} {:?} {} {} s {}",
            if agree { "ok   " } else { "WRONG" },
            case.id,
            seen,
            found["engine"],
            found["seconds"],
            found["reasons"]
        );
        if !agree {
            wrong.push(case.id);
        }
    }
    assert!(wrong.is_empty(), "{wrong:?}");
}
