//! The forms in XML: exteta 1.1, and specifications of STVS.

use super::{Written, cell_text, duration_text, lost_parts, options, quantity_text, subject_text};
use crate::table::model::{Column, ColumnKind, Node, Row, Table};

pub(super) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

const fn io(kind: ColumnKind) -> &'static str {
    match kind {
        ColumnKind::Input => "input",
        ColumnKind::Output => "output",
        ColumnKind::StateAssumption => "state-assumption",
        ColumnKind::StateAssertion => "state-assertion",
    }
}

fn type_attribute(ty: Option<&crate::table::model::Word>) -> String {
    ty.map_or_else(String::new, |ty| format!(" data-type=\"{}\"", escaped(&ty.text)))
}

/// Columns that are bound to something else than the variable of their name.
fn lost_bindings(table: &Table) -> impl Iterator<Item = String> + '_ {
    let bound = |column: &&Column| subject_text(&column.subject) != column.name;
    table.columns.iter().filter(bound).map(|c| format!("that column `{}` is `{}`", c.name, subject_text(&c.subject)))
}

/// The table as exteta 1.1.
#[must_use]
pub fn exteta(table: &Table) -> Written<String> {
    let mut lost: Vec<String> = lost_parts(table);
    lost.retain(|lost| !lost.starts_with("the function"));
    lost.extend(lost_bindings(table));
    if table.is_relational() {
        lost.push("that the table compares runs".to_owned());
    }
    let mut out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
    let name = escaped(&table.name);
    out += &format!("<test-table xmlns=\"http://formal.iti.kit.edu/exteta-1.1\" version=\"1.1\" name=\"{name}\">\n");
    out += "    <variables>\n";
    for column in &table.columns {
        let ty = type_attribute(column.ty.as_ref());
        out += &format!("        <variable io=\"{}\" name=\"{}\"{ty}/>\n", io(column.kind), escaped(&column.name));
    }
    for global in &table.globals {
        let ty = type_attribute(global.ty.as_ref());
        let constraint = global
            .constraint
            .as_ref()
            .map_or_else(String::new, |cell| format!(" constraint=\"{}\"", escaped(&cell_text(Some(cell)))));
        out += &format!("        <constraint name=\"{}\"{ty}{constraint}/>\n", escaped(&global.name));
    }
    out += "    </variables>\n    <steps>\n";
    table.body.iter().for_each(|node| step(node, 2, &mut out));
    out += "    </steps>\n";
    if !table.functions.is_empty() {
        let text: Vec<&str> = table.functions.iter().map(|function| function.text.as_str()).collect();
        out += &format!("    <functions>{}</functions>\n", escaped(&text.join("\n")));
    }
    let constants = table.constants.iter().map(|c| (format!("const.{}", c.name), quantity_text(c.value)));
    let options: Vec<(String, String)> = options(table).into_iter().chain(constants).collect();
    if !options.is_empty() {
        out += "    <options>\n";
        for (key, value) in options {
            out += &format!("        <option key=\"{}\" value=\"{}\"/>\n", escaped(&key), escaped(&value));
        }
        out += "    </options>\n";
    }
    out += "</test-table>\n";
    Written { content: out, lost }
}

fn step(node: &Node, depth: usize, out: &mut String) {
    let indent = "    ".repeat(depth);
    match node {
        Node::Row(row) => {
            let comment =
                row.remark.as_ref().map_or_else(String::new, |word| format!(" comment=\"{}\"", escaped(&word.text)));
            let duration = escaped(&duration_text(&row.duration.duration));
            *out += &format!("{indent}<step name=\"{}\" duration=\"{duration}\"{comment}>", escaped(&row.id));
            for cell in &row.cells {
                *out += &format!("<cell>{}</cell>", escaped(&cell_text(cell.as_ref())));
            }
            *out += "</step>\n";
        }
        Node::Block(block) => {
            let name = block.id.as_ref().map_or_else(String::new, |id| format!(" name=\"{}\"", escaped(id)));
            let duration = escaped(&duration_text(&block.duration.duration));
            *out += &format!("{indent}<block{name} duration=\"{duration}\">\n");
            block.children.iter().for_each(|child| step(child, depth + 1, out));
            *out += &format!("{indent}</block>\n");
        }
    }
}

/// The table as a specification of STVS, which has no blocks and no options.
#[must_use]
pub fn stvs(table: &Table) -> Written<String> {
    let mut lost = lost_parts(table);
    lost.extend(lost_bindings(table));
    lost.extend(
        options(table).into_iter().filter(|(key, _)| key != "concrete").map(|(key, _)| format!("the option `{key}`")),
    );
    lost.extend(table.constants.iter().map(|constant| format!("the time constant `{}`", constant.name)));
    if table.body.iter().any(|node| matches!(node, Node::Block(_))) {
        lost.push("that blocks are repeated: their rows stand one after the other".to_owned());
    }
    if table.is_relational() {
        lost.push("that the table compares runs".to_owned());
    }
    let concrete = table.options.concrete;
    let mut out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
    out += &format!(
        "<specification xmlns=\"http://formal.iti.kit.edu/stvs/io/1.0/\" isConcrete=\"{concrete}\" isCounterExample=\"{}\" name=\"{}\">\n    <variables>\n",
        table.options.counterexample,
        escaped(&table.name)
    );
    for column in &table.columns {
        let ty = type_attribute(column.ty.as_ref());
        let comment = column.remark.as_ref().map_or_else(String::new, |text| format!(" comment=\"{}\"", escaped(text)));
        let name = escaped(&column.name);
        out += &format!("        <ioVariable io=\"{}\" name=\"{name}\"{ty}{comment}/>\n", io(column.kind));
    }
    for global in &table.globals {
        let ty = type_attribute(global.ty.as_ref());
        let default = escaped(&global.constraint.as_ref().map_or_else(|| "-".to_owned(), |cell| cell_text(Some(cell))));
        out += &format!("        <freeVariable name=\"{}\"{ty} default=\"{default}\"/>\n", escaped(&global.name));
    }
    out += "    </variables>\n    <rows>\n";
    table.rows().into_iter().for_each(|row| stvs_row(row, concrete, &mut out));
    out += "    </rows>\n</specification>\n";
    Written { content: out, lost }
}

fn stvs_row(row: &Row, concrete: bool, out: &mut String) {
    let comment = row.remark.as_ref().map_or_else(String::new, |word| format!(" comment=\"{}\"", escaped(&word.text)));
    let cells: String =
        row.cells.iter().map(|cell| format!("<cell>{}</cell>", escaped(&cell_text(cell.as_ref())))).collect();
    let duration = duration_text(&row.duration.duration);
    *out += &format!("        <row{comment}><duration>{}</duration>", escaped(&duration));
    match duration.parse::<usize>() {
        Ok(count) if concrete && count <= 100_000 => *out += &format!("<cycle>{cells}</cycle>").repeat(count),
        _ => *out += &cells,
    }
    *out += "</row>\n";
}
