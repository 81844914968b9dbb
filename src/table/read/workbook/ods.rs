//! Sheets of OpenDocument (`.ods`, ODF 1.2, part 1, section 9), read as a stream: a cell or a line that says that it is
//! repeated is repeated only where it holds something, and as far as the budget goes.

use std::io::{BufReader, Cursor};

use calamine::{CellErrorType, Data, Dimensions};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use zip::ZipArchive;

use super::{Budget, Filling, Sheet, too_many_cells};

/// A cell as it is written.
struct Cell {
    column: u64,
    times: u64,
    /// How many columns it reaches over, where it stands once.
    span: u64,
    value: Data,
    is_formula: bool,
}

pub(super) fn sheets(mut archive: ZipArchive<Cursor<&[u8]>>, budget: &mut Budget) -> Result<Vec<Sheet>, String> {
    let content = archive.by_name("content.xml").map_err(|error| error.to_string())?;
    let mut reader = Reader::from_reader(BufReader::new(content));
    reader.config_mut().expand_empty_elements = true;
    let mut stream = Stream { reader, buffer: Vec::new() };
    let mut sheets = Vec::new();
    while let Some(event) = stream.next()? {
        if let Event::Start(start) = event
            && start.name().as_ref() == "table:table"
        {
            let name = attribute(&start, "table:name").unwrap_or_default();
            let grid = table(&mut stream, &name, budget);
            let stop = grid.is_err();
            sheets.push(Sheet { name, grid });
            if stop {
                break;
            }
        }
    }
    Ok(sheets)
}

/// The events of a document, one at a time.
struct Stream<R> {
    reader: Reader<R>,
    buffer: Vec<u8>,
}

impl<R: std::io::BufRead> Stream<R> {
    /// The next event; nothing at the end of the document.
    fn next(&mut self) -> Result<Option<Event<'_>>, String> {
        self.buffer.clear();
        match self.reader.read_event_into(&mut self.buffer) {
            Ok(Event::Eof) => Ok(None),
            Ok(event) => Ok(Some(event)),
            Err(error) => Err(error.to_string()),
        }
    }

    /// Leaves out everything up to the end of the element `name`, of which one is open.
    fn skip(&mut self, name: &str) -> Result<(), String> {
        let mut open = 1_usize;
        while open > 0 {
            match self.next()? {
                Some(Event::Start(start)) if start.name().as_ref() == name => open += 1,
                Some(Event::End(end)) if end.name().as_ref() == name => open -= 1,
                Some(_) => {}
                None => return Ok(()),
            }
        }
        Ok(())
    }
}

fn attribute(start: &BytesStart<'_>, name: &str) -> Option<String> {
    let found = start.try_get_attribute(name).ok().flatten()?;
    found.normalized_value(quick_xml::XmlVersion::Explicit1_0).ok().map(std::borrow::Cow::into_owned)
}

/// How often a cell or a line stands there.
fn times(start: &BytesStart<'_>, name: &str) -> u64 {
    attribute(start, name).and_then(|times| times.parse().ok()).unwrap_or(1).max(1)
}

fn table<R: std::io::BufRead>(stream: &mut Stream<R>, name: &str, budget: &mut Budget) -> Result<super::Grid, String> {
    let mut filling = Filling::new(name);
    let mut row = 0_u64;
    while let Some(event) = stream.next()? {
        match event {
            Event::Start(start) if start.name().as_ref() == "table:table-row" => {
                let again = times(&start, "table:number-rows-repeated");
                let cells = line(stream)?;
                // A line that holds nothing may be repeated to the end of the sheet.
                for at in (row..row.saturating_add(again)).take_while(|_| !cells.is_empty()) {
                    add(&cells, at, &mut filling, budget)?;
                }
                row = row.saturating_add(again);
            }
            Event::End(end) if end.name().as_ref() == "table:table" => break,
            _ => {}
        }
    }
    filling.grid(budget)
}

