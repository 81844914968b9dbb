//! `rungbook.toml` as typed: every key optional, unknown keys refused.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::gate::{EvidenceSection, GateSection};

/// The file.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct ConfigFile {
    /// Title of the manual.
    pub title: Option<String>,
    /// Subtitle.
    pub subtitle: Option<String>,
    /// Version of what is documented.
    pub version: Option<String>,
    /// Author or company.
    pub author: Option<String>,
    /// BCP 47 language tag of the prose.
    pub language: Option<String>,
    /// `[source]`
    #[serde(default)]
    pub source: SourceSection,
    /// `[docs]`
    #[serde(default)]
    pub docs: DocsSection,
    /// `[audit]`
    #[serde(default)]
    pub audit: AuditSection,
    /// `[tables]`
    #[serde(default)]
    pub tables: TablesSection,
    /// `[verify]`
    #[serde(default)]
    pub verify: super::verify::VerifySection,
    /// `[gate]`
    #[serde(default)]
    pub gate: GateSection,
    /// `[evidence]`
    #[serde(default)]
    pub evidence: EvidenceSection,
    /// `[html]`
    #[serde(default)]
    pub html: HtmlSection,
    /// `[pdf]`
    #[serde(default)]
    pub pdf: PdfSection,
}

/// What is read.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SourceSection {
    /// Globs of files to leave out.
    #[serde(default)]
    pub exclude: Vec<String>,
    /// Globs of files to read; all, if there is none.
    #[serde(default)]
    pub include: Vec<String>,
    /// Largest file that is read, in bytes.
    pub max_file_size: Option<u64>,
}

/// How comments are read.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct DocsSection {
    /// The convention; found out if absent.
    pub profile: Option<String>,
    /// The folder of the narrative pages, below the root.
    pub manual: Option<String>,
}

/// How test tables are read.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TablesSection {
    /// The length of a cycle (`10ms`), for tables that state none.
    pub cycle: Option<String>,
    /// `[[tables.sheet]]`
    #[serde(default)]
    pub sheet: Vec<SheetSection>,
}

/// What the columns of some spreadsheets are.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct SheetSection {
    /// Globs of the files.
    pub files: Vec<String>,
    /// The line of the header, from 1.
    pub header: Option<usize>,
    /// By letter or by name of a column, what it is, as in the header of a pipe table.
    pub columns: BTreeMap<String, String>,
}

/// What is found fault with.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct AuditSection {
    /// The severity from which on `check` fails.
    pub deny: Option<String>,
    /// Severity by code, or `off`.
    #[serde(default)]
    pub rules: BTreeMap<String, String>,
}

/// The site.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct HtmlSection {
    /// Whether `build` writes it.
    pub enabled: Option<bool>,
}

/// The PDF.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct PdfSection {
    /// Whether `build` writes it.
    pub enabled: Option<bool>,
    /// Paper size: `a4`, `b5` or `us-letter`.
    pub paper: Option<String>,
    /// Standard: `pdf-1.7`, `pdf-a-3b`, …
    pub standard: Option<String>,
    /// Whether it carries its structure for screen readers.
    pub tagged: Option<bool>,
    /// Whether it shows the source.
    pub source: Option<bool>,
}

/// Why `rungbook.toml` cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ConfigError {
    /// What is wrong, with line and column where they are known.
    pub message: String,
}

impl ConfigFile {
    /// Reads the text of `rungbook.toml`.
    ///
    /// # Errors
    /// If it is not TOML, has an unknown key, or a value of the wrong type.
    pub fn parse(text: &str) -> Result<Self, ConfigError> {
        toml::from_str(text).map_err(|error| ConfigError { message: error.to_string() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_key_is_refused_by_name() {
        let error = ConfigFile::parse("titel = \"x\"").expect_err("the key is misspelt");
        assert!(error.message.contains("titel"), "{}", error.message);
    }

    #[test]
    fn the_template_is_a_valid_file() {
        let file = ConfigFile::parse(crate::config::TEMPLATE).expect("the template is ours");
        assert_eq!(file.title, None, "every key in the template is commented out");
    }
}
