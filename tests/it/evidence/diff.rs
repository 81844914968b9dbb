//! Comparing releases: rules of compatibility one by one, tables cell by cell, folders, bundles and revisions.

use std::process::Command;

use rungbook::evidence::diff::{Comparison, Step, compare};
use rungbook::evidence::snapshot::{Row, Snapshot, Table};
use serde_json::Value;

use super::{rungbook, stdout, tree, write};

/// What `diff` says of two texts of one file.
fn diff(old: &str, new: &str) -> Value {
    let (old, new) = (tree(&[("a.st", old)]), tree(&[("a.st", new)]));
    let mut command = rungbook();
    command.args(["diff", "-q", "--format", "json"]).arg(old.path()).arg(new.path());
    serde_json::from_str(&stdout(&mut command)).expect("JSON")
}

fn block(variables: &str) -> String {
    format!("// A block.\nFUNCTION_BLOCK FB_A\n{variables}\nEND_FUNCTION_BLOCK\n")
}

fn function(variables: &str) -> String {
    format!("// A function.\nFUNCTION F_A : INT\n{variables}\nF_A := 1;\nEND_FUNCTION\n")
}

fn enumeration(values: &str) -> String {
    format!("// A type.\nTYPE E_A : ({values}); END_TYPE\n")
}

/// `(old, new, whether it breaks, a part of what is said)`
fn cases() -> Vec<(String, String, bool, &'static str)> {
    let input = |text: &str| format!("VAR_INPUT\n{text}\nEND_VAR");
    let output = |text: &str| format!("VAR_OUTPUT\n{text}\nEND_VAR");
    let in_out = |text: &str| format!("VAR_IN_OUT\n{text}\nEND_VAR");
    vec![
        (block(""), block(&input("x : INT;")), false, "input `x` added"),
        (block(&input("x : INT;")), block(""), true, "input `x` removed"),
        (block(""), block(&in_out("x : INT;")), true, "in-out `x` added"),
        (block(""), block(&output("x : INT;")), false, "output `x` added"),
        (block(&input("x : INT;")), block(&input("x : DINT;")), false, "`INT` became `DINT`"),
        (block(&input("x : DINT;")), block(&input("x : INT;")), true, "`DINT` became `INT`"),
        (block(&output("x : INT;")), block(&output("x : DINT;")), true, "`INT` became `DINT`"),
        (block(&output("x : DINT;")), block(&output("x : INT;")), false, "`DINT` became `INT`"),
        (block(&input("x : INT := 1;")), block(&input("x : INT := 2;")), false, "initial value `1` became `2`"),
        (block(&input("x : INT; y : INT;")), block(&input("y : INT; x : INT;")), false, "other order"),
        (block(&input("x : INT;")), block(&output("x : INT;")), true, "input became output"),
        (function(&input("x : INT;")), function(&input("x : INT; y : INT;")), true, "input `y` added"),
        (function(&input("x : INT;")), function(&input("x : INT; y : INT := 3;")), false, "input `y` added"),
        (function(&input("x : INT;")), function(&input("y : INT := 3; x : INT;")), true, "input `y` added"),
        (function(&input("x : INT; y : INT;")), function(&input("y : INT; x : INT;")), true, "other order"),
        (function(""), function("").replace(": INT", ": LINT"), true, "type `INT` became `LINT`"),
        (function(""), function("").replace(": INT", ": SINT"), false, "type `INT` became `SINT`"),
        (enumeration("One, Two"), enumeration("One, Two, Three"), false, "value `Three` added"),
        (enumeration("One, Two"), enumeration("One, Half, Two"), true, "value `Half` added"),
        (enumeration("One := 1, Two := 2"), enumeration("One := 1, Half := 3, Two := 2"), false, "value `Half` added"),
        (enumeration("One := 1"), enumeration("One := 2"), true, "initial value"),
        (block(""), String::new(), true, "function-block removed"),
        (String::new(), block(""), false, "function-block added"),
        (block(""), block("").replace("FUNCTION_BLOCK FB_A", "FUNCTION_BLOCK FINAL FB_A"), true, "became final"),
        (block(""), block("").replace("FUNCTION_BLOCK FB_A", "FUNCTION_BLOCK ABSTRACT FB_A"), true, "became abstract"),
    ]
}

#[test]
fn each_change_of_an_interface_has_its_rule() {
    for (old, new, breaking, part) in cases() {
        let value = diff(&old, &new);
        let found = value["interface"].as_array().expect("a list").iter();
        let found: Vec<_> =
            found.filter(|change| change["what"].as_str().is_some_and(|what| what.contains(part))).collect();
        assert_eq!(found.len(), 1, "{part} in {value:#}");
        assert_eq!(found[0]["breaking"], breaking, "{part}: {}", found[0]["why"]);
        assert_eq!(value["advice"], if breaking { "major" } else { "minor" }, "{part}");
    }
}

