//! Writers: each form of a table from the model. Reading what was written gives the same model, but for what a form
//! cannot hold, which the writer lists.

mod gtt;
pub mod pipe;
mod sheet;
mod test_manager;
mod xml;

use super::cell::print::{self, Style};
use super::duration::{Amount, Bounds, Duration, Flag, Term};
use super::model::{Block, Cell, Node, Quantity, Subject, Table};

pub use gtt::gtt;
pub use pipe::{format_in_place, pipe};
pub use sheet::{csv, ods, xlsx};
pub use test_manager::test_manager;
pub use xml::{exteta, stvs};

/// A table in some form, and what the form cannot hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written<T> {
    /// The file's content.
    pub content: T,
    /// What was lost, one line each.
    pub lost: Vec<String>,
}

/// A cell in plain ASCII; one that could not be read as it was written.
fn cell_text(cell: Option<&Cell>) -> String {
    match cell {
        None => String::new(),
        Some(Cell { constraint: Some(constraint), .. }) => print::constraint(constraint, Style::Ascii),
        Some(cell) => cell.text.clone(),
    }
}

/// What a column is bound to, as text.
fn subject_text(subject: &Subject) -> String {
    match subject {
        Subject::Variable(path) => print::path(path),
        Subject::Projection(exprs) => {
            exprs.iter().map(|expr| print::expression(expr, Style::Ascii)).collect::<Vec<_>>().join(", ")
        }
    }
}

fn quantity_text(quantity: Quantity) -> String {
    match quantity {
        Quantity::Cycles(count) => count.to_string(),
        Quantity::Nanos(nanos) => super::cell::time_text(nanos),
    }
}

fn amount_text(amount: &Amount) -> String {
    let mut out = String::new();
    for (at, (minus, term)) in amount.terms.iter().enumerate() {
        match (at, minus) {
            (0, _) => {}
            (_, true) => out.push_str(" - "),
            (_, false) => out.push_str(" + "),
        }
        match term {
            Term::Quantity(quantity) => out.push_str(&quantity_text(*quantity)),
            Term::Constant(name) => out.push_str(name),
        }
    }
    out
}

/// A duration in plain ASCII.
#[must_use]
pub fn duration_text(duration: &Duration) -> String {
    let text = match &duration.bounds {
        Bounds::Omega => return "omega".to_owned(),
        Bounds::Exactly(amount) => amount_text(amount),
        Bounds::Between(low, None) if *low == Amount::cycles(0) => "-".to_owned(),
        Bounds::Between(low, None) => format!(">= {}", amount_text(low)),
        Bounds::Between(low, Some(high)) => format!("[{}, {}]", amount_text(low), amount_text(high)),
    };
    match duration.flag {
        None => text,
        Some(Flag::Progress) => format!("{text} progress"),
        Some(Flag::Hold) => format!("{text} hold"),
    }
}

/// What no form but `.gtt` holds.
fn lost_parts(table: &Table) -> Vec<String> {
    let mut lost: Vec<String> =
        table.functions.iter().map(|function| format!("the function `{}`", function.name)).collect();
    for row in table.rows() {
        if !row.gotos.is_empty() {
            lost.push(format!("the jumps of row `{}`", row.id));
        }
        if !row.controls.is_empty() {
            lost.push(format!("what row `{}` does with its runs", row.id));
        }
    }
    lost
}

/// The options as key and value, those of other tools and the table's own.
fn options(table: &Table) -> Vec<(String, String)> {
    let mut out = Vec::new();
    if let Some(cycle) = table.options.cycle {
        out.push(("cycle".to_owned(), super::cell::time_text(cycle.nanos)));
    }
    if table.options.strict {
        out.push(("strict".to_owned(), "TRUE".to_owned()));
    }
    if table.options.concrete {
        out.push(("concrete".to_owned(), "TRUE".to_owned()));
    }
    if let Some(unit) = &table.unit {
        out.push(("unit".to_owned(), unit.text.clone()));
    }
    out.extend(table.options.entries.iter().map(|(key, value)| (key.text.clone(), value.text.clone())));
    out
}

/// The blocks that begin in front of a row, and those that end behind it, innermost first.
#[derive(Default)]
struct Marks<'t> {
    begin: Vec<&'t Block>,
    end: Vec<&'t Block>,
}

/// The marks of each row, from top to bottom; blocks without rows are left out.
fn marks(table: &Table) -> Vec<Marks<'_>> {
    fn visit<'t>(nodes: &'t [Node], out: &mut Vec<Marks<'t>>) {
        for node in nodes {
            match node {
                Node::Row(_) => out.push(Marks::default()),
                Node::Block(block) => {
                    let first = out.len();
                    visit(&block.children, out);
                    if first < out.len() {
                        out[first].begin.insert(0, block);
                        let last = out.len() - 1;
                        out[last].end.push(block);
                    }
                }
            }
        }
    }
    let mut out = Vec::new();
    visit(&table.body, &mut out);
    out
}
