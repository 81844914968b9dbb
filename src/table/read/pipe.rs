//! Pipe tables: the form that people write in doc comments and Markdown files.
//!
//! A `@gtt NAME (attributes)` line, then lines that begin with `|`. Comment decoration in front of a line (`*`, `//`,
//! `///`) is skipped, so that the raw text of a source file works as well as the text of a comment.

use super::build::{Builder, subject, word};
use super::heading::{self, find_word};
use super::repeat::Tree;
use super::{Options, Read};
use crate::diagnostic::Finding;
use crate::table::cell::literal;
use crate::table::codes;
use crate::table::duration::Duration;
use crate::table::model::{Column, ColumnKind, Row, Word};
use crate::table::piece::Piece;

/// Reads every pipe table in `piece`.
#[must_use]
pub fn read(piece: &Piece<'_>, options: &Options) -> Read {
    let lines: Vec<Piece<'_>> = piece.lines().map(|line| undecorated(&line)).collect();
    let mut read = Read::default();
    let mut at = 0;
    let mut title: Option<Word> = None;
    while at < lines.len() {
        let line = &lines[at];
        if let Some(heading) = after_tag(line) {
            at = announced(&lines, at, &heading, options, &mut read);
        } else if options.headless && line.text.starts_with('|') {
            at = headless(&lines, at, title.as_ref(), options, &mut read);
        } else {
            if line.text.starts_with('#') {
                let level = line.text.len() - line.text.trim_start_matches('#').len();
                title = Some(word(&line.part(level..line.text.len()).trimmed()));
            }
            at += 1;
        }
    }
    read.sort();
    read
}

/// A line without white space round it and comment decoration in front of it.
pub(in crate::table) fn undecorated<'a>(line: &Piece<'a>) -> Piece<'a> {
    let trimmed = line.trimmed();
    for mark in ["///", "//!", "//", "(**", "(*", "/**", "/*", "*", ">"] {
        if let Some(rest) = trimmed.text.strip_prefix(mark)
            && !rest.starts_with(')')
        {
            return trimmed.part(mark.len()..trimmed.text.len()).trimmed();
        }
    }
    trimmed
}

/// What follows `@gtt` in a line that it begins.
pub(in crate::table) fn after_tag<'a>(line: &Piece<'a>) -> Option<Piece<'a>> {
    let rest = line.text.strip_prefix("@gtt")?;
    let ends = rest.is_empty() || rest.starts_with(char::is_whitespace);
    ends.then(|| line.part(4..line.text.len()).trimmed())
}

/// How many lines of a heading are looked at for the end of its attributes.
const HEADING_LINES: usize = 200;

