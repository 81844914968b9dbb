//! `rungbook table`.

use std::fs;

use super::{rungbook, tree};

const PIPE: &str = "\
@gtt Extends in time (cycle 10ms, for FB_Cylinder)
| # | in E | out Ext | dur   | remark     |
|---|------|---------|-------|------------|
| 1 | F    | T       | 50 ms | travelling |
| 2 | T    | >= 5    | -∞    | arrived    |
";

fn stderr(command: &mut assert_cmd::Command) -> String {
    String::from_utf8(command.output().expect("it runs").stderr).expect("UTF-8")
}

#[test]
fn check_reports_cells_at_their_places() {
    let dir = tree(&[("a.gtt.md", &PIPE.replace(">= 5", ">= ")), ("b.gtt.md", PIPE)]);
    let run = || {
        let mut command = rungbook();
        command.current_dir(dir.path()).args(["table", "check"]);
        command
    };
    run().arg("b.gtt.md").assert().code(0).stdout("");
    run().arg("no.gtt").assert().code(2);
    let text = super::stdout(run().args(["a.gtt.md", "b.gtt.md", "--format", "json"]));
    let json: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(json["findings"][0]["code"], "table-cell");
    assert_eq!((&json["findings"][0]["line"], &json["findings"][0]["file"]), (&5.into(), &"a.gtt.md".into()));
    assert_eq!((&json["failed"], &json["totals"]["error"]), (&true.into(), &1.into()));
    run().arg("a.gtt.md").assert().code(1);
    let said = stderr(run().args(["a.gtt.md", "b.gtt.md"]));
    assert!(said.starts_with("2 tables, 1 errors"), "{said}");
}

#[test]
fn times_and_constants_come_from_outside() {
    let text = PIPE.replace("cycle 10ms, ", "").replace("50 ms", "TOUT");
    let dir = tree(&[("a.gtt.md", &text)]);
    let run = || {
        let mut command = rungbook();
        command.current_dir(dir.path()).args(["table", "check", "a.gtt.md"]);
        command
    };
    run().assert().code(1);
    run().args(["--const", "TOUT=50ms", "--cycle", "10ms"]).assert().code(0);
    run().args(["--const", "TOUT=50ms", "--cycle", "7ms"]).assert().code(1);
    run().args(["--const", "TOUT=7"]).assert().code(0);
    run().args(["--const", "TOUT"]).assert().code(2);
    run().args(["--cycle", "soon"]).assert().code(2);
}

/// Over every form and back: what is written last is what was written first.
#[test]
fn every_form_converts_into_every_other() {
    let dir = tree(&[("start.gtt.md", PIPE)]);
    let convert = |from: &str, to: &str| {
        let mut command = rungbook();
        command.current_dir(dir.path()).args(["table", "convert", from, "-o", to]).assert().code(0);
    };
    let names = ["a.gtt.md", "a.gtt", "a.csv", "a.xlsx", "a.ods", "a.xml"];
    for name in names {
        convert("start.gtt.md", name);
        for other in names {
            let there = format!("to-{other}");
            convert(name, &there);
            convert(&there, "back.md");
            let back = fs::read_to_string(dir.path().join("back.md")).expect("it was written");
            let first = fs::read_to_string(dir.path().join("a.gtt.md")).expect("it was written");
            assert_eq!(back, first, "{name} {other}");
        }
    }
}

