//! Groups and rows.

use super::declaration::{run_name, split_run, unknown};
use super::lexer::Kind;
use super::{Broken, Builder, Finding, MAX_DEPTH, Reader, Result, codes, word};
use crate::diagnostic::Severity;
use crate::table::duration::{Duration, Repeat};
use crate::table::model::{Block, Control, Goto, Node, Row, Word};
use crate::table::piece::Piece;

impl<'p> Reader<'_, 'p> {
    /// The group round everything; a second one stands behind the first.
    pub(super) fn root(&mut self, builder: &mut Builder<'_>) -> Result<()> {
        let block = self.group(builder)?;
        let once = Repeat::Times { low: 1, high: Some(1) };
        let plain = block.duration.duration.count(None, &Default::default()) == Ok(once);
        if plain && block.duration.duration.flag.is_none() && !block.duration.spoiled {
            builder.table.body.extend(block.children);
        } else {
            builder.table.body.push(Node::Block(Box::new(block)));
        }
        Ok(())
    }

    fn group(&mut self, builder: &mut Builder<'_>) -> Result<Block> {
        let from = self.at;
        self.at += 1;
        let place = self.since(from).whole();
        let id = self.node_name(builder);
        let duration = self.node_duration();
        let duration = builder.duration(&duration, Duration::exactly(1), None);
        if self.depth >= MAX_DEPTH {
            return Err(self.unexpected(builder, "a group that is nested less deeply"));
        }
        self.expect(builder, "{")?;
        self.depth += 1;
        let children = self.children(builder);
        self.depth -= 1;
        Ok(Block { id: id.map(|id| id.text), children: children?, duration, place })
    }

    fn children(&mut self, builder: &mut Builder<'_>) -> Result<Vec<Node>> {
        let mut children = Vec::new();
        while !self.eat("}") {
            if self.is("row") {
                children.push(Node::Row(Box::new(self.row(builder)?)));
            } else if self.is("group") {
                children.push(Node::Block(Box::new(self.group(builder)?)));
            } else if self.is("\\goto") {
                let gotos = self.gotos(builder)?;
                if let Some(goto) = gotos.first() {
                    let message = "a jump out of a whole group is not kept";
                    builder.wrong(&codes::TABLE_UNSUPPORTED, goto.table.place, message);
                }
            } else {
                self.unexpected(builder, "`row` or `group`");
                self.find_next_row()?;
            }
        }
        Ok(children)
    }

    /// Steps to the next row or group of the same group, or to its end.
    fn find_next_row(&mut self) -> Result<()> {
        while !self.end() && !self.is("row") && !self.is("group") && !self.is("}") {
            if self.is("{") { self.skip_braces() } else { self.at += 1 }
        }
        if self.end() { Err(Broken) } else { Ok(()) }
    }

    /// The name straight behind `row` or `group`: a name, or a number, but no duration.
    fn node_name(&mut self, builder: &mut Builder<'_>) -> Option<Word> {
        let named = match self.kind() {
            Kind::Word => !self.is("omega"),
            Kind::Number => true,
            _ => self.is("-") && self.tokens[self.at + 1].kind == Kind::Number,
        };
        if named { self.name_or_number(builder, "a name").ok() } else { None }
    }

    /// What stands before the brace.
    fn node_duration(&mut self) -> Piece<'p> {
        let from = self.at;
        while !self.end() && !self.is("{") && !self.is("}") {
            self.at += 1;
        }
        self.since(from)
    }

    fn row(&mut self, builder: &mut Builder<'_>) -> Result<Row> {
        let from = self.at;
        self.at += 1;
        let id = self.node_name(builder);
        let duration = self.node_duration();
        old_flag(builder, &duration);
        let duration = builder.duration(&duration, Duration::exactly(1), None);
        self.expect(builder, "{")?;
        let mut row = Row {
            id: id.map_or_else(String::new, |id| id.text),
            cells: vec![None; builder.table.columns.len()],
            duration,
            remark: self.remark(),
            controls: Vec::new(),
            gotos: Vec::new(),
            place: self.since(from).whole(),
        };
        while !self.eat("}") {
            if self.end() {
                return Err(self.unexpected(builder, "`}` at the end of the row"));
            }
            self.entry(builder, &mut row)?;
        }
        row.place = self.since(from).whole();
        Ok(row)
    }

    /// A `//` comment behind the brace, on its line.
    fn remark(&self) -> Option<Word> {
        let brace = self.tokens[self.at - 1].range.end;
        let comment = self.comments.iter().find(|comment| comment.after == self.at)?;
        let between = self.piece.text.get(brace..comment.range.start)?;
        if between.contains('\n') {
            return None;
        }
        let text = self.piece.part(comment.range.start + 2..comment.range.end).trimmed();
        (!text.text.is_empty()).then(|| word(&text))
    }

    /// One entry of a row.
    fn entry(&mut self, builder: &mut Builder<'_>, row: &mut Row) -> Result<()> {
        match self.text() {
            "\\inherit_from" => self.inherit_row(builder, row)?,
            "\\goto" => {
                let gotos = self.gotos(builder)?;
                if let Some(goto) = gotos.first() {
                    let message = "a jump to another table is kept and not followed";
                    builder.wrong(&codes::TABLE_UNSUPPORTED, goto.table.place, message);
                }
                row.gotos.extend(gotos);
            }
            "\\pause" | "\\play" | "\\backward" => {
                let control = self.control(builder)?;
                row.controls.push(control);
            }
            ";" => self.at += 1,
            _ if matches!(self.kind(), Kind::Word | Kind::Qualified) => self.cell(builder, row)?,
            _ => return self.skip_entry(builder),
        }
        Ok(())
    }

    fn skip_entry(&mut self, builder: &mut Builder<'_>) -> Result<()> {
        self.unexpected(builder, "`NAME: cell`");
        while !self.end() && !self.is("}") && !self.is(";") && !self.begins_cell() {
            self.at += 1;
        }
        Ok(())
    }

    /// Whether `NAME :` stands at the cursor.
    fn begins_cell(&self) -> bool {
        matches!(self.kind(), Kind::Word | Kind::Qualified) && self.text_at(self.at + 1) == ":"
    }

    fn cell(&mut self, builder: &mut Builder<'_>, row: &mut Row) -> Result<()> {
        if !self.begins_cell() {
            return self.skip_entry(builder).map(|()| self.at += usize::from(self.is(";")));
        }
        let name_place = self.place();
        let name = self.column_name(builder);
        self.at += 2;
        let from = self.at;
        let mut depth = 0_usize;
        while !self.end() && !self.is("}") && !self.is(";") && self.kind() != Kind::Command {
            match self.kind() {
                Kind::Sign('(' | '[') => depth += 1,
                Kind::Sign(')' | ']') => depth = depth.saturating_sub(1),
                // Inside parentheses `IN := 1` names an argument.
                _ if depth == 0 && self.begins_cell() => break,
                _ => {}
            }
            self.at += 1;
        }
        let piece = self.since(from);
        self.eat(";");
        let Some(index) = builder.table.column(&name) else {
            let mut finding = Finding::new(&codes::TABLE_COLUMN, name_place, format!("no column is named `{name}`"));
            finding.help.extend(builder.nearest_column(&name).map(|near| format!("the table declares `{near}`")));
            builder.report(finding);
            return Ok(());
        };
        let arguments = builder.table.columns[index].subject.arguments();
        let cell = builder.cell(&piece, arguments);
        if let (Some(before), Some(_)) = (&row.cells[index], &cell)
            && row.place.span.start < before.place.span.start
        {
            let message = format!("this row has two cells for `{name}`, and the second one counts");
            let mut finding = Finding::new(&codes::TABLE_COLUMN, name_place, message);
            finding.severity = Severity::Warning;
            builder.report(finding.label(before.place, "the first one"));
        }
        if cell.is_some() {
            row.cells[index] = cell;
        }
        Ok(())
    }

    /// The column that the word at the cursor names.
    fn column_name(&self, builder: &Builder<'_>) -> String {
        let text = self.text();
        if self.kind() == Kind::Qualified {
            let (run, name) = split_run(text);
            return format!("{}::{name}", run_name(builder, run));
        }
        let name = text.trim_matches('`');
        match builder.table.runs.first() {
            Some(run) if builder.table.column(name).is_none() => format!("{}::{name}", run.text),
            _ => name.to_owned(),
        }
    }

    /// `\inherit_from TABLE ROW`: the cells of that row.
    fn inherit_row(&mut self, builder: &mut Builder<'_>, row: &mut Row) -> Result<()> {
        self.at += 1;
        let table = self.name(builder, "the name of a table")?;
        let wanted = self.name_or_number(builder, "the name of a row")?;
        self.eat(";");
        let Some(parent) = self.read.tables.iter().find(|other| other.name == table.text) else {
            unknown(builder, table.place, &format!("no table in front of this one is named `{}`", table.text));
            return Ok(());
        };
        let Some(source) = parent.rows().into_iter().find(|other| other.id == wanted.text) else {
            unknown(builder, wanted.place, &format!("`{}` has no row named `{}`", table.text, wanted.text));
            return Ok(());
        };
        for (column, cell) in parent.columns.iter().zip(&source.cells) {
            if let (Some(index), Some(cell)) = (builder.table.column(&column.name), cell) {
                row.cells[index] = Some(cell.clone());
            }
        }
        Ok(())
    }

    /// `\goto: \pass(TABLE, ROW), …`.
    fn gotos(&mut self, builder: &mut Builder<'_>) -> Result<Vec<Goto>> {
        self.at += 1;
        self.expect(builder, ":")?;
        let mut out = Vec::new();
        loop {
            let when = match self.text() {
                when @ ("\\pass" | "\\miss" | "\\fail") => when[1..].to_owned(),
                _ => return Err(self.unexpected(builder, "`\\pass`, `\\miss` or `\\fail`")),
            };
            self.at += 1;
            self.expect(builder, "(")?;
            let table = self.name(builder, "the name of a table")?;
            self.expect(builder, ",")?;
            let row = self.name_or_number(builder, "the name of a row")?;
            self.expect(builder, ")")?;
            out.push(Goto { when, table, row });
            if !self.eat(",") {
                self.eat(";");
                return Ok(out);
            }
        }
    }

    fn control(&mut self, builder: &mut Builder<'_>) -> Result<Control> {
        let command = self.text().to_owned();
        let place = self.place();
        self.at += 1;
        let target = if command == "\\backward" {
            self.expect(builder, "(")?;
            let target = self.name_or_number(builder, "the name of a row")?;
            self.expect(builder, ")")?;
            Some(target)
        } else {
            None
        };
        self.expect(builder, ":")?;
        let mut runs = self.list(builder, "the name of a run")?;
        for run in &mut runs {
            run.text = run_name(builder, &run.text);
        }
        self.eat(";");
        builder.wrong(&codes::TABLE_UNSUPPORTED, place, format!("`{command}` is kept and has no meaning here"));
        Ok(match target {
            Some(target) => Control::Backward { target, runs },
            None if command == "\\pause" => Control::Pause(runs),
            None => Control::Play(runs),
        })
    }
}

/// The flag in the spellings of earlier versions.
fn old_flag(builder: &mut Builder<'_>, duration: &Piece<'_>) {
    for old in [">>", "_p"] {
        if duration.text.ends_with(old) {
            let at = duration.text.len() - old.len();
            let message = format!("the flag `{old}` is written `progress` today");
            builder.wrong(&codes::TABLE_OLD_SPELLING, duration.at(at..duration.text.len()), message);
        }
    }
}
