//! The run of a violation, from the record's JSON to what pages see.

use serde_json::Value;

use super::Context;
use crate::book::view::entity::Diagram;
use crate::book::view::run::{RunCycle, RunLine, RunValue, RunView};
use crate::figure::timing::{self, Timing};
use crate::machine::program::Role;
use crate::machine::trace::lane::{Lane, Span};

/// So many cycles are shown, the last ones.
const SHOWN: usize = 40;
/// So many executed lines of a cycle are shown.
const LINES: usize = 200;

fn text(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_owned()
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

/// The run of an artefact; `None` where it is none.
pub(crate) fn view(context: &Context<'_>, name: &str, run: &Value) -> Option<RunView> {
    let all = list(&run["cycles"]);
    let end = run["end"].as_object().filter(|_| !all.is_empty())?;
    let variables: Vec<(String, bool)> =
        list(&run["variables"]).iter().map(|v| (text(&v["name"]), v["input"] == true)).collect();
    let failing: Vec<String> =
        list(&run["end"]["rows"]).iter().flat_map(|row| list(&row["cells"])).map(|c| text(&c["column"])).collect();
    let first = all.len().saturating_sub(SHOWN);
    let cycle = |(index, cycle): (usize, &Value)| {
        let before = index.checked_sub(1).map(|index| list(&all[index]["values"]));
        let last = index + 1 == all.len();
        let value = |(at, value): (usize, &Value)| RunValue {
            text: text(value),
            changed: before.is_some_and(|before| before.get(at) != Some(value)),
            failing: last && failing.iter().any(|name| name.eq_ignore_ascii_case(&variables[at].0)),
        };
        RunCycle {
            number: index + 1,
            values: list(&cycle["values"]).iter().enumerate().map(value).collect(),
            tried: list(&cycle["tried"]).iter().map(text).collect(),
            live: list(&cycle["live"]).iter().map(text).collect(),
            lines: lines(context, list(&cycle["lines"]), &wrong(&run["end"], index + 1)),
        }
    };
    let cycles: Vec<RunCycle> = all.iter().enumerate().skip(first).map(cycle).collect();
    let (timing, unchanged) = timing(name, &variables, &cycles);
    let drawing = timing::draw(&timing);
    let (width, height) = drawing.points();
    Some(RunView {
        summary: summary(&Value::Object(end.clone())),
        globals: list(&run["globals"]).iter().map(|g| (text(&g["name"]), text(&g["value"]))).collect(),
        variables,
        length: all.len(),
        timing: Diagram { svg: drawing.to_svg(), alt: drawing.alt.clone(), width, height },
        edges: timing::edges(&timing),
        unchanged,
        failing: cells(&run["end"]).map(|(row, cell)| (text(row), text(&cell["column"]), explained(cell))).collect(),
        cycles,
    })
}

/// What goes wrong.
fn summary(end: &Value) -> Vec<String> {
    let cycle = &end["cycle"];
    if end["kind"] == "fault" {
        return vec![format!(
            "Cycle {cycle}: {} in {}, line {}.",
            text(&end["fault"]),
            text(&end["file"]),
            end["line"]
        )];
    }
    if end["kind"] == "never-ends" {
        return vec![format!(
            "The cycles from {} to {cycle} can be repeated for ever: the table is never left.",
            end["from"]
        )];
    }
    let row = |row: &Value| {
        let cells = list(&row["cells"]).iter().map(|cell| {
            let set = &cell["set"];
            let set = match set["cycle"].as_u64() {
                Some(own) => format!(", set in cycle {own} by {}:{}", text(&set["file"]), set["line"]),
                None => String::new(),
            };
            format!(
                "{} is {} where {} is expected{set}",
                text(&cell["column"]),
                text(&cell["seen"]),
                text(&cell["expected"])
            )
        });
        format!("Cycle {cycle}, row {}: {}.", text(&row["row"]), cells.collect::<Vec<_>>().join("; "))
    };
    list(&end["rows"]).iter().map(row).collect()
}

/// The failing cells with the names of their rows.
fn cells(end: &Value) -> impl Iterator<Item = (&Value, &Value)> {
    list(&end["rows"]).iter().flat_map(|row| list(&row["cells"]).iter().map(|cell| (&row["row"], cell)))
}

fn explained(cell: &Value) -> String {
    format!("expected {}, seen {}", text(&cell["expected"]), text(&cell["seen"]))
}

/// The lines of a cycle that gave outputs the values that fail.
fn wrong(end: &Value, cycle: usize) -> Vec<(String, u64)> {
    let sets = cells(end).map(|(_, cell)| &cell["set"]).filter(|set| set["cycle"].as_u64() == Some(cycle as u64));
    sets.map(|set| (text(&set["file"]), set["line"].as_u64().unwrap_or_default())).collect()
}

/// The executed lines of a cycle, those first that gave a wrong value where there are too many.
fn lines(context: &Context<'_>, lines: &[Value], wrong: &[(String, u64)]) -> Vec<RunLine> {
    let is_wrong = |line: &Value| {
        let line = (text(&line["file"]), line["line"].as_u64().unwrap_or_default());
        wrong.contains(&line)
    };
    let last = lines.iter().rposition(is_wrong).map_or(0, |at| (at + 1).saturating_sub(LINES));
    let from = if lines.len() > LINES { last } else { 0 };
    let shown = lines.iter().skip(from).take(LINES);
    shown.map(|own| RunLine { wrong: is_wrong(own), ..line(context, own) }).collect()
}

fn line(context: &Context<'_>, line: &Value) -> RunLine {
    let (file, number) = (text(&line["file"]), line["line"].as_u64().and_then(|n| u32::try_from(n).ok()).unwrap_or(0));
    let source = context.input.files.iter().find(|(_, known)| known.path == file).map(|(_, known)| known);
    let shown = source.and_then(|source| source.text.lines().nth(number.saturating_sub(1) as usize));
    RunLine {
        file,
        line: number,
        text: shown.unwrap_or_default().trim().to_owned(),
        set: list(&line["set"]).iter().map(|set| (text(&set["name"]), text(&set["value"]))).collect(),
        wrong: false,
    }
}

/// Values as lanes: a `BOOL` is a level. A variable that keeps its value, and whose value is not wrong, gets none.
fn timing(name: &str, variables: &[(String, bool)], cycles: &[RunCycle]) -> (Timing, Vec<(String, String)>) {
    let mut unchanged = Vec::new();
    let lane = |(at, (name, input)): (usize, &(String, bool))| {
        let mut spans: Vec<Span> = Vec::new();
        for (index, cycle) in cycles.iter().enumerate() {
            let text = cycle.values.get(at).map_or("", |value| value.text.as_str());
            match spans.last_mut() {
                Some(last) if last.text == text => last.to = index + 1,
                _ => spans.push(Span { from: index, to: index + 1, high: text == "TRUE", text: text.to_owned() }),
            }
        }
        let is_level = spans.iter().all(|span| matches!(span.text.as_str(), "TRUE" | "FALSE"));
        Lane { name: name.clone(), role: if *input { Role::Input } else { Role::Output }, is_level, spans }
    };
    let is_failing = |at: usize| cycles.iter().any(|cycle| cycle.values.get(at).is_some_and(|value| value.failing));
    let mut lanes = Vec::new();
    for (at, variable) in variables.iter().enumerate() {
        let lane = lane((at, variable));
        if lane.spans.len() <= 1 && cycles.len() > 1 && !is_failing(at) {
            let value = lane.spans.first().map_or(String::new(), |span| span.text.clone());
            unchanged.push((variable.0.clone(), value));
        } else {
            lanes.push(lane);
        }
    }
    (Timing { name: name.to_owned(), lanes, mark: cycles.len().checked_sub(1) }, unchanged)
}
