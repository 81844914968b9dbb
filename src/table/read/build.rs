//! What all readers share: cells and durations with their findings, and the checks at the end of a table.

use std::collections::{BTreeMap, BTreeSet};

use super::Options;
use crate::diagnostic::{Code, Finding, Severity};
use crate::table::cell::ast::{Expr, Predicate};
use crate::table::cell::{self, CellError, Context, ast::ChunkKind, ast::ExprKind};
use crate::table::codes;
use crate::table::duration::{self, Bounds, Duration, DurationCell, Flag, Uncounted};
use crate::table::model::{Cell, Column, CycleTime, Global, Node, Quantity, Row, Subject, Table, TimeConstant, Word};
use crate::table::piece::Piece;
use crate::text::near::nearest;
use crate::text::{Place, SpanMap};

/// A table in the making.
pub(super) struct Builder<'o> {
    pub(super) table: Table,
    pub(super) context: Context,
    /// For each declared column in the order of the file, its index, or none where it was refused.
    pub(super) slots: Vec<Option<usize>>,
    findings: Vec<Finding>,
    options: &'o Options,
}

/// A word and its place.
pub(super) fn word(piece: &Piece<'_>) -> Word {
    Word { text: piece.text.to_owned(), place: piece.whole() }
}

impl<'o> Builder<'o> {
    pub(super) fn new(name: Word, place: Place, options: &'o Options) -> Self {
        let mut table = Table::new(name, place);
        table.options.cycle = options.cycle.map(|nanos| CycleTime { nanos, place: None });
        Self { table, context: Context::default(), slots: Vec::new(), findings: Vec::new(), options }
    }

    pub(super) fn report(&mut self, finding: Finding) {
        self.findings.push(finding);
    }

    /// Reports something wrong at `place`.
    pub(super) fn wrong(&mut self, code: &'static Code, place: Place, message: impl Into<String>) {
        self.report(Finding::new(code, place, message));
    }

    /// Makes `name` win over the short spellings of other things.
    fn declare(&mut self, name: &str) {
        self.context.declared.insert(name.to_ascii_uppercase());
    }

    /// Adds a column; a name that is taken is an error.
    pub(super) fn column(&mut self, column: Column) -> Option<usize> {
        if let Some(first) = self.table.column(&column.name) {
            let first = self.table.columns[first].place;
            let message = format!("column `{}` is there twice", column.name);
            self.report(Finding::new(&codes::TABLE_COLUMN, column.place, message).label(first, "the first one"));
            return None;
        }
        self.declare(&column.name);
        if let Subject::Variable(path) = &column.subject {
            self.declare(&path.name);
        }
        self.table.columns.push(column);
        Some(self.table.columns.len() - 1)
    }

    /// Adds a global variable.
    pub(super) fn global(&mut self, name: Word, ty: Option<Word>, constraint: Option<&Piece<'_>>) {
        let taken = self.table.global(&name.text).map(|global| global.place);
        if let Some(first) = taken {
            let message = format!("global variable `{}` is declared twice", name.text);
            self.report(Finding::new(&codes::TABLE_NAME, name.place, message).label(first, "the first one"));
            return;
        }
        self.declare(&name.text);
        let constraint = constraint.and_then(|piece| self.cell(piece, 1));
        self.table.globals.push(Global { name: name.text, ty, constraint, place: name.place });
    }

    /// Reads a cell; blank ones give `None`.
    pub(super) fn cell(&mut self, piece: &Piece<'_>, arguments: usize) -> Option<Cell> {
        let piece = piece.trimmed();
        if piece.text.is_empty() {
            return None;
        }
        self.context.arguments = arguments;
        let constraint = match cell::parse(&piece, &self.context) {
            Ok(constraint) => Some(constraint),
            Err(error) => {
                self.cell_error(error, piece.file);
                None
            }
        };
        Some(Cell { text: piece.text.to_owned(), place: piece.whole(), constraint })
    }

    /// Reads the expressions of a projection.
    pub(super) fn projection(&mut self, piece: &Piece<'_>) -> Option<Vec<Expr>> {
        self.context.arguments = 1;
        match cell::parse_expressions(&piece.trimmed(), &self.context) {
            Ok(exprs) => Some(exprs),
            Err(error) => {
                self.cell_error(error, piece.file);
                None
            }
        }
    }

    fn cell_error(&mut self, error: CellError, file: crate::text::FileId) {
        let code = if error.future { &codes::TABLE_FUTURE_REFERENCE } else { &codes::TABLE_CELL };
        let mut finding = Finding::new(code, Place::new(file, error.span), error.message);
        finding.help.extend(error.help);
        self.report(finding);
    }

