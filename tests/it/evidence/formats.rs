//! What `check` writes for other programs: each format against its schema or its grammar, and their totals among each other.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::Value;

use super::{rungbook, stdout, tree, validate};

const SARIF_SCHEMA: &str = include_str!("../../schemas/sarif-2.1.0.schema.json");

fn flawed() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/flawed")
}

fn check(format: &str, dir: &Path) -> String {
    stdout(rungbook().args(["check", "-q", "--format", format]).arg(dir))
}

fn json(format: &str, dir: &Path) -> Value {
    serde_json::from_str(&check(format, dir)).expect("JSON")
}

/// A tree with a finding of each standing and a path that has to be escaped.
fn mixed() -> tempfile::TempDir {
    let dir = tree(&[
        ("old.st", "FUNCTION_BLOCK FB_Old\nEND_FUNCTION_BLOCK\n"),
        ("rungbook.toml", "[gate]\ndocumented = 100\nbaseline = \"base.json\"\n"),
    ]);
    rungbook().args(["check", "-q", "--write-baseline"]).arg(dir.path()).assert().code(0);
    super::write(dir.path(), "new & <odd>, 100%.st", "FUNCTION_BLOCK FB_New\nEND_FUNCTION_BLOCK\n");
    let allowed = "// @allow undocumented: told elsewhere\nFUNCTION_BLOCK FB_Allowed\nEND_FUNCTION_BLOCK\n";
    super::write(dir.path(), "allowed.st", allowed);
    dir
}

#[test]
fn sarif_meets_its_schema_and_reads_as_its_types() {
    let mixed = mixed();
    for dir in [flawed().as_path(), mixed.path()] {
        let text = check("sarif", dir);
        let value: Value = serde_json::from_str(&text).expect("JSON");
        validate(SARIF_SCHEMA, &value);
        let log: serde_sarif::sarif::Sarif = serde_json::from_str(&text).expect("SARIF");
        assert_eq!(log.runs.len(), 1);
        let rules = value["runs"][0]["tool"]["driver"]["rules"].as_array().expect("rules");
        for result in value["runs"][0]["results"].as_array().expect("results") {
            let index = usize::try_from(result["ruleIndex"].as_u64().expect("an index")).expect("small");
            assert_eq!(rules[index]["id"], result["ruleId"]);
        }
    }
}

#[test]
fn junit_counts_what_it_holds() {
    let mixed = mixed();
    for dir in [flawed().as_path(), mixed.path()] {
        let text = check("junit", dir);
        let xml = roxmltree::Document::parse(&text).expect("XML");
        for suite in xml.descendants().filter(|node| node.has_tag_name("testsuite")) {
            let cases = || suite.children().filter(|node| node.has_tag_name("testcase"));
            let with = |tag: &str| cases().filter(|case| case.children().any(|node| node.has_tag_name(tag))).count();
            let said = |name: &str| suite.attribute(name).and_then(|value| value.parse::<usize>().ok());
            assert_eq!(said("tests"), Some(cases().count()));
            for (attribute, tag) in [("failures", "failure"), ("errors", "error"), ("skipped", "skipped")] {
                assert_eq!(said(attribute), Some(with(tag)), "{attribute}");
            }
            assert!(cases().all(|case| case.attribute("name").is_some() && case.attribute("classname").is_some()));
        }
    }
}

#[test]
fn code_quality_meets_the_form_that_gitlab_documents() {
    let schema = r#"{"type": "array", "items": {"type": "object",
        "required": ["description", "check_name", "fingerprint", "severity", "location"],
        "properties": {"description": {"type": "string", "minLength": 1}, "check_name": {"type": "string"},
        "fingerprint": {"type": "string"}, "severity": {"enum": ["info", "minor", "major", "critical", "blocker"]},
        "location": {"type": "object", "required": ["path", "lines"], "properties": {"path": {"type": "string"},
        "lines": {"type": "object", "required": ["begin"], "properties": {"begin": {"type": "integer", "minimum": 1}}}}}}}}"#;
    let value = json("gitlab", &flawed());
    validate(schema, &value);
    let prints: std::collections::BTreeSet<&str> =
        value.as_array().expect("a list").iter().filter_map(|entry| entry["fingerprint"].as_str()).collect();
    assert_eq!(prints.len(), value.as_array().expect("a list").len(), "two findings share a fingerprint");
}

#[test]
fn annotations_escape_what_would_end_them() {
    let dir = mixed();
    let text = check("github", dir.path());
    assert!(text.contains("::warning file=new & <odd>%2C 100%25.st,line=1,col=16,title=undocumented::"), "{text}");
    assert!(text.contains("::error title=gate documented::"), "{text}");
}

#[test]
fn prometheus_text_is_read_line_by_line() {
    let text = check("prometheus", &flawed());
    let mut declared = None;
    for line in text.lines() {
        if let Some(rest) = line.strip_prefix("# TYPE ") {
            declared = rest.split(' ').next().map(str::to_owned);
        } else if !line.starts_with('#') {
            let (series, value) = line.rsplit_once(' ').expect("a sample has a value");
            assert!(value.parse::<f64>().is_ok(), "{line}");
            assert_eq!(series.split('{').next().map(str::to_owned), declared, "{line}");
        }
    }
}

#[test]
fn the_badge_is_a_drawing_with_a_title() {
    let text = check("badge", &flawed());
    let svg = roxmltree::Document::parse(&text).expect("XML");
    let title = svg.descendants().find(|node| node.has_tag_name(("http://www.w3.org/2000/svg", "title")));
    assert!(title.and_then(|node| node.text()).is_some_and(|text| text.contains("% documented")));
}

