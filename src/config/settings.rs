//! What the configuration means: defaults filled in, names checked, each room's options made.

use std::collections::BTreeMap;

use super::file::{ConfigError, ConfigFile, PdfSection, SourceSection};
use crate::audit;
use crate::diagnostic::{Finding, Severity};
use crate::docs::Convention;

/// Everything that a run needs to know, apart from where things lie.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Title of the manual, if given.
    pub title: Option<String>,
    /// Subtitle.
    pub subtitle: String,
    /// Version of what is documented, if given.
    pub version: Option<String>,
    /// Author or company, if given.
    pub author: Option<String>,
    /// Language tag.
    pub language: String,
    /// What is read.
    pub source: crate::source::Options,
    /// How comments are read.
    pub docs: crate::docs::Options,
    /// The folder of the narrative pages, below the root.
    pub manual: String,
    /// How test tables are read.
    pub tables: super::tables::TableReading,
    /// How tables are proven.
    pub verify: super::verify::Verification,
    /// Severity by code.
    pub levels: Levels,
    /// The severity from which on `check` fails.
    pub deny: Severity,
    /// The bar that a release has to clear.
    pub gate: crate::evidence::policy::gate::Options,
    /// The file of the baseline, below the root, if there is one.
    pub baseline: Option<String>,
    /// What goes into evidence.
    pub evidence: super::gate::Evidence,
    /// Whether `build` writes the site.
    pub html: bool,
    /// Whether `build` writes the PDF.
    pub pdf: bool,
    /// How the PDF is made.
    #[cfg_attr(not(feature = "pdf"), expect(dead_code, reason = "only the PDF renderer reads it"))]
    pdf_section: PdfSection,
}

/// Severities by code: what the configuration changes.
#[derive(Clone, Debug, Default)]
pub struct Levels {
    changed: BTreeMap<String, Option<Severity>>,
}

impl Levels {
    /// The finding with its configured severity, or nothing if its code is switched off.
    #[must_use]
    pub fn apply(&self, mut finding: Finding) -> Option<Finding> {
        if let Some(level) = self.changed.get(finding.code.name) {
            finding.severity = (*level)?;
        }
        Some(finding)
    }

    /// Whether the rule of `code`, on by default or not, is to be run.
    #[must_use]
    pub fn runs(&self, code: &str, default: bool) -> bool {
        self.changed.get(code).map_or(default, Option::is_some)
    }
}

impl Settings {
    /// What `file` means.
    ///
    /// # Errors
    /// If a value is none that its key takes.
    pub fn new(file: ConfigFile) -> Result<Self, ConfigError> {
        let deny = severity("audit.deny", file.audit.deny.as_deref().unwrap_or("warning"))?;
        Ok(Self {
            title: file.title,
            subtitle: file.subtitle.unwrap_or_default(),
            version: file.version,
            author: file.author,
            language: file.language.unwrap_or_else(|| "en".to_owned()),
            source: source_options(file.source)?,
            docs: docs_options(file.docs.profile.as_deref())?,
            manual: file.docs.manual.unwrap_or_else(|| "manual".to_owned()),
            tables: super::tables::TableReading::new(file.tables)?,
            verify: super::verify::Verification::new(file.verify)?,
            levels: levels(file.audit.rules)?,
            deny,
            gate: file.gate.options()?,
            baseline: file.gate.baseline,
            evidence: file.evidence.options()?,
            html: file.html.enabled.unwrap_or(true),
            pdf: file.pdf.enabled.unwrap_or(true),
            pdf_section: file.pdf,
        })
    }
}

impl Settings {
    /// The options of the PDF, with the user's templates and the manual's date (`2026-11-22`).
    ///
    /// # Errors
    /// If a value under `[pdf]` is none that its key takes.
    #[cfg(feature = "pdf")]
    pub fn pdf_options(
        &self,
        templates: BTreeMap<String, String>,
        date: &str,
    ) -> Result<crate::render::pdf::Options, ConfigError> {
        super::pdf::options(&self.pdf_section, templates, date)
    }

    /// Leaves the folder `path`, seen from the root, unread: the manual is written there.
    pub fn leave_out(&mut self, path: &str) {
        self.source.output = Some(path.replace('\\', "/"));
    }
}

fn source_options(section: SourceSection) -> Result<crate::source::Options, ConfigError> {
    let default = crate::source::Options::default();
    let filter = crate::source::Filter::new(&section.include, &section.exclude);
    let filter = filter.map_err(|error| ConfigError { message: error.to_string() })?;
    Ok(crate::source::Options {
        filter,
        max_file_size: section.max_file_size.unwrap_or(default.max_file_size),
        ..default
    })
}

fn docs_options(profile: Option<&str>) -> Result<crate::docs::Options, ConfigError> {
    let default = crate::docs::Options::default();
    let Some(name) = profile.filter(|name| *name != "auto") else { return Ok(default) };
    let Some(convention) = Convention::from_key(name) else {
        let names: Vec<&str> = Convention::ALL.iter().map(|convention| convention.key()).collect();
        let message = format!("`docs.profile` is `{name}`; it takes `auto` or one of {}", names.join(", "));
        return Err(ConfigError { message });
    };
    Ok(crate::docs::Options { profile: Some(convention), ..default })
}

fn severity(key: &str, name: &str) -> Result<Severity, ConfigError> {
    Severity::from_name(name)
        .ok_or_else(|| ConfigError { message: format!("`{key}` is `{name}`; it takes `info`, `warning` or `error`") })
}

fn levels(rules: BTreeMap<String, String>) -> Result<Levels, ConfigError> {
    let mut changed = BTreeMap::new();
    for (code, level) in rules {
        if audit::code(&code).is_none() {
            let message = format!("`audit.rules` names `{code}`, which is no finding; `rungbook explain` lists them");
            return Err(ConfigError { message });
        }
        let level = if level == "off" { None } else { Some(severity(&format!("audit.rules.{code}"), &level)?) };
        changed.insert(code, level);
    }
    Ok(Levels { changed })
}
