//! *exteta* 1.0 and 1.1, the XML of earlier versions of geteta: columns and constraints, then nested blocks and steps.
//!
//! Cells stand in the order of the columns. `duration="wait"` is `-` with the progress flag. A block without a duration
//! is there once, as in geteta.

use roxmltree::Node as Element;

use super::build::Builder;
use super::xml::{Source, child, elements};
use super::{Options, Read};
use crate::diagnostic::Finding;
use crate::table::cell::ast::Path;
use crate::table::codes;
use crate::table::duration::Duration;
use crate::table::model::{Block, Column, ColumnKind, Function, Node, Row, Subject, Word};
use crate::table::piece::Piece;

/// Blocks that nest deeper than this are refused.
const MAX_DEPTH: usize = 64;

pub(super) fn table(source: &Source<'_, '_>, root: Element<'_, '_>, options: &Options, read: &mut Read) {
    let name = source.attribute(root, "name");
    let name = name.unwrap_or_else(|| Word { text: "TTable".to_owned(), place: source.head(root) });
    let mut builder = Builder::new(name, source.whole(root), options);
    match child(root, "variables") {
        Some(variables) => elements(variables).for_each(|element| variable(&mut builder, source, element)),
        None => builder.wrong(&codes::TABLE_SYNTAX, source.head(root), "`variables` is missing"),
    }
    if let Some(functions) = child(root, "functions") {
        self::functions(&mut builder, &source.text(functions).piece(source));
    }
    for option in child(root, "options").into_iter().flat_map(elements) {
        if let (Some(key), Some(value)) = (source.attribute(option, "key"), source.attribute(option, "value")) {
            builder.option(key, value);
        }
    }
    match child(root, "steps") {
        Some(steps) => builder.table.body = nodes(&mut builder, source, steps, 0),
        None => builder.wrong(&codes::TABLE_SYNTAX, source.head(root), "`steps` is missing"),
    }
    builder.name_rows();
    read.take(builder.finish());
}

fn variable(builder: &mut Builder<'_>, source: &Source<'_, '_>, element: Element<'_, '_>) {
    let name = source.attribute(element, "name").or_else(|| source.attribute(element, "identifier"));
    let Some(name) = name else {
        builder.wrong(&codes::TABLE_COLUMN, source.head(element), "this variable has no name");
        return;
    };
    let ty = source.attribute(element, "data-type");
    match element.tag_name().name() {
        "variable" => {
            let io = source.attribute(element, "io");
            let slot =
                kind(builder, io, source.head(element)).and_then(|kind| variable_column(builder, name, kind, ty, None));
            builder.slots.push(slot);
        }
        "constraint" => {
            let constraint = source.attribute_text(element, "constraint");
            builder.global(name, ty, constraint.as_ref().map(|text| text.piece(source)).as_ref());
        }
        other => {
            let message = format!("`{other}` is neither `variable` nor `constraint`");
            builder.wrong(&codes::TABLE_SYNTAX, source.head(element), message);
        }
    }
}

/// What a column is for, by its `io` attribute.
pub(super) fn kind(builder: &mut Builder<'_>, io: Option<Word>, head: crate::text::Place) -> Option<ColumnKind> {
    let (text, place) = io.map_or((String::new(), head), |io| (io.text, io.place));
    match text.to_ascii_lowercase().as_str() {
        "input" => Some(ColumnKind::Input),
        "output" => Some(ColumnKind::Output),
        "state" | "state-assumption" => Some(ColumnKind::StateAssumption),
        "state-assertion" => Some(ColumnKind::StateAssertion),
        _ => {
            let message = format!("`{text}` is neither `input` nor `output`");
            builder.wrong(&codes::TABLE_COLUMN, place, message);
            None
        }
    }
}

