//! Spreadsheets: `.xlsx`, `.xls`, `.ods` and `.csv`, in the layout of the papers (a line of groups that spans
//! `Input`, `Output`, `Duration`, `Remark`, a line of names below it), in the layout of CODESYS test-library workbooks
//! (`State | testtime | outputs | # | inputs | # | Purpose`), or with the header of a pipe table.
//!
//! A sheet is turned into the text of pipe tables, which the reader of pipe tables reads; what had to be guessed on the
//! way is a finding. A cell of a workbook has no place in its file, so a finding names it (`Sheet1!B4`).

use std::ops::Range;

use super::workbook::{self, Sheet};
use super::{Mapping, Options, Read, pipe};
use crate::diagnostic::Finding;
use crate::table::codes;
use crate::table::piece::Piece;
use crate::text::{FileId, Place, SpanMap};

/// A cell of a sheet.
#[derive(Clone, Debug, Default)]
pub(super) struct GridCell {
    pub(super) text: String,
    /// For each run of the text, where it stands in the piece.
    runs: Vec<(u32, u32)>,
    /// Where its text stands in the piece, as it was typed.
    span: Range<usize>,
    /// How the sheet calls it.
    pub(super) address: String,
    /// What had to be guessed or refused.
    pub(super) notes: Vec<Note>,
}

#[derive(Clone, Debug)]
pub(super) enum Note {
    Guess(String),
    Refused(String),
}

pub(super) type Grid = Vec<Vec<GridCell>>;

/// Pipe tables made from a sheet, and for each range of their text the cell that it came from.
#[derive(Default)]
struct Made {
    text: String,
    runs: Vec<(u32, u32)>,
    cells: Vec<(Range<usize>, GridCell)>,
    /// Where the cell written last ends in the piece.
    end: usize,
}

pub(super) fn saturate(value: usize) -> u32 {
    u32::try_from(value).unwrap_or(u32::MAX)
}

/// Reads tables from comma-separated values; `;` and tabs separate as well.
#[must_use]
pub fn csv(piece: &Piece<'_>, name: &str, options: &Options) -> Read {
    let grid = csv_grid(piece);
    let made = make(&grid, name, options.mapping.as_ref());
    let inner = piece.rewritten(&made.text, &made.runs).within(piece);
    let mut read = pipe::read(&inner, options);
    for (_, cell) in &made.cells {
        for note in &cell.notes {
            read.findings.push(note.finding(piece.at(cell.span.clone()), ""));
        }
    }
    refused(&mut read);
    if read.tables.is_empty() && read.findings.is_empty() {
        read.findings.push(nothing(piece.at(0..0), ""));
    }
    read.sort();
    read
}

/// Reads the tables of every sheet of a workbook.
#[must_use]
pub fn workbook(file: FileId, bytes: &[u8], options: &Options) -> Read {
    let mut out = Read::default();
    let failed = |message| Finding::of_file(&codes::TABLE_SYNTAX, file, message);
    match workbook::sheets(bytes) {
        Ok(sheets) => {
            for Sheet { name, grid } in sheets {
                match grid {
                    Ok(grid) => sheet_tables(file, &name, &grid, options, &mut out),
                    Err(error) => out.findings.push(failed(format!("sheet `{name}` cannot be read: {error}"))),
                }
            }
        }
        Err(error) => out.findings.push(failed(format!("this workbook cannot be opened: {error}"))),
    }
    if out.tables.is_empty() && out.findings.is_empty() {
        out.findings.push(nothing(Place::file(file), ""));
    }
    out
}

fn nothing(place: Place, address: &str) -> Finding {
    let message = format!("no test table was found{address}");
    Finding::new(&codes::TABLE_SYNTAX, place, message)
        .help("a table has a line with `Input` and `Output`, and the names of the variables below it")
}

/// The tables of one sheet: read once where findings can be traced to their cells, once without places.
fn sheet_tables(file: FileId, sheet: &str, grid: &Grid, options: &Options, out: &mut Read) {
    let made = make(grid, sheet, options.mapping.as_ref());
    let mut traced = pipe::read(&Piece::verbatim(file, &made.text, 0), options);
    for finding in &mut traced.findings {
        let start = finding.place.span.start as usize;
        let cell = made.cells.iter().find(|(range, _)| range.start <= start && start <= range.end);
        let address = cell.map_or(sheet, |(_, cell)| cell.address.as_str());
        finding.message = format!("{} ({address})", finding.message);
        finding.place = Place::file(file);
        finding.labels.clear();
    }
    for (_, cell) in &made.cells {
        let address = format!(" ({})", cell.address);
        traced.findings.extend(cell.notes.iter().map(|note| note.finding(Place::file(file), &address)));
    }
    let nowhere = SpanMap::new(made.text.char_indices().map(|(at, _)| (saturate(at), 0)).collect());
    traced.tables = pipe::read(&Piece::new(file, &made.text, &nowhere), options).tables;
    refused(&mut traced);
    out.tables.append(&mut traced.tables);
    out.findings.append(&mut traced.findings);
}

