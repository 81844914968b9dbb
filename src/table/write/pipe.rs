//! Pipe tables: written from the model, and aligned where they stand.

use super::{Marks, Written, cell_text, duration_text, lost_parts, marks, quantity_text, subject_text};
use crate::table::duration::Bounds;
use crate::table::model::{Block, Column, Subject, Table};
use crate::table::piece::Piece;
use crate::table::read::pipe::{after_tag, cells, is_rule, undecorated};
use crate::text::FileId;

/// The table as a pipe table under its heading.
#[must_use]
pub fn pipe(table: &Table) -> Written<String> {
    let grid = grid(table);
    let mut content = heading(table) + "\n";
    content.push_str(&aligned(&grid, true).join("\n"));
    content.push('\n');
    let mut lost = lost_parts(table);
    lost.extend(
        table.columns.iter().filter(|c| c.remark.is_some()).map(|c| format!("the remark of column `{}`", c.name)),
    );
    Written { content, lost }
}

/// The `@gtt` line.
pub(super) fn heading(table: &Table) -> String {
    let mut attributes = Vec::new();
    if let Some(unit) = &table.unit {
        attributes.push(format!("for {}", unit.text));
    }
    if let Some(cycle) = table.options.cycle {
        attributes.push(format!("cycle {}", crate::table::cell::time_text(cycle.nanos)));
    }
    if table.options.strict {
        attributes.push("strict".to_owned());
    }
    if table.options.concrete {
        attributes.push("concrete".to_owned());
    }
    if !table.runs.is_empty() {
        let runs: Vec<&str> = table.runs.iter().map(|run| run.text.as_str()).collect();
        attributes.push(format!("runs {}", runs.join(" ")));
    }
    attributes.extend(table.constants.iter().map(|c| format!("const {} = {}", c.name, quantity_text(c.value))));
    for global in &table.globals {
        let ty = global.ty.as_ref().map_or_else(String::new, |ty| format!(" : {}", ty.text));
        let with =
            global.constraint.as_ref().map_or_else(String::new, |cell| format!(" with {}", cell_text(Some(cell))));
        attributes.push(format!("global {}{ty}{with}", global.name));
    }
    let entries = table.options.entries.iter();
    attributes.extend(entries.map(|(key, value)| format!("option {} = {}", key.text, value.text)));
    if attributes.is_empty() && table.name.ends_with(')') {
        attributes.push("weak".to_owned());
    }
    let tail = if attributes.is_empty() { String::new() } else { format!(" ({})", attributes.join(", ")) };
    format!("@gtt {}{tail}", table.name)
}

pub(in crate::table) fn header_cell(column: &Column) -> String {
    let subject = subject_text(&column.subject);
    let ty = column.ty.as_ref().map_or_else(String::new, |ty| format!(" : {}", ty.text));
    let plain = matches!(&column.subject, Subject::Variable(_)) && subject == column.name;
    let bound = if plain { String::new() } else { format!(" as {subject}") };
    format!("{} {}{ty}{bound}", column.kind.word(), column.name)
}

/// Header and rows as texts, without escapes.
pub(super) fn grid(table: &Table) -> Vec<Vec<String>> {
    let rows = table.rows();
    let marks = marks(table);
    let repeats = marks.iter().any(|marks| !marks.begin.is_empty());
    let remarks = rows.iter().any(|row| row.remark.is_some());
    let mut header = vec!["#".to_owned()];
    header.extend(table.columns.iter().map(header_cell));
    header.push("dur".to_owned());
    header.extend(repeats.then(|| "repeat".to_owned()));
    header.extend(remarks.then(|| "remark".to_owned()));
    let mut out = vec![header];
    for (row, marks) in rows.iter().zip(&marks) {
        let mut line = vec![row.id.clone()];
        line.extend(row.cells.iter().map(|cell| cell_text(cell.as_ref())));
        line.push(if row.duration.spoiled { row.duration.text.clone() } else { duration_text(&row.duration.duration) });
        line.extend(repeats.then(|| repeat_text(marks)));
        line.extend(remarks.then(|| row.remark.as_ref().map_or_else(String::new, |remark| remark.text.clone())));
        out.push(line);
    }
    out
}

