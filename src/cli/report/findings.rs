//! Findings alone as one JSON object, for `table check --format json`.

use serde_json::{Value, json};

use crate::diagnostic::{Finding, Severity};
use crate::text::Files;

/// `{"findings": […], "totals": {…}, "failed": …}`.
pub(crate) fn render(findings: &[Finding], files: &Files, failed: bool) -> String {
    let count = |severity| findings.iter().filter(|finding| finding.severity == severity).count();
    let list: Vec<Value> = findings.iter().map(|finding| one(finding, files)).collect();
    let object = json!({
        "findings": list,
        "totals": {
            "error": count(Severity::Error),
            "warning": count(Severity::Warning),
            "info": count(Severity::Info),
        },
        "failed": failed,
    });
    format!("{object:#}")
}

fn one(finding: &Finding, files: &Files) -> Value {
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
