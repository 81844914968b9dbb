//! Changes of tables, cell by cell.
//!
//! Rows are aligned by the alignment of highest score (Needleman and Wunsch, 1970, without a price for gaps): equal rows
//! before rows of one name before rows that share at least half of their cells. Columns are matched by their headers.

use serde::Serialize;

use super::fold;
use crate::evidence::snapshot::{Row, Snapshot, Table};

/// A table that changed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct TableChange {
    /// The block.
    pub block: String,
    /// The table.
    pub name: String,
    /// `added`, `removed` or `changed`.
    pub what: &'static str,
    /// The verdict before and after; empty where there was or is no table.
    pub verdicts: (String, String),
    /// Facts that changed: name, before, after.
    pub facts: Vec<(String, String, String)>,
    /// The headers, those of both.
    pub columns: Vec<Column>,
    /// The rows, those of both.
    pub rows: Vec<RowChange>,
}

/// A column of one or both.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Column {
    /// `in` or `out`.
    pub group: String,
    /// The header.
    pub name: String,
    /// `same`, `added` or `removed`.
    pub what: &'static str,
}

/// A row of one or both.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct RowChange {
    /// Its number or name; where it changed, the new one.
    pub id: String,
    /// `same`, `changed`, `added` or `removed`.
    pub what: &'static str,
    /// A cell for each column.
    pub cells: Vec<CellChange>,
    /// The duration.
    pub duration: CellChange,
    /// The remark.
    pub remark: CellChange,
}

/// A cell before and after.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct CellChange {
    /// Before; empty where there was none.
    pub old: String,
    /// After; empty where there is none.
    pub new: String,
    /// Whether they differ.
    pub changed: bool,
}

impl CellChange {
    fn new(old: Option<&str>, new: Option<&str>) -> Self {
        let (old, new) = (old.unwrap_or(""), new.unwrap_or(""));
        Self { old: old.to_owned(), new: new.to_owned(), changed: old != new }
    }
}

/// What makes two tables one: block and name.
pub(super) fn key(table: &Table) -> (String, String) {
    (fold(&table.block), fold(&table.name))
}

/// All changes: of tables in both releases, then those that came, then those that went.
#[must_use]
pub fn compare(old: &Snapshot, new: &Snapshot) -> Vec<TableChange> {
    let find = |list: &'_ [Table], wanted: &Table| list.iter().position(|table| key(table) == key(wanted));
    let mut out = Vec::new();
    for table in &new.tables {
        match find(&old.tables, table) {
            None => out.push(change(&Table::default(), table, "added")),
            Some(index) => {
                let was = &old.tables[index];
                let same = was.facts == table.facts && was.columns == table.columns && was.rows == table.rows;
                if !same {
                    out.push(change(was, table, "changed"));
                }
            }
        }
    }
    let gone = old.tables.iter().filter(|table| find(&new.tables, table).is_none());
    out.extend(gone.map(|table| change(table, &Table::default(), "removed")));
    out
}

fn change(old: &Table, new: &Table, what: &'static str) -> TableChange {
    let named = if what == "removed" { old } else { new };
    let columns = columns(old, new);
    let rows = align(old, new).into_iter().map(|(was, is)| row(old, new, &columns, was, is)).collect();
    TableChange {
        block: named.block.clone(),
        name: named.name.clone(),
        what,
        verdicts: (old.verdict.clone(), new.verdict.clone()),
        facts: facts(old, new),
        columns,
        rows,
    }
}

fn facts(old: &Table, new: &Table) -> Vec<(String, String, String)> {
    let get = |table: &Table, name: &str| {
        table.facts.iter().find(|(key, _)| key == name).map_or_else(String::new, |(_, value)| value.clone())
    };
    let gone = old.facts.iter().filter(|(name, _)| !new.facts.iter().any(|(other, _)| other == name));
    let names = new.facts.iter().chain(gone).map(|(name, _)| name);
    let both = names.map(|name| (name.clone(), get(old, name), get(new, name)));
    both.filter(|(_, was, is)| was != is).collect()
}

