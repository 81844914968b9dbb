//! What helps to read a test table: the meaning of its signs, its automaton, the timing diagram of an instance.

use crate::book::view::entity::Diagram;
use crate::book::view::table::{AidView, SignView};
use crate::figure::automaton::{self, Automaton, Part, Step};
use crate::figure::timing::{self, Timing};
use crate::machine::program::Role;
use crate::machine::trace::lane::{Lane, Span};
use crate::table::bind::BoundTable;
use crate::table::duration::{DurationCell, Repeat};
use crate::table::instances::{self, Instance, NoInstance};
use crate::table::layout::duration_text;
use crate::table::legend::Sign;
use crate::table::model::{Node, Table};
use crate::table::{AttachedTable, decide, explain};

/// Tables with more rows have no drawing of their automaton.
const MOST_ROWS: usize = 40;

/// Signs with their meanings.
pub(super) fn signs(signs: &[Sign]) -> Vec<SignView> {
    let sign = |sign: &Sign| SignView { text: sign.text(), duration: sign.is_of_durations(), meaning: sign.meaning() };
    signs.iter().map(sign).collect()
}

fn without(note: impl Into<String>) -> AidView {
    AidView { diagram: None, note: note.into() }
}

/// The drawing of a table's automaton.
pub(super) fn automaton(table: &Table) -> AidView {
    let rows = table.rows().len();
    if rows == 0 || table.has_errors() {
        return AidView::default();
    }
    if rows > MOST_ROWS {
        return without(format!("The automaton is drawn for up to {MOST_ROWS} rows; this table has {rows}."));
    }
    let mut sentences = explain::sentences(table).into_iter();
    let Some(parts) = parts(&table.body, &mut sentences) else {
        return without("The automaton is not drawn: a duration is a time, and the length of a cycle is not known.");
    };
    let note = note(&parts);
    let drawing = automaton::draw(&Automaton { name: table.name.clone(), parts });
    AidView { diagram: Some(diagram(&drawing)), note }
}

fn diagram(drawing: &crate::figure::Drawing) -> Diagram {
    let (width, height) = drawing.points();
    Diagram { svg: drawing.to_svg(), alt: drawing.alt.clone(), width, height }
}

fn parts(nodes: &[Node], sentences: &mut dyn Iterator<Item = String>) -> Option<Vec<Part>> {
    let part = |node: &Node| {
        Some(match node {
            Node::Row(row) => {
                let remark = row.remark.as_ref().map_or_else(String::new, |remark| remark.text.clone());
                let title = sentences.next().unwrap_or_default();
                Part::Row(Step { name: row.id.clone(), remark, title, ..step(&row.duration)? })
            }
            Node::Block(block) => Part::Block(step(&block.duration)?, parts(&block.children, sentences)?),
        })
    };
    nodes.iter().map(part).collect()
}

fn step(duration: &DurationCell) -> Option<Step> {
    let text = duration_text(duration);
    let repeat = duration.repeat?;
    Some(Step {
        duration: if text.progress { format!("{} p", text.text) } else { text.text },
        skip: matches!(repeat, Repeat::Times { low: 0, .. }),
        again: matches!(repeat, Repeat::Times { high, .. } if high.is_none_or(|high| high > 1)),
        forever: repeat == Repeat::Omega,
        progress: text.progress,
        ..Step::default()
    })
}

/// What of the drawing needs a word: only what occurs.
fn note(all: &[Part]) -> String {
    fn any(parts: &[Part], test: &dyn Fn(&Step) -> bool) -> bool {
        parts.iter().any(|part| match part {
            Part::Row(step) => test(step),
            Part::Block(step, inner) => test(step) || any(inner, test),
        })
    }
    let mut said = vec!["a box is a row"];
    if any(all, &|step| step.skip) {
        said.push("a line at its left leads past what may be left out");
    }
    if any(all, &|step| step.again || step.forever) {
        said.push("a line at its right leads back to what may be repeated");
    }
    if any(all, &|step| step.progress) {
        said.push("a dashed one only while the inputs do not fit what follows");
    }
    let text = said.join("; ");
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| format!("{}{}.", first.to_uppercase(), letters.as_str()))
}

