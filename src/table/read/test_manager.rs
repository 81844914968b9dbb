//! Test tables of the CODESYS Test Manager (`<tabletestspec>`), as its manual describes the XML view: test cases of test
//! steps, each with a duration, values to set, and conditions to check.
//!
//! Each test case becomes a table. What is set becomes an input column and what is checked an output column; a value
//! that was set stays, so a step that sets nothing repeats the one above; a step that checks nothing admits anything.
//! Durations under conditions, ramps and forces have no counterpart and are reported.

use roxmltree::Node as Element;

use super::build::Builder;
use super::exteta::variable_column;
use super::xml::{Source, child, elements};
use super::{Options, Read};
use crate::table::codes;
use crate::table::duration::Duration;
use crate::table::model::{Cell, ColumnKind, Node, Row, Word};
use crate::table::piece::Piece;

pub(super) fn document(source: &Source<'_, '_>, root: Element<'_, '_>, options: &Options, read: &mut Read) {
    let testee = child(root, "testinformation").and_then(|information| source.attribute(information, "testee"));
    let cases: Vec<Element<'_, '_>> = root.descendants().filter(|node| node.tag_name().name() == "testcase").collect();
    for case in cases {
        self::case(source, case, testee.clone(), options, read);
    }
}

fn case(source: &Source<'_, '_>, case: Element<'_, '_>, testee: Option<Word>, options: &Options, read: &mut Read) {
    let name = source.attribute(case, "name");
    let name = name.unwrap_or_else(|| Word { text: "Test case".to_owned(), place: source.head(case) });
    let mut builder = Builder::new(name, source.whole(case), options);
    builder.table.unit = testee.filter(|word| !word.text.is_empty());
    for group in case.ancestors().filter(|node| node.is_element()) {
        for unsupported in ["forces", "invariants", "initialization"] {
            if let Some(element) = child(group, unsupported).filter(|element| elements(*element).next().is_some()) {
                let message = format!("`{unsupported}` has no counterpart in a table and is left out");
                builder.wrong(&codes::TABLE_UNSUPPORTED, source.head(element), message);
            }
        }
    }
    let steps: Vec<Element<'_, '_>> = case.descendants().filter(|node| node.tag_name().name() == "teststep").collect();
    for step in &steps {
        columns(&mut builder, source, *step);
    }
    let body = steps.into_iter().map(|step| Node::Row(Box::new(row(&mut builder, source, step)))).collect();
    builder.table.body = body;
    builder.name_rows();
    read.take(builder.finish());
}

/// The column of a variable: set ones are inputs, checked ones outputs; one that is both has two columns.
fn column_name(variable: &str, kind: ColumnKind, builder: &Builder<'_>) -> String {
    let other = builder.table.columns.iter().any(|column| column.name == variable && column.kind != kind);
    if other { format!("{variable}'") } else { variable.to_owned() }
}

fn columns(builder: &mut Builder<'_>, source: &Source<'_, '_>, step: Element<'_, '_>) {
    for (parent, kind) in [("inputs", ColumnKind::Input), ("conditions", ColumnKind::Output)] {
        for element in child(step, parent).into_iter().flat_map(elements) {
            let Some(variable) = source.attribute(element, "var") else { continue };
            let name = column_name(&variable.text, kind, builder);
            if builder.table.column(&name).is_none()
                && let Some(index) = variable_column(builder, variable, kind, None, None)
            {
                builder.table.columns[index].name = name;
            }
        }
    }
}