#[test]
fn a_method_of_an_interface_has_to_be_implemented() {
    let interface = |methods: &str| format!("// An interface.\nINTERFACE I_A\n{methods}END_INTERFACE\n");
    let value = diff(&interface(""), &interface("METHOD M : BOOL\nEND_METHOD\n"));
    assert_eq!(value["interface"][0]["breaking"], true, "{value:#}");
}

#[test]
fn layout_letters_and_bodies_are_no_change_of_an_interface() {
    let old = "// A block.\nFUNCTION_BLOCK FB_A\nVAR_INPUT\n x : ARRAY[0..1] OF INT;\nEND_VAR\nVAR\n y : INT;\nEND_VAR\ny := 1;\nEND_FUNCTION_BLOCK\n";
    let new = "// A block.\nFunction_Block fb_a\nVAR_INPUT\n\n X : array [0..1]  of int; END_VAR\nVAR\n z : INT;\nEND_VAR\nz := 2;\nEND_FUNCTION_BLOCK\n";
    let value = diff(old, new);
    assert_eq!(value["interface"], serde_json::json!([]), "{value:#}");
    assert_eq!(value["advice"], "patch");
}

#[test]
fn documentation_changes_are_told_apart() {
    let value = diff(&block(""), &block("").replace("A block.", "Another block."));
    assert_eq!(value["documentation"][0]["what"], "changed");
    assert_eq!(value["documentation"][0]["new"], "Another block.");
    let value = diff(&block(""), &block("").replace("// A block.\n", ""));
    assert_eq!(value["documentation"][0]["what"], "removed");
    assert_eq!(value["advice"], "patch");
}

#[test]
fn a_table_in_a_comment_is_no_documentation() {
    let comment = |duration: &str| {
        let table = format!("@gtt Works (cycle 10ms)\n| # | in X | dur |\n|---|---|---|\n| 1 | T | {duration} |\n");
        format!("(* A block.\n\n{table}*)\nFUNCTION_BLOCK FB_A\nVAR_INPUT X : BOOL; END_VAR\nEND_FUNCTION_BLOCK\n")
    };
    let value = diff(&comment("1"), &comment("2"));
    assert_eq!(value["documentation"], serde_json::json!([]), "{value:#}");
    assert_eq!(value["tables"][0]["rows"][0]["duration"]["new"], "2");
}

fn table(rows: &[(&str, &[&str], &str)], verdict: &str) -> Snapshot {
    let rows = rows.iter().map(|(id, cells, duration)| Row {
        id: (*id).to_owned(),
        cells: cells.iter().map(|cell| (*cell).to_owned()).collect(),
        duration: (*duration).to_owned(),
        remark: String::new(),
    });
    let table = Table {
        block: "FB_A".to_owned(),
        name: "Works".to_owned(),
        columns: vec![("in".to_owned(), "X".to_owned()), ("out".to_owned(), "Y".to_owned())],
        rows: rows.collect(),
        verdict: verdict.to_owned(),
        ..Table::default()
    };
    Snapshot { tables: vec![table], ..Snapshot::default() }
}

/// `what id: cells that changed` of each row.
fn rows(comparison: &Comparison) -> Vec<String> {
    let one = |row: &rungbook::evidence::diff::tables::RowChange| {
        let cells: Vec<String> = row
            .cells
            .iter()
            .chain([&row.duration])
            .filter(|cell| cell.changed)
            .map(|cell| format!("{}>{}", cell.old, cell.new))
            .collect();
        format!("{} {}: {}", row.what, row.id, cells.join(" "))
    };
    comparison.tables[0].rows.iter().map(one).collect()
}

#[test]
fn tables_are_compared_cell_by_cell() {
    let old = table(&[("1", &["F", "F"], "1"), ("2", &["T", "T"], "< 5"), ("3", &["F", "-"], "-")], "verified");
    let new = table(&[("1", &["F", "F"], "1"), ("2", &["T", "F"], "< 7"), ("3", &["F", "-"], "-")], "unverified");
    let comparison = compare(&old, &new);
    assert_eq!(rows(&comparison), ["same 1: ", "changed 2: T>F < 5>< 7", "same 3: "]);
    assert_eq!(comparison.lost[0].now, "unverified");
    assert_eq!(comparison.advice, Step::Minor);
}

#[test]
fn evidence_that_is_lost_is_no_patch() {
    let verified = table(&[("1", &["F", "F"], "1")], "verified");
    for (now, step) in [("violated", Step::Major), ("bounded", Step::Minor), ("verified", Step::Patch)] {
        assert_eq!(compare(&verified, &table(&[("1", &["F", "F"], "1")], now)).advice, step, "{now}");
    }
    assert_eq!(compare(&verified, &Snapshot::default()).advice, Step::Major);
}

