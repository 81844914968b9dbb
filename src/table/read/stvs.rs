//! Sessions and specifications of the tool *STVS*, with the code of the session and the concrete tables (instances and
//! counterexamples) that it keeps beside a specification.
//!
//! A concrete row lists every cycle; equal cycles in a row become one row of the model.

use roxmltree::Node as Element;

use super::build::Builder;
use super::exteta::{kind, variable_column};
use super::xml::{Source, child, elements};
use super::{Options, Read};
use crate::diagnostic::Finding;
use crate::table::codes;
use crate::table::duration::Duration;
use crate::table::model::{Cell, Node, Row, Word};
use crate::text::Fragment;

pub(super) fn document(source: &Source<'_, '_>, root: Element<'_, '_>, options: &Options, read: &mut Read) {
    if root.tag_name().name() == "specification" {
        specification(source, root, options, read);
        return;
    }
    if let Some(code) = child(root, "code").and_then(|code| child(code, "plaintext")) {
        let text = source.text(code);
        let piece = text.piece(source);
        let map = super::build::span_map(&piece);
        read.code = Some(Fragment { text: text.as_str().into(), map });
    }
    for tab in child(root, "tabs").into_iter().flat_map(elements) {
        for element in elements(tab) {
            specification(source, element, options, read);
        }
    }
}

fn specification(source: &Source<'_, '_>, element: Element<'_, '_>, options: &Options, read: &mut Read) {
    let name = source.attribute(element, "name");
    let name = name.unwrap_or_else(|| Word { text: "Unnamed".to_owned(), place: source.head(element) });
    let mut builder = Builder::new(name, source.whole(element), options);
    let is = |name: &str| element.attribute(name).is_some_and(|value| value == "true" || value == "1");
    builder.table.options.concrete = is("isConcrete");
    builder.table.options.counterexample = is("isCounterExample");
    match child(element, "variables") {
        Some(variables) => elements(variables).for_each(|variable| declare(&mut builder, source, variable)),
        None => builder.wrong(&codes::TABLE_SYNTAX, source.head(element), "`variables` is missing"),
    }
    let mut body = Vec::new();
    for row in child(element, "rows").into_iter().flat_map(elements) {
        rows(&mut builder, source, row, &mut body);
    }
    builder.table.body = body;
    builder.name_rows();
    read.take(builder.finish());
}

fn declare(builder: &mut Builder<'_>, source: &Source<'_, '_>, element: Element<'_, '_>) {
    let Some(name) = source.attribute(element, "name") else {
        builder.wrong(&codes::TABLE_COLUMN, source.head(element), "this variable has no name");
        return;
    };
    let ty = source.attribute(element, "data-type");
    match element.tag_name().name() {
        "ioVariable" => {
            let remark = element.attribute("comment").filter(|text| !text.is_empty()).map(str::to_owned);
            let io = source.attribute(element, "io");
            let slot = kind(builder, io, source.head(element))
                .and_then(|kind| variable_column(builder, name, kind, ty, remark));
            builder.slots.push(slot);
        }
        "freeVariable" => {
            let default = source.attribute_text(element, "default");
            builder.global(name, ty, default.as_ref().map(|text| text.piece(source)).as_ref());
        }
        other => {
            let message = format!("`{other}` is neither `ioVariable` nor `freeVariable`");
            builder.wrong(&codes::TABLE_SYNTAX, source.head(element), message);
        }
    }
}

fn rows(builder: &mut Builder<'_>, source: &Source<'_, '_>, element: Element<'_, '_>, out: &mut Vec<Node>) {
    let cycles: Vec<Element<'_, '_>> = elements(element).filter(|e| e.tag_name().name() == "cycle").collect();
    let duration = child(element, "duration");
    let text = duration.map(|duration| source.text(duration));
    if cycles.is_empty() {
        let piece = match &text {
            Some(text) => text.piece(source),
            None => {
                builder.wrong(&codes::TABLE_SYNTAX, source.head(element), "`duration` is missing");
                source.piece.part(element.range().start..element.range().start)
            }
        };
        // A concrete row of no cycle lists none and says 0.
        let duration = builder.duration(&piece, Duration::exactly(1), None);
        let cells = cells(builder, source, element);
        let remark = source.attribute(element, "comment").filter(|word| !word.text.is_empty());
        let place = source.whole(element);
        let row = Row { id: String::new(), cells, duration, remark, controls: Vec::new(), gotos: Vec::new(), place };
        out.push(Node::Row(Box::new(row)));
        return;
    }
    let stated = text.and_then(|text| text.as_str().trim().parse::<usize>().ok());
    if stated.is_some_and(|stated| stated != cycles.len()) {
        let message = format!("the row lists {} cycles and says {}", cycles.len(), stated.unwrap_or(0));
        builder.report(Finding::new(&codes::TABLE_DURATION, source.head(element), message));
    }
    concrete(builder, source, &cycles, out);
}

/// Rows of equal cycles.
fn concrete(builder: &mut Builder<'_>, source: &Source<'_, '_>, cycles: &[Element<'_, '_>], out: &mut Vec<Node>) {
    let texts = |cells: &[Option<Cell>]| -> Vec<Option<String>> {
        cells.iter().map(|cell| cell.as_ref().map(|cell| cell.text.clone())).collect()
    };
    let mut last: Option<(Row, i128)> = None;
    let finished = |(mut row, count): (Row, i128)| {
        row.duration.duration = Duration::exactly(count);
        row.duration.text = count.to_string();
        Node::Row(Box::new(row))
    };
    for cycle in cycles {
        let cells = cells(builder, source, *cycle);
        if let Some((row, count)) = &mut last
            && texts(&row.cells) == texts(&cells)
        {
            *count += 1;
            continue;
        }
        out.extend(last.take().map(finished));
        let start = cycle.range().start;
        let duration = builder.duration(&source.piece.part(start..start), Duration::exactly(1), None);
        let place = source.whole(*cycle);
        let row =
            Row { id: String::new(), cells, duration, remark: None, controls: Vec::new(), gotos: Vec::new(), place };
        last = Some((row, 1));
    }
    out.extend(last.map(finished));
}

fn cells(builder: &mut Builder<'_>, source: &Source<'_, '_>, parent: Element<'_, '_>) -> Vec<Option<Cell>> {
    let slots = builder.slots.clone();
    let mut out = vec![None; builder.table.columns.len()];
    let mut count = 0;
    for element in elements(parent).filter(|element| element.tag_name().name() == "cell") {
        count += 1;
        match slots.get(count - 1) {
            Some(Some(index)) => {
                let text = source.text(element);
                out[*index] = builder.cell(&text.piece(source), 1);
            }
            Some(None) => {}
            None => {
                let message = format!("there is no column for this cell; the table has {}", slots.len());
                builder.wrong(&codes::TABLE_COLUMN, source.whole(element), message);
                return out;
            }
        }
    }
    if count < slots.len() {
        let message = format!("this row has {count} cells, and the table has {} columns", slots.len());
        builder.wrong(&codes::TABLE_COLUMN, source.head(parent), message);
    }
    out
}