/// Adds a column that is bound to the variable of its own name, which may be a path.
pub(super) fn variable_column(
    builder: &mut Builder<'_>,
    name: Word,
    kind: ColumnKind,
    ty: Option<Word>,
    remark: Option<String>,
) -> Option<usize> {
    let piece = Piece::verbatim(name.place.file, &name.text, name.place.span.start);
    let context = crate::table::cell::Context { relational: true, arguments: 1, ..Default::default() };
    let subject = match crate::table::cell::parse_expression(&piece, &context) {
        Ok(expr) => super::build::subject(vec![expr]),
        // A name with signs that Structured Text does not know, as generated code has (`$`).
        Err(_) => Subject::Variable(Path::plain(name.text.clone())),
    };
    builder.column(Column { name: name.text, kind, subject, ty, remark, place: name.place })
}

fn functions(builder: &mut Builder<'_>, piece: &Piece<'_>) {
    let upper = piece.text.to_ascii_uppercase();
    let mut at = 0;
    while let Some(begin) = upper[at..].find("FUNCTION").map(|begin| at + begin) {
        let Some(end) = upper[begin..].find("END_FUNCTION").map(|end| begin + end + 12) else {
            builder.wrong(&codes::TABLE_SYNTAX, piece.at(begin..begin + 8), "this function never ends");
            return;
        };
        let part = piece.part(begin..end);
        let name = part.text[8..].trim_start().split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or("");
        let function = Function { name: name.to_owned(), text: part.text.to_owned(), place: part.whole() };
        builder.table.functions.push(function);
        at = end;
    }
}

fn nodes(builder: &mut Builder<'_>, source: &Source<'_, '_>, parent: Element<'_, '_>, depth: usize) -> Vec<Node> {
    let mut out = Vec::new();
    for element in elements(parent) {
        match element.tag_name().name() {
            "step" => out.push(Node::Row(Box::new(step(builder, source, element)))),
            "block" | "region" if depth < MAX_DEPTH => {
                let duration = duration(builder, source, element);
                let children = nodes(builder, source, element, depth + 1);
                let id = element.attribute("name").map(str::to_owned);
                let place = source.head(element);
                out.push(Node::Block(Box::new(Block { id, children, duration, place })));
            }
            other => {
                let message = format!("`{other}` is neither `step` nor `block`, or nested too deeply");
                builder.wrong(&codes::TABLE_SYNTAX, source.head(element), message);
            }
        }
    }
    out
}

fn duration(
    builder: &mut Builder<'_>,
    source: &Source<'_, '_>,
    element: Element<'_, '_>,
) -> crate::table::duration::DurationCell {
    match source.attribute_text(element, "duration") {
        Some(text) => builder.duration(&text.piece(source), Duration::exactly(1), None),
        None => {
            let start = element.range().start;
            builder.duration(&source.piece.part(start..start), Duration::exactly(1), None)
        }
    }
}

fn step(builder: &mut Builder<'_>, source: &Source<'_, '_>, element: Element<'_, '_>) -> Row {
    let duration = duration(builder, source, element);
    let mut cells = vec![None; builder.table.columns.len()];
    let mut next = 0;
    for child in elements(element) {
        let name = child.tag_name().name();
        // Named elements write `$`, which XML does not allow in a name, as `___`.
        let named = || builder.table.column(name).or_else(|| builder.table.column(&name.replace("___", "$")));
        let slot = if name == "cell" { builder.slots.get(next).copied() } else { named().map(Some) };
        next += usize::from(name == "cell");
        let text = source.text(child);
        match slot {
            Some(Some(index)) => cells[index] = builder.cell(&text.piece(source), 1),
            Some(None) => {}
            None => {
                let count = builder.slots.len();
                let message = format!("there is no column for this cell; the table has {count}");
                builder.report(Finding::new(&codes::TABLE_COLUMN, source.whole(child), message));
            }
        }
    }
    let remark = source.attribute(element, "comment").filter(|word| !word.text.is_empty());
    let id = element.attribute("name").unwrap_or("").to_owned();
    Row { id, cells, duration, remark, controls: Vec::new(), gotos: Vec::new(), place: source.whole(element) }
}
