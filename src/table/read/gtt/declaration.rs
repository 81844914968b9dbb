//! What stands in front of the rows: variables, projections, global variables, constants, options, functions.

use super::lexer::Kind;
use super::{Builder, Finding, Reader, Result, codes, word};
use crate::diagnostic::Severity;
use crate::table::cell::ast::Path;
use crate::table::model::{Column, ColumnKind, Function, Subject, Word};
use crate::table::piece::Piece;
use crate::table::read::build::subject;
use crate::table::read::heading::add_constant;
use crate::text::Place;

impl<'p> Reader<'_, 'p> {
    /// `var MODIFIER… NAME [as NEW], … : TYPE`.
    pub(super) fn variables(&mut self, builder: &mut Builder<'_>) -> Result<()> {
        self.at += 1;
        let kind = self.modifiers(builder)?;
        let mut names = Vec::new();
        if self.eat("{") {
            let runs = self.list(builder, "the name of a run")?;
            self.expect(builder, "}")?;
            loop {
                let name = self.name(builder, "the name of a variable")?;
                names.extend(runs.iter().map(|run| Named {
                    run: Some(run_name(builder, &run.text)),
                    name: name.clone(),
                    alias: None,
                }));
                if !self.eat(",") {
                    break;
                }
            }
        } else {
            loop {
                names.push(self.named(builder)?);
                if !self.eat(",") {
                    break;
                }
            }
        }
        self.expect(builder, ":")?;
        let ty = self.type_name(builder)?;
        self.eat(";");
        for named in names {
            add_variable(builder, named, kind, ty.clone());
        }
        Ok(())
    }

    /// The words in front of a variable or column that say what it is for.
    fn modifiers(&mut self, builder: &mut Builder<'_>) -> Result<ColumnKind> {
        let from = self.at;
        let (mut state, mut assumed, mut asserted) = (false, false, false);
        loop {
            match self.text() {
                "state" => state = true,
                "input" | "assume" | "ASSUME" => assumed = true,
                "output" | "assert" | "ASSERT" => asserted = true,
                "next" => {}
                _ => break,
            }
            self.at += 1;
        }
        match (state, assumed, asserted) {
            (false, true, false) => Ok(ColumnKind::Input),
            (false, false, true) => Ok(ColumnKind::Output),
            (true, true, false) => Ok(ColumnKind::StateAssumption),
            (true, false, true) => Ok(ColumnKind::StateAssertion),
            (true, false, false) => Ok(ColumnKind::StateAssumption),
            (_, true, true) => {
                let message = "a column is either assumed or asserted";
                builder.wrong(&codes::TABLE_COLUMN, self.since(from).whole(), message);
                Ok(ColumnKind::Output)
            }
            (false, false, false) => Err(self.unexpected(builder, "`input`, `output` or `state`")),
        }
    }

    fn named(&mut self, builder: &mut Builder<'_>) -> Result<Named> {
        let (run, name) = if self.kind() == Kind::Qualified {
            let (run, name) = split_run(self.text());
            let name = Word { text: name.to_owned(), place: self.place() };
            let run = run_name(builder, run);
            self.at += 1;
            (Some(run), name)
        } else {
            (None, self.name(builder, "the name of a variable")?)
        };
        let alias = if self.eat("as") { Some(self.name(builder, "the new name")?) } else { None };
        Ok(Named { run, name, alias })
    }

    fn type_name(&mut self, builder: &mut Builder<'_>) -> Result<Word> {
        let ty = self.name(builder, "a type")?;
        if ty.text == "ENUM" && self.is("ENUM") {
            let message = "`ENUM ENUM` is written `ENUM` today";
            builder.wrong(&codes::TABLE_OLD_SPELLING, self.place(), message);
            self.at += 1;
        }
        Ok(ty)
    }

    /// `column MODIFIER… NAME [: TYPE] as e1, e2`.
    pub(super) fn projection(&mut self, builder: &mut Builder<'_>) -> Result<()> {
        self.at += 1;
        let kind = self.modifiers(builder)?;
        let name = self.name(builder, "the name of the column")?;
        let ty = if self.eat(":") { Some(self.type_name(builder)?) } else { None };
        self.expect(builder, "as")?;
        let piece = self.until_member();
        if let Some(exprs) = builder.projection(&piece) {
            let subject = subject(exprs);
            builder.column(Column { name: name.text, kind, subject, ty, remark: None, place: name.place });
        }
        Ok(())
    }

    /// What stands before the next part of the table, and the `;` behind it.
    fn until_member(&mut self) -> Piece<'p> {
        let from = self.at;
        while !self.at_member() && !self.is(";") {
            self.at += 1;
        }
        let piece = self.since(from);
        self.eat(";");
        piece
    }

    /// `gvar NAME [: TYPE] [with CELL]`.
    pub(super) fn global(&mut self, builder: &mut Builder<'_>) -> Result<()> {
        self.at += 1;
        let name = self.name(builder, "the name of a global variable")?;
        let ty = if self.eat(":") { Some(self.type_name(builder)?) } else { None };
        let constraint = if self.eat("with") { Some(self.until_member()) } else { None };
        self.eat(";");
        builder.global(name, ty, constraint.as_ref());
        Ok(())
    }

    /// `timeconst NAME : 5`.
    pub(super) fn time_constant(&mut self, builder: &mut Builder<'_>) -> Result<()> {
        self.at += 1;
        let name = self.name(builder, "the name of a time constant")?;
        self.expect(builder, ":")?;
        let value = self.until_member();
        add_constant(builder, name, &value);
        Ok(())
    }

    /// `options { key = value … }`.
    pub(super) fn table_options(&mut self, builder: &mut Builder<'_>) -> Result<()> {
        self.at += 1;
        self.expect(builder, "{")?;
        while !self.eat("}") {
            if self.end() {
                return Err(self.unexpected(builder, "`}`"));
            }
            let from = self.at;
            while matches!(self.kind(), Kind::Word | Kind::Number | Kind::Sign('.')) {
                self.at += 1;
            }
            let key = word(&self.since(from));
            if key.text.is_empty() || !(self.eat("=") || self.eat(":")) {
                return Err(self.unexpected(builder, "`key = value`"));
            }
            let from = self.at;
            self.eat("-");
            self.at += usize::from(!self.is("}") && !self.end());
            if self.is(".") && self.tokens[self.at + 1].kind == Kind::Number {
                self.at += 2;
            }
            let value = word(&self.since(from));
            self.eat(";");
            builder.option(key, value);
        }
        Ok(())
    }

    /// `\inherit_from TABLE`: its columns, global variables and constants.
    pub(super) fn inherit_table(&mut self, builder: &mut Builder<'_>) -> Result<()> {
        self.at += 1;
        let name = self.name(builder, "the name of a table")?;
        self.eat(";");
        let Some(parent) = self.read.tables.iter().find(|table| table.name == name.text) else {
            unknown(builder, name.place, &format!("no table in front of this one is named `{}`", name.text));
            return Ok(());
        };
        for column in &parent.columns {
            builder.column(column.clone());
        }
        for global in &parent.globals {
            builder.context.declared.insert(global.name.to_ascii_uppercase());
            builder.table.globals.push(global.clone());
        }
        builder.table.constants.extend(parent.constants.iter().cloned());
        Ok(())
    }

    /// A function in Structured Text, kept as it is.
    pub(super) fn function(&mut self, builder: &mut Builder<'_>) -> Result<()> {
        let start = self.token().range.start;
        let from = self.at;
        self.at += 1;
        let name = self.name(builder, "the name of a function")?;
        while !self.end() && !self.text().eq_ignore_ascii_case("END_FUNCTION") {
            self.at += 1;
        }
        if self.end() {
            self.at = from + 1;
            builder.wrong(&codes::TABLE_SYNTAX, self.piece.part(start..start + 8).whole(), "this function never ends");
            self.at = self.tokens.len() - 1;
            return Ok(());
        }
        self.at += 1;
        let piece = self.since(from);
        let function = Function { name: name.text, text: piece.text.to_owned(), place: piece.whole() };
        builder.table.functions.push(function);
        Ok(())
    }
}