/// A refused cell spoils every table of its sheet.
fn refused(read: &mut Read) {
    let errors = read.findings.iter().filter(|f| f.code == &codes::TABLE_IMPORT_REFUSED).count();
    read.tables.iter_mut().for_each(|table| table.errors += errors);
}

impl GridCell {
    /// An empty cell of a workbook, which has no place in its file.
    pub(super) fn at(address: String) -> Self {
        Self { address, ..Self::default() }
    }
}

impl Note {
    fn finding(&self, place: Place, address: &str) -> Finding {
        match self {
            Self::Guess(message) => Finding::new(&codes::TABLE_IMPORT_GUESS, place, format!("{message}{address}")),
            Self::Refused(message) => Finding::new(&codes::TABLE_IMPORT_REFUSED, place, format!("{message}{address}")),
        }
    }
}

/// Spellings that spreadsheets have and cells have not.
fn guessed(mut cell: GridCell) -> GridCell {
    let text = cell.text.clone();
    let meant = match text.to_uppercase().as_str() {
        "ON" | "WAHR" | "VRAI" => Some("TRUE".to_owned()),
        "OFF" | "FALSCH" | "FAUX" => Some("FALSE".to_owned()),
        _ => decimal_comma(&text),
    };
    if let Some(meant) = meant {
        cell.notes.push(Note::Guess(format!("`{text}` is read as `{meant}`")));
        cell.text = meant;
        cell.runs.truncate(1);
    }
    cell
}

fn decimal_comma(text: &str) -> Option<String> {
    let (whole, fraction) = text.split_once(',')?;
    let digits = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    (digits(whole.trim_start_matches('-')) && digits(fraction)).then(|| format!("{whole}.{fraction}"))
}

/// Splits by RFC 4180, with the separator that the first line suggests.
fn csv_grid(piece: &Piece<'_>) -> Grid {
    let text = piece.text;
    let first = text.lines().find(|line| !line.trim().is_empty() && !line.contains("@gtt")).unwrap_or("");
    let count = |separator: &char| first.matches(*separator).count();
    let separator = [';', '\t', ','].into_iter().max_by_key(|c| (count(c), *c == ',')).unwrap_or(',');
    let mut grid: Grid = vec![Vec::new()];
    let mut cell = GridCell::default();
    let (mut quoted, mut at, mut contiguous) = (false, 0, false);
    while let Some(c) = text[at..].chars().next() {
        let next = text[at + c.len_utf8()..].chars().next();
        let mut skip = 0;
        let part = match (quoted, c) {
            (true, '"') if next == Some('"') => {
                skip = 1;
                Some('"')
            }
            (_, '"') if quoted || cell.text.is_empty() => {
                quoted = !quoted;
                None
            }
            (false, '\r') if next == Some('\n') => None,
            (false, '\n' | '\r') => {
                finish(&mut grid, std::mem::take(&mut cell), at);
                grid.push(Vec::new());
                None
            }
            (false, c) if c == separator => {
                finish(&mut grid, std::mem::take(&mut cell), at);
                None
            }
            (true, '\n' | '\r') => Some(' '),
            (_, c) => Some(c),
        };
        if let Some(part) = part {
            if !contiguous || cell.text.is_empty() || skip > 0 {
                cell.runs.push((saturate(cell.text.len()), saturate(at + skip)));
            }
            let start = if cell.text.is_empty() { at } else { cell.span.start };
            cell.span = start..at + c.len_utf8() + skip;
            cell.text.push(part);
        }
        contiguous = part.is_some();
        at += c.len_utf8() + skip;
    }
    finish(&mut grid, cell, at);
    grid
}

fn finish(grid: &mut Grid, mut cell: GridCell, at: usize) {
    if cell.text.is_empty() {
        cell.span = at..at;
    }
    let text = cell.text.trim_end();
    cell.text.truncate(text.len());
    if let Some(row) = grid.last_mut() {
        row.push(cell);
    }
}