    /// Reads a duration. `missing` is what a blank one means, `unit` what a bare number counts.
    pub(super) fn duration(&mut self, piece: &Piece<'_>, missing: Duration, unit: Option<i128>) -> DurationCell {
        let piece = piece.trimmed();
        let place = piece.whole();
        let text = piece.text.to_owned();
        if text.is_empty() {
            return DurationCell { text, place, duration: missing, repeat: None, spoiled: false };
        }
        match duration::parse(&piece, unit) {
            Ok(duration) => DurationCell { text, place, duration, repeat: None, spoiled: false },
            Err(error) => {
                let place = Place::new(piece.file, error.span);
                let mut finding = Finding::new(&codes::TABLE_DURATION, place, error.message);
                finding.help.extend(error.help);
                self.report(finding);
                DurationCell { text, place: piece.whole(), duration: missing, repeat: None, spoiled: true }
            }
        }
    }

    /// Takes an option: those that this program itself writes are understood, those of other tools are kept.
    pub(super) fn option(&mut self, key: Word, value: Word) {
        let text = value.text.trim_matches('"').to_owned();
        let yes = text.eq_ignore_ascii_case("true");
        let options = &mut self.table.options;
        match key.text.as_str() {
            "cycle" => match super::heading::quantity(&text) {
                Some(Quantity::Nanos(nanos)) if nanos > 0 => {
                    options.cycle = Some(CycleTime { nanos, place: Some(value.place) });
                }
                _ => self.wrong(&codes::TABLE_SYNTAX, value.place, format!("`{text}` is no cycle time")),
            },
            "strict" => options.strict = yes,
            "concrete" => options.concrete = yes,
            "title" => self.table.name = text,
            "unit" => self.table.unit = Some(Word { text, place: value.place }),
            name if name.starts_with("const.") => match super::heading::quantity(&text) {
                Some(quantity) => {
                    let name = name["const.".len()..].to_owned();
                    self.table.constants.push(TimeConstant { name, value: quantity, place: key.place });
                }
                None => self.wrong(&codes::TABLE_SYNTAX, value.place, format!("`{text}` is no duration")),
            },
            _ => options.entries.push((key, Word { text, place: value.place })),
        }
    }

    /// The nearest column to a name that is none.
    pub(super) fn nearest_column(&self, name: &str) -> Option<String> {
        nearest(name, self.table.columns.iter().map(|column| column.name.as_str())).map(str::to_owned)
    }

    /// Counts durations, checks names, and closes the table.
    pub(super) fn finish(mut self) -> (Table, Vec<Finding>) {
        self.resolve_predicates();
        let constants = self.constants();
        let cycle = self.table.options.cycle.map(|cycle| cycle.nanos);
        let mut body = std::mem::take(&mut self.table.body);
        fill(&mut body, self.table.columns.len());
        self.count(&mut body, cycle, &constants);
        self.table.body = body;
        self.check_names();
        let errors = self.findings.iter().filter(|finding| finding.severity == Severity::Error).count();
        self.table.errors = errors;
        (self.table, self.findings)
    }

    fn constants(&self) -> BTreeMap<String, Quantity> {
        let own = self.table.constants.iter().map(|constant| (constant.name.to_ascii_uppercase(), constant.value));
        let given = self.options.constants.iter().map(|(name, value)| (name.to_ascii_uppercase(), *value));
        own.chain(given).collect()
    }

    fn count(&mut self, nodes: &mut [Node], cycle: Option<i128>, constants: &BTreeMap<String, Quantity>) {
        for node in nodes {
            let cell = match node {
                Node::Row(row) => &mut row.duration,
                Node::Block(block) => {
                    self.count(&mut block.children, cycle, constants);
                    &mut block.duration
                }
            };
            if !cell.spoiled {
                self.count_one(cell, cycle, constants);
            }
        }
    }

