//! The sheets of a workbook as grids of text, in bounded time and memory.
//!
//! `.xlsx` and `.ods` are archives: small files that may unpack to any size, and whose cells may claim any place and
//! repeat any text. So what an archive unpacks to is counted before anything else reads it, cells are taken one by one,
//! and a sheet that would fill more than [`CELLS`] cells or [`BYTES`] bytes of text is refused. The old binary `.xls` is
//! not packed; `xls` measures it before the library that reads it lays its sheets out.

mod ods;
mod xls;

use std::io::{Cursor, Read as _};

use calamine::{Data, DataRef, Dimensions, Reader, Xls, Xlsx, XlsxError};
use zip::ZipArchive;

use super::sheet::{Grid, GridCell, Note, saturate};

/// What an archive may unpack to, in bytes.
const UNPACKED: u64 = 64 << 20;
/// How many cells the sheets of one workbook may fill, those between others included.
const CELLS: usize = 1 << 18;
/// How much text the cells of one workbook may hold.
const BYTES: usize = 16 << 20;

/// How much of a sheet's name is repeated with each of its cells, in bytes.
const NAME: usize = 128;

/// A sheet: its cells, or why they cannot be read.
pub(super) struct Sheet {
    pub(super) name: String,
    pub(super) grid: Result<Grid, String>,
}

/// The sheets of a workbook, in its order.
pub(super) fn sheets(bytes: &[u8]) -> Result<Vec<Sheet>, String> {
    const COMPOUND: &[u8] = &[0xD0, 0xCF, 0x11, 0xE0];
    let mut budget = Budget { cells: CELLS, bytes: BYTES };
    if bytes.starts_with(COMPOUND) {
        return old(bytes, &mut budget);
    }
    let archive = unpacked(bytes)?;
    match archive.index_for_name("content.xml") {
        Some(_) => ods::sheets(archive, &mut budget),
        None => new(bytes, &mut budget),
    }
}

/// The archive, once it is known that it unpacks to no more than [`UNPACKED`] bytes.
fn unpacked(bytes: &[u8]) -> Result<ZipArchive<Cursor<&[u8]>>, String> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| error.to_string())?;
    let mut left = UNPACKED;
    for index in 0..archive.len() {
        // What cannot be unpacked here cannot be unpacked later.
        let Ok(entry) = archive.by_index(index) else { continue };
        let size = std::io::copy(&mut entry.take(left + 1), &mut std::io::sink()).unwrap_or(0);
        left = left.checked_sub(size).ok_or_else(|| format!("it unpacks to more than {} MiB", UNPACKED >> 20))?;
    }
    Ok(archive)
}

/// The sheets of a `.xlsx`.
fn new(bytes: &[u8], budget: &mut Budget) -> Result<Vec<Sheet>, String> {
    let mut book = Xlsx::new(Cursor::new(bytes)).map_err(|error| error.to_string())?;
    let names = book.sheet_names();
    Ok(names.into_iter().map(|name| Sheet { grid: new_sheet(&mut book, &name, budget), name }).collect())
}

fn new_sheet(book: &mut Xlsx<Cursor<&[u8]>>, name: &str, budget: &mut Budget) -> Result<Grid, String> {
    let mut reader = match book.worksheet_cells_reader(name) {
        Ok(reader) => reader,
        Err(XlsxError::NotAWorksheet(_)) => return Ok(Grid::new()),
        Err(error) => return Err(error.to_string()),
    };
    let mut filling = Filling::new(name);
    while let Some(record) = reader.next_cell_with_formula_metadata().map_err(|error| error.to_string())? {
        let value = match record.value {
            // Many cells may share one text, so it is counted before it is copied.
            DataRef::SharedString(text) if text.len() > budget.bytes => return Err(too_much_text()),
            value => Data::from(value),
        };
        filling.add(record.pos, &value, record.formula.is_some(), budget)?;
    }
    drop(reader);
    let merged = book.merge_cells_by_sheet_name(name).map_err(|error| error.to_string())?;
    merged.iter().for_each(|region| filling.merge(region));
    filling.grid(budget)
}

