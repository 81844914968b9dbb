//! The comparison of two releases: for the terminal, and as one HTML page on which changed cells are shaded as the papers do it.

use crate::evidence::diff::Comparison;
use crate::evidence::diff::tables::{CellChange, TableChange};

/// A few lines a change.
pub(crate) fn text(comparison: &Comparison) -> String {
    let mut out = String::new();
    for change in &comparison.interface {
        let mark = if change.breaking { "incompatible" } else { "compatible" };
        out.push_str(&format!("{mark}: {}: {} ({})\n", change.entity, change.what, change.why));
    }
    for change in &comparison.documentation {
        out.push_str(&format!("documentation: {}: {}\n", change.name, change.what));
    }
    for table in &comparison.tables {
        out.push_str(&format!("table: {}: {}: {}\n", table.block, table.name, table.what));
        if table.what == "changed" {
            cells(table, &mut out);
        }
    }
    for lost in &comparison.lost {
        out.push_str(&format!("lost: {}: {} was verified and is {}\n", lost.block, lost.table, lost.now));
    }
    out
}

fn cells(table: &TableChange, out: &mut String) {
    for (name, was, is) in &table.facts {
        out.push_str(&format!("  {name}: {} -> {}\n", or_none(was), or_none(is)));
    }
    for row in table.rows.iter().filter(|row| row.what != "same") {
        if row.what != "changed" {
            out.push_str(&format!("  row {} {}\n", row.id, row.what));
            continue;
        }
        let named = table.columns.iter().map(|column| column.name.as_str()).chain(["dur", "remark"]);
        let all = row.cells.iter().chain([&row.duration, &row.remark]);
        for (name, cell) in named.zip(all).filter(|(_, cell)| cell.changed) {
            out.push_str(&format!("  row {}, {name}: {} -> {}\n", row.id, or_none(&cell.old), or_none(&cell.new)));
        }
    }
}

fn or_none(text: &str) -> &str {
    if text.is_empty() { "nothing" } else { text }
}

const STYLE: &str = "body{font:16px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:60rem;padding:0 1rem;color:#1a1a1a;\
background:#fff}table{border-collapse:collapse;margin:1rem 0}th,td{border-bottom:1px solid #ccc;padding:.2rem .6rem;\
text-align:left;vertical-align:top}thead th{border-bottom:2px solid #444}td.changed,th.added,tr.added td{background:#d9d9d9}\
tr.removed td,th.removed{background:#f3d9d9}del{color:#6b1d1d}ins{text-decoration:none;font-weight:600}.breaking{color:#8b1a1a;\
font-weight:600}caption{text-align:left;font-weight:600;padding:.3rem 0}.scroll{overflow-x:auto}\
@media(prefers-color-scheme:dark){body{background:#161616;color:#eee}td.changed,th.added,tr.added td{background:#444}\
tr.removed td,th.removed{background:#532}del{color:#f0a0a0}.breaking{color:#ff9a9a}}";

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Names in backticks as code; text with an odd one is left as it is.
fn code(text: &str) -> String {
    if !text.matches('`').count().is_multiple_of(2) {
        return text.to_owned();
    }
    let part = |(n, part): (usize, &str)| if n % 2 == 1 { format!("<code>{part}</code>") } else { part.to_owned() };
    text.split('`').enumerate().map(part).collect()
}

