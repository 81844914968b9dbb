//! The forms of a table as files: which one a file is, and all readers and writers behind one door.

use super::model::Table;
use super::piece::Piece;
use super::read::{self, Options, Read};
use super::write::{self, Written};
use crate::text::FileId;

/// A form.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Form {
    /// A pipe table.
    Pipe,
    /// The language of geteta.
    Gtt,
    /// Comma-separated values.
    Csv,
    /// A workbook of Excel.
    Xlsx,
    /// A workbook of old Excel, which is read only.
    Xls,
    /// A workbook of OpenDocument.
    Ods,
    /// XML of geteta, version 1.1.
    Exteta,
    /// XML of STVS.
    Stvs,
    /// XML of the CODESYS Test Manager.
    TestManager,
}

impl Form {
    /// All forms.
    pub const ALL: [Self; 9] = [
        Self::Pipe,
        Self::Gtt,
        Self::Csv,
        Self::Xlsx,
        Self::Xls,
        Self::Ods,
        Self::Exteta,
        Self::Stvs,
        Self::TestManager,
    ];

    /// The word for it on the command line.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Pipe => "pipe",
            Self::Gtt => "gtt",
            Self::Csv => "csv",
            Self::Xlsx => "xlsx",
            Self::Xls => "xls",
            Self::Ods => "ods",
            Self::Exteta => "exteta",
            Self::Stvs => "stvs",
            Self::TestManager => "test-manager",
        }
    }

    /// The form of that word.
    #[must_use]
    pub fn named(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|form| form.key() == key)
    }

    /// The form that a file's name says; XML is exteta's where the name says no more (`x.stvs.xml`, `x.test-manager.xml`).
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        let name = name.to_lowercase();
        let ends = |endings: &[&str]| endings.iter().any(|ending| name.ends_with(ending));
        Some(match () {
            () if ends(&[".stvs.xml"]) => Self::Stvs,
            () if ends(&[".test-manager.xml", ".tabletest.xml"]) => Self::TestManager,
            () if ends(&[".xml"]) => Self::Exteta,
            () if ends(&[".csv"]) => Self::Csv,
            () if ends(&[".xlsx"]) => Self::Xlsx,
            () if ends(&[".xls"]) => Self::Xls,
            () if ends(&[".ods"]) => Self::Ods,
            () if ends(&[".gtt"]) => Self::Gtt,
            () if ends(&[".md", ".txt"]) => Self::Pipe,
            () => return None,
        })
    }

    /// Whether its files are no text.
    #[must_use]
    pub const fn is_binary(self) -> bool {
        matches!(self, Self::Xlsx | Self::Xls | Self::Ods)
    }
}

/// A file that holds tables.
#[derive(Clone, Copy, Debug)]
pub struct File<'a> {
    /// Its number.
    pub id: FileId,
    /// Its path, from which the form is seen.
    pub path: &'a str,
    /// Its text; empty for a workbook.
    pub text: &'a str,
    /// Its bytes; only a workbook needs them.
    pub bytes: &'a [u8],
}

/// Reads a file. A text that is neither a spreadsheet nor of another form is looked through for pipe tables.
#[must_use]
pub fn read(file: &File<'_>, options: &Options) -> Read {
    let piece = Piece::verbatim(file.id, file.text, 0);
    let stem = file.path.rsplit('/').next().unwrap_or(file.path);
    match Form::of_name(file.path) {
        Some(Form::Csv) => read::sheet::csv(&piece, stem, options),
        Some(form) if form.is_binary() => read::sheet::workbook(file.id, file.bytes, options),
        _ => read::text(&piece, options),
    }
}

/// Writes tables into one file of `form`.
///
/// # Errors
/// Where the form is not written, holds one table only, or its writer fails.
pub fn write(form: Form, tables: &[&Table]) -> Result<Written<Vec<u8>>, String> {
    let one = || match tables {
        [table] => Ok(*table),
        _ => Err(format!("a file of the form `{}` holds one table, and these are {}", form.key(), tables.len())),
    };
    let bytes = |written: Written<String>| Written { content: written.content.into_bytes(), lost: written.lost };
    match form {
        Form::Pipe => Ok(bytes(joined(tables.iter().map(|table| write::pipe(table))))),
        Form::Gtt => Ok(bytes(joined(tables.iter().map(|table| write::gtt(table))))),
        Form::Csv => {
            let all: Vec<Written<String>> = tables.iter().map(|table| write::csv(table)).collect::<Result<_, _>>()?;
            Ok(bytes(joined(all.into_iter())))
        }
        Form::Xlsx => write::xlsx(tables),
        Form::Ods => write::ods(tables),
        Form::Xls => Err("the form `xls` is read and not written; `xlsx` is its successor".to_owned()),
        Form::Exteta => Ok(bytes(write::exteta(one()?))),
        Form::Stvs => Ok(bytes(write::stvs(one()?))),
        Form::TestManager => Ok(bytes(write::test_manager(tables))),
    }
}

fn joined(all: impl Iterator<Item = Written<String>>) -> Written<String> {
    let mut out = Written { content: String::new(), lost: Vec::new() };
    for written in all {
        if !out.content.is_empty() {
            out.content.push('\n');
        }
        out.content.push_str(&written.content);
        out.lost.extend(written.lost);
    }
    out
}