/// Reads a table under its `@gtt` line; gives the line behind it.
fn announced(lines: &[Piece<'_>], at: usize, heading: &Piece<'_>, options: &Options, read: &mut Read) -> usize {
    let mut joined = String::new();
    let mut runs = Vec::new();
    let mut next = at;
    let base = heading;
    // Joins the lines of the heading until its parentheses close.
    loop {
        let line = if next == at { heading.clone() } else { lines[next].clone() };
        let offset = line.behind(base);
        runs.push((saturate(joined.len()), offset));
        joined.push_str(line.text);
        next += 1;
        let open = joined.matches('(').count() > joined.matches(')').count();
        let more = lines.get(next).is_some_and(|line| !line.text.starts_with('|') && after_tag(line).is_none());
        if !open || !more || next - at > HEADING_LINES {
            break;
        }
        joined.push(' ');
    }
    let head = base.rewritten(&joined, &runs);
    let mut body = next;
    while lines.get(body).is_some_and(|line| line.text.is_empty() || line.text.starts_with("```")) {
        body += 1;
    }
    if !lines.get(body).is_some_and(|line| line.text.starts_with('|')) {
        reference(&head, read);
        return next;
    }
    let end = body + lines[body..].iter().take_while(|line| line.text.starts_with('|')).count();
    let (name, attributes) = name_and_attributes(&head);
    let place = crate::text::Place::new(head.file, lines[at].whole().span.cover(lines[end - 1].whole().span));
    let mut builder = Builder::new(word(&name), place, options);
    if name.text.is_empty() {
        let message = "a table needs a name behind `@gtt`";
        builder.wrong(&codes::TABLE_SYNTAX, lines[at].whole(), message);
    }
    if let Some(attributes) = attributes {
        heading::attributes(&mut builder, &attributes);
    }
    table(&mut builder, &lines[body..end]);
    read.take(builder.finish());
    end
}

fn saturate(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

fn reference(head: &Piece<'_>, read: &mut Read) {
    const ENDINGS: [&str; 8] = [".gtt", ".md", ".xlsx", ".xls", ".ods", ".csv", ".xml", ".txt"];
    let path = head.trimmed();
    let lower = path.text.to_ascii_lowercase();
    if ENDINGS.iter().any(|ending| lower.ends_with(ending)) {
        read.references.push(word(&path));
        return;
    }
    let finding = Finding::new(&codes::TABLE_SYNTAX, path.whole(), "no table follows this heading");
    read.findings.push(finding.help("the lines of the table begin with `|`; `@gtt path` names a file that holds one"));
}

fn name_and_attributes<'a>(head: &Piece<'a>) -> (Piece<'a>, Option<Piece<'a>>) {
    let text = head.text.trim_end();
    let Some(open) = last_group(text) else { return (head.trimmed(), None) };
    let end = text.len() - usize::from(text.ends_with(')'));
    (head.part(0..open).trimmed(), Some(head.part(open + 1..end)))
}

/// Where the last group in parentheses begins that ends the text, or that never ends.
fn last_group(text: &str) -> Option<usize> {
    let mut open = Vec::new();
    let mut last = None;
    for (at, c) in text.char_indices() {
        match c {
            '(' => open.push(at),
            ')' => last = open.pop().map(|begin| (begin, at)),
            _ => {}
        }
    }
    match (open.first(), last) {
        (Some(begin), _) => Some(*begin),
        (None, Some((begin, end))) if end + 1 == text.len() => Some(begin),
        _ => None,
    }
}

/// Reads a table that no `@gtt` line announces, if its header is that of one.
fn headless(lines: &[Piece<'_>], at: usize, title: Option<&Word>, options: &Options, read: &mut Read) -> usize {
    let end = at + lines[at..].iter().take_while(|line| line.text.starts_with('|')).count();
    let bound = |cell: &Piece<'_>| matches!(header_kind(cell.trimmed().text), Header::Bound(..));
    if !cells(&lines[at]).iter().any(|cell| bound(&cell.piece())) {
        return end;
    }
    let place = crate::text::Place::new(lines[at].file, lines[at].whole().span.cover(lines[end - 1].whole().span));
    let name = title.cloned().unwrap_or_else(|| Word { text: "Table".to_owned(), place: lines[at].whole() });
    let mut builder = Builder::new(name, place, options);
    table(&mut builder, &lines[at..end]);
    read.take(builder.finish());
    end
}

/// A cell between two pipes: its own text, where `\|` has become `|`.
pub(in crate::table) struct RawCell<'a> {
    raw: Piece<'a>,
    text: String,
    runs: Vec<(u32, u32)>,
}

impl RawCell<'_> {
    pub(in crate::table) fn piece(&self) -> Piece<'_> {
        if self.runs.is_empty() { self.raw.clone() } else { self.raw.rewritten(&self.text, &self.runs) }
    }
}

/// The cells of a line that begins with `|`.
pub(in crate::table) fn cells<'a>(line: &Piece<'a>) -> Vec<RawCell<'a>> {
    let bytes = line.text.as_bytes();
    let mut bars: Vec<usize> =
        (0..bytes.len()).filter(|i| bytes[*i] == b'|' && (*i == 0 || bytes[i - 1] != b'\\')).collect();
    if bars.last().is_none_or(|last| last + 1 < bytes.len()) {
        bars.push(bytes.len());
    }
    bars.windows(2).map(|pair| raw_cell(line.part(pair[0] + 1..pair[1]).trimmed())).collect()
}

