//! Findings as the two forges show them beside a change: GitHub's workflow commands, GitLab's code quality report.

use serde_json::{Value, json};

use super::outcome::Outcome;
use crate::diagnostic::Severity;

/// `::error file=…,line=…,col=…,title=…::message`, one line a finding that counts.
pub(crate) fn github(outcome: &Outcome<'_>) -> String {
    let mut out = String::new();
    for reported in outcome.new_ones() {
        let finding = reported.finding;
        let at = outcome.at(finding);
        let command = match finding.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Info => "notice",
        };
        let path = property(outcome.path(finding));
        let (line, column, title) = (at.line, at.column, finding.code.name);
        out.push_str(&format!(
            "::{command} file={path},line={line},col={column},title={title}::{}\n",
            data(&finding.message)
        ));
    }
    for line in outcome.gate.iter().filter(|line| !line.passed) {
        let text = format!("wanted {}, found {}", line.wanted, line.found);
        out.push_str(&format!("::error title=gate {}::{}\n", property(line.key), data(&text)));
    }
    out
}

/// As GitHub's toolkit escapes the text of a command.
fn data(text: &str) -> String {
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// As GitHub's toolkit escapes a property.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

/// GitLab's code quality report: a list of what counts.
pub(crate) fn gitlab(outcome: &Outcome<'_>) -> String {
    let one = |reported: &super::outcome::Reported<'_>| {
        let finding = reported.finding;
        let severity = match finding.severity {
            Severity::Error => "major",
            Severity::Warning => "minor",
            Severity::Info => "info",
        };
        json!({
            "description": finding.message,
            "check_name": finding.code.name,
            "fingerprint": reported.fingerprint,
            "severity": severity,
            "location": {"path": outcome.path(finding), "lines": {"begin": outcome.at(finding).line}},
        })
    };
    let list: Vec<Value> = outcome.new_ones().map(one).collect();
    format!("{:#}\n", Value::Array(list))
}
