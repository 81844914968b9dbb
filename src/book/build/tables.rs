//! Test tables as pages see them.

use super::address::slug;
use super::{Context, aids, prose};
use crate::book::view::prose::{Block, Inline};
use crate::book::view::run::RunView;
use crate::book::view::table::{
    BracketView, CellView, ColumnView, CoverageView, MissedView, RowView, TableView, VerdictView,
};
use crate::evidence::coverage::{Coverage, Fate, Kind};
use crate::evidence::record::{Answer, Verdict};
use crate::library::ItemId;
use crate::table::explain;
use crate::table::layout::{self, DurationText, Layout, Role};
use crate::table::model::ColumnKind;
use crate::table::{AttachedTable, Table, legend};

/// The tables of a top-level item and of its members.
pub(crate) fn of(context: &Context<'_>, top: ItemId) -> Vec<TableView> {
    let own = context.tables.get(&top).into_iter().flatten();
    own.enumerate()
        .map(|(n, i)| view(context, top, &context.input.tables[*i], n, context.input.answers.get(*i)))
        .collect()
}

/// What is known of the table with this index.
pub(crate) fn known(context: &Context<'_>, index: usize) -> VerdictView {
    verdict(&context.input.tables[index], context.input.answers.get(index))
}

/// What is known of a table.
pub(crate) fn verdict(table: &AttachedTable, answer: Option<&Answer>) -> VerdictView {
    if table.table.has_errors() {
        let note = "The table has errors; it gets no verdict.".to_owned();
        let (key, label) = ("unusable", "unusable".to_owned());
        return VerdictView { key, label, note, facts: Vec::new(), coverage: None };
    }
    let verdict = answer.map_or(&Verdict::Unverified, |answer| &answer.verdict);
    let note = match verdict {
        Verdict::Verified => {
            "Proven for runs of every length; the certificate was checked again by a second program.".to_owned()
        }
        Verdict::Violated => "This run violates the table; it was played again on the interpreter.".to_owned(),
        Verdict::Unverified => "Nobody has proven that the block conforms to this table.".to_owned(),
        Verdict::Bounded { cycles } => {
            format!("No violation in the first {cycles} cycles; nothing is claimed beyond.")
        }
        Verdict::Stale { was, changed } => format!("It was {was}; changed since: {}.", changed.join(", ")),
        Verdict::Unsupported { reasons } => format!("Not modelled: {}", reasons.join("; ")),
        Verdict::Unusable { reasons } => format!("No verdict is possible: {}", reasons.join("; ")),
    };
    let facts = answer.map(facts_of).unwrap_or_default();
    let coverage = answer.and_then(|answer| answer.coverage.as_ref()).map(covered);
    VerdictView { key: verdict.word(), label: verdict.word().to_owned(), note, facts, coverage }
}

/// What a proof covered.
fn covered(coverage: &Coverage) -> CoverageView {
    let missed = coverage.missed().map(|item| MissedView {
        kind: match item.kind {
            Kind::Row => "row",
            Kind::Statement => "statement",
            Kind::Branch => "branch",
        },
        text: item.name.clone(),
        file: item.file.clone(),
        line: item.line,
        fate: match item.fate {
            Fate::NotWithin { cycles } => format!("not reached in {cycles} cycles"),
            fate => fate.text(),
        },
    });
    let survivors = coverage.mutants.iter().flat_map(|mutants| mutants.survivors()).map(|mutant| MissedView {
        kind: "mutant",
        text: mutant.change.clone(),
        file: mutant.file.clone(),
        line: mutant.line,
        fate: mutant.outcome.text(),
    });
    CoverageView { line: coverage.line(), vacuous: coverage.vacuous.clone(), missed: missed.chain(survivors).collect() }
}

/// How a verdict was found.
fn facts_of(answer: &Answer) -> Vec<(String, String)> {
    let mut facts = Vec::new();
    let mut push = |name: &str, value: String| facts.push((name.to_owned(), value));
    if !answer.engine.is_empty() {
        push("Engine", answer.engine.clone());
    }
    answer.rests_on.iter().for_each(|text| push("Assumes", text.clone()));
    if let Some(reference) = answer.artefact.as_ref().map(crate::evidence::record::Artefact::reference) {
        let hex = reference.digest.hex();
        push("Evidence", format!("{} {}", reference.kind.folder().trim_end_matches('s'), &hex[..12.min(hex.len())]));
    }
    facts
}

