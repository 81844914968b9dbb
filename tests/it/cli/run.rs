//! `rungbook run`.

use std::fs;

use serde_json::Value;

use super::{rungbook, stdout, tree};

/// A lamp that an input switches on for three cycles, with a table that says so, and one that says two.
const LAMP: &str = "\
(*
A lamp that stays on for a while.

@gtt Three cycles (cycle 10ms)
| # | in Press | out Lamp | out Left | dur  |
|---|----------|----------|----------|------|
| 1 | F        | F        | 0        | >= 1 |
| 2 | T        | T        | 3        | 1    |
| 3 | F        | T        | [1, 2]   | 2    |
| 4 | F        | F        | 0        | -∞   |

@gtt Two cycles (cycle 10ms)
| # | in Press | out Lamp | dur |
|---|----------|----------|-----|
| 1 | T        | T        | 1   |
| 2 | F        | T        | 1   |
| 3 | F        | F        | 1   |
*)
FUNCTION_BLOCK FB_Lamp
VAR_INPUT
    Press : BOOL; // switches it on
END_VAR
VAR_OUTPUT
    Lamp : BOOL; // the lamp
    Left : INT; // for how many cycles
END_VAR

IF Press THEN
    Left := 3;
ELSIF Left > 0 THEN
    Left := Left - 1;
END_IF
Lamp := Left > 0;
END_FUNCTION_BLOCK
";

#[test]
fn a_table_that_holds_passes_row_by_row() {
    let dir = tree(&[("FB_Lamp.st", LAMP)]);
    let mut command = rungbook();
    command.current_dir(dir.path()).args(["run", "Three cycles", "--cycles", "2", "-q"]);
    command.assert().code(0);
    let text = stdout(&mut command);
    assert!(text.starts_with("FB_Lamp: Three cycles\n  cycle 1              row 1: pass\n"), "{text}");
    assert!(text.contains("  cycles 3 to 4        row 3: pass\n"), "{text}");
    assert!(text.contains("  passed 6 cycles; the table goes on\n"), "{text}");
    assert!(text.contains("Press") && text.contains('┌'), "no diagram: {text}");
}

#[test]
fn the_first_difference_is_told_and_fails() {
    let dir = tree(&[("FB_Lamp.st", LAMP)]);
    let junit = dir.path().join("out.xml");
    let mut command = rungbook();
    command.current_dir(dir.path()).args(["run", "fb_lamp", "-q", "--junit"]).arg(&junit);
    command.assert().code(1);
    let text = stdout(&mut command);
    assert!(text.contains("  violated in cycle 3\n    row 3, `Lamp`: expected `F`, seen `TRUE`\n"), "{text}");
    assert!(text.contains('▲'), "{text}");
    let report = fs::read_to_string(&junit).expect("the report");
    assert!(report.contains("tests=\"2\"") && report.contains("failures=\"1\""), "{report}");
    assert!(report.contains("violated in cycle 3; row 3, `Lamp`: expected `F`, seen `TRUE`"), "{report}");
}

#[test]
fn json_has_every_cycle() {
    let dir = tree(&[("FB_Lamp.st", LAMP)]);
    let mut command = rungbook();
    command.current_dir(dir.path()).args(["run", "Two cycles", "--format", "json", "-q"]);
    let json: Value = serde_json::from_str(&stdout(&mut command)).expect("JSON");
    let table = &json["tables"][0];
    assert_eq!(table["outcome"], "violated");
    assert_eq!(table["cycles"], 3);
    assert_eq!(table["failures"][0]["seen"], "TRUE");
    assert_eq!(table["signals"][0]["values"], serde_json::json!(["TRUE", "FALSE", "FALSE"]));
    assert_eq!(table["rows"], serde_json::json!([["1"], ["2"], []]));
}

#[test]
fn what_was_recorded_is_held_against_the_table() {
    let dir = tree(&[("FB_Lamp.st", LAMP)]);
    for (option, name) in [("--csv", "run.csv"), ("--vcd", "run.vcd"), ("--svg", "run.svg")] {
        let mut command = rungbook();
        command.current_dir(dir.path()).args(["run", "Three cycles", "-q", option, name]);
        command.assert().code(0);
    }
    for name in ["run.csv", "run.vcd"] {
        let mut command = rungbook();
        command.current_dir(dir.path()).args(["run", "Three cycles", "-q", "--trace", name]);
        command.assert().code(0);
        assert!(stdout(&mut command).contains("passed 14 cycles; the table goes on"), "{name}");
    }
    let recorded = fs::read_to_string(dir.path().join("run.csv")).expect("the run");
    let spoiled = recorded.replacen("TRUE,TRUE,3", "TRUE,FALSE,3", 1);
    assert_ne!(recorded, spoiled);
    fs::write(dir.path().join("bad.csv"), spoiled).expect("a file");
    let mut command = rungbook();
    command.current_dir(dir.path()).args(["run", "Three cycles", "-q", "--trace", "bad.csv"]);
    command.assert().code(1);
    assert!(stdout(&mut command).contains("row 2, `Lamp`: expected `T`, seen `FALSE`"));
    assert!(fs::read_to_string(dir.path().join("run.svg")).expect("the drawing").starts_with("<svg"));
}

#[test]
fn what_cannot_be_played_is_said() {
    let dir = tree(&[("FB_Lamp.st", LAMP), ("bad.csv", "cycle,Press\n1,TRUE\n")]);
    let code = |args: &[&str]| {
        let mut command = rungbook();
        command.current_dir(dir.path()).arg("run").args(args).arg("-q");
        command.output().expect("it runs").status.code()
    };
    assert_eq!(code(&["No such table"]), Some(2));
    assert_eq!(code(&["Three cycles", "--trace", "bad.csv"]), Some(2));
    assert_eq!(code(&["Three cycles", "--trace", "none.csv"]), Some(2));
    assert_eq!(code(&["FB_Lamp", "--csv", "two.csv"]), Some(2));
    assert_eq!(code(&["Three cycles", "--global", "nothing"]), Some(2));
    let unknown = LAMP.replace("Left : INT;", "Left : INT;\n    Odd : T_Unknown;");
    fs::write(dir.path().join("FB_Lamp.st"), unknown).expect("a file");
    assert_eq!(code(&["Three cycles"]), Some(3));
}
