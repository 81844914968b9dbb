//! Workbooks that unpack to more than they look like, or that claim cells far apart: a finding, in bounded memory.

use std::io::{Cursor, Write as _};

use rungbook::table::read::{self, Options, Read};
use rungbook::text::FileId;
use zip::write::SimpleFileOptions;

fn archive(parts: &[(&str, &[u8])]) -> Vec<u8> {
    let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in parts {
        archive.start_file(*name, SimpleFileOptions::default()).expect("a name");
        archive.write_all(bytes).expect("memory");
    }
    archive.finish().expect("memory").into_inner()
}

/// A `.xlsx` with one sheet, which holds `cells`, and one shared text.
fn xlsx(cells: &str, shared: &str) -> Vec<u8> {
    const RELATIONS: &str = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
    let relations = format!(
        "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship Id=\"r1\" Type=\"{RELATIONS}/worksheet\" Target=\"worksheets/sheet1.xml\"/><Relationship Id=\"r2\" Type=\"{RELATIONS}/sharedStrings\" Target=\"sharedStrings.xml\"/></Relationships>"
    );
    let book = format!(
        "<workbook xmlns:r=\"{RELATIONS}\"><sheets><sheet name=\"S\" sheetId=\"1\" r:id=\"r1\"/></sheets></workbook>"
    );
    let root = format!(
        "<Relationships xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"><Relationship Id=\"r0\" Type=\"{RELATIONS}/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>"
    );
    let sheet = format!("<worksheet><sheetData>{cells}</sheetData></worksheet>");
    let strings = format!("<sst><si><t>{shared}</t></si></sst>");
    archive(&[
        ("[Content_Types].xml", b"<Types/>"),
        ("_rels/.rels", root.as_bytes()),
        ("xl/workbook.xml", book.as_bytes()),
        ("xl/_rels/workbook.xml.rels", relations.as_bytes()),
        ("xl/worksheets/sheet1.xml", sheet.as_bytes()),
        ("xl/sharedStrings.xml", strings.as_bytes()),
    ])
}

/// A `.ods` with one sheet, which holds `rows`.
fn ods(rows: &str) -> Vec<u8> {
    let content = format!(
        "<office:document-content><office:body><office:spreadsheet><table:table table:name=\"S\">{rows}</table:table></office:spreadsheet></office:body></office:document-content>"
    );
    archive(&[
        ("mimetype", b"application/vnd.oasis.opendocument.spreadsheet"),
        ("META-INF/manifest.xml", b"<manifest/>"),
        ("content.xml", content.as_bytes()),
    ])
}

fn read(bytes: &[u8]) -> Read {
    read::sheet::workbook(FileId(0), bytes, &Options::default())
}

#[track_caller]
fn refused(bytes: &[u8], why: &str) {
    let read = read(bytes);
    let messages: Vec<&str> = read.findings.iter().map(|finding| finding.message.as_str()).collect();
    assert!(read.tables.is_empty() && messages.len() == 1 && messages[0].contains(why), "{messages:?}");
}

const HEAD: &str = "<row><c t=\"inlineStr\"><is><t>in x : INT</t></is></c><c t=\"inlineStr\"><is><t>out y : INT</t></is></c></row><row><c><v>1</v></c><c><f>A2</f><v>2</v></c></row>";

#[test]
fn a_small_workbook_is_read() {
    let read = read(&xlsx(HEAD, ""));
    assert_eq!(read.tables[0].rows().len(), 1);
    let messages: Vec<&str> = read.findings.iter().map(|finding| finding.message.as_str()).collect();
    assert_eq!(messages, ["this cell is a formula; its last value `2` is taken (S!B2)"]);
}

const MERGED: &str = "in x : INT|in y : INT|out z : INT|remark;1|2|3|a;4||5|b;||6|c";

#[track_caller]
fn merged(bytes: &[u8]) {
    let read = read(bytes);
    let messages: Vec<&str> = read.findings.iter().map(|finding| finding.message.as_str()).collect();
    assert_eq!(messages, ["this cell is merged with S!A3; its text `4` is taken (S!B3)"]);
    let rows = read.tables[0].rows();
    let texts: Vec<Vec<Option<&str>>> = rows
        .iter()
        .map(|row| row.cells.iter().map(|cell| cell.as_ref().map(|cell| cell.text.as_str())).collect())
        .collect();
    assert_eq!(texts[1], [Some("4"), Some("4"), Some("5")]);
    assert_eq!(texts[2], [None, None, Some("6")], "below, it repeats");
}

