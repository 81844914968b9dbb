//! `[gate]` and `[evidence]`: what a release has to reach, and what its evidence holds.

use serde::Deserialize;

use super::file::ConfigError;
use crate::evidence::policy::gate;

/// The bar of a release.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct GateSection {
    /// At least so many percent of the entities are documented.
    pub documented: Option<u8>,
    /// At least so many percent of the test tables are verified.
    pub verified: Option<u8>,
    /// No table is violated.
    #[serde(default)]
    pub no_violated: bool,
    /// No verdict is stale.
    #[serde(default)]
    pub no_stale: bool,
    /// No verified table proves nothing.
    #[serde(default)]
    pub no_vacuous: bool,
    /// Every allowance names an owner and a last day.
    #[serde(default)]
    pub no_suppressed_without_owner: bool,
    /// No incompatible change against the compared release.
    #[serde(default)]
    pub no_breaking: bool,
    /// No evidence was lost against the compared release.
    #[serde(default)]
    pub no_lost_evidence: bool,
    /// The file of the baseline, below the root.
    pub baseline: Option<String>,
}

impl GateSection {
    /// What it means.
    pub(super) fn options(&self) -> Result<gate::Options, ConfigError> {
        for (key, value) in [("documented", self.documented), ("verified", self.verified)] {
            if let Some(value) = value.filter(|value| *value > 100) {
                let message = format!("`gate.{key}` is `{value}`; it takes a percentage from 0 to 100");
                return Err(ConfigError { message });
            }
        }
        Ok(gate::Options {
            documented: self.documented,
            verified: self.verified,
            no_violated: self.no_violated,
            no_stale: self.no_stale,
            no_vacuous: self.no_vacuous,
            no_suppressed_without_owner: self.no_suppressed_without_owner,
            no_breaking: self.no_breaking,
            no_lost_evidence: self.no_lost_evidence,
        })
    }
}

/// What evidence holds.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct EvidenceSection {
    /// The folder of records, below the root.
    pub store: Option<String>,
    /// `full` or `digests`.
    pub sources: Option<String>,
    /// Lists of requirements, below the root.
    #[serde(default)]
    pub requirements: Vec<String>,
    /// Results of other tools, below the root.
    #[serde(default)]
    pub results: Vec<String>,
    /// `ROLE: NAME` for each line of the sign-off page.
    #[serde(default)]
    pub sign_off: Vec<String>,
}

/// What evidence holds, with the defaults filled in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// The folder of records, below the root.
    pub store: String,
    /// Whether bundles hold the sources themselves, or their digests only.
    pub sources: bool,
    /// Lists of requirements, below the root.
    pub requirements: Vec<String>,
    /// Results of other tools, below the root.
    pub results: Vec<String>,
    /// Roles with names; a name may be empty.
    pub sign_off: Vec<(String, String)>,
}

impl EvidenceSection {
    /// What it means.
    pub(super) fn options(self) -> Result<Evidence, ConfigError> {
        let sources = match self.sources.as_deref() {
            None | Some("full") => true,
            Some("digests") => false,
            Some(other) => {
                let message = format!("`evidence.sources` is `{other}`; it takes `full` or `digests`");
                return Err(ConfigError { message });
            }
        };
        let line = |text: String| match text.split_once(':') {
            Some((role, name)) => (role.trim().to_owned(), name.trim().to_owned()),
            None => (text.trim().to_owned(), String::new()),
        };
        let blank = ["Author", "Reviewer", "Release"].map(|role| (role.to_owned(), String::new()));
        let sign_off: Vec<_> = self.sign_off.into_iter().map(line).collect();
        Ok(Evidence {
            store: self.store.unwrap_or_else(|| "target/rungbook/evidence".to_owned()),
            sources,
            requirements: self.requirements,
            results: self.results,
            sign_off: if sign_off.is_empty() { blank.into() } else { sign_off },
        })
    }
}
