//! What passes and what does not: allowances, the baseline, the gate.

use std::fs;

use serde_json::Value;

use super::{rungbook, stdout, tree, write};

fn check(dir: &std::path::Path) -> Value {
    serde_json::from_str(&stdout(rungbook().args(["check", "-q", "--format", "json"]).arg(dir))).expect("JSON")
}

/// `code standing` of each finding, sorted.
fn standings(value: &Value) -> Vec<String> {
    let word = |value: &Value| value.as_str().expect("a word").to_owned();
    let list = value["findings"].as_array().expect("findings").iter();
    let mut out: Vec<String> = list.map(|f| format!("{} {}", word(&f["code"]), word(&f["standing"]))).collect();
    out.sort();
    out
}

const BARE: &str = "FUNCTION_BLOCK FB_A\nVAR_INPUT\n    a : BOOL;\nEND_VAR\nEND_FUNCTION_BLOCK\n";

#[test]
fn an_allowance_above_a_declaration_speaks_of_all_of_it() {
    let dir = tree(&[("a.st", &format!("// @allow undocumented, undocumented-member: generated\n{BARE}"))]);
    let value = check(dir.path());
    assert_eq!(standings(&value), ["undocumented allowed", "undocumented-member allowed"]);
    assert_eq!(value["findings"][0]["allowed"]["reason"], "generated");
    assert_eq!(value["failed"], false);
    let line = "FUNCTION_BLOCK FB_A\nEND_FUNCTION_BLOCK\n";
    let two = format!("// @allow undocumented: generated\n{line}{}", line.replace("FB_A", "FB_B"));
    let dir = tree(&[("a.st", &two)]);
    assert_eq!(
        standings(&check(dir.path())),
        ["undocumented allowed", "undocumented new"],
        "the second one is not meant"
    );
}

#[test]
fn an_allowance_is_no_documentation_and_hides_none() {
    let text = "// Opens and closes.\n// @allow missing-brief: not wanted\nFUNCTION_BLOCK FB_A\nEND_FUNCTION_BLOCK\n";
    let dir = tree(&[("a.st", text)]);
    assert_eq!(standings(&check(dir.path())), ["unused-allowance new"]);
    let text = "// @allow missing-brief: not wanted\n// Opens and closes.\nFUNCTION_BLOCK FB_A\nEND_FUNCTION_BLOCK\n";
    let dir = tree(&[("a.st", text)]);
    assert_eq!(standings(&check(dir.path())), ["unused-allowance new"]);
}

#[test]
fn a_pragma_allows_as_a_comment_does() {
    let text = "{attribute 'rungbook.allow' := 'undocumented: generated (owner A. Vogel, until 2099-12-31)'}\n";
    let dir = tree(&[("a.st", &format!("{text}FUNCTION_BLOCK FB_A\nEND_FUNCTION_BLOCK\n"))]);
    let value = check(dir.path());
    assert_eq!(standings(&value), ["undocumented allowed"]);
    assert_eq!(value["findings"][0]["allowed"]["owner"], "A. Vogel");
}

#[test]
fn an_allowance_runs_out() {
    let text =
        "// @allow undocumented: later (owner A. Vogel, until 2026-11-21)\nFUNCTION_BLOCK FB_A\nEND_FUNCTION_BLOCK\n";
    let dir = tree(&[("a.st", text)]);
    assert_eq!(standings(&check(dir.path())), ["expired-allowance new", "undocumented new"]);
    let dir = tree(&[("a.st", &text.replace("11-21", "11-22"))]);
    assert_eq!(standings(&check(dir.path())), ["undocumented allowed"], "the last day counts");
}

#[test]
fn a_malformed_allowance_allows_nothing_and_says_why() {
    for (text, part) in [
        ("// @allow undocumented\n", "gives no reason"),
        ("// @allow undocumentd: typo\n", "no finding's code"),
        ("// @allow undocumented: x (until tomorrow)\n", "no date"),
    ] {
        let dir = tree(&[("a.st", &format!("{text}FUNCTION_BLOCK FB_A\nEND_FUNCTION_BLOCK\n"))]);
        let value = check(dir.path());
        assert_eq!(standings(&value), ["malformed-allowance new", "undocumented new"], "{text}");
        assert!(value["findings"].to_string().contains(part), "{text}");
    }
}

