//! Verdicts in the terminal and as JSON.

use std::io::IsTerminal;

use serde_json::{Value, json};

use crate::cli::Exit;
use crate::evidence::coverage::{Coverage, Fate, Item, Kind};
use crate::evidence::record::{Answer, Verdict};
use crate::machine::program::Role;
use crate::machine::trace::diagram;
use crate::machine::trace::{Signal, Trace};
use crate::pipeline::Project;
use crate::pipeline::verify::Verified;
use crate::semantics::show::Kind as Shown;

/// A table and what is known of it now.
pub(crate) struct Line {
    /// Its index.
    pub(crate) table: usize,
    /// The answer.
    pub(crate) answer: Answer,
    /// How it was found; `None` for an answer from the store.
    pub(crate) verified: Option<Verified>,
}

/// How many things that a proof did not cover the terminal shows.
const MISSED: usize = 12;
/// How many cycles of a run the terminal shows.
const SHOWN: usize = 60;

/// The exit code: what is violated counts before what is unusable, and that before what is undecided.
pub(crate) fn exit(lines: &[Line]) -> Exit {
    let any = |words: &[&str]| lines.iter().any(|line| words.contains(&line.answer.verdict.word()));
    if any(&["violated"]) {
        Exit::Findings
    } else if any(&["unusable"]) {
        Exit::Unusable
    } else if any(&["bounded", "unsupported", "stale", "unverified"]) {
        Exit::Undecided
    } else {
        Exit::Ok
    }
}

/// How many tables have which verdict.
pub(crate) fn totals(lines: &[Line]) -> String {
    counted(lines.iter().map(|line| &line.answer.verdict))
}

/// The same of verdicts alone.
pub(crate) fn counted<'a>(verdicts: impl Iterator<Item = &'a Verdict> + Clone) -> String {
    let count = |word: &str| verdicts.clone().filter(|verdict| verdict.word() == word).count();
    let counts = Verdict::WORDS.iter().map(|word| (count(word), word)).filter(|(count, _)| *count > 0);
    let counts: Vec<String> = counts.map(|(count, word)| format!("{count} {word}")).collect();
    match verdicts.count() {
        0 => "no test tables".to_owned(),
        1 => format!("1 table: {}", counts.join(", ")),
        tables => format!("{tables} tables: {}", counts.join(", ")),
    }
}

/// What to do where nothing was tried, or not since the sources changed; empty where there is nothing to do.
pub(crate) fn advice<'a>(verdicts: impl Iterator<Item = &'a Verdict>) -> String {
    let open = verdicts.filter(|verdict| matches!(verdict, Verdict::Unverified | Verdict::Stale { .. })).count();
    match open {
        0 => String::new(),
        1 => "nothing is known of 1 table as it is now; `--verify` decides it first\n".to_owned(),
        open => format!("nothing is known of {open} tables as they are now; `--verify` decides them first\n"),
    }
}

/// For people.
pub(crate) fn text(project: &Project, lines: &[Line]) -> String {
    let colour = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    lines.iter().map(|line| told(project, line, colour)).collect()
}

fn painted(word: &str, colour: bool) -> String {
    let code = match word {
        "verified" => "32",
        "violated" | "unusable" => "31",
        _ => "33",
    };
    if colour { format!("\x1b[1;{code}m{word:<11}\x1b[0m") } else { format!("{word:<11}") }
}

fn told(project: &Project, line: &Line, colour: bool) -> String {
    let attached = &project.tables[line.table];
    let unit = attached.item.map_or("no block", |item| &project.catalogue.item(item).name);
    let how = match (&line.verified, &line.answer.effort) {
        (None, _) => " (known)".to_owned(),
        (Some(verified), _) if verified.engine.is_empty() => String::new(),
        (Some(verified), _) => format!(" ({}, {:.2} s)", verified.engine, verified.time.as_secs_f64()),
    };
    let word = painted(line.answer.verdict.word(), colour);
    let mut out = format!("{word} {unit}: {}{how}\n", attached.table.name);
    match &line.answer.verdict {
        Verdict::Unsupported { reasons } | Verdict::Unusable { reasons } => {
            reasons.iter().for_each(|reason| out.push_str(&format!("            {reason}\n")));
        }
        Verdict::Bounded { cycles } => {
            let ended = line.verified.as_ref().and_then(|verified| verified.ended);
            let ended = ended.map_or_else(String::new, |reason| format!("; {reason}"));
            out.push_str(&format!("            no violation in the first {cycles} cycles{ended}\n"));
        }
        _ => {}
    }
    for assumption in &line.answer.rests_on {
        out.push_str(&format!("            assumes: {assumption}\n"));
    }
    if let Some(coverage) = &line.answer.coverage {
        out.push_str(&covered(coverage));
    }
    if let Some(internal) = line.verified.as_ref().and_then(|verified| verified.internal.as_ref()) {
        out.push_str(&format!("            internal error: {internal}\n"));
    }
    if let Some(run) = run(line) {
        out.push_str(&loss(run));
        out.push_str(&drawn(project, line, run));
    }
    out
}

/// What a proof covered: a line, and one for each thing that is missed.
fn covered(coverage: &Coverage) -> String {
    let mut out = format!("            {}\n", coverage.line());
    for reason in &coverage.vacuous {
        out.push_str(&format!("            proves nothing: {reason}\n"));
    }
    let missed: Vec<String> = coverage.missed().map(missed).collect();
    missed.iter().take(MISSED).for_each(|line| out.push_str(line));
    if missed.len() > MISSED {
        out.push_str(&format!("            … and {} more; `--format json` lists all\n", missed.len() - MISSED));
    }
    for mutant in coverage.mutants.iter().flat_map(|mutants| mutants.survivors()) {
        let outcome = mutant.outcome.text();
        out.push_str(&format!("            {}:{}: {}: {outcome}\n", mutant.file, mutant.line, mutant.change));
    }
    out
}

