//! Played tables in the terminal, as JSON and as JUnit XML.

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use serde_json::{Value, json};

use crate::cli::Exit;
use crate::machine::trace::diagram;
use crate::pipeline::Project;
use crate::pipeline::run::{Failure, NotPlayed, Outcome};
use crate::semantics::show::literal;

/// A table and how it was played.
pub(crate) struct Line {
    /// Its name.
    table: String,
    /// Its block; empty for none.
    unit: String,
    /// The outcome, or why there is none.
    pub(crate) outcome: Result<Outcome, NotPlayed>,
}

impl Line {
    /// What is told of a table.
    pub(crate) fn new(project: &Project, index: usize, outcome: Result<Outcome, NotPlayed>) -> Self {
        let attached = &project.tables[index];
        let unit = attached.item.map_or_else(String::new, |item| project.catalogue.qualified_name(item));
        Self { table: attached.table.name.clone(), unit, outcome }
    }

    const fn word(&self) -> &'static str {
        match &self.outcome {
            Ok(outcome) => outcome.word,
            Err(NotPlayed { is_wrong: true, .. }) => "unusable",
            Err(_) => "unsupported",
        }
    }

    fn title(&self) -> String {
        if self.unit.is_empty() { self.table.clone() } else { format!("{}: {}", self.unit, self.table) }
    }
}

/// The exit code: what is violated counts before what is unusable, and that before what cannot be played.
pub(crate) fn exit(lines: &[Line]) -> Exit {
    let any = |words: &[&str]| lines.iter().any(|line| words.contains(&line.word()));
    if any(&["violated", "fault"]) {
        Exit::Findings
    } else if any(&["unusable"]) {
        Exit::Unusable
    } else if any(&["unsupported"]) {
        Exit::Undecided
    } else {
        Exit::Ok
    }
}

/// How many passed.
pub(crate) fn totals(lines: &[Line]) -> String {
    let passed = lines.iter().filter(|line| line.outcome.as_ref().is_ok_and(|outcome| outcome.passed)).count();
    let not_played = lines.iter().filter(|line| line.outcome.is_err()).count();
    let failed = lines.len() - passed - not_played;
    format!("{} tables: {passed} passed, {failed} failed, {not_played} not played", lines.len())
}

/// For people.
pub(crate) fn text(lines: &[Line], diagrams: bool) -> String {
    let mut out = String::new();
    for line in lines {
        out.push_str(&format!("{}\n", line.title()));
        match &line.outcome {
            Err(NotPlayed { reasons, .. }) => {
                out.push_str("  not played\n");
                reasons.iter().for_each(|reason| out.push_str(&format!("    {reason}\n")));
            }
            Ok(outcome) => {
                out.push_str(&told(outcome));
                if diagrams || lines.len() == 1 || !outcome.passed {
                    out.push('\n');
                    out.push_str(&drawn(outcome));
                }
            }
        }
        out.push('\n');
    }
    out
}

/// The rows with their cycles, and how it ended.
fn told(outcome: &Outcome) -> String {
    let mut out = String::new();
    for (name, value) in &outcome.globals {
        out.push_str(&format!("  with {name} = {value}\n"));
    }
    let mut from = 0;
    for (cycle, rows) in outcome.rows.iter().enumerate() {
        let next = outcome.rows.get(cycle + 1);
        if next == Some(rows) || rows.is_empty() {
            continue;
        }
        let cycles = if from == cycle {
            format!("cycle {}", cycle + 1)
        } else {
            format!("cycles {} to {}", from + 1, cycle + 1)
        };
        let word = if rows.len() == 1 { "row" } else { "rows" };
        out.push_str(&format!("  {cycles:<20} {word} {}: pass\n", rows.join(", ")));
        from = cycle + 1;
    }
    out.push_str(&format!("  {}\n", outcome.end));
    outcome.failures.iter().for_each(|failure| out.push_str(&format!("    {}\n", difference(failure))));
    out
}

fn difference(failure: &Failure) -> String {
    let Failure { row, column, expected, seen } = failure;
    let seen = if seen.is_empty() { String::new() } else { format!(", seen `{seen}`") };
    format!("row {row}, `{column}`: expected `{expected}`{seen}")
}

fn drawn(outcome: &Outcome) -> String {
    let mark = (!outcome.passed).then(|| outcome.trace.cycles().saturating_sub(1));
    let options = diagram::Options { mark, ..diagram::Options::default() };
    let drawn = diagram::draw(&outcome.trace, &options);
    drawn.lines().map(|line| if line.is_empty() { "\n".to_owned() } else { format!("  {line}\n") }).collect()
}

/// `{"tables": […]}`: for each its outcome, the rows possible after each cycle, and the values of its variables.
pub(crate) fn json(lines: &[Line]) -> Value {
    json!({"tables": lines.iter().map(one).collect::<Vec<_>>()})
}

fn one(line: &Line) -> Value {
    let mut value = json!({"table": line.table, "unit": line.unit, "outcome": line.word()});
    match &line.outcome {
        Err(NotPlayed { reasons, .. }) => value["reasons"] = json!(reasons),
        Ok(outcome) => {
            let failure = |failure: &Failure| json!({"row": failure.row, "column": failure.column, "expected": failure.expected, "seen": failure.seen});
            let signal = |signal: &crate::machine::trace::Signal| {
                let values: Vec<String> = signal.values.iter().map(|bits| literal(&signal.kind, *bits)).collect();
                json!({"name": signal.name, "values": values})
            };
            let globals = outcome.globals.iter().map(|(name, value)| json!({"name": name, "value": value}));
            value["message"] = json!(outcome.end);
            value["cycle_ns"] = json!(outcome.trace.cycle_time);
            value["cycles"] = json!(outcome.trace.cycles());
            value["globals"] = globals.collect();
            value["rows"] = json!(outcome.rows);
            value["failures"] = outcome.failures.iter().map(failure).collect();
            value["signals"] = outcome.trace.signals.iter().map(signal).collect();
        }
    }
    value
}

/// A suite with a case for each table.
pub(crate) fn junit(lines: &[Line]) -> Result<String, String> {
    let mut report = Report::new("rungbook");
    let mut suite = TestSuite::new("run");
    for line in lines {
        let status = match &line.outcome {
            Ok(outcome) if outcome.passed => TestCaseStatus::success(),
            Ok(outcome) => {
                let differences = outcome.failures.iter().map(difference);
                let lines: Vec<String> = std::iter::once(outcome.end.clone()).chain(differences).collect();
                failed(NonSuccessKind::Failure, line.word(), &lines.join("; "))
            }
            Err(NotPlayed { reasons, is_wrong: true }) => {
                failed(NonSuccessKind::Error, line.word(), &reasons.join("; "))
            }
            Err(NotPlayed { reasons, .. }) => {
                let mut status = TestCaseStatus::skipped();
                status.set_message(reasons.join("; "));
                status
            }
        };
        let mut case = TestCase::new(line.table.as_str(), status);
        case.set_classname(if line.unit.is_empty() { "tables" } else { line.unit.as_str() });
        suite.add_test_case(case);
    }
    report.add_test_suite(suite);
    report.to_string().map_err(|error| error.to_string())
}

fn failed(kind: NonSuccessKind, type_: &str, message: &str) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(kind);
    status.set_type(type_).set_message(message);
    status
}
