//! A test table as values: column groups, and brackets as cells that span the rows of their block.

use tera::Value;

use super::prose::{Prose, message};
use super::value::{list, markup, record};
use crate::book::view::table::{AidView, BracketView, CellView, ColumnView, RowView, SignView, TableView};

/// The table for its template. `line_href` leads to the listing that shows it, if one does.
pub(super) fn value(table: &TableView, prose: &Prose<'_>, line_href: Option<String>) -> Value {
    let lanes = lanes(&table.brackets, table.rows.len());
    let mut signs = Signs { legend: &table.legend, anchor: &table.anchor, met: Vec::new() };
    let rows = rows(table, &lanes, prose, &mut signs);
    record! {
        name: table.name.as_str(),
        anchor: table.anchor.as_str(),
        file: table.file.as_str(),
        line: table.line,
        line_href: line_href,
        verdict: record! {
            key: table.verdict.key,
            label: table.verdict.label.as_str(),
            note: table.verdict.note.as_str(),
        },
        coverage: table.verdict.coverage.as_ref().map(|coverage| record! {
            line: coverage.line.as_str(),
            vacuous: list(&coverage.vacuous, |reason| Value::from(reason.as_str())),
            missed: list(&coverage.missed, |missed| record! {
                kind: missed.kind,
                text: missed.text.as_str(),
                file: missed.file.as_str(),
                line: missed.line,
                fate: missed.fate.as_str(),
            }),
        }),
        facts: list(&table.facts, |(name, value)| record! { name: name.as_str(), value: value.as_str() }),
        remark: markup(&prose.inlines(&table.remark)),
        groups: groups(&table.columns),
        columns: columns(&table.columns),
        lanes: lanes.len(),
        rows: rows,
        is_long: table.rows.len() > LONG,
        legend: legend(table),
        automaton: aid(&table.automaton),
        example: aid(&table.example),
        has_remarks: table.rows.iter().any(|row| !row.remark.is_empty()),
        has_sentences: table.rows.iter().any(|row| !row.sentence.is_empty()),
        errors: list(&table.errors, |error| markup(&message(error))),
        verdict_facts: list(&table.verdict.facts, |(name, value)| record! { name: name.as_str(), value: value.as_str() }),
        run: table.run.as_ref().map(|run| super::run::value(run, &table.anchor)),
    }
}

/// Runs of columns with the same group: title and width.
fn groups(columns: &[ColumnView]) -> Value {
    let groups: Vec<Value> = columns
        .chunk_by(|a, b| a.group == b.group)
        .map(|run| {
            let key = run.first().map_or("", |column| column.group);
            record! { key: key, title: if key == "output" { "Output" } else { "Input" }, span: run.len() }
        })
        .collect();
    Value::from(groups)
}

/// Whether column `i` begins a group; a line is drawn there.
fn begins_group(columns: &[ColumnView], i: usize) -> bool {
    i == 0 || columns.get(i).map(|c| c.group) != columns.get(i - 1).map(|c| c.group)
}

fn columns(columns: &[ColumnView]) -> Value {
    let column = |(i, column): (usize, &ColumnView)| {
        record! {
            group: column.group,
            name: column.name.as_str(),
            type: column.type_.as_str(),
            state: column.state,
            edge: begins_group(columns, i),
        }
    };
    Value::from(columns.iter().enumerate().map(column).collect::<Vec<_>>())
}

fn rows(table: &TableView, lanes: &[Lane<'_>], prose: &Prose<'_>, signs: &mut Signs<'_>) -> Value {
    let row = |(i, row): (usize, &RowView)| {
        record! {
            seq: row.seq.as_str(),
            cells: cells(row, &table.columns, signs),
            duration: row.duration.as_str(),
            duration_meaning: tip(&row.duration_meaning, &row.duration_signs),
            duration_sign: signs.first(&row.duration_signs),
            remark: markup(&prose.inlines(&row.remark)),
            sentence: markup(&message(&row.sentence)),
            brackets: Value::from(lanes.iter().filter_map(|lane| bracket_cell(lane, i)).collect::<Vec<_>>()),
        }
    };
    Value::from(table.rows.iter().enumerate().map(row).collect::<Vec<_>>())
}

/// One cell for each column, even where the row has fewer.
fn cells(row: &RowView, columns: &[ColumnView], signs: &mut Signs<'_>) -> Value {
    let cell = |(i, column): (usize, &ColumnView)| match row.cells.get(i) {
        Some(cell) => filled(cell, column, (begins_group(columns, i), 2 * i >= columns.len()), signs),
        None => record! { edge: begins_group(columns, i), group: column.group, text: "", effective: "", same: false,
        any: false, meaning: "", sign: Value::none(), far: false, error: Value::none(), failing: Value::none() },
    };
    Value::from(columns.iter().enumerate().map(cell).collect::<Vec<_>>())
}

fn filled(cell: &CellView, column: &ColumnView, (edge, far): (bool, bool), signs: &mut Signs<'_>) -> Value {
    let meaning = if cell.any { "" } else { cell.meaning.as_str() };
    record! {
        edge: edge,
        group: column.group,
        text: cell.text.as_str(),
        effective: cell.effective.as_str(),
        same: cell.same,
        any: cell.any,
        meaning: tip(meaning, &cell.signs),
        sign: signs.first(&cell.signs),
        far: far,
        error: cell.error.as_deref(),
        failing: cell.failing.as_deref(),
    }
}

/// Tables with more rows scroll in a box of their own, below their header.
const LONG: usize = 18;

/// What is told where a pointer is over a cell or the keyboard has come to it: its meaning, then that of its signs.
fn tip(meaning: &str, signs: &[SignView]) -> String {
    let lines = signs.iter().map(|sign| format!("{}  {}", sign.text, sign.meaning));
    let first = (!meaning.is_empty()).then(|| meaning.to_owned());
    first.into_iter().chain(lines).collect::<Vec<_>>().join("\n")
}

/// The signs of a table as they are met: the first cell that shows one is a stop of the keyboard. A stop at every cell would make
/// thousands of them.
struct Signs<'a> {
    legend: &'a [SignView],
    anchor: &'a str,
    met: Vec<SignView>,
}

