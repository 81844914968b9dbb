//! `check --format junit`: JUnit XML, as build servers read it.
//!
//! Three suites: a case for each test table with its rows as properties, a case for each finding, a case for each line of
//! the gate. A table passes only if it is verified; a verdict that claims nothing is a skipped case.

use quick_junit::{NonSuccessKind, Property, Report, TestCase, TestCaseStatus, TestSuite};

use super::outcome::{Outcome, Reported, Standing, TableLine};

/// The report.
pub(crate) fn render(outcome: &Outcome<'_>) -> Result<String, String> {
    let mut report = Report::new("rungbook");
    let mut tables = TestSuite::new("tables");
    tables.add_test_cases(outcome.tables.iter().map(table));
    let mut findings = TestSuite::new("findings");
    findings.add_test_cases(outcome.findings.iter().map(|reported| finding(outcome, reported)));
    let mut gate = TestSuite::new("gate");
    gate.add_test_cases(outcome.gate.iter().map(|line| {
        let status = if line.passed {
            TestCaseStatus::success()
        } else {
            failed(NonSuccessKind::Failure, "gate", &format!("wanted {}, found {}", line.wanted, line.found))
        };
        case(line.key, "gate", status)
    }));
    report.add_test_suites([tables, findings, gate]);
    report.to_string().map_err(|error| error.to_string())
}

fn case(name: &str, class: &str, status: TestCaseStatus) -> TestCase {
    let mut case = TestCase::new(name, status);
    case.set_classname(class);
    case
}

fn failed(kind: NonSuccessKind, type_: &str, message: &str) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(kind);
    status.set_type(type_).set_message(message);
    status
}

fn skipped(message: &str) -> TestCaseStatus {
    let mut status = TestCaseStatus::skipped();
    status.set_message(message);
    status
}

fn table(line: &TableLine) -> TestCase {
    let text =
        if line.detail.is_empty() { line.verdict.to_owned() } else { format!("{}: {}", line.verdict, line.detail) };
    let status = match line.verdict {
        "verified" => TestCaseStatus::success(),
        "violated" => failed(NonSuccessKind::Failure, "violated", &text),
        "unusable" => failed(NonSuccessKind::Error, "unusable", &text),
        _ => skipped(&text),
    };
    let mut case = case(&line.name, if line.block.is_empty() { "tables" } else { &line.block }, status);
    case.add_property(Property::new("verdict", line.verdict));
    case.add_property(Property::new("file", format!("{}:{}", line.file, line.line)));
    if !line.engine.is_empty() {
        case.add_property(Property::new("engine", line.engine.as_str()));
    }
    for (id, sentence) in &line.rows {
        case.add_property(Property::new(format!("row {id}"), sentence.as_str()));
    }
    case
}

fn finding(outcome: &Outcome<'_>, reported: &Reported<'_>) -> TestCase {
    let finding = reported.finding;
    let at = outcome.at(finding);
    let path = outcome.path(finding);
    let text = format!("{path}:{}:{}: {}", at.line, at.column, finding.message);
    let status = match &reported.standing {
        Standing::New if outcome.denies(reported) => failed(NonSuccessKind::Failure, finding.severity.name(), &text),
        Standing::New => skipped(&text),
        Standing::Old => skipped(&format!("in the baseline: {text}")),
        Standing::NewRule => skipped(&format!("the rule is younger than the baseline: {text}")),
        Standing::Allowed(allowance) => skipped(&format!("allowed, {}: {text}", allowance.reason)),
    };
    let mut case = case(&format!("{} {path}:{}", finding.code.name, at.line), path, status);
    case.add_property(Property::new("code", finding.code.name));
    case.add_property(Property::new("severity", finding.severity.name()));
    case.add_property(Property::new("standing", reported.standing.name()));
    case
}
