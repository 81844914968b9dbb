//! The signs of a table and what each of them means: for its legend, and for the cell in which one stands.

use super::cell::ast::{Arm, BinaryOp, Chunk, ChunkKind, Constraint, Expr, ExprKind, Path};
use super::duration::{Bounds, DurationCell};
use super::layout::duration_text;
use super::model::{Node, Table};

/// A sign that needs a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sign {
    /// `–` in a cell.
    Any,
    /// A cell that has no text of its own.
    Blank,
    /// A comparison that begins with its operator.
    Compare,
    /// `= e`, where `e` is a truth value that could be taken for a condition.
    Equals,
    /// A comparison that names both of its sides.
    Condition,
    /// `[a, b]`.
    Interval,
    /// An interval with an open side: `(a, b]`.
    OpenInterval,
    /// `c1, c2`.
    All,
    /// `√c`.
    Trigger,
    /// `X[-n]`.
    Past,
    /// `if :: g → e fi`.
    Guarded,
    /// The name of a global variable.
    Global,
    /// `–` as a duration.
    AnyDuration,
    /// `[m, n]`, `≥ n` as a duration.
    Between,
    /// `p` behind a duration.
    Progress,
    /// `ω` as a duration.
    Omega,
    /// A bracket beside the rows.
    Bracket,
}

impl Sign {
    /// How it is written in a legend.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Any => "–",
            Self::Blank => "(blank)",
            Self::Compare => "≥ e",
            Self::Equals => "= e",
            Self::Condition => "a < b",
            Self::Interval => "[a, b]",
            Self::OpenInterval => "(a, b)",
            Self::All => "c, d",
            Self::Trigger => "√c",
            Self::Past => "X[-n]",
            Self::Guarded => "if :: g → e fi",
            Self::Global => "p",
            Self::AnyDuration => "–",
            Self::Between => "[m, n]",
            Self::Progress => "p",
            Self::Omega => "ω",
            Self::Bracket => "⎤",
        }
    }

    /// Whether it stands in the column of durations or beside the rows.
    #[must_use]
    pub const fn is_of_durations(self) -> bool {
        matches!(self, Self::AnyDuration | Self::Between | Self::Progress | Self::Omega | Self::Bracket)
    }

    /// What it means.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Any => "anything",
            Self::Blank => "the same as in the row above",
            Self::Compare => "the column's variable compares with e in this way",
            Self::Equals => "the column's variable equals e",
            Self::Condition => "this condition holds, whatever the column's variable is",
            Self::Interval => "between a and b, both included; ∞ leaves a side open",
            Self::OpenInterval => "between a and b, without the end that has a round bracket",
            Self::All => "all of these hold",
            Self::Trigger => "c in the first cycle of the row, then anything",
            Self::Past => "the value that X had n cycles ago",
            Self::Guarded => "e of the first guard g that holds",
            Self::Global => "one value for the whole run; the table must hold for each that is admitted",
            Self::AnyDuration => "any number of cycles, none included",
            Self::Between => "from m to n cycles or so long; the row may be left anywhere in between",
            Self::Progress => "must be left as soon as the inputs fit what follows",
            Self::Omega => "for ever once it is entered",
            Self::Bracket => "these rows are repeated as a whole, as often as it says",
        }
    }
}

/// The signs of `table`, each once, in the order of a legend.
#[must_use]
pub fn of_table(table: &Table) -> Vec<Sign> {
    let mut out = Vec::new();
    for (at, row) in table.rows().into_iter().enumerate() {
        for cell in &row.cells {
            match cell {
                Some(cell) => out.extend(cell.constraint.iter().flat_map(|constraint| of_cell(table, constraint))),
                None if at == 0 => out.push(Sign::Any),
                None => out.push(Sign::Blank),
            }
        }
    }
    durations(&table.body, &mut out);
    out.sort_unstable();
    out.dedup();
    out
}

fn durations(nodes: &[Node], out: &mut Vec<Sign>) {
    for node in nodes {
        match node {
            Node::Row(row) => out.extend(of_duration(&row.duration)),
            Node::Block(block) => {
                out.push(Sign::Bracket);
                out.extend(of_duration(&block.duration));
                durations(&block.children, out);
            }
        }
    }
}

/// The signs of a duration.
#[must_use]
pub fn of_duration(cell: &DurationCell) -> Vec<Sign> {
    if cell.spoiled {
        return Vec::new();
    }
    let text = duration_text(cell);
    let mut out = match &cell.duration.bounds {
        Bounds::Omega => vec![Sign::Omega],
        _ if text.text == "–" => vec![Sign::AnyDuration],
        Bounds::Between(..) if text.text.starts_with('[') => vec![Sign::Between],
        _ => Vec::new(),
    };
    out.extend(text.progress.then_some(Sign::Progress));
    out
}

/// The signs of a cell, in the order of a legend.
#[must_use]
pub fn of_cell(table: &Table, constraint: &Constraint) -> Vec<Sign> {
    let mut out: Vec<Sign> = constraint.chunks.iter().flat_map(of_chunk).collect();
    if constraint.chunks.len() > 1 {
        out.push(Sign::All);
    }
    constraint.walk(&mut |expr: &Expr| match &expr.kind {
        ExprKind::Past(..) => out.push(Sign::Past),
        ExprKind::Guarded(_) => out.push(Sign::Guarded),
        ExprKind::Name(path) if is_global(table, path) => out.push(Sign::Global),
        _ => {}
    });
    out.sort_unstable();
    out.dedup();
    out
}

fn is_global(table: &Table, path: &Path) -> bool {
    path.run.is_none() && path.steps.is_empty() && table.global(&path.name).is_some()
}

fn of_chunk(chunk: &Chunk) -> Vec<Sign> {
    match &chunk.kind {
        ChunkKind::Any => vec![Sign::Any],
        ChunkKind::Value(_) | ChunkKind::Predicate(_) => Vec::new(),
        ChunkKind::Compare(BinaryOp::Eq, _) => vec![Sign::Equals],
        ChunkKind::Compare(..) => vec![Sign::Compare],
        ChunkKind::Interval(interval) if interval.low_closed && interval.high_closed => vec![Sign::Interval],
        ChunkKind::Interval(_) => vec![Sign::OpenInterval],
        ChunkKind::Condition(expr) => {
            let mut own = false;
            expr.walk(&mut |part| own |= part.kind == ExprKind::Own);
            vec![if own { Sign::Compare } else { Sign::Condition }]
        }
        ChunkKind::Trigger(inner) => [vec![Sign::Trigger], of_chunk(inner)].concat(),
        ChunkKind::Guarded(arms) => {
            let inner = arms.iter().flat_map(|Arm { then, .. }| of_chunk(then));
            std::iter::once(Sign::Guarded).chain(inner).collect()
        }
    }
}