/// One page that needs nothing beside it.
pub(crate) fn html(comparison: &Comparison) -> String {
    let release = |of: &crate::evidence::diff::Release| escape([&*of.title, &of.version, &of.commit].join(" ").trim());
    let title = format!("Changes from {} to {}", release(&comparison.old), release(&comparison.new));
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\
         <title>{title}</title><style>{STYLE}</style></head><body><main><h1>{title}</h1>\n"
    );
    let advice = comparison.advice.word();
    out.push_str(&format!(
        "<p>{} incompatible changes; by Semantic Versioning a <strong>{advice}</strong> release.</p>\n",
        comparison.breaking()
    ));
    if !comparison.lost.is_empty() {
        out.push_str("<h2>Evidence that was lost</h2><ul>");
        for lost in &comparison.lost {
            let (block, table, now) = (escape(&lost.block), escape(&lost.table), escape(&lost.now));
            out.push_str(&format!("<li>{block}: {table} was verified and is <strong>{now}</strong></li>"));
        }
        out.push_str("</ul>\n");
    }
    interface(comparison, &mut out);
    if !comparison.tables.is_empty() {
        out.push_str("<h2>Tables</h2>\n<p>Changed cells are shaded.</p>\n");
        comparison.tables.iter().for_each(|table| self::table(table, &mut out));
    }
    if !comparison.documentation.is_empty() {
        out.push_str("<h2>Documentation</h2><table><thead><tr><th>entity</th><th></th><th>before</th><th>now</th></tr></thead><tbody>\n");
        for change in &comparison.documentation {
            let cells = [&change.name, change.what, &change.old, &change.new].map(escape);
            out.push_str(&format!("<tr><td>{}</td></tr>\n", cells.join("</td><td>")));
        }
        out.push_str("</tbody></table>\n");
    }
    out.push_str("</main></body></html>\n");
    out
}

fn interface(comparison: &Comparison, out: &mut String) {
    if comparison.interface.is_empty() {
        return;
    }
    out.push_str("<h2>Interfaces</h2><table><thead><tr><th>entity</th><th>change</th><th></th></tr></thead><tbody>\n");
    for change in &comparison.interface {
        let kind = if change.breaking { "<span class=\"breaking\">incompatible</span>: " } else { "compatible: " };
        let (entity, what, why) = (escape(&change.entity), code(&escape(&change.what)), escape(change.why));
        out.push_str(&format!("<tr><td>{entity}</td><td>{what}</td><td>{kind}{why}</td></tr>\n"));
    }
    out.push_str("</tbody></table>\n");
}

fn cell(cell: &CellChange, out: &mut String) {
    let (old, new) = (escape(&cell.old), escape(&cell.new));
    match (cell.changed, old.is_empty(), new.is_empty()) {
        (false, ..) => out.push_str(&format!("<td>{new}</td>")),
        (_, true, _) => out.push_str(&format!("<td class=\"changed\"><ins>{new}</ins></td>")),
        (_, _, true) => out.push_str(&format!("<td class=\"changed\"><del>{old}</del></td>")),
        _ => out.push_str(&format!("<td class=\"changed\"><del>{old}</del> <ins>{new}</ins></td>")),
    }
}

fn table(table: &TableChange, out: &mut String) {
    let (block, name) = (escape(&table.block), escape(&table.name));
    let (was, is) = (escape(&table.verdicts.0), escape(&table.verdicts.1));
    let verdict = if was == is { was } else { format!("{was} → {is}") };
    out.push_str(&format!("<div class=\"scroll\" tabindex=\"0\"><table><caption>{block}: {name} ({}; {verdict})</caption><thead><tr><th>#</th>", table.what));
    for column in &table.columns {
        let (class, group, name) = (column.what, escape(&column.group), escape(&column.name));
        out.push_str(&format!("<th class=\"{class}\"><small>{group}</small> {name}</th>"));
    }
    out.push_str("<th>dur</th><th>remark</th></tr></thead><tbody>\n");
    for row in &table.rows {
        out.push_str(&format!("<tr class=\"{}\"><td>{}</td>", row.what, escape(&row.id)));
        row.cells.iter().chain([&row.duration, &row.remark]).for_each(|each| cell(each, out));
        out.push_str("</tr>\n");
    }
    out.push_str("</tbody></table></div>\n");
    for (name, was, is) in &table.facts {
        out.push_str(&format!("<p>{}: <del>{}</del> <ins>{}</ins></p>\n", escape(name), escape(was), escape(is)));
    }
}