fn raw_cell(raw: Piece<'_>) -> RawCell<'_> {
    let mut text = String::new();
    let mut runs = Vec::new();
    let mut from = 0;
    for (at, _) in raw.text.match_indices("\\|") {
        runs.push((saturate(text.len()), saturate(from)));
        text.push_str(&raw.text[from..at]);
        from = at + 1;
    }
    if from > 0 {
        runs.push((saturate(text.len()), saturate(from)));
        text.push_str(&raw.text[from..]);
    }
    RawCell { raw, text, runs }
}

/// What a header cell announces.
#[derive(Clone, Copy)]
pub(in crate::table) enum Header {
    /// A column of the kind, and where its name begins.
    Bound(ColumnKind, usize),
    Number,
    Duration,
    Remark,
    Repeat,
    Unknown,
}

/// What the header cell `text` announces.
pub(in crate::table) fn header_kind(text: &str) -> Header {
    let first = text.split_whitespace().next().unwrap_or("");
    let end = text.len() - text.trim_start().len() + first.len();
    let rest = !text[end..].trim().is_empty();
    match (first.to_ascii_lowercase().as_str(), rest) {
        ("in" | "input", true) => Header::Bound(ColumnKind::Input, end),
        ("out" | "output", true) => Header::Bound(ColumnKind::Output, end),
        ("state", true) => Header::Bound(ColumnKind::StateAssumption, end),
        ("state!", true) => Header::Bound(ColumnKind::StateAssertion, end),
        ("#" | "row" | "no" | "no." | "seq" | "seq." | "id", false) => Header::Number,
        ("dur" | "duration", _) => Header::Duration,
        ("remark" | "remarks" | "comment", false) => Header::Remark,
        ("repeat" | "block", false) => Header::Repeat,
        _ => Header::Unknown,
    }
}

/// What a position in a row stands for.
#[derive(Clone, Copy)]
enum Slot {
    Column(usize),
    Number,
    Duration(Option<i128>),
    Remark,
    Repeat,
    Spoilt,
}

fn table(builder: &mut Builder<'_>, lines: &[Piece<'_>]) {
    let slots: Vec<Slot> = cells(&lines[0]).iter().map(|cell| slot(builder, &cell.piece())).collect();
    builder.context.relational = builder.table.is_relational();
    if builder.table.columns.is_empty() {
        let message = "no column is bound to a variable";
        let finding = Finding::new(&codes::TABLE_COLUMN, lines[0].whole(), message);
        builder.report(finding.help("write `in NAME` for an input and `out NAME` for an output"));
    }
    let skip = if lines.get(1).is_some_and(is_rule) { 2 } else { 1 };
    let mut tree = Tree::default();
    for line in lines.iter().skip(skip) {
        row(builder, &mut tree, &slots, line);
    }
    builder.table.body = tree.finish(builder);
    builder.name_rows();
}

/// Whether the line is the rule below a header.
pub(in crate::table) fn is_rule(line: &Piece<'_>) -> bool {
    let cells = cells(line);
    !cells.is_empty()
        && cells.iter().all(|cell| {
            let text = cell.raw.text;
            (text.len() > 1 || text.contains(':')) && text.bytes().all(|b| b == b'-' || b == b':') && text.contains('-')
        })
}