/// A variable in a declaration.
struct Named {
    run: Option<String>,
    name: Word,
    alias: Option<Word>,
}

fn add_variable(builder: &mut Builder<'_>, named: Named, kind: ColumnKind, ty: Word) {
    let Named { run, name, alias } = named;
    let shown = alias.as_ref().map_or(&name.text, |alias| &alias.text);
    let column_name = run.as_ref().map_or_else(|| shown.clone(), |run| format!("{run}::{shown}"));
    let place = alias.as_ref().map_or(name.place, |alias| alias.place);
    let subject = Subject::Variable(Path { run, ..Path::plain(name.text) });
    builder.column(Column { name: column_name, kind, subject, ty: Some(ty), remark: None, place });
}

/// The run's name, where it is given by its number.
pub(super) fn run_name(builder: &Builder<'_>, run: &str) -> String {
    let by_number = run.parse::<usize>().ok().and_then(|index| builder.table.runs.get(index));
    by_number.map_or_else(|| run.to_owned(), |run| run.text.clone())
}

/// Run and name of `old|>X`.
pub(super) fn split_run(text: &str) -> (&str, &str) {
    let cut = ["|>", "·", "::"].iter().find_map(|mark| text.split_once(mark));
    cut.unwrap_or(("", text))
}

pub(super) fn unknown(builder: &mut Builder<'_>, place: Place, message: &str) {
    let mut finding = Finding::new(&codes::TABLE_NAME, place, message);
    finding.severity = Severity::Error;
    builder.report(finding);
}