/// One more line of `cells`.
fn add(cells: &[Cell], row: u64, filling: &mut Filling<'_>, budget: &mut Budget) -> Result<(), String> {
    let place = |at: u64| u32::try_from(at).ok().filter(|at| *at < u32::MAX).ok_or_else(too_many_cells);
    for cell in cells {
        for column in cell.column..cell.column.saturating_add(cell.times) {
            filling.add((place(row)?, place(column)?), &cell.value, cell.is_formula, budget)?;
        }
        if cell.times == 1 && cell.span > 1 {
            let start = (place(row)?, place(cell.column)?);
            let last = place(cell.column.saturating_add(cell.span - 1))?;
            filling.merge(&Dimensions::new(start, (start.0, last)));
        }
    }
    Ok(())
}

/// The cells of a line that hold something.
fn line<R: std::io::BufRead>(stream: &mut Stream<R>) -> Result<Vec<Cell>, String> {
    let mut cells = Vec::new();
    let mut column = 0_u64;
    while let Some(event) = stream.next()? {
        match event {
            Event::Start(start) => {
                let name = start.name().as_ref().to_owned();
                if !matches!(name.as_str(), "table:table-cell" | "table:covered-table-cell") {
                    continue;
                }
                let span = times(&start, "table:number-columns-spanned");
                let times = times(&start, "table:number-columns-repeated");
                let is_formula = attribute(&start, "table:formula").is_some_and(|formula| !formula.is_empty());
                let stated = stated(&start);
                let text = text(stream, &name)?;
                let value = stated.unwrap_or(if text.is_empty() { Data::Empty } else { Data::String(text) });
                if is_formula || !matches!(value, Data::Empty) {
                    cells.push(Cell { column, times, span, value, is_formula });
                }
                column = column.saturating_add(times);
            }
            Event::End(end) if end.name().as_ref() == "table:table-row" => break,
            _ => {}
        }
    }
    Ok(cells)
}

/// The value that a cell's attributes state; a text may stand in its content instead.
fn stated(start: &BytesStart<'_>) -> Option<Data> {
    if attribute(start, "calcext:value-type").is_some_and(|kind| kind == "error") {
        return Some(Data::Error(CellErrorType::Value));
    }
    match attribute(start, "office:value-type")?.as_str() {
        "float" | "percentage" | "currency" => {
            let value = attribute(start, "office:value")?;
            Some(value.parse().map_or(Data::String(value), Data::Float))
        }
        "boolean" => Some(Data::Bool(attribute(start, "office:boolean-value")?.eq_ignore_ascii_case("true"))),
        "date" | "time" => Some(Data::DateTimeIso(String::new())),
        _ => attribute(start, "office:string-value").map(Data::String),
    }
}

/// The text of a cell: its paragraphs, without what somebody remarked about it.
fn text<R: std::io::BufRead>(stream: &mut Stream<R>, cell: &str) -> Result<String, String> {
    let mut out = String::new();
    let mut paragraphs = 0;
    while let Some(event) = stream.next()? {
        match event {
            Event::Start(start) => match start.name().as_ref() {
                name @ ("office:annotation" | "table:table") => {
                    let name = name.to_owned();
                    stream.skip(&name)?;
                }
                "text:p" => {
                    paragraphs += 1;
                    if paragraphs > 1 {
                        out.push('\n');
                    }
                }
                "text:s" => {
                    let spaces = times(&start, "text:c").min(1024);
                    out.extend(std::iter::repeat_n(' ', usize::try_from(spaces).unwrap_or(1)));
                }
                "text:tab" => out.push(' '),
                "text:line-break" => out.push('\n'),
                _ => {}
            },
            Event::Text(text) if paragraphs > 0 => out.push_str(&text.xml10_content()),
            Event::CData(text) if paragraphs > 0 => out.push_str(&text.xml10_content()),
            Event::GeneralRef(entity) if paragraphs > 0 => out.extend(character(&entity)),
            Event::End(end) if end.name().as_ref() == cell => break,
            _ => {}
        }
    }
    Ok(out)
}

/// The character that a reference stands for; entities that a document declares stand for nothing.
fn character(entity: &quick_xml::events::BytesRef<'_>) -> Option<char> {
    if let Ok(Some(character)) = entity.resolve_char_ref() {
        return Some(character);
    }
    let name: &str = entity;
    Some(match name {
        "amp" => '&',
        "lt" => '<',
        "gt" => '>',
        "quot" => '"',
        "apos" => '\'',
        _ => return None,
    })
}