/// The columns of the new table, each old one that is gone behind the column that it stood behind.
fn columns(old: &Table, new: &Table) -> Vec<Column> {
    let has = |table: &Table, column: &(String, String)| table.columns.contains(column);
    let make = |column: &(String, String), what| Column { group: column.0.clone(), name: column.1.clone(), what };
    let what = |column| if has(old, column) || old.columns.is_empty() { "same" } else { "added" };
    let mut out: Vec<Column> = new.columns.iter().map(|column| make(column, what(column))).collect();
    for (index, column) in old.columns.iter().enumerate().filter(|(_, column)| !has(new, column)) {
        let before = index.checked_sub(1).map(|index| &old.columns[index]);
        let at = before.and_then(|before| out.iter().position(|c| c.group == before.0 && c.name == before.1));
        let what = if new.columns.is_empty() { "same" } else { "removed" };
        out.insert(at.map_or(0, |at| at + 1), make(column, what));
    }
    out
}

fn row(old: &Table, new: &Table, columns: &[Column], was: Option<&Row>, is: Option<&Row>) -> RowChange {
    let cell = |table: &Table, row: Option<&'_ Row>, column: &Column| -> Option<String> {
        let index = table.columns.iter().position(|c| c.0 == column.group && c.1 == column.name)?;
        row?.cells.get(index).cloned()
    };
    let cells: Vec<CellChange> = columns
        .iter()
        .map(|column| CellChange::new(cell(old, was, column).as_deref(), cell(new, is, column).as_deref()))
        .collect();
    let duration = CellChange::new(was.map(|row| row.duration.as_str()), is.map(|row| row.duration.as_str()));
    let remark = CellChange::new(was.map(|row| row.remark.as_str()), is.map(|row| row.remark.as_str()));
    let what = match (was, is) {
        (None, _) => "added",
        (_, None) => "removed",
        _ if duration.changed || remark.changed || cells.iter().any(|cell| cell.changed) => "changed",
        _ => "same",
    };
    let id = is.or(was).map_or_else(String::new, |row| row.id.clone());
    RowChange { id, what, cells, duration, remark }
}

/// How much speaks for `a` having become `b`; 0 if nothing does.
fn score(old: &Table, new: &Table, a: &Row, b: &Row) -> u32 {
    let cells = old.columns.iter().zip(&a.cells);
    let other = |column: &(String, String)| new.columns.iter().position(|c| c == column).and_then(|i| b.cells.get(i));
    let equal =
        cells.filter(|(column, cell)| other(column) == Some(cell)).count() + usize::from(a.duration == b.duration);
    let all = old.columns.len().max(new.columns.len()) + 1;
    let percent = u32::try_from(equal * 100 / all).unwrap_or(0);
    let named = u32::from(a.id == b.id);
    if percent >= 50 || named == 1 { percent + 40 * named } else { 0 }
}

/// Pairs of rows, in order.
fn align<'a>(old: &'a Table, new: &'a Table) -> Vec<(Option<&'a Row>, Option<&'a Row>)> {
    let (n, m) = (old.rows.len(), new.rows.len());
    let scores: Vec<Vec<u32>> =
        old.rows.iter().map(|a| new.rows.iter().map(|b| score(old, new, a, b)).collect()).collect();
    // best[i][j]: the best alignment of the rows from i and from j on.
    let mut best = vec![vec![0_u32; m + 1]; n + 1];
    for i in (0..n).rev() {
        for j in (0..m).rev() {
            let paired = if scores[i][j] > 0 { best[i + 1][j + 1] + scores[i][j] } else { 0 };
            best[i][j] = paired.max(best[i + 1][j]).max(best[i][j + 1]);
        }
    }
    let (mut i, mut j, mut out) = (0, 0, Vec::new());
    while i < n || j < m {
        if i < n && j < m && scores[i][j] > 0 && best[i][j] == best[i + 1][j + 1] + scores[i][j] {
            out.push((Some(&old.rows[i]), Some(&new.rows[j])));
            (i, j) = (i + 1, j + 1);
        } else if j == m || i < n && best[i][j] == best[i + 1][j] {
            out.push((Some(&old.rows[i]), None));
            i += 1;
        } else {
            out.push((None, Some(&new.rows[j])));
            j += 1;
        }
    }
    out
}