/// A merged cell means what it shows: one text over all its columns.
#[test]
fn merged_cells_show_one_text() {
    let cell = |text: &str| match text {
        "" => "<c/>".to_owned(),
        text => format!("<c t=\"inlineStr\"><is><t>{text}</t></is></c>"),
    };
    let row = |line: &str| format!("<row>{}</row>", line.split('|').map(cell).collect::<String>());
    let rows: String = MERGED.split(';').map(row).collect();
    let regions = "</sheetData><mergeCells><mergeCell ref=\"A3:B4\"/></mergeCells><sheetData>";
    merged(&xlsx(&format!("{rows}{regions}"), ""));
    let cell = |text: &str| match text {
        "" => "<table:covered-table-cell/>".to_owned(),
        text => {
            let over =
                if text == "4" { " table:number-columns-spanned=\"2\" table:number-rows-spanned=\"2\"" } else { "" };
            format!("<table:table-cell office:value-type=\"string\"{over}><text:p>{text}</text:p></table:table-cell>")
        }
    };
    let row =
        |line: &str| format!("<table:table-row>{}</table:table-row>", line.split('|').map(cell).collect::<String>());
    let rows: String = MERGED.split(';').map(row).collect();
    merged(&ods(&rows));
    let hidden = rows.replacen("<table:covered-table-cell/>", &cell("7"), 1);
    let read = read(&ods(&hidden));
    assert!(read.findings[0].message.contains("holds `7`, hidden by S!A3"), "{:?}", read.findings);
    assert!(read.tables[0].errors > 0, "what nobody sees is not taken");
}

#[test]
fn an_archive_that_unpacks_to_too_much_is_refused() {
    let much = vec![b' '; (64 << 20) + 1];
    let bomb = archive(&[("xl/workbook.xml", b"<workbook/>"), ("xl/media/picture", &much)]);
    assert!(bomb.len() < 1 << 20, "it is small");
    refused(&bomb, "it unpacks to more than 64 MiB");
}

#[test]
fn cells_far_apart_are_refused() {
    let corners =
        "<row r=\"1\"><c r=\"A1\"><v>1</v></c></row><row r=\"1048576\"><c r=\"XFD1048576\"><v>1</v></c></row>";
    refused(&xlsx(corners, ""), "cells");
    refused(&xlsx("<row r=\"1\"><c r=\"A1\"><v>1</v></c><c r=\"A900000\"><v>1</v></c></row>", ""), "cells");
}

#[test]
fn one_text_in_many_cells_is_counted_before_it_is_copied() {
    let cells = "<row><c t=\"s\"><v>0</v></c></row>".repeat(100);
    refused(&xlsx(&cells, &"a".repeat(1 << 20)), "text");
}

#[test]
fn repeated_cells_are_repeated_within_bounds() {
    let cell = |text: &str| {
        format!("<table:table-cell office:value-type=\"string\"><text:p>{text}</text:p></table:table-cell>")
    };
    let row = |cells: &str| format!("<table:table-row>{cells}</table:table-row>");
    let head = row(&format!("{}{}", cell("in x : INT"), cell("out y : INT")));
    let values = "<table:table-row table:number-rows-repeated=\"3\"><table:table-cell office:value-type=\"float\" office:value=\"1\" table:number-columns-repeated=\"2\"/></table:table-row>";
    let rest = "<table:table-row table:number-rows-repeated=\"1048000\"><table:table-cell table:number-columns-repeated=\"16384\"/></table:table-row>";
    let good = read(&ods(&format!("{head}{values}{rest}")));
    assert_eq!((good.tables[0].rows().len(), good.findings.len()), (3, 0));
    refused(&ods(&values.replace("\"3\"", "\"1000000\"")), "cells");
    refused(&ods(&values.replace("\"2\"", "\"18446744073709551615\"")), "cells");
    let long = row(&cell(&"a".repeat(1 << 20))
        .replace("table-cell office", "table-cell table:number-columns-repeated=\"99\" office"));
    refused(&ods(&long), "text");
}

