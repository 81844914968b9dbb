//! The comparison of two releases as a page in Markdown.

use super::diff::tables::{CellChange, TableChange};
use super::diff::{Comparison, Release};
use super::report::cell;

/// The path of the page among the narrative pages.
pub const PATH: &str = "rungbook/changes.md";

/// The page.
#[must_use]
pub fn markdown(comparison: &Comparison) -> String {
    format!("# Changes\n\n{}", body(comparison, "##"))
}

fn name(release: &Release) -> String {
    let words = [&release.title, &release.version, &release.commit].map(|word| cell(word));
    words.into_iter().filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ")
}

/// The page without its title; its headings begin with `level`.
pub(super) fn body(comparison: &Comparison, level: &str) -> String {
    let mut out = format!("From {} to {}.\n\n", name(&comparison.old), name(&comparison.new));
    if comparison.is_empty() {
        out.push_str("Nothing changed that users can tell.\n\n");
        return out;
    }
    let breaking = comparison.breaking();
    out.push_str(&format!(
        "{breaking} incompatible changes of interfaces, {} compatible ones; {} of documentation, {} tables; {} tables lost their \
         evidence. By Semantic Versioning this is a **{}** release.\n\n",
        comparison.interface.len() - breaking,
        comparison.documentation.len(),
        comparison.tables.len(),
        comparison.lost.len(),
        comparison.advice.word(),
    ));
    lost(comparison, level, &mut out);
    interface(comparison, level, &mut out);
    if !comparison.tables.is_empty() {
        out.push_str(&format!("{level} Tables\n\n"));
        comparison.tables.iter().for_each(|table| self::table(table, level, &mut out));
    }
    documentation(comparison, level, &mut out);
    out
}

fn lost(comparison: &Comparison, level: &str, out: &mut String) {
    if comparison.lost.is_empty() {
        return;
    }
    out.push_str(&format!("{level} Evidence that was lost\n\n"));
    for lost in &comparison.lost {
        out.push_str(&format!(
            "* {}: {} was verified and is **{}**\n",
            cell(&lost.block),
            cell(&lost.table),
            cell(&lost.now)
        ));
    }
    out.push('\n');
}

fn interface(comparison: &Comparison, level: &str, out: &mut String) {
    for (breaking, title) in [(true, "Incompatible changes"), (false, "Compatible changes")] {
        let mut changes = comparison.interface.iter().filter(|change| change.breaking == breaking).peekable();
        if changes.peek().is_none() {
            continue;
        }
        out.push_str(&format!("{level} {title}\n\n| entity | change | |\n|---|---|---|\n"));
        for change in changes {
            out.push_str(&format!(
                "| {} | {} | {} |\n",
                cell(&change.entity),
                code_cell(&change.what),
                cell(change.why)
            ));
        }
        out.push('\n');
    }
}

/// Text whose names stand in backticks already.
fn code_cell(text: &str) -> String {
    let part =
        |(n, part): (usize, &str)| if n % 2 == 1 { format!("`{}`", part.replace('|', "\\|")) } else { cell(part) };
    if text.matches('`').count().is_multiple_of(2) {
        text.split('`').enumerate().map(part).collect()
    } else {
        cell(text)
    }
}

/// What was is struck out, what is stands in bold.
fn change(cell: &CellChange) -> String {
    let (old, new) = (self::cell(&cell.old), self::cell(&cell.new));
    match (cell.changed, old.is_empty(), new.is_empty()) {
        (false, ..) => new,
        (_, true, _) => format!("**{new}**"),
        (_, _, true) => format!("~~{old}~~"),
        _ => format!("~~{old}~~ **{new}**"),
    }
}

fn table(table: &TableChange, level: &str, out: &mut String) {
    out.push_str(&format!("{level}# {}: {} ({})\n\n", cell(&table.block), cell(&table.name), table.what));
    for (name, was, is) in &table.facts {
        let both = CellChange { old: was.clone(), new: is.clone(), changed: true };
        out.push_str(&format!("* {}: {}\n", cell(name), change(&both)));
    }
    if !table.facts.is_empty() {
        out.push('\n');
    }
    let heads: Vec<String> = table
        .columns
        .iter()
        .map(|column| match column.what {
            "removed" => format!("~~{} {}~~", column.group, cell(&column.name)),
            "added" => format!("**{} {}**", column.group, cell(&column.name)),
            _ => format!("{} {}", column.group, cell(&column.name)),
        })
        .collect();
    out.push_str(&format!(
        "| | # | {} | dur | remark |\n|---|---|{}---|---|\n",
        heads.join(" | "),
        "---|".repeat(heads.len())
    ));
    for row in &table.rows {
        let mark = match row.what {
            "added" => "+",
            "removed" => "−",
            "changed" => "≠",
            _ => "",
        };
        let cells: Vec<String> = row.cells.iter().map(change).collect();
        let line = [mark, &cell(&row.id), &cells.join(" | "), &change(&row.duration), &change(&row.remark)].join(" | ");
        out.push_str(&format!("| {line} |\n"));
    }
    out.push('\n');
}

fn documentation(comparison: &Comparison, level: &str, out: &mut String) {
    if comparison.documentation.is_empty() {
        return;
    }
    out.push_str(&format!("{level} Documentation\n\n| entity | | before | now |\n|---|---|---|---|\n"));
    for change in &comparison.documentation {
        let cells = [&change.name, change.what, &change.old, &change.new].map(cell);
        out.push_str(&format!("| {} |\n", cells.join(" | ")));
    }
    out.push('\n');
}