#[test]
fn what_a_form_cannot_hold_is_said() {
    let dir = tree(&[("a.gtt.md", PIPE)]);
    let mut command = rungbook();
    command.current_dir(dir.path()).args(["table", "convert", "a.gtt.md", "-o", "-", "--to", "test-manager"]);
    let said = stderr(&mut command);
    assert!(said.contains("left out: the duration `omega` of row `2`"), "{said}");
    let text = super::stdout(&mut command);
    for part in ["testee=\"FB_Cylinder\"", "<set var=\"E\" value=\"FALSE\"/>", "<durationtimespan time=\"50ms\"/>"] {
        assert!(text.contains(part), "{part} is missing in {text}");
    }
    let run = |args: &[&str]| rungbook().current_dir(dir.path()).args(["table", "convert"]).args(args).assert();
    run(&["a.gtt.md", "-o", "b.xls"]).code(2);
    run(&["a.gtt.md", "-o", "b.unknown"]).code(2);
    let missing = run(&["a.gtt.md", "-o", "b.gtt", "--table", "Extent in time"]).code(2);
    let said = String::from_utf8_lossy(&missing.get_output().stderr).into_owned();
    assert!(said.contains("`Extends in time` is one"), "{said}");
    assert!(!dir.path().join("b.gtt").exists());
}

#[test]
fn a_table_with_errors_is_not_converted() {
    let dir = tree(&[("a.gtt.md", &PIPE.replace(">= 5", ">= "))]);
    rungbook().current_dir(dir.path()).args(["table", "convert", "a.gtt.md", "-o", "b.gtt"]).assert().code(1);
    assert!(!dir.path().join("b.gtt").exists());
}

#[test]
fn fmt_aligns_in_place_and_touches_nothing_else() {
    let code = "(*  @gtt T\n | # | in a | out b |\n |--|--|--|\n | 1 |x|T|\n*)\r\nFUNCTION_BLOCK  F   (* a|b *)\nEND_FUNCTION_BLOCK";
    let aligned = "(*  @gtt T\n | # | in a | out b |\n |---|------|-------|\n | 1 | x    | T     |\n*)\r\nFUNCTION_BLOCK  F   (* a|b *)\nEND_FUNCTION_BLOCK";
    let dir = tree(&[("a.st", code)]);
    fs::write(dir.path().join("latin.st"), b"(* \xe9 *)").expect("a file");
    let run = |args: &[&str]| rungbook().current_dir(dir.path()).args(["table", "fmt"]).args(args).assert();
    run(&["--check", "a.st"]).code(1);
    assert_eq!(fs::read_to_string(dir.path().join("a.st")).expect("there"), code);
    run(&["a.st"]).code(0);
    assert_eq!(fs::read_to_string(dir.path().join("a.st")).expect("there"), aligned);
    run(&["--check", "a.st"]).code(0);
    run(&["latin.st"]).code(2);
}

#[test]
fn the_columns_of_a_spreadsheet_are_mapped_by_the_configuration() {
    let sheet = "A report;;;;\nNo;Start button;Motor on;Time;What\n1;1;0;10;rest\n2;;1;20;run\n";
    let mapping = |extra: &str| format!("[tables]\ncycle = \"10ms\"\n[[tables.sheet]]\nfiles = [\"*.csv\"]\n{extra}\n");
    let columns = "columns = { No = \"#\", \"Start button\" = \"in Start\", C = \"out Motor\", D = \"dur ms\" }";
    let by_line = mapping(&format!("header = 2\n{columns}"));
    let by_name = mapping(&columns.replace("C =", "\"Motor on\" =").replace("D =", "Time ="));
    for config in [by_line, by_name] {
        let dir = tree(&[("s.csv", sheet), ("rungbook.toml", &config)]);
        let mut command = rungbook();
        command.current_dir(dir.path()).args(["table", "convert", "s.csv", "-o", "-", "--to", "pipe"]);
        let text = super::stdout(&mut command);
        assert!(text.contains("| # | in Start | out Motor | dur  |"), "{text}");
        assert!(text.contains("| 2 |          | 1         | 20ms |"), "{text}");
    }
    let dir = tree(&[
        ("s.csv", sheet),
        ("rungbook.toml", &mapping(columns).replace("No =", "A =").replace("\"Start button\" =", "B =")),
    ]);
    rungbook().current_dir(dir.path()).args(["table", "check", "s.csv"]).assert().code(2);
}