fn repeat_text(marks: &Marks<'_>) -> String {
    let begin = |block: &&Block| block.id.as_ref().map_or_else(|| "{".to_owned(), |id| format!("{{ {id}"));
    let end = |block: &&Block| match block.duration.duration.bounds {
        Bounds::Omega => "}".to_owned(),
        _ => format!("}} x {}", duration_text(&block.duration.duration)),
    };
    marks.begin.iter().map(begin).chain(marks.end.iter().map(end)).collect::<Vec<_>>().join(" ")
}

/// The lines of a pipe table with its bars below each other; the first line is the header.
fn aligned(grid: &[Vec<String>], rule: bool) -> Vec<String> {
    let escaped: Vec<Vec<String>> =
        grid.iter().map(|row| row.iter().map(|cell| cell.replace('\n', " ").replace('|', "\\|")).collect()).collect();
    let columns = escaped.iter().map(Vec::len).max().unwrap_or(0);
    let width = |at: usize| escaped.iter().filter_map(|row| row.get(at)).map(|cell| cell.chars().count()).max();
    let widths: Vec<usize> = (0..columns).map(|at| width(at).unwrap_or(0).max(1)).collect();
    let line = |row: &Vec<String>| {
        let cells = row.iter().zip(&widths).map(|(cell, width)| format!(" {cell:<width$} |")).collect::<String>();
        format!("|{cells}")
    };
    let mut out: Vec<String> = escaped.iter().map(line).collect();
    if rule {
        let rule = widths.iter().map(|width| format!("{}|", "-".repeat(width + 2))).collect::<String>();
        out.insert(1.min(out.len()), format!("|{rule}"));
    }
    out
}

/// The text of a source or Markdown file with its test tables aligned; nothing else changes. Rows keep what they say, cell by
/// cell: only the blanks between the bars change.
#[must_use]
pub fn format_in_place(text: &str) -> String {
    let piece = Piece::verbatim(FileId(0), text, 0);
    let lines: Vec<Piece<'_>> = piece.lines().collect();
    let mut out = String::with_capacity(text.len());
    let (mut at, mut copied) = (0, 0);
    let mut announced = false;
    while at < lines.len() {
        let line = undecorated(&lines[at]);
        if line.text.starts_with('|') && announced {
            let end = at + lines[at..].iter().take_while(|line| undecorated(line).text.starts_with('|')).count();
            for (line, new) in lines[at..end].iter().zip(realigned(&lines[at..end])) {
                let inner = undecorated(line);
                let begin = inner.behind(&piece) as usize;
                out.push_str(&text[copied..begin]);
                out.push_str(&new);
                copied = begin + inner.text.len();
            }
            announced = false;
            at = end;
            continue;
        }
        announced = after_tag(&line).is_some() || (announced && !ends_heading(line.text));
        at += 1;
    }
    out + &text[copied..]
}

/// A blank line or a fence may stand between a heading and its table, and a heading may go on over lines.
fn ends_heading(line: &str) -> bool {
    line.starts_with('#') || line.starts_with('@')
}

fn realigned(lines: &[Piece<'_>]) -> Vec<String> {
    let lines: Vec<Piece<'_>> = lines.iter().map(undecorated).collect();
    let rule = lines.get(1).is_some_and(is_rule);
    let grid: Vec<Vec<String>> = lines
        .iter()
        .enumerate()
        .filter(|(at, _)| !(rule && *at == 1))
        .map(|(_, line)| cells(line).iter().map(|cell| cell.piece().text.to_owned()).collect())
        .collect();
    aligned(&grid, rule)
}
