//! The baseline: the findings of the day on which a team began, which stay allowed while new ones do not.
//!
//! A finding is known by a fingerprint that survives moved lines: its code, its file, the text of its line without
//! its layout, and its number among findings of which all that is equal. The file lists the codes that the tool had when it was
//! written; a finding of a code that came later never fails an old baseline.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use crate::diagnostic::Finding;
use crate::evidence::digest::{Digest, canonical};
use crate::text::Files;

/// The version of the format.
pub const VERSION: u32 = 1;

/// A baseline, as its file has it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Baseline {
    /// [`VERSION`].
    pub baseline_version: u32,
    /// The tool that wrote it.
    pub tool: String,
    /// The codes that the tool had.
    pub codes: BTreeSet<String>,
    /// The findings.
    pub findings: Vec<Known>,
}

/// A finding of a baseline; people read code and file, the tool the fingerprint.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Known {
    /// The file below the root.
    pub file: String,
    /// The code.
    pub code: String,
    /// See [`fingerprints`].
    pub fingerprint: String,
}

/// How a finding stands to a baseline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// It is not in the baseline.
    New,
    /// It is in the baseline.
    Old,
    /// Its code is younger than the baseline.
    NewRule,
}

impl Baseline {
    /// The baseline of `findings`.
    #[must_use]
    pub fn new<'a>(tool: &str, codes: impl IntoIterator<Item = &'a str>, findings: &[Finding], files: &Files) -> Self {
        let prints = fingerprints(findings, files);
        let known = |(finding, fingerprint): (&Finding, String)| Known {
            file: files.get(finding.place.file).path.clone(),
            code: finding.code.name.to_owned(),
            fingerprint,
        };
        let mut findings: Vec<Known> = findings.iter().zip(prints).map(known).collect();
        findings.sort();
        let codes = codes.into_iter().map(str::to_owned).collect();
        Self { baseline_version: VERSION, tool: tool.to_owned(), codes, findings }
    }

    /// Its file.
    #[must_use]
    pub fn bytes(&self) -> Vec<u8> {
        canonical(self)
    }

    /// Reads a file.
    ///
    /// # Errors
    /// If it is no baseline of this version.
    pub fn parse(bytes: &[u8]) -> Result<Self, String> {
        let baseline: Self = serde_json::from_slice(bytes).map_err(|error| error.to_string())?;
        if baseline.baseline_version != VERSION {
            return Err(format!("the baseline has version {}; this tool reads {VERSION}", baseline.baseline_version));
        }
        Ok(baseline)
    }

    /// How each of `findings` stands to it, and how many of its own are gone.
    #[must_use]
    pub fn compare(&self, findings: &[Finding], files: &Files) -> (Vec<State>, usize) {
        let mut left: BTreeSet<&str> = self.findings.iter().map(|known| known.fingerprint.as_str()).collect();
        let prints = fingerprints(findings, files);
        let states = findings.iter().zip(&prints).map(|(finding, print)| {
            if left.remove(print.as_str()) {
                State::Old
            } else if self.codes.contains(finding.code.name) {
                State::New
            } else {
                State::NewRule
            }
        });
        let states = states.collect();
        (states, left.len())
    }
}

/// The fingerprint of each finding.
#[must_use]
pub fn fingerprints(findings: &[Finding], files: &Files) -> Vec<String> {
    let mut seen: BTreeMap<Digest, usize> = BTreeMap::new();
    let one = |finding: &Finding| {
        let path = &files.get(finding.place.file).path;
        let line = line(finding, files);
        let digest = Digest::of_parts(["finding", finding.code.name, path, &line]);
        let count = seen.entry(digest).or_default();
        *count += 1;
        format!("{}-{count}", &digest.hex()[..32])
    };
    findings.iter().map(one).collect()
}

/// The line of a finding with its white space folded; empty where the file has no text.
fn line(finding: &Finding, files: &Files) -> String {
    let file = files.get(finding.place.file);
    if finding.place.span.is_empty() && finding.place.span.start == 0 {
        // Of the file as a whole: its first line has nothing to do with it.
        return String::new();
    }
    let start = file.lines.line_start(file.lines.line(finding.place.span.start)) as usize;
    let rest = file.text.get(start..).unwrap_or("");
    let line = rest.lines().next().unwrap_or("");
    line.split_whitespace().collect::<Vec<_>>().join(" ")
}
