//! `.gtt`: everything that a table holds can be said in it.

use super::{Written, cell_text, duration_text, options, quantity_text, subject_text};
use crate::table::model::{Block, Column, ColumnKind, Control, Node, Row, Subject, Table};

/// The table in the language of geteta.
#[must_use]
pub fn gtt(table: &Table) -> Written<String> {
    let mut writer = Writer { out: String::new(), table, lost: Vec::new() };
    writer.table();
    Written { content: writer.out, lost: writer.lost }
}

struct Writer<'t> {
    out: String,
    table: &'t Table,
    lost: Vec<String>,
}

/// A name as the language takes it: in backticks where it is no word.
fn name(text: &str) -> String {
    let word = text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '$');
    let number = !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    if (word || number) && text != "omega" { text.to_owned() } else { format!("`{text}`") }
}

/// The name of a table with the signs that a word does not have replaced.
fn identifier(text: &str) -> String {
    let word: String = text.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if word.starts_with(|c: char| c.is_ascii_alphabetic()) { word } else { format!("t_{word}") }
}

impl Writer<'_> {
    fn line(&mut self, depth: usize, text: &str) {
        self.out.push_str(&"    ".repeat(depth));
        self.out.push_str(text);
        self.out.push('\n');
    }

    fn table(&mut self) {
        let table = self.table;
        let id = identifier(&table.name);
        if table.runs.is_empty() {
            self.line(0, &format!("table {id} {{"));
        } else {
            let runs: Vec<&str> = table.runs.iter().map(|run| run.text.as_str()).collect();
            self.line(0, &format!("relational table {id}({}) {{", runs.join(", ")));
        }
        table.columns.iter().for_each(|column| self.column(column));
        for global in &table.globals {
            let ty = global.ty.as_ref().map_or_else(String::new, |ty| format!(" : {}", ty.text));
            let with = global.constraint.as_ref().map_or_else(String::new, |c| format!(" with {}", cell_text(Some(c))));
            self.line(1, &format!("gvar {}{ty}{with}", global.name));
        }
        for constant in &table.constants {
            self.line(1, &format!("timeconst {} : {}", constant.name, quantity_text(constant.value)));
        }
        self.options(id != table.name);
        self.body();
        for function in &table.functions {
            self.line(1, &function.text);
        }
        self.line(0, "}");
    }

    fn column(&mut self, column: &Column) {
        let kind = match column.kind {
            ColumnKind::Input => "input",
            ColumnKind::Output => "output",
            ColumnKind::StateAssumption => "state assume",
            ColumnKind::StateAssertion => "state assert",
        };
        if let Some(remark) = &column.remark {
            self.lost.push(format!("the remark of column `{}`: {remark}", column.name));
        }
        let ty = column.ty.as_ref().map(|ty| ty.text.as_str());
        match &column.subject {
            Subject::Variable(path) if path.steps.is_empty() && ty.is_some() => {
                let shown = column.name.rsplit("::").next().unwrap_or(&column.name);
                let alias = if shown == path.name { String::new() } else { format!(" as {}", name(shown)) };
                let run = path.run.as_ref().map_or_else(String::new, |run| format!("{run}::"));
                let ty = ty.unwrap_or("");
                let variable = if run.is_empty() { name(&path.name) } else { path.name.clone() };
                self.line(1, &format!("var {kind} {run}{variable}{alias} : {ty}"));
            }
            subject => {
                let ty = ty.map_or_else(String::new, |ty| format!(" : {ty}"));
                self.line(1, &format!("column {kind} {}{ty} as {}", name(&column.name), subject_text(subject)));
            }
        }
    }

    fn options(&mut self, titled: bool) {
        let mut options = options(self.table);
        if titled {
            options.push(("title".to_owned(), self.table.name.clone()));
        }
        if options.is_empty() {
            return;
        }
        self.line(1, "options {");
        for (key, value) in options {
            self.line(2, &format!("{key} = \"{value}\";"));
        }
        self.line(1, "}");
    }

    /// A block that is everything is the group round everything, unless that would leave no trace of it.
    fn body(&mut self) {
        self.line(1, "group {");
        let table = self.table;
        table.body.iter().for_each(|node| self.node(node, 2));
        self.line(1, "}");
    }

    fn node(&mut self, node: &Node, depth: usize) {
        match node {
            Node::Row(row) => self.row(row, depth),
            Node::Block(block) => self.block(block, depth),
        }
    }

    fn block(&mut self, block: &Block, depth: usize) {
        let id = block.id.as_ref().map_or_else(String::new, |id| format!(" {}", name(id)));
        // A bare number behind `group` would be its name.
        let duration = duration_text(&block.duration.duration);
        let bare = id.is_empty() && duration.starts_with(|c: char| c.is_alphanumeric()) && duration != "omega";
        let duration = if bare { format!("[{duration}, {duration}]") } else { duration };
        self.line(depth, &format!("group{id} {duration} {{"));
        block.children.iter().for_each(|child| self.node(child, depth + 1));
        self.line(depth, "}");
    }

    fn row(&mut self, row: &Row, depth: usize) {
        let remark = row.remark.as_ref().map_or_else(String::new, |remark| format!(" // {}", remark.text));
        let duration = duration_text(&row.duration.duration);
        self.line(depth, &format!("row {} {duration} {{{remark}", name(&row.id)));
        for control in &row.controls {
            let text = control_text(control);
            self.line(depth + 1, &text);
        }
        for goto in &row.gotos {
            self.line(
                depth + 1,
                &format!("\\goto: \\{}({}, {});", goto.when, name(&goto.table.text), name(&goto.row.text)),
            );
        }
        for (cell, column) in row.cells.iter().zip(&self.table.columns) {
            if let Some(cell) = cell {
                let key = if column.name.contains("::") { column.name.clone() } else { name(&column.name) };
                let text = format!("{key}: {};", cell_text(Some(cell)));
                self.line(depth + 1, &text);
            }
        }
        self.line(depth, "}");
    }
}

fn control_text(control: &Control) -> String {
    let list =
        |runs: &[crate::table::model::Word]| runs.iter().map(|run| run.text.as_str()).collect::<Vec<_>>().join(", ");
    match control {
        Control::Pause(runs) => format!("\\pause: {};", list(runs)),
        Control::Play(runs) => format!("\\play: {};", list(runs)),
        Control::Backward { target, runs } => format!("\\backward({}): {};", name(&target.text), list(runs)),
    }
}
