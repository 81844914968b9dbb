//! A table as the papers draw it, for any renderer: header groups, rows of short texts, which cells a blank one
//! repeats, and the brackets of repeated blocks.
//!
//! Inputs stand in front of outputs whatever order the user wrote; a renderer needs nothing of the model.

use super::cell::ast::{BinaryOp, Chunk, ChunkKind, Constraint};
use super::cell::print::{self, Style};
use super::duration::{Bounds, DurationCell, Flag};
use super::legend::{self, Sign};
use super::model::{Column, ColumnKind, Node, Row, Subject, Table};

/// A table, ready to be drawn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Its name.
    pub title: String,
    /// The upper header: which columns belong together, from left to right, without number, duration and remark.
    pub groups: Vec<Group>,
    /// The lower header.
    pub columns: Vec<Head>,
    /// Whether a column of remarks is needed.
    pub has_remarks: bool,
    /// The rows.
    pub rows: Vec<Line>,
    /// The brackets beside the rows; the outermost ones have depth 0.
    pub brackets: Vec<Bracket>,
    /// How many brackets stand side by side at most.
    pub bracket_depth: usize,
    /// The global variables with what they must satisfy, for the lines below the title.
    pub globals: Vec<(String, String)>,
    /// The time constants with their values.
    pub constants: Vec<(String, String)>,
    /// The signs that occur, and what they mean.
    pub legend: Vec<Sign>,
}

/// Columns under one heading.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// `Input`, `State` or `Output`.
    pub label: &'static str,
    /// What the columns are for.
    pub kind: ColumnKind,
    /// How many columns.
    pub columns: usize,
}

/// A column's header.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Head {
    /// The name.
    pub name: String,
    /// The declared type.
    pub ty: Option<String>,
    /// What it is for.
    pub kind: ColumnKind,
    /// What it is bound to, where that is not a variable of its name.
    pub bound_to: Option<String>,
    /// Its index in the table.
    pub index: usize,
}

/// A row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// Name or number.
    pub id: String,
    /// A cell for each column of [`Layout::columns`].
    pub cells: Vec<LaidCell>,
    /// The duration.
    pub duration: DurationText,
    /// The remark; empty where there is none.
    pub remark: String,
    /// Whether a part of it could not be read.
    pub spoiled: bool,
}

/// A cell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LaidCell {
    /// What to print; for a cell that repeats the one above, the text of that one.
    pub text: String,
    /// How many rows it covers where blank cells below are merged into it; 0 for such a blank cell.
    pub rows: usize,
    /// How it is meant.
    pub role: Role,
    /// The signs in it that need a word.
    pub signs: Vec<Sign>,
}

/// How a cell is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Anything.
    Any,
    /// The variable equals what is printed.
    Value,
    /// What is printed holds.
    Condition,
    /// It could not be read.
    Spoiled,
}

/// A duration.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DurationText {
    /// What to print.
    pub text: String,
    /// Whether the progress flag stands behind it.
    pub progress: bool,
}

/// A bracket beside the rows of a repeated block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bracket {
    /// How many brackets stand outside of it.
    pub depth: usize,
    /// The first row.
    pub first: usize,
    /// The last row.
    pub last: usize,
    /// How often, as printed beside it.
    pub label: DurationText,
    /// The block's name.
    pub name: Option<String>,
}

/// Lays `table` out.
#[must_use]
pub fn layout(table: &Table) -> Layout {
    let mut order: Vec<usize> = (0..table.columns.len()).collect();
    order.sort_by_key(|index| table.columns[*index].kind);
    let columns: Vec<Head> = order.iter().map(|index| head(&table.columns[*index], *index)).collect();
    let rows = lines(table, &order);
    let mut brackets = Vec::new();
    brackets_of(&table.body, 0, &mut 0, &mut brackets);
    let bracket_depth = brackets.iter().map(|bracket| bracket.depth + 1).max().unwrap_or(0);
    Layout {
        title: table.name.clone(),
        groups: groups(&columns),
        has_remarks: rows.iter().any(|row| !row.remark.is_empty()),
        legend: legend::of_table(table),
        globals: globals(table),
        constants: table.constants.iter().map(|c| (c.name.clone(), quantity_text(c.value))).collect(),
        columns,
        rows,
        brackets,
        bracket_depth,
    }
}

fn quantity_text(quantity: super::model::Quantity) -> String {
    match quantity {
        super::model::Quantity::Cycles(1) => "1 cycle".to_owned(),
        super::model::Quantity::Cycles(count) => format!("{count} cycles"),
        super::model::Quantity::Nanos(nanos) => super::cell::time_text(nanos),
    }
}

fn globals(table: &Table) -> Vec<(String, String)> {
    let text = |cell: &super::model::Cell| {
        cell.constraint.as_ref().map_or_else(|| cell.text.clone(), |c| print::constraint(c, Style::Signs))
    };
    let one = |global: &super::model::Global| {
        let name = match &global.ty {
            Some(ty) => format!("{} : {}", global.name, ty.text),
            None => global.name.clone(),
        };
        (name, global.constraint.as_ref().map_or_else(|| "–".to_owned(), text))
    };
    table.globals.iter().map(one).collect()
}

const fn label(kind: ColumnKind) -> &'static str {
    match kind {
        ColumnKind::Input => "Input",
        ColumnKind::Output => "Output",
        ColumnKind::StateAssumption => "State (assumed)",
        ColumnKind::StateAssertion => "State (asserted)",
    }
}

