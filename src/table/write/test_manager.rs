//! Test tables of the CODESYS Test Manager (`<tabletestspec>`): each table a test case, each row a test step.
//!
//! A step sets constants, compares with constants, and lasts a fixed number of cycles or a fixed time. Everything else of a
//! table has no counterpart there: it is left out and listed as lost.

use super::xml::escaped;
use super::{Written, cell_text, duration_text, quantity_text};
use crate::table::cell::ast::{BinaryOp, ChunkKind, Expr, ExprKind, Literal, LiteralValue, UnaryOp};
use crate::table::cell::print::{self, Style};
use crate::table::duration::{Bounds, DurationCell, Repeat, Term};
use crate::table::model::{Cell, Column, Node, Row, Table};

/// The tables as test cases.
#[must_use]
pub fn test_manager(tables: &[&Table]) -> Written<String> {
    let mut lost = Vec::new();
    let testee = tables.iter().find_map(|table| table.unit.as_ref()).map_or("", |unit| unit.text.as_str());
    let mut out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<tabletestspec>\n".to_owned();
    out += &format!("    <testinformation testee=\"{}\"/>\n    <testgroup>\n", escaped(testee));
    for table in tables {
        case(table, &mut out, &mut lost);
    }
    out += "    </testgroup>\n</tabletestspec>\n";
    Written { content: out, lost }
}

fn case(table: &Table, out: &mut String, lost: &mut Vec<String>) {
    if table.body.iter().any(|node| matches!(node, Node::Block(_))) {
        lost.push("that blocks are repeated: their rows stand one after the other".to_owned());
    }
    lost.extend(table.globals.iter().map(|global| format!("the global variable `{}`", global.name)));
    lost.extend(super::lost_parts(table));
    *out += &format!("        <testcase name=\"{}\">\n", escaped(&table.name));
    for (row, cells) in table.rows().iter().zip(table.effective()) {
        step(table, row, &cells, out, lost);
    }
    *out += "        </testcase>\n";
}

fn step(table: &Table, row: &Row, cells: &[Option<&Cell>], out: &mut String, lost: &mut Vec<String>) {
    let description = row.remark.as_ref().map_or("", |remark| remark.text.as_str());
    *out += &format!("            <teststep description=\"{}\">\n                <inputs>", escaped(description));
    for (at, column) in table.columns.iter().enumerate().filter(|(_, column)| column.kind.is_assumption()) {
        // What was set stays set.
        if row.cells[at].is_some() {
            entries((row, table.options.concrete), column, cells[at], true, out, lost);
        }
    }
    *out += "</inputs>\n                <conditions>";
    for (at, column) in table.columns.iter().enumerate().filter(|(_, column)| !column.kind.is_assumption()) {
        entries((row, table.options.concrete), column, cells[at], false, out, lost);
    }
    *out += "</conditions>\n                ";
    *out += &duration(row, lost);
    *out += "\n            </teststep>\n";
}

fn entries(
    (row, concrete): (&Row, bool),
    column: &Column,
    cell: Option<&Cell>,
    set: bool,
    out: &mut String,
    lost: &mut Vec<String>,
) {
    let Some(constraint) = cell.and_then(|cell| cell.constraint.as_ref()) else { return };
    let variable = escaped(&super::subject_text(&column.subject));
    for chunk in &constraint.chunks {
        let entry = match (&chunk.kind, set) {
            (ChunkKind::Any, _) => continue,
            (ChunkKind::Value(expr) | ChunkKind::Compare(BinaryOp::Eq, expr), true) => {
                constant(expr, concrete).map(|value| format!("<set var=\"{variable}\" value=\"{value}\"/>"))
            }
            (ChunkKind::Value(expr), false) => constant(expr, concrete).map(|value| check(&variable, "=", &value)),
            (ChunkKind::Compare(op, expr), false) => {
                constant(expr, concrete).map(|value| check(&variable, sign(*op), &value))
            }
            (ChunkKind::Interval(interval), false) if interval.low_closed && interval.high_closed => {
                let ends = (
                    interval.low.as_ref().and_then(|end| constant(end, concrete)),
                    interval.high.as_ref().and_then(|end| constant(end, concrete)),
                );
                match ends {
                    (Some(low), Some(high)) => {
                        Some(format!("<checkrange var=\"{variable}\" lower=\"{low}\" upper=\"{high}\"/>"))
                    }
                    _ => None,
                }
            }
            _ => None,
        };
        match entry {
            Some(entry) => *out += &entry,
            None => lost.push(format!("`{}` of `{}` in row `{}`", cell_text(cell), column.name, row.id)),
        }
    }
}

fn check(variable: &str, operator: &str, value: &str) -> String {
    let operator = escaped(operator);
    format!("<checkvalue var=\"{variable}\" operator=\"{operator}\" value=\"{value}\"/>")
}

/// The operators of the Test Manager are `= < <= > => <>`.
const fn sign(op: BinaryOp) -> &'static str {
    match op {
        BinaryOp::Ne => "<>",
        BinaryOp::Lt => "<",
        BinaryOp::Le => "<=",
        BinaryOp::Gt => ">",
        BinaryOp::Ge => "=>",
        _ => "=",
    }
}

/// The text of a constant; names are none, unless they are values of enumerations.
fn constant(expr: &Expr, concrete: bool) -> Option<String> {
    if let ExprKind::Literal(Literal { value: LiteralValue::Bool(value), .. }) = &expr.kind {
        return Some(if *value { "TRUE" } else { "FALSE" }.to_owned());
    }
    let is_constant = match &expr.kind {
        ExprKind::Literal(_) | ExprKind::EnumValue { .. } => true,
        // In a concrete table, a name is a value of an enumeration.
        ExprKind::Name(path) => concrete && path.is_plain(),
        ExprKind::Unary(UnaryOp::Minus | UnaryOp::Plus, inner) => matches!(inner.kind, ExprKind::Literal(_)),
        _ => false,
    };
    is_constant.then(|| escaped(&print::expression(expr, Style::Ascii)))
}

fn duration(row: &Row, lost: &mut Vec<String>) -> String {
    let cell: &DurationCell = &row.duration;
    if let Bounds::Exactly(amount) = &cell.duration.bounds
        && let [(false, Term::Quantity(quantity))] = amount.terms.as_slice()
    {
        let text = quantity_text(*quantity);
        return match quantity {
            crate::table::model::Quantity::Cycles(_) => format!("<durationrepeat count=\"{text}\"/>"),
            crate::table::model::Quantity::Nanos(_) => {
                format!("<durationtimespan time=\"{}\"/>", text.replace(' ', ""))
            }
        };
    }
    if let Some(Repeat::Times { low, high }) = cell.repeat
        && high == Some(low)
    {
        return format!("<durationrepeat count=\"{low}\"/>");
    }
    let count = match cell.repeat {
        Some(Repeat::Times { low, .. }) => low.max(1),
        _ => 1,
    };
    lost.push(format!("the duration `{}` of row `{}`: {count} cycles", duration_text(&cell.duration), row.id));
    format!("<durationrepeat count=\"{count}\"/>")
}
