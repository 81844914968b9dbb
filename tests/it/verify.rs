//! `verify` from the command line: verdicts, exit codes, what is kept, and what is checked again.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;

const TOGGLE: &str = "(* A lamp that a press switches on.\n\n   @gtt Stays on\n   | # | in Press | out Lamp | dur |\n   |---|---|---|---|\n   \
                      | 1 | F | F | - |\n   | 2 | T | T | 1 |\n   | 3 | - | T | -∞ |\n*)\n\
                      FUNCTION_BLOCK FB_Lamp\nVAR_INPUT Press : BOOL; END_VAR\nVAR_OUTPUT Lamp : BOOL; END_VAR\n\
                      IF Press THEN Lamp := TRUE; END_IF\nEND_FUNCTION_BLOCK\n";

/// The exit code and the answer.
fn verify(arguments: &[&str], folder: &Path) -> (i32, Value) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rungbook"));
    let output = command.current_dir(folder).args(["verify", "-q", "--format", "json"]).args(arguments).output();
    let output = output.expect("it runs");
    let value = serde_json::from_slice(&output.stdout).unwrap_or_else(|error| {
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(!said.is_empty(), "{error}");
        Value::from(said)
    });
    (output.status.code().unwrap_or(-1), value)
}

fn folder(text: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("FB_Lamp.st"), text).expect("written");
    folder
}

#[test]
fn a_verdict_is_found_and_kept_until_something_changes() {
    let folder = folder(TOGGLE);
    let (code, first) = verify(&[], folder.path());
    assert_eq!((code, &first["tables"][0]["verdict"]), (0, &Value::from("verified")));
    assert_eq!(first["tables"][0]["known"], false);
    let (code, again) = verify(&[], folder.path());
    assert_eq!((code, &again["tables"][0]["known"]), (0, &Value::from(true)));
    // A comment is no change; the body is.
    fs::write(folder.path().join("FB_Lamp.st"), format!("{TOGGLE}// a comment\n")).expect("written");
    assert_eq!(verify(&[], folder.path()).1["tables"][0]["known"], true);
    fs::write(folder.path().join("FB_Lamp.st"), TOGGLE.replace("Lamp := TRUE", "Lamp := NOT Lamp")).expect("written");
    let (code, broken) = verify(&[], folder.path());
    let table = &broken["tables"][0];
    assert_eq!((code, &table["verdict"]), (1, &Value::from("violated")));
    assert_eq!((&table["row"], &table["columns"][0]), (&Value::from("3"), &Value::from("Lamp")));
    assert_eq!(table["run"]["cycles"].as_array().map(Vec::len), table["cycle"].as_u64().map(|cycle| cycle as usize));
}

#[test]
fn what_is_not_modelled_and_what_is_wrong_have_exit_codes_of_their_own() {
    let unmodelled = TOGGLE.replace("IF Press", "JMP next;\nnext:\nIF Press");
    assert_eq!(verify(&[], folder(&unmodelled).path()).0, 3);
    let wrong = TOGGLE.replace("out Lamp", "out Lump");
    let (code, answer) = verify(&[], folder(&wrong).path());
    assert_eq!((code, &answer["tables"][0]["verdict"]), (2, &Value::from("unusable")));
    // Nothing conforms strictly to a table that never ends.
    let (code, answer) = verify(&["--strict"], folder(TOGGLE).path());
    assert_eq!((code, &answer["tables"][0]["verdict"]), (2, &Value::from("unusable")));
}

#[test]
fn a_fault_while_the_table_holds_is_a_violation() {
    let text = TOGGLE
        .replace("IF Press THEN", "x := 10 / x;\nIF Press THEN")
        .replace("VAR_OUTPUT", "VAR x : INT := 1; END_VAR\nVAR_OUTPUT");
    let text = text.replace("x := 10 / x;", "x := x - 1; IF Press THEN x := 10 / x; END_IF");
    let (code, answer) = verify(&[], folder(&text).path());
    assert_eq!(code, 1, "{answer:#}");
    assert_eq!(answer["tables"][0]["run"]["end"]["fault"], "division by zero");
}

#[test]
fn a_bundle_is_checked_again_certificate_by_certificate() {
    let folder = folder(TOGGLE);
    assert_eq!(verify(&[], folder.path()).0, 0);
    let run = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_rungbook"));
        command.current_dir(folder.path()).args(arguments).output().expect("it runs")
    };
    assert!(run(&["evidence", "bundle", ".", "-o", "release.zip"]).status.success());
    let checked = run(&["evidence", "verify", "release.zip"]);
    assert!(checked.status.success());
    let text = String::from_utf8_lossy(&checked.stdout).into_owned();
    assert_eq!(run(&["recheck", "release.zip"]).stdout, checked.stdout);
    assert!(text.contains("verified, checked again"), "{text}");
}