fn view(context: &Context<'_>, top: ItemId, attached: &AttachedTable, n: usize, answer: Option<&Answer>) -> TableView {
    let table = &attached.table;
    let layout = layout::layout(table);
    let at = context.input.files.line_column(table.place);
    let anchor = format!("t{}-{}", n + 1, slug(&table.name));
    let run = answer
        .and_then(|answer| answer.artefact.as_ref())
        .and_then(|artefact| super::run::view(context, &table.name, &artefact.value));
    let mut rows = rows(context, attached, &layout);
    mark(&mut rows, &layout, run.as_ref());
    TableView {
        name: table.name.clone(),
        label: format!("{}::{anchor}", context.addresses.item(top).label),
        anchor,
        file: context.input.files.get(table.place.file).path.clone(),
        line: at.line,
        verdict: verdict(attached, answer),
        run,
        facts: facts(table, &layout),
        remark: Vec::new(),
        columns: columns(&layout),
        rows,
        brackets: brackets(&layout),
        errors: attached.errors.iter().map(|error| error.message.clone()).collect(),
        legend: aids::signs(&layout.legend),
        automaton: aids::automaton(table),
        example: aids::example(attached),
    }
}

/// Marks the cells in which a run fails.
fn mark(rows: &mut [RowView], layout: &Layout, run: Option<&RunView>) {
    for (row, column, explained) in run.iter().flat_map(|run| &run.failing) {
        for own in rows.iter_mut().filter(|own| own.seq == *row) {
            let cells = own.cells.iter_mut().zip(&layout.columns).filter(|(_, head)| head.name == *column);
            cells.for_each(|(cell, _)| cell.failing = Some(explained.clone()));
        }
    }
}

fn facts(table: &Table, layout: &Layout) -> Vec<(String, String)> {
    let mut facts = Vec::new();
    if let Some(cycle) = &table.options.cycle {
        facts.push(("Cycle time".to_owned(), crate::table::cell::time_text(cycle.nanos)));
    }
    if table.options.strict {
        facts.push(("Conformance".to_owned(), "strict".to_owned()));
    }
    facts.extend(layout.constants.iter().cloned());
    facts.extend(layout.globals.iter().map(|(name, constraint)| (format!("for every {name}"), constraint.clone())));
    facts
}

fn columns(layout: &Layout) -> Vec<ColumnView> {
    let column = |head: &layout::Head| ColumnView {
        group: if head.kind.is_assumption() { "input" } else { "output" },
        name: head.bound_to.clone().unwrap_or_else(|| head.name.clone()),
        type_: head.ty.clone().unwrap_or_default(),
        state: matches!(head.kind, ColumnKind::StateAssumption | ColumnKind::StateAssertion),
    };
    layout.columns.iter().map(column).collect()
}

fn rows(context: &Context<'_>, attached: &AttachedTable, layout: &Layout) -> Vec<RowView> {
    let own = attached.table.rows();
    let mut sentences = explain::sentences(&attached.table).into_iter();
    let mut row = |(i, line): (usize, &layout::Line)| RowView {
        seq: line.id.clone(),
        cells: line
            .cells
            .iter()
            .enumerate()
            .map(|(column, cell)| {
                let index = layout.columns[column].index;
                let written = own.get(i).and_then(|row| row.cells.get(index)).and_then(Option::as_ref);
                let inside = |error: &&crate::table::TableError| {
                    written.is_some_and(|cell| {
                        cell.place.file == error.place.file && cell.place.span.contains(error.place.span)
                    })
                };
                let error = attached.errors.iter().find(inside).map(|error| error.message.clone());
                self::cell(cell, &layout.columns[column].name, error)
            })
            .collect(),
        duration: duration(&line.duration),
        duration_meaning: own.get(i).map_or(String::new(), |row| explain::duration(&row.duration)),
        duration_signs: own.get(i).map_or(Vec::new(), |row| aids::signs(&legend::of_duration(&row.duration))),
        remark: remark(context, &line.remark),
        sentence: sentences.next().unwrap_or_default(),
    };
    layout.rows.iter().enumerate().map(&mut row).collect()
}

fn remark(context: &Context<'_>, text: &str) -> Vec<Inline> {
    match prose::markdown(context, text).into_iter().next() {
        Some(Block::Paragraph { content }) => content,
        Some(_) => vec![Inline::text(text)],
        None => Vec::new(),
    }
}

fn cell(cell: &layout::LaidCell, column: &str, error: Option<String>) -> CellView {
    let same = cell.rows == 0;
    let meaning = match cell.role {
        Role::Any => "anything".to_owned(),
        Role::Value => format!("{column} = {}", cell.text),
        Role::Condition => format!("{column}: {}", cell.text),
        Role::Spoiled => String::new(),
    };
    CellView {
        text: if same { String::new() } else { cell.text.clone() },
        effective: cell.text.clone(),
        same,
        any: cell.role == Role::Any,
        meaning,
        signs: aids::signs(&cell.signs),
        error,
        failing: None,
    }
}

fn duration(duration: &DurationText) -> String {
    if duration.progress { format!("{} p", duration.text) } else { duration.text.clone() }
}

fn brackets(layout: &Layout) -> Vec<BracketView> {
    let bracket = |bracket: &layout::Bracket| BracketView {
        depth: u32::try_from(bracket.depth).unwrap_or(u32::MAX),
        first: bracket.first,
        last: bracket.last,
        label: duration(&bracket.label),
    };
    layout.brackets.iter().map(bracket).collect()
}
