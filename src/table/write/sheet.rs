//! Spreadsheets in the layout of the papers: a line with the heading, one with the groups, one with the names.

use super::pipe::{grid, header_cell, heading};
use super::{Written, lost_parts};
use crate::table::model::{ColumnKind, Table};

/// The sheet as rows of texts.
fn sheet(table: &Table) -> Vec<Vec<String>> {
    let mut lines = grid(table).into_iter();
    let names = lines.next().unwrap_or_default();
    let mut groups = Vec::new();
    let mut last = None;
    let mut below = Vec::new();
    for (at, name) in names.iter().enumerate() {
        match at.checked_sub(1).and_then(|at| table.columns.get(at)) {
            Some(column) => {
                let same = last == Some(column.kind);
                groups.push(if same { String::new() } else { group(column.kind).to_owned() });
                let word = column.kind.word().len() + 1;
                below.push(header_cell(column)[word..].to_owned());
                last = Some(column.kind);
            }
            None => {
                groups.push(match name.as_str() {
                    "dur" => "Duration".to_owned(),
                    "remark" => "Remark".to_owned(),
                    "repeat" => "Repeat".to_owned(),
                    _ => "Seq.".to_owned(),
                });
                below.push(String::new());
                last = None;
            }
        }
    }
    let mut out = vec![vec![heading(table)], groups, below];
    out.extend(lines);
    out
}

const fn group(kind: ColumnKind) -> &'static str {
    match kind {
        ColumnKind::Input => "Input",
        ColumnKind::Output => "Output",
        ColumnKind::StateAssumption => "State",
        ColumnKind::StateAssertion => "State!",
    }
}

/// The table as comma-separated values.
///
/// # Errors
/// Where the writer of the format fails.
pub fn csv(table: &Table) -> Result<Written<String>, String> {
    let mut writer = csv::WriterBuilder::new().flexible(true).from_writer(Vec::new());
    for line in sheet(table) {
        writer.write_record(&line).map_err(|error| error.to_string())?;
    }
    let bytes = writer.into_inner().map_err(|error| error.to_string())?;
    let content = String::from_utf8(bytes).map_err(|error| error.to_string())?;
    Ok(Written { content, lost: lost_parts(table) })
}

/// The table as an Excel workbook of one sheet; every cell is a text.
///
/// # Errors
/// Where the writer of the format fails, as for more rows than a sheet has.
pub fn xlsx(table: &Table) -> Result<Written<Vec<u8>>, String> {
    let mut workbook = rust_xlsxwriter::Workbook::new();
    let fixed = rust_xlsxwriter::ExcelDateTime::from_ymd(2000, 1, 1).map_err(|error| error.to_string())?;
    workbook.set_properties(&rust_xlsxwriter::DocProperties::new().set_creation_datetime(&fixed));
    let bold = rust_xlsxwriter::Format::new().set_bold();
    let sheet = workbook.add_worksheet();
    for (row, line) in self::sheet(table).iter().enumerate() {
        let at = u32::try_from(row).map_err(|_| "too many rows".to_owned())?;
        for (column, text) in line.iter().enumerate().filter(|(_, text)| !text.is_empty()) {
            let column = u16::try_from(column).map_err(|_| "too many columns".to_owned())?;
            let written = if row < 3 {
                sheet.write_string_with_format(at, column, text, &bold)
            } else {
                sheet.write_string(at, column, text)
            };
            written.map_err(|error| error.to_string())?;
        }
    }
    sheet.set_freeze_panes(3, 1).map_err(|error| error.to_string())?;
    let content = workbook.save_to_buffer().map_err(|error| error.to_string())?;
    Ok(Written { content, lost: lost_parts(table) })
}