/// Findings that count, by severity.
type Counts = BTreeMap<&'static str, usize>;

fn of_json(value: &Value) -> Counts {
    ["error", "warning", "info"]
        .map(|name| (name, usize::try_from(value["totals"][name].as_u64().expect("a number")).expect("small")))
        .into()
}

fn of_sarif(value: &Value) -> Counts {
    let results = value["runs"][0]["results"].as_array().expect("results");
    let count = |level: &str| {
        let same = |result: &&Value| result["properties"]["standing"] == "new" && result["level"] == level;
        results.iter().filter(same).count()
    };
    [("error", count("error")), ("warning", count("warning")), ("info", count("note"))].into()
}

fn of_junit(text: &str) -> Counts {
    let xml = roxmltree::Document::parse(text).expect("XML");
    let mut counts: Counts = [("error", 0), ("warning", 0), ("info", 0)].into();
    for case in xml.descendants().filter(|node| node.has_tag_name("testcase")) {
        let property = |name: &str| {
            let found =
                case.descendants().find(|node| node.attribute("name") == Some(name) && node.has_tag_name("property"));
            found.and_then(|node| node.attribute("value")).unwrap_or("")
        };
        if property("standing") == "new" {
            *counts.get_mut(property("severity")).expect("a severity") += 1;
        }
    }
    counts
}

fn of_github(text: &str) -> Counts {
    let count = |word: &str| text.lines().filter(|line| line.starts_with(&format!("::{word} file="))).count();
    [("error", count("error")), ("warning", count("warning")), ("info", count("notice"))].into()
}

fn of_gitlab(value: &Value) -> Counts {
    let list = value.as_array().expect("a list");
    let count = |name: &str| list.iter().filter(|entry| entry["severity"] == name).count();
    [("error", count("major")), ("warning", count("minor")), ("info", count("info"))].into()
}

fn of_prometheus(text: &str) -> Counts {
    let value = |severity: &str| {
        let series = format!("rungbook_findings{{severity=\"{severity}\",standing=\"new\"}} ");
        text.lines()
            .find_map(|line| line.strip_prefix(series.as_str()))
            .and_then(|value| value.parse().ok())
            .expect("a sample")
    };
    ["error", "warning", "info"].map(|name| (name, value(name))).into()
}

fn of_markdown(text: &str) -> Counts {
    let line = text.lines().find(|line| line.starts_with("| new |")).expect("the line of what counts");
    let numbers: Vec<usize> = line.split('|').filter_map(|cell| cell.trim().parse().ok()).collect();
    [("error", numbers[0]), ("warning", numbers[1]), ("info", numbers[2])].into()
}

#[test]
fn totals_agree_in_all_formats() {
    let mixed = mixed();
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
    for dir in [flawed().as_path(), mixed.path(), &samples.join("pick-and-place"), &samples.join("basics")] {
        let text = check("json", dir);
        let object: Value = serde_json::from_str(&text).expect("JSON");
        let counts = of_json(&object);
        assert_eq!(of_sarif(&json("sarif", dir)), counts, "SARIF");
        assert_eq!(of_junit(&check("junit", dir)), counts, "JUnit");
        assert_eq!(of_github(&check("github", dir)), counts, "GitHub");
        assert_eq!(of_gitlab(&json("gitlab", dir)), counts, "GitLab");
        assert_eq!(of_prometheus(&check("prometheus", dir)), counts, "Prometheus");
        assert_eq!(of_markdown(&check("markdown", dir)), counts, "Markdown");
        let terminal = rungbook().arg("check").arg(dir).output().expect("it runs");
        let said = String::from_utf8_lossy(&terminal.stderr).into_owned();
        let (e, w, i) = (counts["error"], counts["warning"], counts["info"]);
        assert!(said.contains(&format!("{e} errors, {w} warnings, {i} infos")), "{said}");
    }
}

#[test]
fn the_numbers_of_check_are_those_of_the_manual() {
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples");
    for name in ["pick-and-place", "flawed"] {
        let dir = samples.join(name);
        let out = tempfile::TempDir::new().expect("a folder");
        rungbook().args(["build", "-q", "--json", "-o"]).arg(out.path()).arg(&dir).assert().code(0);
        let model = std::fs::read(out.path().join("model.json")).expect("written");
        let model: Value = serde_json::from_slice(&model).expect("JSON");
        let check = json("json", &dir);
        for (ours, theirs) in
            [("entities", "entities"), ("documented", "documented"), ("tables", "tables"), ("error", "errors")]
        {
            assert_eq!(check["totals"][ours], model["totals"][theirs], "{name}: {ours}");
        }
    }
}

#[test]
fn several_reports_are_written_in_one_run() {
    let out = tempfile::TempDir::new().expect("a folder");
    let argument = |format: &str| format!("{format}={}", out.path().join(format).display());
    let reports = ["sarif", "junit", "markdown", "badge"].map(argument);
    let mut command = rungbook();
    command.args(["check", "-q"]);
    for report in &reports {
        command.args(["--report", report]);
    }
    command.arg(flawed()).assert().code(1);
    for format in ["sarif", "junit", "markdown", "badge"] {
        let written = std::fs::read_to_string(out.path().join(format)).expect("written");
        assert_eq!(written, check(format, &flawed()), "{format}");
    }
    rungbook().args(["check", "--report", "sarif"]).arg(flawed()).assert().code(2);
}