    fn count_one(&mut self, cell: &mut DurationCell, cycle: Option<i128>, constants: &BTreeMap<String, Quantity>) {
        match cell.duration.count(cycle, constants) {
            Ok(repeat) => cell.repeat = Some(repeat),
            Err(Uncounted::NoCycleTime) => {
                let message = format!("`{}` is a time, and the length of a cycle is not known", cell.text);
                let finding = Finding::new(&codes::TABLE_CYCLE_TIME, cell.place, message);
                self.report(finding.help("state it in the heading, as in `(cycle 10ms)`"));
            }
            Err(Uncounted::Wrong { message, help }) => {
                cell.spoiled = true;
                let mut finding = Finding::new(&codes::TABLE_DURATION, cell.place, message);
                finding.help.extend(help);
                self.report(finding);
            }
        }
        if cell.duration.flag == Some(Flag::Hold) {
            let message = "the flag `hold` has no meaning here";
            self.wrong(&codes::TABLE_UNSUPPORTED, cell.place, message);
        }
        if matches!(cell.duration.bounds, Bounds::Omega) && cell.duration.flag.is_some() {
            let message = "a row that lasts for ever cannot be left, so its flag says nothing";
            self.wrong(&codes::TABLE_DURATION, cell.place, message);
        }
    }

    /// Rows and blocks have names of their own.
    fn check_names(&mut self) {
        let mut seen: BTreeMap<String, Place> = BTreeMap::new();
        let mut twice = Vec::new();
        for row in self.table.rows() {
            if let Some(first) = seen.get(&row.id) {
                twice.push((row.id.clone(), row.place, *first));
            } else {
                seen.insert(row.id.clone(), row.place);
            }
        }
        for (id, place, first) in twice {
            let message = format!("two rows are named `{id}`");
            self.report(Finding::new(&codes::TABLE_NAME, place, message).label(first, "the first one"));
        }
    }

    /// Predicates that are no comparison must be functions of the table.
    fn resolve_predicates(&mut self) {
        let functions: BTreeSet<String> =
            self.table.functions.iter().map(|function| function.name.to_ascii_uppercase()).collect();
        let mut unknown = Vec::new();
        for cell in self.table.rows().iter().flat_map(|row| row.cells.iter().flatten()) {
            for chunk in cell.constraint.iter().flat_map(|constraint| &constraint.chunks) {
                if let ChunkKind::Predicate(Predicate::Function(name)) = &chunk.kind
                    && !functions.contains(&name.to_ascii_uppercase())
                {
                    unknown.push((Place::new(cell.place.file, chunk.span), name.clone()));
                }
            }
        }
        for (place, name) in unknown {
            let names = ["eq", "neq", "lt", "leq", "gt", "geq"];
            let near = nearest(&name, names.into_iter().chain(functions.iter().map(String::as_str)));
            let mut finding = Finding::new(&codes::TABLE_CELL, place, format!("no predicate is named `{name}`"));
            finding.help.extend(near.map(|near| format!("`{near}` is one")));
            self.report(finding);
        }
    }

    /// Numbers the rows that have no name of their own.
    pub(super) fn name_rows(&mut self) {
        let taken: BTreeSet<String> = self.table.rows().iter().map(|row| row.id.clone()).collect();
        let mut number = 0_usize;
        visit_rows(&mut self.table.body, &mut |row| {
            number += 1;
            if row.id.is_empty() {
                let mut id = number.to_string();
                while taken.contains(&id) {
                    id.push('\'');
                }
                row.id = id;
            }
        });
    }
}

/// The map of a piece's own text, for spans that are taken later.
pub(super) fn span_map(piece: &Piece<'_>) -> SpanMap {
    let mut runs = Vec::new();
    let mut next = None;
    for (at, _) in piece.text.char_indices().chain(std::iter::once((piece.text.len(), ' '))) {
        let at = u32::try_from(at).unwrap_or(u32::MAX);
        let there = piece.span(crate::text::Span::at(at)).start;
        if next != Some((at, there)) && runs.last().is_none_or(|(from, to): &(u32, u32)| to + (at - from) != there) {
            runs.push((at, there));
        }
        next = Some((at, there));
    }
    SpanMap::new(runs)
}

/// Calls `visit` on every row, from top to bottom.
pub(super) fn visit_rows(nodes: &mut [Node], visit: &mut dyn FnMut(&mut Row)) {
    for node in nodes {
        match node {
            Node::Row(row) => visit(row),
            Node::Block(block) => visit_rows(&mut block.children, visit),
        }
    }
}

/// What a projection is bound to: a single plain variable is no projection.
pub(super) fn subject(exprs: Vec<Expr>) -> Subject {
    match exprs.as_slice() {
        [Expr { kind: ExprKind::Name(path), .. }] => Subject::Variable(path.clone()),
        _ => Subject::Projection(exprs),
    }
}

/// Gives every row a cell for each of `columns` columns: a column may be declared behind the rows.
fn fill(nodes: &mut [Node], columns: usize) {
    for node in nodes {
        match node {
            Node::Row(row) => row.cells.resize_with(columns, || None),
            Node::Block(block) => fill(&mut block.children, columns),
        }
    }
}