#[test]
fn an_inserted_row_does_not_change_those_below_it() {
    let old = table(&[("1", &["F", "F"], "1"), ("2", &["T", "T"], "5")], "verified");
    let new = table(&[("1", &["F", "F"], "1"), ("2", &[">3", "<9"], "2"), ("3", &["T", "T"], "5")], "verified");
    let comparison = compare(&old, &new);
    assert_eq!(rows(&comparison), ["same 1: ", "added 2: >>3 ><9 >2", "same 3: "]);
    assert!(comparison.lost.is_empty());
    let back = compare(&new, &old);
    assert_eq!(rows(&back)[1], "removed 2: >3> <9> 2>");
}

#[test]
fn a_column_that_came_is_not_a_change_of_the_others() {
    let old = table(&[("1", &["F", "F"], "1")], "verified");
    let mut new = table(&[("1", &["F", "T", "F"], "1")], "verified");
    new.tables[0].columns.insert(1, ("in".to_owned(), "Z".to_owned()));
    let comparison = compare(&old, &new);
    let columns: Vec<_> =
        comparison.tables[0].columns.iter().map(|column| (column.name.as_str(), column.what)).collect();
    assert_eq!(columns, [("X", "same"), ("Z", "added"), ("Y", "same")]);
    assert_eq!(rows(&comparison), ["changed 1: >T"]);
}

#[test]
fn folders_bundles_and_revisions_compare_alike() {
    let with = |ty: &str| block(&format!("VAR_INPUT\nx : {ty};\nEND_VAR"));
    let dir = tree(&[("a.st", &with("DINT"))]);
    let git = |args: &[&str]| {
        let mut command = Command::new("git");
        command.current_dir(dir.path()).args(["-c", "user.name=T", "-c", "user.email=t@example.com"]).args(args);
        command.output().is_ok_and(|output| output.status.success())
    };
    let release = dir.path().join("old.zip");
    rungbook().args(["evidence", "bundle", "-q", "--no-pdf", "-o"]).arg(&release).arg(dir.path()).assert().code(0);
    let bundled = std::fs::read(&release).expect("written");
    let committed = git(&["init", "-q"]) && git(&["add", "a.st"]) && git(&["commit", "-qm", "one"]);
    write(dir.path(), "a.st", &with("INT"));
    let out = tree(&[]);
    std::fs::write(out.path().join("old.zip"), bundled).expect("written");
    let mut olds = vec![out.path().join("old.zip").display().to_string()];
    if committed {
        olds.push("HEAD".to_owned());
    }
    for old in olds {
        let mut command = rungbook();
        command.current_dir(dir.path()).args(["diff", "--deny-breaking", &old, "."]);
        let run = command.assert().code(1);
        let said = String::from_utf8_lossy(&run.get_output().stdout).into_owned();
        assert!(said.contains("incompatible: FB_A: input `x`: type `DINT` became `INT`"), "{old}: {said}");
    }
    rungbook().current_dir(dir.path()).args(["diff", "no-such-thing"]).assert().code(2);
    rungbook().current_dir(dir.path()).args(["diff", ".", "."]).assert().code(0).stdout("");
}

#[test]
fn pages_of_changes_escape_what_they_show() {
    let old = tree(&[("a.st", &block("VAR_INPUT\nx : STRING := '<b>|';\nEND_VAR"))]);
    let new = tree(&[("a.st", &block("VAR_INPUT\nx : STRING := '<i>&';\nEND_VAR"))]);
    let page =
        |format: &str| stdout(rungbook().args(["diff", "-q", "--format", format]).arg(old.path()).arg(new.path()));
    let html = page("html");
    assert!(html.contains("&lt;b&gt;|") && !html.contains("<b>"), "{html}");
    assert!(html.starts_with("<!DOCTYPE html>"));
    let markdown = page("markdown");
    assert!(markdown.contains("**minor** release"), "{markdown}");
}

#[test]
fn the_manual_has_a_page_of_changes() {
    let old = tree(&[("a.st", &block(""))]);
    let new = tree(&[("a.st", &block("VAR_INPUT\nx : INT;\nEND_VAR"))]);
    let out = tree(&[]);
    let mut command = rungbook();
    command.args(["build", "-q", "--html", "--evidence", "--previous"]).arg(old.path()).arg("-o").arg(out.path());
    command.arg(new.path()).assert().code(0);
    let changes = std::fs::read_to_string(out.path().join("html/chapters/changes.html")).expect("written");
    assert!(changes.contains("added"), "{changes}");
    let evidence = std::fs::read_to_string(out.path().join("html/chapters/evidence.html")).expect("written");
    for part in ["Sign-off", "What is claimed", "how to check again"] {
        assert!(evidence.contains(part), "{part}");
    }
}
