//! `[tables]`: how test tables are read.

use super::file::{ConfigError, TablesSection};
use crate::source::Filter;
use crate::table::read::{self, Mapping, Options};

/// How test tables are read.
#[derive(Clone, Debug, Default)]
pub struct TableReading {
    /// What holds for all of them.
    pub all: Options,
    /// What the columns of some spreadsheets are.
    sheets: Vec<(Filter, Mapping)>,
}

impl TableReading {
    /// What the section means.
    ///
    /// # Errors
    /// If a time or a glob cannot be read, or a mapping names no column.
    pub fn new(section: TablesSection) -> Result<Self, ConfigError> {
        let mut all = Options::default();
        if let Some(text) = section.cycle {
            let message = format!("`tables.cycle` is `{text}`; it takes a time such as `10ms`");
            all.cycle = Some(read::time(&text).ok_or(ConfigError { message })?);
        }
        let mut sheets = Vec::new();
        for sheet in section.sheet {
            let filter = Filter::new(&sheet.files, &[]);
            let filter = filter.map_err(|error| ConfigError { message: format!("`tables.sheet.files`: {error}") })?;
            let letters = |key: &String| key.len() <= 3 && key.bytes().all(|b| b.is_ascii_uppercase());
            if sheet.files.is_empty() || sheet.header.is_none() && sheet.columns.keys().all(letters) {
                let message = "`tables.sheet` needs `files`, and the line of the `header` or the name of a column";
                return Err(ConfigError { message: message.to_owned() });
            }
            let mapping = Mapping { header: sheet.header, columns: sheet.columns.into_iter().collect() };
            sheets.push((filter, mapping));
        }
        Ok(Self { all, sheets })
    }

    /// The options for the file at `path`.
    #[must_use]
    pub fn options(&self, path: &str) -> Options {
        let sheet = self.sheets.iter().find(|(filter, _)| filter.takes_file(path));
        Options { mapping: sheet.map(|(_, mapping)| mapping.clone()), ..self.all.clone() }
    }
}