#[test]
fn an_old_workbook_that_is_damaged_is_refused() {
    let mut bytes = vec![0xD0, 0xCF, 0x11, 0xE0, 0xA1, 0xB1, 0x1A, 0xE1];
    refused(&bytes, "damaged");
    bytes.resize(4096, 0);
    bytes[30] = 9;
    refused(&bytes, "damaged");
    refused(b"neither", "cannot be opened");
}

/// A compound file with one stream, `Workbook`, which holds `records`.
fn old(records: &[(u16, &[u8])]) -> Vec<u8> {
    let mut stream: Vec<u8> = Vec::new();
    for (kind, data) in records {
        stream.extend(kind.to_le_bytes());
        stream.extend(u16::try_from(data.len()).expect("short").to_le_bytes());
        stream.extend(*data);
    }
    stream.resize(4096, 0);
    let mut bytes = vec![0; 512];
    bytes[..8].copy_from_slice(&[0xD0, 0xCF, 0x11, 0xE0, 0xA1, 0xB1, 0x1A, 0xE1]);
    let mut put = |at: usize, value: u32| bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
    put(24, 0x0003_003E);
    put(28, 0x0009_FFFE);
    put(32, 6);
    put(44, 1);
    put(48, 1);
    put(56, 4096);
    put(60, 0xFFFF_FFFE);
    put(68, 0xFFFF_FFFE);
    (0..109).for_each(|i| put(76 + 4 * i, if i == 0 { 0 } else { 0xFFFF_FFFF }));
    // The table of sectors, the folder, and eight sectors of the stream.
    let mut next = [0xFFFF_FFFD, 0xFFFF_FFFE, 3, 4, 5, 6, 7, 8, 9, 0xFFFF_FFFE].to_vec();
    next.resize(128, 0xFFFF_FFFF);
    bytes.extend(next.iter().flat_map(|sector: &u32| sector.to_le_bytes()));
    for (name, kind, first, size) in [("Root Entry", 5, 0xFFFF_FFFE, 0), ("Workbook", 2, 2, 4096_u32)] {
        let mut entry: Vec<u8> = name.encode_utf16().flat_map(u16::to_le_bytes).collect();
        let length = u16::try_from(entry.len() + 2).expect("short");
        entry.resize(64, 0);
        entry.extend(length.to_le_bytes());
        entry.extend([kind, 1]);
        entry.extend([0xFF; 12]);
        entry.resize(116, 0);
        entry.extend(u32::to_le_bytes(first));
        entry.extend(size.to_le_bytes());
        entry.resize(128, 0);
        bytes.extend(entry);
    }
    bytes.resize(1536, 0);
    bytes.extend(stream);
    bytes
}

/// A workbook whose sheet begins `offset` bytes behind where it does, and holds `cells`.
fn old_sheet(cells: &[(u16, &[u8])], offset: u32) -> Vec<u8> {
    const BOF: (u16, &[u8]) = (0x0809, &[0, 6, 5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
    const EOF: (u16, &[u8]) = (0x000A, &[]);
    let mut sheet = (20 + 4 + 9 + 4 + offset).to_le_bytes().to_vec();
    sheet.extend([0, 0, 1, 0, b'S']);
    let mut records = vec![BOF, (0x0085, sheet.as_slice()), EOF, BOF];
    records.extend(cells);
    records.push(EOF);
    old(&records)
}

#[test]
fn an_old_workbook_is_measured() {
    fn number(row: u16, column: u16) -> Vec<u8> {
        [&row.to_le_bytes()[..], &column.to_le_bytes(), &[0, 0], &1.5_f64.to_le_bytes()].concat()
    }
    let (near, far) = (number(0, 0), number(65535, 255));
    refused(&old_sheet(&[(0x0203, &near)], 0), "no test table was found");
    refused(&old_sheet(&[(0x0203, &near), (0x0203, &far)], 0), "fill more than can be read");
    refused(&old_sheet(&[(0x0203, &near)], 4), "do not begin where it says");
    refused(&old_sheet(&[(0x0203, &near)], 1 << 20), "do not begin where it says");
    let mut everything = vec![0; 8];
    everything[4..].fill(0xFF);
    everything.extend([0, 0, 0, 1, 0, 0]);
    refused(&old_sheet(&[(0x0200, &everything), (0x0203, &near)], 0), "fill more than can be read");
    refused(&old_sheet(&[(0x0200, &[1])], 0), "damaged");
}