/// The last row is reached by what the block does, not by what the inputs are.
fn strict() -> String {
    let text = TOGGLE.replace("@gtt Stays on", "@gtt Stays on (strict)");
    text.replace("| 3 | - | T | -∞ |", "| 3 | - | T | - |\n   | 4 | - | F | 1 |")
}

#[test]
fn strict_conformance_asks_that_the_end_is_reached() {
    // The lamp stays on for ever, and the inputs always let the last row begin.
    let stays = folder(&strict());
    let (code, answer) = verify(&[], stays.path());
    let table = &answer["tables"][0];
    assert_eq!((code, &table["verdict"]), (1, &Value::from("violated")), "{answer:#}");
    assert_eq!(table["run"]["end"]["kind"], "never-ends");
    // It goes out after three cycles, whatever the inputs are.
    let body = "IF n > 0 THEN n := MIN(n + 1, 4); ELSIF Press THEN n := 1; END_IF\nLamp := n > 0 AND n < 4;";
    let goes = strict().replace("IF Press THEN Lamp := TRUE; END_IF", body);
    let goes = folder(&goes.replace("VAR_OUTPUT", "VAR n : INT; END_VAR\nVAR_OUTPUT"));
    let (code, answer) = verify(&[], goes.path());
    assert_eq!((code, &answer["tables"][0]["verdict"]), (0, &Value::from("verified")), "{answer:#}");
    for folder in [&stays, &goes] {
        let run = |arguments: &[&str]| {
            let mut command = Command::new(env!("CARGO_BIN_EXE_rungbook"));
            command.current_dir(folder.path()).args(arguments).output().expect("it runs")
        };
        assert!(run(&["evidence", "bundle", ".", "-o", "release.zip"]).status.success());
        let checked = run(&["recheck", "release.zip"]);
        let text = String::from_utf8_lossy(&checked.stdout).into_owned();
        assert!(checked.status.success() && text.contains("checked again"), "{text}");
    }
}

#[test]
fn obligations_are_written_for_other_checkers() {
    let folder = folder(TOGGLE);
    let mut command = Command::new(env!("CARGO_BIN_EXE_rungbook"));
    command.current_dir(folder.path()).args(["verify", "-q", "--aiger", "out"]).assert().code(0).stdout("");
    let bytes = fs::read(folder.path().join("out/FB_Lamp-Stays_on.aig")).expect("written");
    let text = String::from_utf8_lossy(&bytes);
    let header: Vec<&str> = text.lines().next().expect("a header").split(' ').collect();
    // One bad literal, and no constraints, which not every checker reads.
    assert_eq!((header[0], header[4], header.get(6), header.get(7)), ("aig", "0", Some(&"1"), None));
    assert!(text.lines().any(|line| line.starts_with('l') && line.ends_with("Lamp")), "names are kept: {text}");
}

#[test]
fn a_fixed_point_reading_is_an_assumption_of_the_verdict() {
    let text = "(* Doubles.\n\n   @gtt Doubles\n   | # | in x | out y | dur |\n   |---|---|---|---|\n   \
                | 1 | [0.0, 100.0] | <= 200.0 | -∞ |\n*)\n\
                FUNCTION_BLOCK FB_Lamp\nVAR_INPUT x : REAL; END_VAR\nVAR_OUTPUT y : REAL; END_VAR\n\
                y := x + x;\nEND_FUNCTION_BLOCK\n";
    let folder = folder(text);
    let (code, answer) = verify(&["--fixed", "2,24"], folder.path());
    let table = &answer["tables"][0];
    let assumption = "`REAL` and `LREAL` are read in fixed point: 2 decimal digits in 24 bits, not IEEE 754";
    assert_eq!((code, &table["verdict"]), (0, &Value::from("verified")), "{answer:#}");
    assert_eq!(table["assumptions"], serde_json::json!([assumption]));
    // The same is kept with the verdict, and another reading is another question.
    let (_, again) = verify(&["--fixed", "2,24"], folder.path());
    assert_eq!(
        (&again["tables"][0]["known"], &again["tables"][0]["assumptions"][0]),
        (&true.into(), &assumption.into())
    );
    assert_eq!(verify(&["--fixed", "3,24"], folder.path()).1["tables"][0]["known"], false);
    // A violation is replayed in the same reading.
    fs::write(folder.path().join("FB_Lamp.st"), text.replace("x + x", "x + x + 0.01")).expect("written");
    fs::write(folder.path().join("rungbook.toml"), "[verify]\nfixed = { digits = 2, width = 24 }\n").expect("written");
    let (code, broken) = verify(&[], folder.path());
    assert_eq!((code, &broken["tables"][0]["verdict"]), (1, &Value::from("violated")), "{broken:#}");
    assert_eq!(broken["tables"][0]["run"]["end"]["rows"][0]["cells"][0]["seen"], "200.01", "{broken:#}");
    assert_eq!(verify(&["--fixed", "9,16"], folder.path()).0, 2);
}