/// An instance of the table as a timing diagram.
pub(super) fn example(attached: &AttachedTable) -> AidView {
    let table = &attached.table;
    let Some(bound) = attached.bound.as_ref().filter(|_| !table.has_errors()) else { return AidView::default() };
    if table.rows().is_empty() {
        return AidView::default();
    }
    match instances::example(table, bound) {
        Ok(instance) => {
            let drawing = timing::draw(&timing(table, bound, &instance));
            AidView { diagram: Some(diagram(&drawing)), note: said(table, bound, &instance) }
        }
        Err(NoInstance::Unusable(reason)) => without(format!("No example run is shown: {reason}.")),
        Err(NoInstance::Contradiction(_)) => {
            without("No example run is shown: no run was found that satisfies its cells.")
        }
        Err(NoInstance::Undecided) => {
            without("No example run is shown: no values were found with the effort that is allowed for a page.")
        }
    }
}

fn said(table: &Table, bound: &BoundTable, instance: &Instance) -> String {
    let cycles: u64 = instance.steps.iter().map(|step| step.cycles).sum();
    let mut rows: Vec<usize> = instance.steps.iter().map(|step| step.row).collect();
    rows.sort_unstable();
    rows.dedup();
    let values = bound.globals.iter().zip(&instance.globals);
    let values: Vec<String> = values
        .map(|(global, bits)| format!("{} = {}", global.name, decide::literal(global.scalar, &global.labels, *bits)))
        .collect();
    let with = if values.is_empty() { String::new() } else { format!(", for {}", values.join(", ")) };
    let all = table.rows().len();
    let part = if rows.len() == all { "all rows".to_owned() } else { format!("{} of {all} rows", rows.len()) };
    let count = if cycles == 1 { "1 cycle".to_owned() } else { format!("{cycles} cycles") };
    format!("One run that satisfies the table: {count} through {part}{with}.")
}

/// The rows on top, then the variables of the columns; what nothing asks for is free.
fn timing(table: &Table, bound: &BoundTable, instance: &Instance) -> Timing {
    let rows = table.rows();
    let of_rows = spans(instance, &|step| rows.get(step.row).map_or_else(String::new, |row| row.id.clone()));
    let row = Lane { name: "row".to_owned(), role: Role::State, is_level: false, spans: of_rows };
    let mut columns: Vec<usize> = (0..table.columns.len()).collect();
    columns.sort_by_key(|column| table.columns[*column].kind);
    let mut seen = Vec::new();
    let lane = |column: usize| {
        let index = instances::variable(table, bound, column)?;
        if seen.contains(&index) {
            return None;
        }
        seen.push(index);
        let variable = &bound.variables[index];
        let text = |step: &instances::Step| {
            let value = step.values.get(index).copied().flatten();
            value.map_or_else(String::new, |bits| decide::literal(variable.scalar, &variable.labels, bits))
        };
        let role = if table.columns[column].kind.is_assumption() { Role::Input } else { Role::Output };
        let name = table.columns[column].name.clone();
        let spans = spans(instance, &text);
        let is_level = spans.iter().all(|span| matches!(span.text.as_str(), "TRUE" | "FALSE" | ""));
        Some(Lane { name, role, is_level, spans })
    };
    let lanes = std::iter::once(row).chain(columns.into_iter().filter_map(lane)).collect();
    Timing { name: table.name.clone(), lanes, mark: None }
}

fn spans(instance: &Instance, text: &dyn Fn(&instances::Step) -> String) -> Vec<Span> {
    let (mut out, mut at): (Vec<Span>, usize) = (Vec::new(), 0);
    for step in &instance.steps {
        let (text, to) = (text(step), at + usize::try_from(step.cycles).unwrap_or(usize::MAX - at));
        match out.last_mut() {
            Some(last) if last.text == text => last.to = to,
            _ => out.push(Span { from: at, to, high: text == "TRUE", text }),
        }
        at = to;
    }
    out
}