impl Signs<'_> {
    /// The entries of the legend for signs that were not met before, as ids; none if there are none.
    fn first(&mut self, signs: &[SignView]) -> Option<String> {
        let mut ids = Vec::new();
        for sign in signs.iter().filter(|sign| !self.met.contains(sign)).copied().collect::<Vec<_>>() {
            self.met.push(sign);
            ids.extend(self.legend.iter().position(|known| *known == sign).map(|at| sign_id(self.anchor, at)));
        }
        (!ids.is_empty()).then(|| ids.join(" "))
    }
}

fn sign_id(anchor: &str, at: usize) -> String {
    format!("{anchor}-sign-{}", at + 1)
}

fn legend(table: &TableView) -> Value {
    let sign = |(at, sign): (usize, &SignView)| {
        record! {
            id: sign_id(&table.anchor, at),
            text: sign.text,
            duration: sign.duration,
            meaning: sign.meaning,
        }
    };
    Value::from(table.legend.iter().enumerate().map(sign).collect::<Vec<_>>())
}

fn aid(aid: &AidView) -> Value {
    record! { svg: aid.diagram.as_ref().map(|diagram| markup(&diagram.svg)), note: aid.note.as_str() }
}

/// A column of brackets that do not overlap.
type Lane<'a> = Vec<&'a BracketView>;

/// Brackets in lanes, the innermost first, which stands nearest to the rows. Each takes the lane of its depth; one that
/// would overlap there moves outwards. Brackets beyond the rows are left out.
fn lanes(brackets: &[BracketView], rows: usize) -> Vec<Lane<'_>> {
    let mut sorted: Vec<&BracketView> = brackets.iter().filter(|b| b.first <= b.last && b.last < rows).collect();
    sorted.sort_by_key(|b| (std::cmp::Reverse(b.depth), b.first));
    let deepest = sorted.first().map_or(0, |b| b.depth);
    let mut lanes: Vec<Lane<'_>> = Vec::new();
    for bracket in sorted {
        let mut lane = (deepest - bracket.depth).min(u32::try_from(brackets.len()).unwrap_or(u32::MAX)) as usize;
        while lanes.get(lane).is_some_and(|lane| lane.iter().any(|b| overlap(b, bracket))) {
            lane += 1;
        }
        if lanes.len() <= lane {
            lanes.resize_with(lane + 1, Vec::new);
        }
        lanes[lane].push(bracket);
    }
    lanes.retain(|lane| !lane.is_empty());
    lanes
}

fn overlap(a: &BracketView, b: &BracketView) -> bool {
    a.first <= b.last && b.first <= a.last
}

/// The cell of `lane` in row `row`; none where a bracket from above reaches it.
fn bracket_cell(lane: &Lane<'_>, row: usize) -> Option<Value> {
    match lane.iter().find(|b| (b.first..=b.last).contains(&row)) {
        Some(bracket) if bracket.first == row => {
            Some(record! { rows: bracket.last - bracket.first + 1, label: bracket.label.as_str() })
        }
        Some(_) => None,
        None => Some(record! { rows: 0, label: "" }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bracket(depth: u32, first: usize, last: usize) -> BracketView {
        BracketView { depth, first, last, label: String::new() }
    }

    /// First rows by lane.
    fn firsts(brackets: &[BracketView], rows: usize) -> Vec<Vec<usize>> {
        lanes(brackets, rows).iter().map(|lane| lane.iter().map(|b| b.first).collect()).collect()
    }

    #[test]
    fn the_innermost_lane_comes_first() {
        let brackets = [bracket(0, 0, 5), bracket(1, 1, 2), bracket(1, 3, 4)];
        assert_eq!(firsts(&brackets, 6), [vec![1, 3], vec![0]]);
    }

    #[test]
    fn overlapping_brackets_get_lanes_of_their_own() {
        assert_eq!(firsts(&[bracket(0, 0, 3), bracket(0, 2, 5)], 6), [vec![0], vec![2]]);
    }

    #[test]
    fn brackets_beyond_the_rows_are_left_out() {
        assert!(firsts(&[bracket(0, 4, 9), bracket(0, 3, 1), bracket(u32::MAX, 6, 6)], 6).is_empty());
        assert_eq!(firsts(&[bracket(u32::MAX, 0, 0), bracket(0, 1, 1)], 2), [vec![0], vec![1]]);
    }

    #[test]
    fn every_row_has_one_cell_a_lane_or_is_spanned() {
        let brackets = [bracket(0, 1, 2)];
        let lanes = lanes(&brackets, 4);
        let cells: Vec<bool> = (0..4).map(|row| bracket_cell(&lanes[0], row).is_some()).collect();
        assert_eq!(cells, [true, true, false, true]);
    }
}
