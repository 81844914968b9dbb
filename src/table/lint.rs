//! What reads as specification and is none: the lints of the reference that need no decision about values.

use std::collections::BTreeSet;

use super::automaton::{Automaton, Target};
use super::cell::ast::{BinaryOp, ChunkKind, Constraint, Expr, ExprKind};
use super::codes;
use super::duration::Repeat;
use super::model::{Cell, Node, Row, Table};
use crate::diagnostic::Finding;
use crate::text::Place;

/// All lints of a table, in the order of its text. A table with errors gets those that need no automaton.
#[must_use]
pub fn lint(table: &Table) -> Vec<Finding> {
    let mut out = Vec::new();
    never_checked(table, &mut out);
    never_reached(&table.body, false, &mut out);
    cells(table, &mut out);
    globals(table, &mut out);
    columns(table, &mut out);
    blanks(table, &mut out);
    if let Ok(automaton) = Automaton::build(table) {
        ends(table, &automaton, &mut out);
        early_past(table, &automaton, &mut out);
    }
    out.sort_by_key(|finding| finding.place);
    out
}

fn repeat(node: &Node) -> Option<Repeat> {
    match node {
        Node::Row(row) => row.duration.repeat,
        Node::Block(block) => block.duration.repeat,
    }
}

fn may_be_empty(node: &Node) -> bool {
    let hollow = matches!(node, Node::Block(block) if block.children.iter().all(may_be_empty));
    matches!(repeat(node), Some(Repeat::Times { low: 0, .. })) || hollow && repeat(node) != Some(Repeat::Omega)
}

fn rows_of<'t>(node: &'t Node, out: &mut Vec<&'t Row>) {
    match node {
        Node::Row(row) => out.push(row),
        Node::Block(block) => block.children.iter().for_each(|child| rows_of(child, out)),
    }
}

/// Everything behind the last part that cannot be skipped; the findings stop at the first part that may be empty.
fn never_checked(table: &Table, out: &mut Vec<Finding>) {
    let skipped = table.body.iter().rev().take_while(|node| may_be_empty(node)).count();
    if skipped == table.body.len() {
        return;
    }
    for node in &table.body[table.body.len() - skipped..] {
        let mut rows = Vec::new();
        rows_of(node, &mut rows);
        for row in rows.into_iter().filter(|row| row.duration.repeat != Some(Repeat::Times { low: 0, high: Some(0) })) {
            let message = format!("row `{}` may be skipped, and so may all behind it: it is never checked", row.id);
            let finding = Finding::new(&codes::TABLE_NEVER_CHECKED, row.duration.place, message);
            out.push(finding.help("write `-∞` if it holds for ever, or give it a lower bound"));
        }
    }
}

/// Whether words can go on behind the nodes; reports rows behind one that lasts for ever, and rows that last no cycle.
fn never_reached(nodes: &[Node], mut dead: bool, out: &mut Vec<Finding>) -> bool {
    for node in nodes {
        let none = matches!(repeat(node), Some(Repeat::Times { high: Some(0), .. }));
        match node {
            Node::Row(row) if dead || none => {
                let why = if dead { "what stands in front of it lasts for ever" } else { "it lasts no cycle" };
                let message = format!("row `{}` is never reached: {why}", row.id);
                out.push(Finding::new(&codes::TABLE_NEVER_REACHED, row.place, message));
            }
            Node::Row(_) => {}
            Node::Block(block) => {
                dead |= never_reached(&block.children, dead || none, out) && !may_be_empty(node) && !none
            }
        }
        dead |= repeat(node) == Some(Repeat::Omega);
    }
    dead
}

fn constraints(table: &Table) -> impl Iterator<Item = (&Cell, &Constraint)> {
    let rows = table.rows();
    let cells = rows.into_iter().flat_map(|row| row.cells.iter().flatten());
    cells.filter_map(|cell| Some((cell, cell.constraint.as_ref()?)))
}

fn cells(table: &Table, out: &mut Vec<Finding>) {
    for (cell, constraint) in constraints(table) {
        for chunk in &constraint.chunks {
            if let ChunkKind::Value(expr) = &chunk.kind
                && is_ambiguous(expr)
            {
                let message = format!("`{}` is read as a value, not as a condition", cell.text);
                let place = Place::new(cell.place.file, expr.span);
                let finding = Finding::new(&codes::TABLE_AMBIGUOUS_BOOLEAN, place, message);
                out.push(
                    finding.help("begin it with `=` if the value is meant; compare every part if the condition is"),
                );
            }
        }
    }
}

/// A connective at the top with a comparison below it.
fn is_ambiguous(expr: &Expr) -> bool {
    use BinaryOp::{And, Implies, Or, Xor};
    let connective = matches!(
        &expr.kind,
        ExprKind::Binary(And | Or | Xor | Implies, ..) | ExprKind::Unary(super::cell::ast::UnaryOp::Not, _)
    );
    let mut compares = false;
    expr.walk(&mut |part| compares |= matches!(&part.kind, ExprKind::Binary(op, ..) if op.is_comparison()));
    connective && compares
}