/// What a heading of the upper line stands for, as the header of a pipe table spells it.
fn group(text: &str) -> Option<&'static str> {
    Some(match text.trim().trim_end_matches('.').to_lowercase().as_str() {
        "input" | "inputs" | "in" | "eingang" | "eingänge" | "entrées" => "in",
        "output" | "outputs" | "out" | "ausgang" | "ausgänge" | "sorties" => "out",
        "state" | "states" => "state",
        "state!" => "state!",
        "duration" | "dur" | "dauer" | "time" => "dur",
        "remark" | "remarks" | "comment" | "bemerkung" | "purpose" => "remark",
        "repeat" | "block" => "repeat",
        "seq" | "#" | "no" | "nr" | "row" | "step" => "#",
        _ => return None,
    })
}

/// What each column of a table is, and how many lines its header takes.
struct Header {
    /// The header cell of a pipe table for each column; `None` for a column that is left out.
    columns: Vec<Option<String>>,
    lines: usize,
}

fn make(grid: &Grid, name: &str, mapping: Option<&Mapping>) -> Made {
    let mut made = Made::default();
    let mut heading: Option<GridCell> = None;
    let mut at = 0;
    while at < grid.len() {
        if let Some(cell) = grid[at].iter().find(|cell| cell.text.starts_with("@gtt")) {
            heading = Some(cell.clone());
            at += 1;
            continue;
        }
        let found = match mapping {
            Some(mapping) => mapped(mapping, grid, at),
            None => header(&grid[at..]),
        };
        let Some(header) = found else {
            at += 1;
            continue;
        };
        let plain = GridCell { text: format!("@gtt {name}"), ..grid[at].first().cloned().unwrap_or_default() };
        made.cell(&heading.take().unwrap_or(GridCell { notes: Vec::new(), ..plain }), false);
        made.glue("\n", made.end);
        at = made.table(grid, at, &header);
    }
    made
}

/// The header that a mapping says, if it is the line `at`.
fn mapped(mapping: &Mapping, grid: &Grid, at: usize) -> Option<Header> {
    let line = grid.get(at)?;
    if mapping.header.is_some_and(|wanted| wanted != at + 1) {
        return None;
    }
    let width = grid[at..].iter().map(Vec::len).max().unwrap_or(0);
    let mut columns = vec![None; width];
    for (key, title) in &mapping.columns {
        let named = line.iter().position(|cell| cell.text.trim().eq_ignore_ascii_case(key.trim()));
        let lettered = || column_number(key).filter(|_| mapping.header.is_some());
        match named.or_else(lettered) {
            Some(column) if column < width => columns[column] = Some(title.clone()),
            _ if mapping.header.is_none() => return None,
            _ => {}
        }
    }
    columns.iter().any(Option::is_some).then_some(Header { columns, lines: 1 })
}

/// The number of the column that a sheet calls so: `A` is 0.
fn column_number(letters: &str) -> Option<usize> {
    let valid = (1..=3).contains(&letters.len()) && letters.bytes().all(|b| b.is_ascii_uppercase());
    valid.then(|| letters.bytes().fold(0, |sum, b| sum * 26 + usize::from(b - b'A') + 1) - 1)
}

fn header(lines: &[Vec<GridCell>]) -> Option<Header> {
    library_workbook(lines).or_else(|| two_lines(lines)).or_else(|| one_line(lines))
}

/// A line of groups above a line of names.
fn two_lines(lines: &[Vec<GridCell>]) -> Option<Header> {
    let (above, below) = (lines.first()?, lines.get(1)?);
    let words: Vec<Option<&str>> = above.iter().map(|cell| group(&cell.text)).collect();
    if !words.contains(&Some("in")) && !words.contains(&Some("out")) {
        return None;
    }
    let mut columns = Vec::new();
    let mut current = None;
    let width = above.len().max(below.len());
    let stated = above.iter().map(|cell| !cell.text.is_empty()).chain(std::iter::repeat(false));
    let words = words.into_iter().chain(std::iter::repeat(None));
    for (at, (stated, word)) in stated.zip(words).enumerate().take(width) {
        if stated {
            current = word;
        }
        let name = below.get(at).map_or("", |cell| cell.text.trim());
        columns.push(match current {
            Some(kind @ ("in" | "out" | "state" | "state!")) if !name.is_empty() => Some(format!("{kind} {name}")),
            Some(kind @ ("dur" | "remark" | "repeat" | "#")) if stated => {
                let unit = if kind == "dur" { name } else { "" };
                Some(format!("{kind} {unit}").trim_end().to_owned())
            }
            _ => None,
        });
    }
    Some(Header { columns, lines: 2 })
}

