//! Numbers for others to draw: Prometheus' text format (0.0.4), and a badge as SVG.

use super::outcome::{Outcome, Standing};
use crate::diagnostic::Severity;
use crate::evidence::record::Verdict;

/// Prometheus text.
pub(crate) fn prometheus(outcome: &Outcome<'_>) -> String {
    let numbers = &outcome.numbers;
    let mut out = String::new();
    let mut family = |name: &str, help: &str, samples: &[(String, usize)]| {
        out.push_str(&format!("# HELP {name} {help}\n# TYPE {name} gauge\n"));
        for (labels, value) in samples {
            out.push_str(&format!("{name}{labels} {value}\n"));
        }
    };
    let mut findings = Vec::new();
    for standing in Standing::NAMES {
        for severity in [Severity::Error, Severity::Warning, Severity::Info] {
            let labels = format!("{{severity=\"{}\",standing=\"{standing}\"}}", severity.name());
            findings.push((labels, outcome.count(severity, standing)));
        }
    }
    let verdict = |word: &str| (format!("{{verdict=\"{word}\"}}"), numbers.verdicts.get(word).copied().unwrap_or(0));
    let gate =
        |line: &crate::evidence::policy::gate::Line| (format!("{{key=\"{}\"}}", line.key), usize::from(line.passed));
    let one = |value: usize| vec![(String::new(), value)];
    family("rungbook_findings", "Findings by severity and standing.", &findings);
    family("rungbook_entities", "Entities, members included.", &one(numbers.entities));
    family("rungbook_entities_documented", "Entities with documentation.", &one(numbers.documented));
    family("rungbook_tables", "Test tables by verdict.", &Verdict::WORDS.map(verdict));
    family(
        "rungbook_gate_passed",
        "1 where a line of the gate is reached.",
        &outcome.gate.iter().map(gate).collect::<Vec<_>>(),
    );
    family("rungbook_check_failed", "1 if the check failed.", &one(usize::from(outcome.failed())));
    out
}

/// A badge: how much is documented, and how many tables are verified.
pub(crate) fn badge(outcome: &Outcome<'_>) -> String {
    let numbers = &outcome.numbers;
    let verified = numbers.verdicts.get("verified").copied().unwrap_or(0);
    let violated = numbers.verdicts.get("violated").copied().unwrap_or(0);
    let percent = Outcome::percent(numbers.documented, numbers.entities);
    let documented = format!("{percent} % documented");
    let tables = match numbers.tables {
        0 => "no tables".to_owned(),
        total => format!("{verified}/{total} verified"),
    };
    let good = |done: usize, of: usize| if done == of { "#2c6e49" } else { "#6b5b00" };
    let colour = if violated > 0 { "#9b2226" } else { good(verified, numbers.tables) };
    let parts = [("rungbook", "#444444"), (&documented, good(numbers.documented, numbers.entities)), (&tables, colour)];
    let title = format!("rungbook: {documented}, {tables}");
    let (mut x, mut body) = (0, String::new());
    for (text, fill) in parts {
        let width = 12 + 7 * text.chars().count();
        body.push_str(&format!("<rect x=\"{x}\" width=\"{width}\" height=\"20\" fill=\"{fill}\"/>"));
        let middle = x + width / 2;
        let inner = width - 12;
        body.push_str(&format!(
            "<text x=\"{middle}\" y=\"14\" text-anchor=\"middle\" textLength=\"{inner}\" fill=\"#fff\">{text}</text>"
        ));
        x += width;
    }
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{x}\" height=\"20\" role=\"img\" aria-label=\"{title}\">\
         <title>{title}</title><g font-family=\"Verdana,DejaVu Sans,sans-serif\" font-size=\"11\">{body}</g></svg>\n"
    )
}