fn slot(builder: &mut Builder<'_>, cell: &Piece<'_>) -> Slot {
    let cell = cell.trimmed();
    match header_kind(cell.text) {
        Header::Bound(kind, at) => {
            let name = cell.part(at..cell.text.len()).trimmed();
            column(builder, kind, &name, &cell).map_or(Slot::Spoilt, Slot::Column)
        }
        Header::Number => Slot::Number,
        Header::Duration => Slot::Duration(duration_unit(builder, &cell)),
        Header::Remark => Slot::Remark,
        Header::Repeat => Slot::Repeat,
        Header::Unknown => {
            let message = format!("the header does not say what column `{}` is for", cell.text);
            let finding = Finding::new(&codes::TABLE_COLUMN, cell.whole(), message);
            builder.report(finding.help(format!("write `in {0}` for an input or `out {0}` for an output", cell.text)));
            Slot::Spoilt
        }
    }
}

/// `dur ms`, `dur [ms]`, `duration (s)`: what a bare number in the column counts.
fn duration_unit(builder: &mut Builder<'_>, cell: &Piece<'_>) -> Option<i128> {
    let (_, rest) = cell.text.split_once(|c: char| !c.is_alphabetic())?;
    let unit = rest.trim_matches(|c: char| c.is_whitespace() || "[]()".contains(c));
    if unit.is_empty() || unit.eq_ignore_ascii_case("cycles") {
        return None;
    }
    let nanos = literal::unit(unit);
    if nanos.is_none() {
        builder.wrong(&codes::TABLE_COLUMN, cell.whole(), format!("`{unit}` is no unit of time"));
    }
    nanos
}

/// `NAME`, `NAME : TYPE`, `NAME : TYPE as e1, e2`, or an expression.
fn column(builder: &mut Builder<'_>, kind: ColumnKind, piece: &Piece<'_>, cell: &Piece<'_>) -> Option<usize> {
    builder.context.relational = true;
    let alias = find_word(piece.text, "as");
    let head = piece.part(0..alias.unwrap_or(piece.text.len())).trimmed();
    let colon = single_colon(head.text);
    let name = head.part(0..colon.unwrap_or(head.text.len())).trimmed();
    let ty = colon.map(|at| word(&head.part(at + 1..head.text.len()).trimmed()));
    let bound = alias.map_or_else(|| name.clone(), |at| piece.part(at + 2..piece.text.len()));
    let subject = subject(builder.projection(&bound)?);
    let place = cell.whole();
    builder.column(Column { name: name.text.to_owned(), kind, subject, ty, remark: None, place })
}

/// Where the first `:` stands that is no part of `::` or `:=`.
fn single_colon(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    (0..bytes.len()).find(|i| bytes[*i] == b':' && bytes.get(i + 1) != Some(&b':') && (*i == 0 || bytes[i - 1] != b':'))
}

fn row(builder: &mut Builder<'_>, tree: &mut Tree, slots: &[Slot], line: &Piece<'_>) {
    let raw = cells(line);
    let mut row = Row {
        id: String::new(),
        cells: vec![None; builder.table.columns.len()],
        duration: builder.duration(&line.part(0..0), Duration::exactly(1), None),
        remark: None,
        controls: Vec::new(),
        gotos: Vec::new(),
        place: line.whole(),
    };
    let mut repeat = None;
    for (raw, slot) in raw.iter().zip(slots) {
        let piece = raw.piece();
        match *slot {
            Slot::Column(i) => {
                let arguments = builder.table.columns[i].subject.arguments();
                row.cells[i] = builder.cell(&piece, arguments);
            }
            Slot::Number => piece.text.clone_into(&mut row.id),
            Slot::Duration(unit) => row.duration = builder.duration(&piece, Duration::exactly(1), unit),
            Slot::Remark => row.remark = (!piece.text.is_empty()).then(|| word(&piece)),
            Slot::Repeat => repeat = Some(raw),
            Slot::Spoilt => {}
        }
    }
    if let Some(extra) = raw.get(slots.len()) {
        let message = format!("this row has {} cells, and the header has {}", raw.len(), slots.len());
        let finding = Finding::new(&codes::TABLE_COLUMN, extra.piece().whole(), message);
        builder.report(finding.help("a `|` inside a cell is written `\\|`"));
    }
    let repeat = repeat.map(RawCell::piece);
    tree.row(builder, row, repeat.as_ref());
}