/// `State | testtime | outputs | # | inputs | # | Purpose`.
fn library_workbook(lines: &[Vec<GridCell>]) -> Option<Header> {
    let line = lines.first()?;
    let is = |at: usize, wanted: &str| line.get(at).is_some_and(|cell| cell.text.eq_ignore_ascii_case(wanted));
    if !is(0, "State") || !is(1, "testtime") {
        return None;
    }
    let mut kind = "out";
    let columns = line.iter().enumerate().map(|(at, cell)| match (at, cell.text.as_str()) {
        (0, _) => Some("#".to_owned()),
        (1, _) => Some("dur ms".to_owned()),
        (_, "#") => {
            kind = "in";
            None
        }
        (_, text) if text.eq_ignore_ascii_case("Purpose") => Some("remark".to_owned()),
        (_, "") => None,
        (_, text) => Some(format!("{kind} {text}")),
    });
    Some(Header { columns: columns.collect(), lines: 1 })
}

/// The header of a pipe table.
fn one_line(lines: &[Vec<GridCell>]) -> Option<Header> {
    let line = lines.first()?;
    let bound = |cell: &GridCell| matches!(pipe::header_kind(cell.text.trim()), pipe::Header::Bound(..));
    if !line.iter().any(bound) {
        return None;
    }
    let columns = line.iter().map(|cell| (!cell.text.is_empty()).then(|| cell.text.clone())).collect();
    Some(Header { columns, lines: 1 })
}

impl Made {
    /// Writes a table from the line `at` on; gives the line behind it.
    fn table(&mut self, grid: &Grid, at: usize, header: &Header) -> usize {
        for (column, title) in header.columns.iter().enumerate() {
            let Some(title) = title else { continue };
            let below = grid[at + header.lines - 1].get(column).filter(|cell| !cell.text.is_empty());
            let source = below.or_else(|| grid[at].get(column)).cloned().unwrap_or_default();
            let runs = source.runs.first().map(|run| (0, run.1)).into_iter().collect();
            self.bar(&source);
            self.cell(&GridCell { text: title.clone(), notes: Vec::new(), runs, ..source }, true);
        }
        self.line_end();
        let mut row = at + header.lines;
        while row < grid.len() {
            let line = &grid[row];
            let blank = line.iter().all(|cell| cell.text.is_empty() && cell.notes.is_empty());
            if blank || line.iter().any(|cell| cell.text.starts_with("@gtt")) {
                break;
            }
            for (column, title) in header.columns.iter().enumerate() {
                let Some(title) = title else { continue };
                let cell = line.get(column).cloned().unwrap_or_default();
                let bound = matches!(pipe::header_kind(title), pipe::Header::Bound(..));
                self.bar(&cell);
                self.cell(&if bound { guessed(cell) } else { cell }, true);
            }
            self.line_end();
            row += 1;
        }
        row
    }

    /// Text that stands nowhere: all of it at one place of the piece.
    fn glue(&mut self, text: &str, at: usize) {
        for c in text.chars() {
            self.runs.push((saturate(self.text.len()), saturate(at)));
            self.text.push(c);
        }
    }

    /// The bar in front of a cell, at its beginning.
    fn bar(&mut self, cell: &GridCell) {
        self.glue("| ", cell.span.start.max(self.end));
    }

    /// The last bar of a line, at the last byte of its last cell, so that a line ends where that cell does.
    fn line_end(&mut self) {
        self.glue("|", self.end.saturating_sub(1));
        self.glue("\n", self.end);
    }

    fn cell(&mut self, cell: &GridCell, escape: bool) {
        let start = self.text.len();
        let mut runs = cell.runs.iter().peekable();
        let mut there = self.end;
        for (at, c) in cell.text.char_indices() {
            if let Some((_, to)) = runs.next_if(|(from, _)| *from as usize <= at) {
                there = *to as usize;
            }
            let here = there.min(cell.span.end.max(self.end));
            if c == '|' && escape {
                self.runs.push((saturate(self.text.len()), saturate(here)));
                self.text.push('\\');
            }
            self.runs.push((saturate(self.text.len()), saturate(here)));
            self.text.push(c);
            there += c.len_utf8();
        }
        self.end = cell.span.end.max(self.end);
        self.cells.push((start..self.text.len(), cell.clone()));
        self.glue(" ", self.end);
    }
}