fn row(builder: &mut Builder<'_>, source: &Source<'_, '_>, step: Element<'_, '_>) -> Row {
    let mut cells: Vec<Option<Cell>> = vec![None; builder.table.columns.len()];
    // What is not checked in this step may be anything, so no blank may repeat the cell above.
    for (cell, column) in cells.iter_mut().zip(&builder.table.columns) {
        if column.kind == ColumnKind::Output {
            *cell = Some(any(source, step));
        }
    }
    for element in child(step, "inputs").into_iter().flat_map(elements) {
        cell(builder, source, element, ColumnKind::Input, &mut cells);
    }
    for element in child(step, "conditions").into_iter().flat_map(elements) {
        cell(builder, source, element, ColumnKind::Output, &mut cells);
    }
    let duration = duration(builder, source, step);
    let remark = source.attribute(step, "description").filter(|word| !word.text.is_empty());
    let place = source.whole(step);
    Row { id: String::new(), cells, duration, remark, controls: Vec::new(), gotos: Vec::new(), place }
}

fn any(source: &Source<'_, '_>, step: Element<'_, '_>) -> Cell {
    let place = source.head(step);
    let chunk = crate::table::cell::ast::Chunk { kind: crate::table::cell::ast::ChunkKind::Any, span: place.span };
    let constraint = Some(crate::table::cell::ast::Constraint { chunks: vec![chunk] });
    Cell { text: "-".to_owned(), place, constraint }
}

fn cell(
    builder: &mut Builder<'_>,
    source: &Source<'_, '_>,
    element: Element<'_, '_>,
    kind: ColumnKind,
    cells: &mut [Option<Cell>],
) {
    let attribute = |name: &str| element.attribute(name).unwrap_or("").trim().to_owned();
    let text = match element.tag_name().name() {
        "set" => attribute("value"),
        "checkvalue" => checked_value(&attribute),
        "checkrange" => format!("[{}, {}]", attribute("lower"), attribute("upper")),
        other => {
            let message = format!("`{other}` has no counterpart in a table and is left out");
            builder.wrong(&codes::TABLE_UNSUPPORTED, source.head(element), message);
            return;
        }
    };
    let variable = attribute("var");
    let name = column_name(&variable, kind, builder);
    let found = builder.table.columns.iter().position(|column| column.name == name && column.kind == kind);
    let Some(index) = found else {
        builder.wrong(&codes::TABLE_COLUMN, source.head(element), "this entry names no variable");
        return;
    };
    // The text is made from several attributes: all of it stands at the element.
    let head = source.head(element);
    let piece = Piece::verbatim(head.file, &text, head.span.start);
    let mut read = builder.cell(&piece, 1);
    if let Some(cell) = &mut read {
        cell.place = head;
    }
    cells[index] = read;
}

/// The manual writes the operators as `= < <= > => <>`.
fn checked_value(attribute: &dyn Fn(&str) -> String) -> String {
    let (value, precision) = (attribute("value"), attribute("precision"));
    match attribute("operator").as_str() {
        "" | "=" if !precision.is_empty() && precision != "0" => {
            format!("[{value} - {precision}, {value} + {precision}]")
        }
        "" | "=" => value,
        "=>" => format!(">= {value}"),
        operator => format!("{operator} {value}"),
    }
}

fn duration(
    builder: &mut Builder<'_>,
    source: &Source<'_, '_>,
    step: Element<'_, '_>,
) -> crate::table::duration::DurationCell {
    let text = child(step, "durationrepeat").and_then(|element| source.attribute_text(element, "count"));
    let text = text.or_else(|| child(step, "durationtimespan").and_then(|e| source.attribute_text(e, "time")));
    if let Some(element) = child(step, "durationconditions") {
        let message = "a duration that depends on conditions has no counterpart; the step lasts any time";
        builder.wrong(&codes::TABLE_UNSUPPORTED, source.head(element), message);
        let mut duration = builder.duration(&source.piece.part(0..0), Duration::any(), None);
        duration.place = source.head(element);
        duration.text = "-".to_owned();
        return duration;
    }
    match text {
        Some(text) => builder.duration(&text.piece(source), Duration::exactly(1), None),
        None => {
            let start = step.range().start;
            builder.duration(&source.piece.part(start..start), Duration::exactly(1), None)
        }
    }
}