/// The sheets of a `.xls`.
fn old(bytes: &[u8], budget: &mut Budget) -> Result<Vec<Sheet>, String> {
    xls::measure(bytes)?;
    let mut book = Xls::new(Cursor::new(bytes)).map_err(|error| error.to_string())?;
    let names = book.sheet_names();
    let mut sheet = |name: &str| {
        let range = book.worksheet_range(name).map_err(|error| error.to_string())?;
        let formulas = book.worksheet_formula(name).ok();
        let mut filling = Filling::new(name);
        let (top, left) = range.start().unwrap_or((0, 0));
        for (row, column, value) in range.used_cells() {
            let at = (top + saturate(row), left + saturate(column));
            let formula = formulas.as_ref().and_then(|formulas| formulas.get_value(at));
            filling.add(at, value, formula.is_some_and(|formula| !formula.is_empty()), budget)?;
        }
        let merged = book.merge_cells_by_sheet_name(name).map_err(|error| error.to_string())?;
        merged.iter().for_each(|region| filling.merge(region));
        filling.grid(budget)
    };
    Ok(names.into_iter().map(|name| Sheet { grid: sheet(&name), name }).collect())
}

/// What the sheets of one workbook may still take.
struct Budget {
    cells: usize,
    bytes: usize,
}

fn too_much_text() -> String {
    format!("it holds more than {} MiB of text", BYTES >> 20)
}

/// The cells of a sheet, as they come.
struct Filling<'a> {
    /// The name of the sheet, as far as it is shown with each cell.
    sheet: &'a str,
    cells: Vec<((u32, u32), GridCell)>,
    /// The cells that reach over others to the right: the line, and the first and the last column.
    wide: Vec<(u32, u32, u32)>,
}

impl<'a> Filling<'a> {
    fn new(sheet: &'a str) -> Self {
        Self { sheet: &sheet[..sheet.floor_char_boundary(NAME)], cells: Vec::new(), wide: Vec::new() }
    }

    /// That cells are merged; only the first line of a region matters, since a blank cell repeats the one above.
    fn merge(&mut self, region: &Dimensions) {
        let ((row, first), (_, last)) = (region.start, region.end);
        self.wide.extend((last > first).then_some((row, first, last)));
    }

    fn add(&mut self, at: (u32, u32), value: &Data, is_formula: bool, budget: &mut Budget) -> Result<(), String> {
        if matches!(value, Data::Empty) && !is_formula {
            return Ok(());
        }
        let cell = cell(self.sheet, at, value, is_formula);
        budget.bytes = budget.bytes.checked_sub(cell.text.len()).ok_or_else(too_much_text)?;
        if self.cells.len() >= budget.cells {
            return Err(too_many_cells());
        }
        self.cells.push((at, cell));
        Ok(())
    }

    /// Lines from the first that holds something to the last, each from the first column that holds something.
    fn grid(mut self, budget: &mut Budget) -> Result<Grid, String> {
        let wide = std::mem::take(&mut self.wide);
        let (mut grid, (top, left)) = self.filled(budget)?;
        let width = grid.iter().map(Vec::len).max().unwrap_or(0);
        for (row, first, last) in wide {
            let Some((line, first)) = row.checked_sub(top).zip(first.checked_sub(left)) else { continue };
            let Some(line) = grid.get_mut(line as usize) else { continue };
            if line.len() < width.min((last - left) as usize + 1) {
                return Err(too_many_cells());
            }
            let Some(([.., anchor], covered)) = line.split_at_mut_checked(first as usize + 1) else { continue };
            let over = covered.len().min((last - left - first) as usize);
            budget.cells = budget.cells.checked_sub(over).ok_or_else(too_many_cells)?;
            budget.bytes = budget.bytes.checked_sub(anchor.text.len() * over).ok_or_else(too_much_text)?;
            for cell in &mut covered[..over] {
                cell.merged = Some((anchor.address.clone(), anchor.text.clone()));
            }
        }
        Ok(grid)
    }

