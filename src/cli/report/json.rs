//! `check --format json` and `table check --format json`: everything as one JSON object.

use serde_json::{Map, Value, json};

use super::outcome::{Outcome, Reported, Standing, TableLine};
use crate::diagnostic::{Finding, Severity};
use crate::text::Files;

/// `{"findings": […], "totals": {…}, "tables": […], "gate": […], "failed": …}`; the totals count what counts.
pub(crate) fn render(outcome: &Outcome<'_>) -> String {
    let list: Vec<Value> = outcome.findings.iter().map(|reported| one(outcome, reported)).collect();
    let gate = outcome
        .gate
        .iter()
        .map(|line| json!({"key": line.key, "wanted": line.wanted, "found": line.found, "passed": line.passed}));
    let object = json!({
        "findings": list,
        "totals": totals(outcome),
        "tables": outcome.tables.iter().map(table).collect::<Vec<_>>(),
        "gate": gate.collect::<Vec<_>>(),
        "failed": outcome.failed(),
    });
    format!("{object:#}\n")
}

/// Findings alone, which all count: `{"findings": […], "totals": {…}, "failed": …}`.
pub(crate) fn findings(findings: &[Finding], files: &Files, failed: bool) -> String {
    let count = |severity| findings.iter().filter(|finding| finding.severity == severity).count();
    let object = json!({
        "findings": findings.iter().map(|one| finding(one, files)).collect::<Vec<_>>(),
        "totals": {
            "error": count(Severity::Error),
            "warning": count(Severity::Warning),
            "info": count(Severity::Info),
        },
        "failed": failed,
    });
    format!("{object:#}\n")
}

fn finding(finding: &Finding, files: &Files) -> Value {
    let at = files.line_column(finding.place);
    json!({
        "code": finding.code.name,
        "severity": finding.severity.name(),
        "message": finding.message,
        "file": files.get(finding.place.file).path,
        "line": at.line,
        "column": at.column,
        "help": finding.help,
    })
}

fn totals(outcome: &Outcome<'_>) -> Value {
    let mut map = Map::new();
    for severity in [Severity::Error, Severity::Warning, Severity::Info] {
        map.insert(severity.name().to_owned(), outcome.count(severity, "new").into());
    }
    for standing in Standing::NAMES.iter().skip(1) {
        let count = outcome.findings.iter().filter(|reported| reported.standing.name() == *standing).count();
        map.insert((*standing).to_owned(), count.into());
    }
    let numbers = &outcome.numbers;
    map.insert("baseline-gone".to_owned(), outcome.gone.into());
    map.insert("entities".to_owned(), numbers.entities.into());
    map.insert("documented".to_owned(), numbers.documented.into());
    map.insert("tables".to_owned(), numbers.tables.into());
    map.insert("verdicts".to_owned(), json!(numbers.verdicts));
    Value::Object(map)
}

fn table(line: &TableLine) -> Value {
    json!({
        "name": line.name,
        "unit": line.block,
        "file": line.file,
        "line": line.line,
        "verdict": line.verdict,
        "detail": line.detail,
        "engine": line.engine,
    })
}

fn one(outcome: &Outcome<'_>, reported: &Reported<'_>) -> Value {
    let mut value = finding(reported.finding, outcome.files);
    value["standing"] = reported.standing.name().into();
    value["fingerprint"] = reported.fingerprint.clone().into();
    if let Standing::Allowed(allowance) = &reported.standing {
        value["allowed"] = json!({"reason": allowance.reason, "owner": allowance.owner, "until": allowance.until});
    }
    value
}