fn groups(columns: &[Head]) -> Vec<Group> {
    let mut out: Vec<Group> = Vec::new();
    for column in columns {
        match out.last_mut() {
            Some(group) if group.kind == column.kind => group.columns += 1,
            _ => out.push(Group { label: label(column.kind), kind: column.kind, columns: 1 }),
        }
    }
    out
}

fn head(column: &Column, index: usize) -> Head {
    let bound_to = match &column.subject {
        Subject::Variable(path) => Some(print::path(path)).filter(|path| *path != column.name),
        Subject::Projection(exprs) => {
            let text = exprs.iter().map(|expr| print::expression(expr, Style::Signs)).collect::<Vec<_>>().join(", ");
            Some(text).filter(|text| *text != column.name)
        }
    };
    let ty = column.ty.as_ref().map(|ty| ty.text.clone());
    Head { name: column.name.clone(), ty, kind: column.kind, bound_to, index }
}

fn lines(table: &Table, order: &[usize]) -> Vec<Line> {
    let rows = table.rows();
    let effective = table.effective();
    let cells_of = |at: usize, row: &Row| -> Vec<LaidCell> {
        order
            .iter()
            .map(|column| {
                let own = row.cells[*column].is_some();
                let merged = !own && at > 0;
                let below = rows[at + 1..].iter().take_while(|row| row.cells[*column].is_none()).count();
                let (text, role) = cell_text(effective[at][*column]);
                let constraint = effective[at][*column].and_then(|cell| cell.constraint.as_ref());
                let signs = match constraint {
                    _ if merged => vec![Sign::Blank],
                    Some(constraint) => legend::of_cell(table, constraint),
                    None if role == Role::Any => vec![Sign::Any],
                    None => Vec::new(),
                };
                LaidCell { text, rows: if merged { 0 } else { 1 + below }, role, signs }
            })
            .collect()
    };
    let line = |(at, row): (usize, &&Row)| Line {
        id: row.id.clone(),
        cells: cells_of(at, row),
        duration: duration_text(&row.duration),
        remark: row.remark.as_ref().map_or_else(String::new, |remark| remark.text.clone()),
        spoiled: row.is_spoiled(),
    };
    rows.iter().enumerate().map(line).collect()
}

fn cell_text(cell: Option<&super::model::Cell>) -> (String, Role) {
    let Some(cell) = cell else { return ("–".to_owned(), Role::Any) };
    match &cell.constraint {
        None => (cell.text.clone(), Role::Spoiled),
        Some(constraint) => (print::constraint(constraint, Style::Signs), role(constraint)),
    }
}

fn role(constraint: &Constraint) -> Role {
    let value = |chunk: &Chunk| matches!(chunk.kind, ChunkKind::Value(_) | ChunkKind::Compare(BinaryOp::Eq, _));
    if constraint.is_any() {
        Role::Any
    } else if constraint.chunks.iter().all(value) {
        Role::Value
    } else {
        Role::Condition
    }
}

/// A duration as it is printed: the user's words with the signs of the papers.
#[must_use]
pub fn duration_text(cell: &DurationCell) -> DurationText {
    if cell.spoiled {
        return DurationText { text: cell.text.clone(), progress: false };
    }
    let progress = cell.duration.flag == Some(Flag::Progress);
    let text = match &cell.duration.bounds {
        Bounds::Omega => "ω".to_owned(),
        _ if cell.text.is_empty() => "1".to_owned(),
        Bounds::Between(low, None) if *low == super::duration::Amount::cycles(0) && !cell.text.contains('[') => {
            "–".to_owned()
        }
        _ => prettified(&without_flag(&cell.text)),
    };
    let hold = if cell.duration.flag == Some(Flag::Hold) { " hold" } else { "" };
    DurationText { text: text + hold, progress }
}

fn without_flag(text: &str) -> String {
    let mut text = text.trim();
    for flag in ["input", "progress", "hold", ">>", "_p"] {
        text = text.strip_suffix(flag).unwrap_or(text).trim_end();
    }
    let bare = text.strip_suffix('p').filter(|rest| !rest.ends_with(|c: char| c.is_alphabetic()));
    bare.unwrap_or(text).trim_end().to_owned()
}

/// An interval's open end as `∞`, comparisons as one sign.
fn prettified(text: &str) -> String {
    let text = text.replace("<=", "≤").replace(">=", "≥");
    match text.split_once(',') {
        Some((low, high)) => {
            let high = high.trim();
            let open = ["-]", "–]", "—]", "*]", "∞]", "+∞]"].iter().any(|end| high.replace(' ', "") == *end);
            format!("{}, {}", low.trim(), if open { "∞]" } else { high })
        }
        None => text,
    }
}

fn brackets_of(nodes: &[Node], depth: usize, row: &mut usize, out: &mut Vec<Bracket>) {
    for node in nodes {
        match node {
            Node::Row(_) => *row += 1,
            Node::Block(block) => {
                let (first, at) = (*row, out.len());
                brackets_of(&block.children, depth + 1, row, out);
                if *row > first {
                    let label = duration_text(&block.duration);
                    out.insert(at, Bracket { depth, first, last: *row - 1, label, name: block.id.clone() });
                }
            }
        }
    }
}