    /// The grid without what is merged, and the line and the column at which it begins.
    fn filled(mut self, budget: &mut Budget) -> Result<(Grid, (u32, u32)), String> {
        self.cells.sort_by_key(|(at, _)| *at);
        let left = self.cells.iter().map(|((_, column), _)| *column).min().unwrap_or(0);
        let top = self.cells.first().map_or(0, |((row, _), _)| *row);
        let mut grid = Grid::new();
        for ((row, column), cell) in self.cells {
            let (line, place) = ((row - top) as usize, (column - left) as usize);
            let lines = (line + 1).saturating_sub(grid.len());
            let here = grid.get(line).map_or(0, Vec::len);
            let cells = lines + (place + 1).saturating_sub(here);
            budget.cells = budget.cells.checked_sub(cells).ok_or_else(too_many_cells)?;
            grid.resize_with(grid.len() + lines, Vec::new);
            for empty in here..=place {
                grid[line].push(GridCell::at(address(self.sheet, row, left + saturate(empty))));
            }
            grid[line][place] = cell;
        }
        let width = grid.iter().map(Vec::len).max().unwrap_or(0);
        let missing = grid.iter().map(|line| width - line.len()).sum::<usize>();
        if missing > budget.cells {
            // Too ragged to be filled up: what is missing at the end of a line reads as empty all the same.
            return Ok((grid, (top, left)));
        }
        budget.cells -= missing;
        for (line, row) in grid.iter_mut().zip(top..) {
            for empty in line.len()..width {
                line.push(GridCell::at(address(self.sheet, row, left + saturate(empty))));
            }
        }
        Ok((grid, (top, left)))
    }
}

fn too_many_cells() -> String {
    format!("it fills more than {CELLS} cells")
}

fn cell(sheet: &str, at: (u32, u32), value: &Data, is_formula: bool) -> GridCell {
    let mut cell = GridCell::at(address(sheet, at.0, at.1));
    let mut refuse = |what: &str| cell.notes.push(Note::Refused(what.to_owned()));
    cell.text = match value {
        Data::Empty => String::new(),
        Data::String(text) => text.trim().replace(['\n', '\r'], " "),
        Data::Int(value) => value.to_string(),
        Data::Float(value) => number(*value),
        Data::Bool(value) => if *value { "TRUE" } else { "FALSE" }.to_owned(),
        Data::Error(error) => {
            refuse(&format!("the formula of this cell failed: {error:?}"));
            String::new()
        }
        _ => {
            refuse("the spreadsheet made a date of this cell; format it as text");
            String::new()
        }
    };
    if is_formula && matches!(value, Data::Empty) {
        cell.notes.push(Note::Refused("this cell is a formula without a stored value; write the value".to_owned()));
    } else if is_formula {
        let message = format!("this cell is a formula; its last value `{}` is taken", cell.text);
        cell.notes.push(Note::Guess(message));
    }
    cell
}

fn number(value: f64) -> String {
    #[allow(clippy::cast_possible_truncation, reason = "whole and small, so nothing is cut")]
    if value.fract() == 0.0 && value.abs() < 1e15 { format!("{}", value as i64) } else { format!("{value:?}") }
}

/// `3` and `1` as `B4`.
fn address(sheet: &str, row: u32, column: u32) -> String {
    let mut letters = String::new();
    let mut rest = column + 1;
    while rest > 0 {
        letters.insert(0, char::from(b'A' + u8::try_from((rest - 1) % 26).unwrap_or(0)));
        rest = (rest - 1) / 26;
    }
    format!("{sheet}!{letters}{}", row + 1)
}