#[test]
fn a_stub_that_cannot_be_read_is_told() {
    let fs = rungbook::source::Memory::new().with("a.st", "FUNCTION_BLOCK FB_A\nEND_FUNCTION_BLOCK\n");
    let asked = "[verify]\nstubs = { FB_Vendor = \"stubs/none.st\", FB_Other = \"arbitrary\" }\n";
    let project = rungbook::pipeline::read(&fs, "tree", &crate::support::settings(asked), &|_| {});
    let told = project.findings.iter().find(|finding| finding.code.name == "unreadable-path").expect("it is told");
    assert!(told.message.starts_with("the stub of `FB_Vendor` cannot be read"), "{}", told.message);
    assert_eq!(project.files.get(told.place.file).path, "stubs/none.st");
    assert_eq!(project.asked.stubs.len(), 1);
}

/// A block whose table holds only if a number of 31 bits is prime, and one that is proven at once.
const HOPELESS: &str = "(* Two factors.\n\n   @gtt No product\n   | # | out Found | dur |\n   |---|---|---|\n   | 1 | F | -∞ |\n*)\n\
                        FUNCTION_BLOCK FB_Factors\nVAR_INPUT A, B : ULINT; END_VAR\nVAR_OUTPUT Found : BOOL; END_VAR\n\
                        Found := A > 1 AND B > 1 AND A < 4294967296 AND B < 4294967296 AND A * B = 2305843009213693951;\n\
                        END_FUNCTION_BLOCK\n";

fn hopeless_and_simple() -> tempfile::TempDir {
    let folder = folder(TOGGLE);
    fs::write(folder.path().join("FB_Factors.st"), HOPELESS).expect("written");
    folder
}

fn verdicts(answer: &Value) -> Vec<(&str, &str)> {
    let tables = answer["tables"].as_array().expect("tables").iter();
    tables.map(|table| (table["verdict"].as_str().unwrap_or(""), table["ended"].as_str().unwrap_or(""))).collect()
}

#[test]
fn a_hopeless_table_ends_with_its_time_and_the_others_have_their_verdicts() {
    // On a busy machine one try may be late; three are not.
    let late = (0..3).all(|_| {
        let (code, answer) = verify(&["--timeout", "4", "--fresh"], hopeless_and_simple().path());
        assert_eq!((code, verdicts(&answer)), (3, vec![("bounded", "time"), ("verified", "")]));
        let seconds = answer["tables"][0]["seconds"].as_f64().expect("a time");
        assert!(seconds >= 3.9, "it gave up after {seconds} s");
        seconds > 4.4
    });
    assert!(!late, "more than 10 % over the time limit, three times");
}

/// A block that multiplies what it holds: every cycle more is as much more to remember.
const GROWING: &str = "(* Numbers.\n\n   @gtt Never this one\n   | # | in Step | out State | dur |\n   |---|---|---|---|\n\
                       | 1 | - | <> 123456789 | -∞ |\n*)\n\
                       FUNCTION_BLOCK FB_Factors\nVAR_INPUT Step : BOOL; END_VAR\nVAR_OUTPUT State : UDINT; END_VAR\n\
                       IF Step THEN State := State * 1664525 + 1013904223; ELSE State := State * State + 12345; END_IF\n\
                       END_FUNCTION_BLOCK\n";

#[test]
fn a_hopeless_table_ends_with_its_memory_and_the_others_have_their_verdicts() {
    let folder = folder(TOGGLE);
    fs::write(folder.path().join("FB_Factors.st"), GROWING).expect("written");
    let (code, answer) = verify(&["--timeout", "600", "--memory", "8", "--fresh"], folder.path());
    assert_eq!((code, verdicts(&answer)), (3, vec![("bounded", "memory"), ("verified", "")]));
    assert!(answer["tables"][0]["detail"] != "no violation in the first 0 cycles", "it looked at some cycles first");
}