#[test]
fn the_gate_can_ask_for_owner_and_day() {
    let gate = "[gate]\nno-suppressed-without-owner = true\n";
    let text = "// @allow undocumented: later\nFUNCTION_BLOCK FB_A\nEND_FUNCTION_BLOCK\n";
    let dir = tree(&[("a.st", text), ("rungbook.toml", gate)]);
    rungbook().arg("check").arg(dir.path()).assert().code(1);
    write(dir.path(), "a.st", &text.replace("later", "later (owner A. Vogel, until 2099-01-01)"));
    rungbook().arg("check").arg(dir.path()).assert().code(0);
}

#[test]
fn a_baseline_survives_moved_lines_and_stops_new_findings() {
    let dir = tree(&[("a.st", BARE), ("rungbook.toml", "[gate]\nbaseline = \"base.json\"\n")]);
    says(dir.path(), 2, "--write-baseline");
    rungbook().args(["check", "--write-baseline"]).arg(dir.path()).assert().code(0);
    let first = fs::read(dir.path().join("base.json")).expect("written");
    rungbook().arg("check").arg(dir.path()).assert().code(0);
    write(dir.path(), "a.st", &format!("\n\n   {}", BARE.replace("    a", "  \ta")));
    rungbook().arg("check").arg(dir.path()).assert().code(0);
    write(dir.path(), "b.st", &BARE.replace("FB_A", "FB_B"));
    let value = check(dir.path());
    assert_eq!(value["failed"], true);
    assert!(
        value["findings"]
            .as_array()
            .expect("findings")
            .iter()
            .all(|f| (f["file"] == "b.st") == (f["standing"] == "new"))
    );
    fs::remove_file(dir.path().join("b.st")).expect("there");
    write(dir.path(), "a.st", BARE);
    rungbook().args(["check", "--write-baseline"]).arg(dir.path()).assert().code(0);
    assert_eq!(fs::read(dir.path().join("base.json")).expect("written"), first, "the same findings, the same bytes");
}

#[test]
fn a_rule_younger_than_the_baseline_fails_nothing() {
    let dir = tree(&[("a.st", BARE), ("rungbook.toml", "[gate]\nbaseline = \"base.json\"\n")]);
    rungbook().args(["check", "--write-baseline"]).arg(dir.path()).assert().code(0);
    let mut base: Value =
        serde_json::from_slice(&fs::read(dir.path().join("base.json")).expect("written")).expect("JSON");
    base["codes"] =
        base["codes"].as_array().expect("codes").iter().filter(|code| *code != "undocumented").cloned().collect();
    base["findings"] = base["findings"]
        .as_array()
        .expect("findings")
        .iter()
        .filter(|f| f["code"] != "undocumented")
        .cloned()
        .collect();
    write(dir.path(), "base.json", &base.to_string());
    let value = check(dir.path());
    assert_eq!(standings(&value), ["undocumented new-rule", "undocumented-member baseline"]);
    assert_eq!(value["failed"], false);
}

#[test]
fn the_gate_counts_without_rounding_and_refuses_nonsense() {
    let dir = tree(&[
        ("a.st", "// Opens.\nFUNCTION_BLOCK FB_A\nEND_FUNCTION_BLOCK\n"),
        ("b.st", "FUNCTION_BLOCK FB_B\nEND_FUNCTION_BLOCK\n"),
        ("rungbook.toml", "[gate]\ndocumented = 50\n[audit]\ndeny = \"error\"\n"),
    ]);
    rungbook().arg("check").arg(dir.path()).assert().code(0);
    write(dir.path(), "rungbook.toml", "[gate]\ndocumented = 51\n[audit]\ndeny = \"error\"\n");
    says(dir.path(), 1, "gate documented: failed");
    write(dir.path(), "rungbook.toml", "[gate]\ndocumented = 101\n");
    rungbook().arg("check").arg(dir.path()).assert().code(2);
}

/// `check` ends with `code` and says `part`.
fn says(dir: &std::path::Path, code: i32, part: &str) {
    let run = rungbook().arg("check").arg(dir).assert().code(code);
    let said = String::from_utf8_lossy(&run.get_output().stderr).into_owned();
    assert!(said.contains(part), "{part} is missing in:\n{said}");
}
