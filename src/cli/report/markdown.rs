//! `check --format markdown`: a summary for a merge request or a job's page.

use super::outcome::{Outcome, Standing};
use crate::diagnostic::Severity;
use crate::evidence::record::Verdict;

/// More findings than this are counted and not listed.
const LIMIT: usize = 100;

/// The summary.
pub(crate) fn render(outcome: &Outcome<'_>) -> String {
    let numbers = &outcome.numbers;
    let state = if outcome.failed() { "failed" } else { "passed" };
    let mut out = format!("# rungbook: {state}\n\n");
    out.push_str("| findings | error | warning | info |\n|---|---:|---:|---:|\n");
    for standing in Standing::NAMES {
        let counts =
            [Severity::Error, Severity::Warning, Severity::Info].map(|s| outcome.count(s, standing).to_string());
        out.push_str(&format!("| {standing} | {} |\n", counts.join(" | ")));
    }
    let percent = Outcome::percent(numbers.documented, numbers.entities);
    out.push_str(&format!("\n{} of {} entities documented ({percent} %)\n", numbers.documented, numbers.entities));
    if numbers.tables > 0 {
        out.push_str("\n| verdict | tables |\n|---|---:|\n");
        for word in Verdict::WORDS {
            if let Some(count) = numbers.verdicts.get(word) {
                out.push_str(&format!("| {word} | {count} |\n"));
            }
        }
    }
    if !outcome.gate.is_empty() {
        out.push_str("\n| gate | wanted | found | |\n|---|---|---|---|\n");
        for line in &outcome.gate {
            let mark = if line.passed { "passed" } else { "**failed**" };
            out.push_str(&format!("| {} | {} | {} | {mark} |\n", line.key, line.wanted, line.found));
        }
    }
    list(outcome, &mut out);
    out
}

fn list(outcome: &Outcome<'_>, out: &mut String) {
    let count = outcome.new_ones().count();
    if count == 0 {
        return;
    }
    out.push_str("\n| finding | where | what |\n|---|---|---|\n");
    for reported in outcome.new_ones().take(LIMIT) {
        let finding = reported.finding;
        let (path, line) = (cell(outcome.path(finding)), outcome.at(finding).line);
        out.push_str(&format!(
            "| {} `{}` | {path}:{line} | {} |\n",
            finding.severity.name(),
            finding.code.name,
            cell(&finding.message)
        ));
    }
    if count > LIMIT {
        out.push_str(&format!("\nand {} more\n", count - LIMIT));
    }
}

fn cell(text: &str) -> String {
    text.replace('\\', "\\\\").replace('|', "\\|").replace('<', "&lt;").replace(['\n', '\r'], " ")
}
