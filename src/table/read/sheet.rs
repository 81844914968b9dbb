//! Spreadsheets: `.xlsx`, `.xls`, `.ods` and `.csv`, in the layout of the papers (a line of groups that spans
//! `Input`, `Output`, `Duration`, `Remark`, a line of names below it), in the layout of CODESYS test-library workbooks
//! (`State | testtime | outputs | # | inputs | # | Purpose`), or with the header of a pipe table.
//!
//! A sheet is turned into the text of pipe tables, which the reader of pipe tables reads; what had to be guessed on the
//! way is a finding. A cell of a workbook has no place in its file, so a finding names it (`Sheet1!B4`).

mod header;

use std::ops::Range;

use super::workbook::{self, Sheet};
use super::{Options, Read, pipe};
use crate::diagnostic::Finding;
use crate::table::codes;
use crate::table::piece::Piece;
use crate::text::{FileId, Place, SpanMap};
use header::make;

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
    /// Where it is merged with a cell to the left: the address of that cell and its text.
    pub(super) merged: Option<(String, String)>,
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

/// A cell that is merged with one to the left shows the text of that one. Merged with one above, it is blank, and a blank
/// cell repeats the one above as it is.
fn unmerged(mut cell: GridCell) -> GridCell {
    let Some((address, text)) = cell.merged.take() else { return cell };
    if cell.text.is_empty() {
        cell.notes.push(Note::Guess(format!("this cell is merged with {address}; its text `{text}` is taken")));
        cell.text = text;
    } else if cell.text != text {
        let message = format!("this cell holds `{}`, hidden by {address}, with which it is merged", cell.text);
        cell.notes.push(Note::Refused(message));
    }
    cell
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