fn missed(item: &Item) -> String {
    let fate = match item.fate {
        Fate::NotWithin { cycles } => format!("not reached in {cycles} cycles"),
        fate => fate.text(),
    };
    match item.kind {
        Kind::Row => format!("            row {}: {fate}\n", item.name),
        Kind::Statement | Kind::Branch => format!("            {}:{}: `{}`: {fate}\n", item.file, item.line, item.name),
    }
}

fn run(line: &Line) -> Option<&Value> {
    line.answer.artefact.as_ref().map(|artefact| &artefact.value).filter(|value| value["end"].is_object())
}

/// What goes wrong, in a line or two.
fn loss(run: &Value) -> String {
    let end = &run["end"];
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    if end["kind"] == "fault" {
        let (fault, file, line) = (text(&end["fault"]), text(&end["file"]), &end["line"]);
        return format!("            cycle {}: {fault} at {file}:{line}\n", end["cycle"]);
    }
    let mut out = String::new();
    if end["kind"] == "never-ends" {
        let (from, to) = (&end["from"], &end["cycle"]);
        out.push_str(&format!("            cycles {from} to {to} can be repeated for ever: the table is never left\n"));
    }
    for row in end["rows"].as_array().into_iter().flatten() {
        let cells: Vec<String> = row["cells"]
            .as_array()
            .into_iter()
            .flatten()
            .map(|cell| {
                let set = &cell["set"];
                let set = match set["cycle"].as_u64() {
                    Some(cycle) => format!(" (set in cycle {cycle} by {}:{})", text(&set["file"]), set["line"]),
                    None => String::new(),
                };
                format!("{} is {}, not {}{set}", text(&cell["column"]), text(&cell["seen"]), text(&cell["expected"]))
            })
            .collect();
        out.push_str(&format!("            cycle {}, row {}: {}\n", end["cycle"], text(&row["row"]), cells.join("; ")));
    }
    let globals: Vec<String> = run["globals"]
        .as_array()
        .into_iter()
        .flatten()
        .map(|global| format!("{} = {}", text(&global["name"]), text(&global["value"])))
        .collect();
    if !globals.is_empty() {
        out.push_str(&format!("            where {}\n", globals.join(", ")));
    }
    out
}

/// The last cycles as a timing diagram.
fn drawn(project: &Project, line: &Line, run: &Value) -> String {
    let Some(verified) = &line.verified else {
        let cycles = run["cycles"].as_array().map_or(0, Vec::len);
        return format!("            {cycles} cycles; the manual shows them, and so does `--fresh`\n");
    };
    let (Some(bound), Some(replay)) = (&verified.bound, &verified.replay) else { return String::new() };
    let first = replay.cycles.len().saturating_sub(SHOWN);
    let mut trace = Trace::new(project.tables[line.table].table.name.clone(), verified.cycle_time);
    for (index, variable) in bound.variables.iter().enumerate() {
        let input = variable.role == crate::table::bind::Role::Input;
        let values = replay.cycles[first..].iter().map(|cycle| cycle.values[index][usize::from(!input)]).collect();
        let role = if input { Role::Input } else { Role::Output };
        trace.signals.push(Signal { name: variable.path.clone(), kind: Shown::from(variable.scalar), role, values });
    }
    let options = diagram::Options { mark: Some(trace.cycles().saturating_sub(1)), ..diagram::Options::default() };
    let drawn = diagram::draw(&trace, &options);
    let skipped = if first > 0 {
        format!("            cycles {} to {}\n", first + 1, replay.cycles.len())
    } else {
        String::new()
    };
    let lines = drawn.lines().map(|line| format!("            {}\n", line.trim_end()));
    skipped + &lines.collect::<String>()
}

/// `{"tables": [{"name", "unit", "verdict", …}]}`.
pub(crate) fn json(project: &Project, lines: &[Line]) -> Value {
    json!({ "tables": lines.iter().map(|line| one(project, line)).collect::<Vec<_>>() })
}

fn one(project: &Project, line: &Line) -> Value {
    let attached = &project.tables[line.table];
    let at = project.files.line_column(attached.table.place);
    let run = run(line);
    let end = run.map(|run| &run["end"]);
    let row = end.and_then(|end| end["rows"].get(0));
    let columns: Option<Vec<&Value>> =
        row.and_then(|row| row["cells"].as_array()).map(|cells| cells.iter().map(|cell| &cell["column"]).collect());
    let reasons = match &line.answer.verdict {
        Verdict::Unsupported { reasons } | Verdict::Unusable { reasons } => reasons.clone(),
        _ => Vec::new(),
    };
    json!({
        "name": attached.table.name,
        "unit": attached.item.map(|item| project.catalogue.item(item).name.clone()),
        "file": project.files.get(attached.table.place.file).path,
        "line": at.line,
        "verdict": line.answer.verdict.word(),
        "detail": line.answer.verdict.detail(),
        "cycle": end.map(|end| &end["cycle"]),
        "row": row.map(|row| &row["row"]),
        "columns": columns,
        "reasons": reasons,
        "engine": line.answer.engine,
        "ended": line.verified.as_ref().and_then(|verified| verified.ended).map(|reason| reason.word()),
        "seconds": line.answer.effort.map(|effort| effort.milliseconds as f64 / 1000.0),
        "cycle_ns": line.verified.as_ref().map(|verified| verified.cycle_time),
        "assumptions": line.answer.rests_on,
        "internal_error": line.verified.as_ref().and_then(|verified| verified.internal.as_ref()),
        "known": line.verified.is_none(),
        "coverage": line.answer.coverage,
        "run": run,
    })
}
