//! `check --format sarif`: SARIF 2.1.0 (OASIS), as GitHub's code scanning and the viewers of editors read it.
//!
//! A finding of the baseline is `unchanged`, an allowed one is suppressed in source; a table that is not verified is a
//! result as well, of the rule `table-verdict`, whose kind says which verdict it has.

use serde_json::{Value, json};

use super::outcome::{Outcome, Reported, Standing, TableLine, codes_of};
use crate::diagnostic::{Code, Severity};

/// The rule of the results that tell verdicts.
pub(crate) const VERDICT_RULE: &str = "table-verdict";

/// The log file.
pub(crate) fn render(outcome: &Outcome<'_>) -> String {
    let codes = codes_of(outcome);
    let mut rules: Vec<Value> = codes.iter().map(|code| rule(code)).collect();
    rules.push(json!({
        "id": VERDICT_RULE,
        "shortDescription": {"text": "The verdict of a test table"},
        "defaultConfiguration": {"level": "note"},
    }));
    let index = |name: &str| codes.iter().position(|code| code.name == name).unwrap_or(codes.len());
    let findings = outcome.findings.iter().map(|reported| result(outcome, reported, index(reported.finding.code.name)));
    let verdicts = outcome.tables.iter().map(|line| verdict(line, codes.len()));
    let version = env!("CARGO_PKG_VERSION");
    let mut run = json!({
        "tool": {"driver": {"name": "rungbook", "version": version, "semanticVersion": version, "rules": rules}},
        "columnKind": "unicodeCodePoints",
        "originalUriBaseIds": {"ROOT": {"description": {"text": "The root of the source tree."}}},
        "invocations": [{"executionSuccessful": true, "exitCode": i32::from(outcome.failed())}],
        "results": findings.chain(verdicts).collect::<Vec<_>>(),
    });
    if !outcome.stamp.commit.is_empty() {
        run["properties"] = json!({"commit": outcome.stamp.commit});
    }
    let log = json!({
        "$schema": "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json",
        "version": "2.1.0",
        "runs": [run],
    });
    format!("{log:#}\n")
}

const fn level(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Info => "note",
    }
}

fn rule(code: &Code) -> Value {
    let text = code.text();
    json!({
        "id": code.name,
        "shortDescription": {"text": code.title()},
        "help": {"text": text, "markdown": text},
        "defaultConfiguration": {"level": level(code.severity)},
    })
}

/// A URI reference: what RFC 3986 does not allow in a path is escaped.
pub(crate) fn uri(path: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~/!$&'()*+,;=@".contains(&byte);
    let mut out = String::new();
    for byte in path.bytes() {
        if plain(byte) { out.push(char::from(byte)) } else { out.push_str(&format!("%{byte:02X}")) }
    }
    out
}

fn location(path: &str, region: &Value) -> Value {
    json!({"physicalLocation": {"artifactLocation": {"uri": uri(path), "uriBaseId": "ROOT"}, "region": region}})
}

fn result(outcome: &Outcome<'_>, reported: &Reported<'_>, index: usize) -> Value {
    let finding = reported.finding;
    let at = outcome.at(finding);
    let region = json!({"startLine": at.line, "startColumn": at.column});
    let mut text = finding.message.clone();
    for help in &finding.help {
        text.push_str("\nhelp: ");
        text.push_str(help);
    }
    let related = finding.labels.iter().enumerate().map(|(id, label)| {
        let at = outcome.files.line_column(label.place);
        let region = json!({"startLine": at.line, "startColumn": at.column});
        let mut place = location(&outcome.files.get(label.place.file).path, &region);
        place["id"] = json!(id);
        place["message"] = json!({"text": label.message});
        place
    });
    let related: Vec<Value> = related.collect();
    let mut value = json!({
        "ruleId": finding.code.name,
        "ruleIndex": index,
        "level": level(finding.severity),
        "message": {"text": text},
        "locations": [location(outcome.path(finding), &region)],
        "partialFingerprints": {"rungbook/v1": reported.fingerprint},
        "baselineState": if matches!(reported.standing, Standing::Old) { "unchanged" } else { "new" },
        "properties": {"standing": reported.standing.name()},
    });
    if !related.is_empty() {
        value["relatedLocations"] = Value::Array(related);
    }
    match &reported.standing {
        Standing::Allowed(allowance) => {
            value["suppressions"] =
                json!([{"kind": "inSource", "status": "accepted", "justification": allowance.reason}]);
        }
        Standing::NewRule => {
            let why = "the rule is younger than the baseline";
            value["suppressions"] = json!([{"kind": "external", "status": "accepted", "justification": why}]);
        }
        Standing::New | Standing::Old => {}
    }
    value
}

fn verdict(line: &TableLine, index: usize) -> Value {
    let (kind, level) = match line.verdict {
        "verified" => ("pass", "none"),
        "violated" => ("fail", "error"),
        "unusable" => ("fail", "warning"),
        _ => ("open", "none"),
    };
    let detail = if line.detail.is_empty() { String::new() } else { format!(" ({})", line.detail) };
    json!({
        "ruleId": VERDICT_RULE,
        "ruleIndex": index,
        "kind": kind,
        "level": level,
        "message": {"text": format!("test table `{}` of `{}`: {}{detail}", line.name, line.block, line.verdict)},
        "locations": [location(&line.file, &json!({"startLine": line.line}))],
        "properties": {"verdict": line.verdict},
    })
}
