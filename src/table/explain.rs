//! A sentence for each row in plain English: "for at most 500 ms, while `E` is false: `Ext` is on and `Alarm` is off".

use super::cell::ast::{BinaryOp, Chunk, ChunkKind, Constraint, Expr, ExprKind, Interval, Literal, LiteralValue};
use super::cell::print::{self, Style};
use super::duration::{Amount, Bounds, DurationCell, Term};
use super::model::{Column, Quantity, Subject, Table};

/// A sentence for each row, from top to bottom; names and values stand in backticks.
#[must_use]
pub fn sentences(table: &Table) -> Vec<String> {
    let rows = table.rows();
    let sentence = |(row, cells): (&&super::model::Row, Vec<Option<&super::model::Cell>>)| {
        let phrases = |assumed: bool| -> Vec<String> {
            let columns = table.columns.iter().zip(&cells).filter(|(column, _)| column.kind.is_assumption() == assumed);
            columns
                .flat_map(|(column, cell)| cell_phrases(column, cell.and_then(|cell| cell.constraint.as_ref())))
                .collect()
        };
        let (inputs, outputs) = (phrases(true), phrases(false));
        let condition =
            if inputs.is_empty() { "whatever the inputs are".to_owned() } else { format!("while {}", listed(&inputs)) };
        let result = if outputs.is_empty() { "nothing is required".to_owned() } else { listed(&outputs) };
        format!("{}, {condition}: {result}", duration(&row.duration))
    };
    rows.iter().zip(table.effective()).map(sentence).collect()
}

/// `a, b and c`.
fn listed(phrases: &[String]) -> String {
    match phrases {
        [] => String::new(),
        [one] => one.clone(),
        [init @ .., last] => format!("{} and {last}", init.join(", ")),
    }
}

/// How long, as the beginning of a sentence.
#[must_use]
pub fn duration(cell: &DurationCell) -> String {
    let duration = &cell.duration;
    let zero = Amount::cycles(0);
    let text = match &duration.bounds {
        Bounds::Omega => "from then on for ever".to_owned(),
        Bounds::Exactly(exactly) => format!("for {}", amount(exactly)),
        Bounds::Between(low, None) if *low == zero => "for any time, perhaps none".to_owned(),
        Bounds::Between(low, None) => format!("for at least {}", amount(low)),
        Bounds::Between(low, Some(high)) if *low == zero => match below(high) {
            Some(limit) => format!("for less than {limit}"),
            None => format!("for at most {}", amount(high)),
        },
        Bounds::Between(low, Some(high)) => format!("for {} to {}", amount(low), amount(high)),
    };
    if duration.has_progress() { text + " and until the inputs fit what follows" } else { text }
}

/// `500 ms`, where the amount is that less one cycle.
fn below(amount: &Amount) -> Option<String> {
    match amount.terms.as_slice() {
        [first, (true, Term::Quantity(Quantity::Cycles(1)))] => Some(term(&first.1)),
        _ => None,
    }
}

fn amount(amount: &Amount) -> String {
    let mut out = String::new();
    for (at, (minus, part)) in amount.terms.iter().enumerate() {
        if at > 0 {
            out.push_str(if *minus { " less " } else { " and " });
        }
        out.push_str(&term(part));
    }
    out
}

fn term(term: &Term) -> String {
    match term {
        Term::Quantity(Quantity::Cycles(1)) => "one cycle".to_owned(),
        Term::Quantity(Quantity::Cycles(count)) => format!("{count} cycles"),
        Term::Quantity(Quantity::Nanos(nanos)) => super::cell::time_text(*nanos),
        Term::Constant(name) => format!("`{name}`"),
    }
}

fn cell_phrases(column: &Column, constraint: Option<&Constraint>) -> Vec<String> {
    let chunks = constraint.map_or(&[][..], |constraint| &constraint.chunks);
    chunks.iter().filter_map(|chunk| phrase(column, chunk)).collect()
}

fn phrase(column: &Column, chunk: &Chunk) -> Option<String> {
    let name = format!("`{}`", column.name);
    Some(match &chunk.kind {
        ChunkKind::Any => return None,
        ChunkKind::Value(expr) | ChunkKind::Compare(BinaryOp::Eq, expr) => value(column, &name, expr),
        ChunkKind::Compare(op, expr) => format!("{name} {} {}", relation(*op), quoted(expr)),
        ChunkKind::Interval(interval) => between(&name, interval)?,
        ChunkKind::Condition(expr) => format!("`{}` holds", own_named(expr, &column.name)),
        ChunkKind::Trigger(inner) => format!("in the first cycle {}", phrase(column, inner)?),
        ChunkKind::Guarded(_) => format!("{name} follows `{}`", print::chunk(chunk, Style::Signs)),
        ChunkKind::Predicate(predicate) => {
            format!("`{}` holds between the arguments of {name}", print::predicate_name(predicate))
        }
    })
}

fn quoted(expr: &Expr) -> String {
    format!("`{}`", print::expression(expr, Style::Signs))
}

/// An expression whose comparisons may leave out the column's own name.
fn own_named(expr: &Expr, name: &str) -> String {
    let text = print::expression(expr, Style::Signs);
    let mut own = false;
    expr.walk(&mut |part| own |= part.kind == ExprKind::Own);
    if own { format!("{name}: {text}") } else { text }
}

fn value(column: &Column, name: &str, expr: &Expr) -> String {
    match &expr.kind {
        ExprKind::Literal(Literal { value: LiteralValue::Bool(value), .. }) => {
            let word = match (column.kind.is_assumption(), value) {
                (true, true) => "true",
                (true, false) => "false",
                (false, true) => "on",
                (false, false) => "off",
            };
            format!("{name} is {word}")
        }
        ExprKind::Past(path, 1) if column.subject == Subject::Variable(path.clone()) => {
            format!("{name} keeps its value")
        }
        ExprKind::Literal(_) | ExprKind::Name(_) | ExprKind::EnumValue { .. } => format!("{name} is {}", quoted(expr)),
        _ => format!("{name} equals {}", quoted(expr)),
    }
}

const fn relation(op: BinaryOp) -> &'static str {
    match op {
        BinaryOp::Lt => "is below",
        BinaryOp::Le => "is at most",
        BinaryOp::Gt => "is above",
        BinaryOp::Ge => "is at least",
        BinaryOp::Ne => "is not",
        _ => "is",
    }
}

fn between(name: &str, interval: &Interval) -> Option<String> {
    let low = interval.low.as_ref().map(|low| {
        format!("{} {}", relation(if interval.low_closed { BinaryOp::Ge } else { BinaryOp::Gt }), quoted(low))
    });
    let high = interval.high.as_ref().map(|high| {
        format!("{} {}", relation(if interval.high_closed { BinaryOp::Le } else { BinaryOp::Lt }), quoted(high))
    });
    match (&interval.low, &interval.high, interval.low_closed && interval.high_closed) {
        (Some(low), Some(high), true) => Some(format!("{name} is between {} and {}", quoted(low), quoted(high))),
        _ => match (low, high) {
            (Some(low), Some(high)) => Some(format!("{name} {low} and {high}")),
            (Some(end), None) | (None, Some(end)) => Some(format!("{name} {end}")),
            (None, None) => None,
        },
    }
}