fn globals(table: &Table, out: &mut Vec<Finding>) {
    for global in &table.globals {
        let mut count = 0;
        let mut visit = |expr: &Expr| {
            let named = matches!(&expr.kind, ExprKind::Name(path) if path.name.eq_ignore_ascii_case(&global.name));
            count += usize::from(named);
        };
        constraints(table).for_each(|(_, constraint)| constraint.walk(&mut visit));
        let others = table.globals.iter().filter(|other| other.name != global.name);
        let others = others.filter_map(|other| other.constraint.as_ref()?.constraint.as_ref());
        others.for_each(|constraint| constraint.walk(&mut visit));
        if count < 2 {
            let how = if count == 0 { "is used nowhere" } else { "is used once, which says no more than `-`" };
            let message = format!("global variable `{}` {how}", global.name);
            out.push(Finding::new(&codes::TABLE_GLOBAL_ONCE, global.place, message));
        }
    }
}

fn columns(table: &Table, out: &mut Vec<Finding>) {
    let effective = table.effective();
    for (at, column) in table.columns.iter().enumerate() {
        let free =
            |cell: Option<&Cell>| cell.is_none_or(|cell| cell.constraint.as_ref().is_some_and(Constraint::is_any));
        if !effective.is_empty() && effective.iter().all(|row| free(row[at])) {
            let message = format!("column `{}` is never constrained", column.name);
            out.push(Finding::new(&codes::TABLE_FREE_COLUMN, column.place, message));
        }
    }
}

/// One finding for a table: the first blank that repeats a constraint, and how many there are.
fn blanks(table: &Table, out: &mut Vec<Finding>) {
    let effective = table.effective();
    let rows = table.rows();
    let blanks = rows.iter().zip(&effective).flat_map(|(row, cells)| {
        let own = row.cells.iter().zip(cells);
        own.filter_map(|(own, counts)| match (own, counts) {
            (None, Some(cell)) if cell.constraint.as_ref().is_some_and(|c| !c.is_any()) => Some(row.place),
            _ => None,
        })
    });
    let blanks: Vec<Place> = blanks.collect();
    if let Some(first) = blanks.first() {
        let message = format!("blank cells repeat the one above; {} do in this table", blanks.len());
        out.push(Finding::new(&codes::TABLE_BLANK_REPEATS, *first, message));
    }
}

fn ends(table: &Table, automaton: &Automaton, out: &mut Vec<Finding>) {
    if automaton.may_be_empty {
        let message = "every row may be skipped, so the table may be over before it begins";
        out.push(Finding::new(&codes::TABLE_EMPTY_RUN, table.name_place, message));
    }
    if table.options.strict && !automaton.ends {
        let message = "the table never ends, so nothing can conform to it strictly";
        out.push(Finding::new(&codes::TABLE_NEVER_STRICT, table.name_place, message));
    }
}

/// For each leaf the fewest cycles that lie before it, by shortest ways over the edges (Dijkstra 1959).
fn earliest(automaton: &Automaton) -> Vec<Option<u64>> {
    let mut best: Vec<Option<u64>> = vec![None; automaton.leaves.len()];
    let mut work: BTreeSet<(u64, usize)> = BTreeSet::new();
    let enter = |edge: &super::automaton::Edge| match edge.target {
        Target::Enter(leaf) => Some(leaf),
        _ => None,
    };
    work.extend(automaton.entries.iter().filter_map(enter).map(|leaf| (0, leaf)));
    while let Some((cycles, leaf)) = work.pop_first() {
        if best[leaf].is_some_and(|known| known <= cycles) {
            continue;
        }
        best[leaf] = Some(cycles);
        if let Repeat::Times { low, .. } = automaton.leaves[leaf].repeat {
            let after = cycles.saturating_add(low.max(1));
            work.extend(automaton.edges[leaf].iter().filter_map(enter).map(|next| (after, next)));
        }
    }
    best
}

fn early_past(table: &Table, automaton: &Automaton, out: &mut Vec<Finding>) {
    let effective = table.effective();
    for (leaf, cycles) in automaton.leaves.iter().zip(earliest(automaton)) {
        let Some(cycles) = cycles else { continue };
        for cell in effective[leaf.row].iter().flatten() {
            let Some(constraint) = &cell.constraint else { continue };
            constraint.walk(&mut |expr| {
                if let ExprKind::Past(path, ago) = &expr.kind
                    && u64::from(*ago) > cycles
                {
                    let message = format!("`{}[-{ago}]` can be asked for in cycle {}", path.name, cycles + 1);
                    let place = Place::new(cell.place.file, expr.span);
                    let finding = Finding::new(&codes::TABLE_EARLY_PAST, place, message);
                    let finding = finding.help(format!("it is the initial value of `{}` then", path.name));
                    if !out.contains(&finding) {
                        out.push(finding);
                    }
                }
            });
        }
    }
}
