//! A run that violates a table as values for its template: cycles, executed lines, the timing diagram.

use tera::Value;

use super::value::{list, markup, record};
use crate::book::view::run::{RunCycle, RunLine, RunValue, RunView};

/// The run for its template; `anchor` is that of its table.
pub(super) fn value(run: &RunView, anchor: &str) -> Value {
    let edges: Vec<String> = run.edges.iter().map(|edge| format!("{edge:.1}")).collect();
    record! {
        id: format!("{anchor}-run"),
        summary: list(&run.summary, |text| Value::from(text.as_str())),
        globals: list(&run.globals, |(name, value)| record! { name: name.as_str(), value: value.as_str() }),
        variables: list(&run.variables, |(name, input)| record! { name: name.as_str(), input: *input }),
        length: run.length,
        first: run.cycles.first().map_or(0, |cycle| cycle.number),
        last: run.length,
        cycles: list(&run.cycles, cycle),
        unchanged: list(&run.unchanged, |(name, value)| record! { name: name.as_str(), value: value.as_str() }),
        timing: markup(&run.timing.svg),
        edges: edges.join(" "),
    }
}

fn cycle(cycle: &RunCycle) -> Value {
    record! {
        number: cycle.number,
        values: list(&cycle.values, value_of),
        tried: cycle.tried.join(", "),
        live: cycle.live.join(", "),
        lines: list(&cycle.lines, line),
    }
}

fn value_of(value: &RunValue) -> Value {
    record! { text: value.text.as_str(), changed: value.changed, failing: value.failing }
}

fn line(line: &RunLine) -> Value {
    record! {
        file: line.file.as_str(),
        line: line.line,
        text: line.text.as_str(),
        wrong: line.wrong,
        set: list(&line.set, |(name, value)| record! { name: name.as_str(), value: value.as_str() }),
    }
}
