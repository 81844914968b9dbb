//! `[verify]`: how tables are proven.

use std::collections::BTreeMap;
use std::time::Duration;

use serde::Deserialize;

use super::file::ConfigError;
use crate::machine::fixed::Reading;
use crate::prove::options::Options;

/// `[verify]` as typed.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct VerifySection {
    /// Seconds for one table.
    pub timeout: Option<u64>,
    /// MiB for one table.
    pub memory: Option<u64>,
    /// How many threads: a table each, and two for a table where there are fewer of them.
    pub jobs: Option<usize>,
    /// Whether what a proof covered is found out.
    pub coverage: Option<bool>,
    /// Strict conformance for every table.
    pub strict: Option<bool>,
    /// How often the body of a loop without constant bounds may be done.
    pub loop_limit: Option<u64>,
    /// Reals in fixed point: decimal digits behind the point, and bits.
    pub fixed: Option<FixedSection>,
    /// What stands in for blocks that have no source: `arbitrary`, or a file of Structured Text below the root.
    #[serde(default)]
    pub stubs: BTreeMap<String, String>,
}

/// `fixed` under `[verify]` as typed.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FixedSection {
    /// Decimal digits behind the point.
    pub digits: u32,
    /// Bits.
    pub width: u32,
}

/// `[verify]` with its defaults.
#[derive(Clone, Debug)]
pub struct Verification {
    /// The prover's own options.
    pub options: Options,
    /// How many threads: a table each, and two for a table where there are fewer of them.
    pub jobs: usize,
    /// Whether what a proof covered is found out.
    pub coverage: bool,
    /// Whether mutants of verified blocks are tried; the command line asks for them.
    pub mutants: bool,
    /// How often the body of a loop without constant bounds may be done.
    pub loop_limit: u64,
    /// How reals are read, if not as IEEE 754.
    pub fixed: Option<Reading>,
    /// What stands in for blocks that have no source.
    pub stubs: BTreeMap<String, String>,
}

impl Default for Verification {
    fn default() -> Self {
        Self {
            options: Options::default(),
            jobs: 0,
            coverage: true,
            mutants: false,
            loop_limit: 1_000,
            fixed: None,
            stubs: BTreeMap::new(),
        }
    }
}

impl Verification {
    /// What the section means.
    ///
    /// # Errors
    /// If a number is zero.
    pub fn new(section: VerifySection) -> Result<Self, ConfigError> {
        let default = Self::default();
        let positive = |key: &str, value: Option<u64>, default: u64| match value {
            Some(0) => Err(ConfigError { message: format!("`verify.{key}` is 0; it takes 1 or more") }),
            value => Ok(value.unwrap_or(default)),
        };
        let fixed = section.fixed.map(|fixed| Reading::new(fixed.digits, fixed.width)).transpose();
        let fixed = fixed.map_err(|message| ConfigError { message: format!("`verify.fixed`: {message}") })?;
        Ok(Self {
            options: Options {
                timeout: Duration::from_secs(positive("timeout", section.timeout, default.options.timeout.as_secs())?),
                memory: positive("memory", section.memory, default.options.memory)?,
                strict: section.strict.unwrap_or(false),
                ..default.options
            },
            jobs: section.jobs.unwrap_or(0),
            coverage: section.coverage.unwrap_or(true),
            mutants: false,
            loop_limit: positive("loop-limit", section.loop_limit, default.loop_limit)?,
            fixed,
            stubs: section.stubs,
        })
    }
}
