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

/// The tables as an Excel workbook, a sheet each; every cell is a text.
///
/// # Errors
/// Where the writer of the format fails, as for more rows than a sheet has.
pub fn xlsx(tables: &[&Table]) -> Result<Written<Vec<u8>>, String> {
    let mut workbook = rust_xlsxwriter::Workbook::new();
    let fixed = rust_xlsxwriter::ExcelDateTime::from_ymd(2000, 1, 1).map_err(|error| error.to_string())?;
    workbook.set_properties(&rust_xlsxwriter::DocProperties::new().set_creation_datetime(&fixed));
    for table in tables {
        xlsx_sheet(workbook.add_worksheet(), table)?;
    }
    let content = workbook.save_to_buffer().map_err(|error| error.to_string())?;
    Ok(Written { content, lost: tables.iter().flat_map(|table| lost_parts(table)).collect() })
}

fn xlsx_sheet(sheet: &mut rust_xlsxwriter::Worksheet, table: &Table) -> Result<(), String> {
    let bold = rust_xlsxwriter::Format::new().set_bold();
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
    Ok(())
}

const ODS_HEAD: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<office:document-content \
    xmlns:office=\"urn:oasis:names:tc:opendocument:xmlns:office:1.0\" \
    xmlns:table=\"urn:oasis:names:tc:opendocument:xmlns:table:1.0\" \
    xmlns:text=\"urn:oasis:names:tc:opendocument:xmlns:text:1.0\" office:version=\"1.3\">\
    <office:body><office:spreadsheet>";

const ODS_MANIFEST: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<manifest:manifest \
    xmlns:manifest=\"urn:oasis:names:tc:opendocument:xmlns:manifest:1.0\" manifest:version=\"1.3\">\
    <manifest:file-entry manifest:full-path=\"/\" manifest:media-type=\"application/vnd.oasis.opendocument.spreadsheet\"/>\
    <manifest:file-entry manifest:full-path=\"content.xml\" manifest:media-type=\"text/xml\"/></manifest:manifest>";

/// The tables as an OpenDocument workbook, a sheet each; every cell is a text.
///
/// # Errors
/// Where the archive cannot be written.
pub fn ods(tables: &[&Table]) -> Result<Written<Vec<u8>>, String> {
    let mut content = ODS_HEAD.to_owned();
    for (number, table) in tables.iter().enumerate() {
        content += &format!("<table:table table:name=\"Sheet{}\">", number + 1);
        for line in sheet(table) {
            content += "<table:table-row>";
            line.iter().for_each(|text| ods_cell(text, &mut content));
            content += "</table:table-row>";
        }
        content += "</table:table>";
    }
    content += "</office:spreadsheet></office:body></office:document-content>";
    let packed = ods_archive(&content).map_err(|error| error.to_string())?;
    Ok(Written { content: packed, lost: tables.iter().flat_map(|table| lost_parts(table)).collect() })
}

/// Blanks that stand together are one blank and a `text:s` for each of the others.
fn ods_cell(text: &str, out: &mut String) {
    if text.is_empty() {
        *out += "<table:table-cell/>";
        return;
    }
    let text = super::xml::escaped(text);
    let mut blank = false;
    *out += "<table:table-cell office:value-type=\"string\"><text:p>";
    for c in text.chars() {
        if c == ' ' && blank {
            *out += "<text:s/>";
        } else {
            out.push(c);
        }
        blank = c == ' ';
    }
    *out += "</text:p></table:table-cell>";
}

/// The file `mimetype` comes first and is stored as it is, by OpenDocument 1.3, part 2, 3.3.
fn ods_archive(content: &str) -> zip::result::ZipResult<Vec<u8>> {
    use std::io::Write;
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    let stored = zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Stored);
    let packed = zip::write::SimpleFileOptions::default().compression_method(zip::CompressionMethod::Deflated);
    zip.start_file("mimetype", stored)?;
    zip.write_all(b"application/vnd.oasis.opendocument.spreadsheet")?;
    zip.start_file("META-INF/manifest.xml", packed)?;
    zip.write_all(ODS_MANIFEST.as_bytes())?;
    zip.start_file("content.xml", packed)?;
    zip.write_all(content.as_bytes())?;
    Ok(zip.finish()?.into_inner())
}
