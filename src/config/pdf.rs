//! The options of the PDF.

use std::collections::BTreeMap;

use super::file::{ConfigError, PdfSection};
use crate::render::pdf::{Date, Options, Paper, Standard};

/// The names of the standards.
const STANDARDS: [(&str, Standard); 7] = [
    ("pdf-1.7", Standard::Pdf17),
    ("pdf-a-1b", Standard::A1b),
    ("pdf-a-2b", Standard::A2b),
    ("pdf-a-3b", Standard::A3b),
    ("pdf-a-3a", Standard::A3a),
    ("pdf-ua-1", Standard::Ua1),
    ("pdf-a-3a-ua-1", Standard::A3aUa1),
];

/// What `section` means, with the user's templates and the manual's date (`2026-11-22`).
pub(super) fn options(
    section: &PdfSection,
    templates: BTreeMap<String, String>,
    date: &str,
) -> Result<Options, ConfigError> {
    let mut options = Options { templates, date: self::date(date), ..Options::default() };
    if let Some(name) = &section.paper {
        let papers = [("a4", Paper::A4), ("b5", Paper::B5), ("us-letter", Paper::Letter)];
        options.paper = choose("pdf.paper", name, &papers)?;
    }
    if let Some(name) = &section.standard {
        options.standard = choose("pdf.standard", name, &STANDARDS)?;
    }
    options.tagged = section.tagged.unwrap_or(options.tagged);
    options.parts.sources = section.source.unwrap_or(options.parts.sources);
    Ok(options)
}

fn choose<T: Copy>(key: &str, name: &str, choices: &[(&str, T)]) -> Result<T, ConfigError> {
    choices.iter().find(|(known, _)| *known == name).map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<&str> = choices.iter().map(|(name, _)| *name).collect();
        ConfigError { message: format!("`{key}` is `{name}`; it takes {}", names.join(", ")) }
    })
}

fn date(text: &str) -> Option<Date> {
    let mut parts = text.splitn(3, '-');
    let (year, month, day) = (parts.next()?.parse().ok()?, parts.next()?.parse().ok()?, parts.next()?.parse().ok()?);
    Some(Date { year, month, day, hour: 0, minute: 0, second: 0 })
}
