//! The record of a table: what is claimed, for exactly which source, found how, by which tool.
//!
//! One JSON object a table, described by [`SCHEMA`]. It names files below the root of the tree and never absolutely, and
//! takes date, commit, tool and author from the one stamp of a run; the time that an engine took is [`Effort`], which is left
//! out where bytes have to be reproducible.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

pub use super::coverage::{Coverage, Ratio};
use super::digest::{Digest, canonical};

/// The version of the format; a change that old readers cannot read raises it.
pub const VERSION: u32 = 2;

/// The JSON Schema of a record (draft 2020-12).
pub const SCHEMA: &str = include_str!("record.schema.json");

/// What is known of one table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// [`VERSION`].
    pub record_version: u32,
    /// The digest of [`Record::claim`], under which the store keeps it.
    pub key: Digest,
    /// What the verdict is about.
    pub claim: Claim,
    /// The verdict.
    pub verdict: Verdict,
    /// What the proof covered.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coverage: Option<Coverage>,
    /// The certificate or the run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub artefact: Option<ArtefactRef>,
    /// What the verdict rests on besides the source, as the elaboration of the block found out: stubs, readings, restarts.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rests_on: Vec<String>,
    /// The engine that answered; empty where none did.
    pub engine: String,
    /// What it took; absent where bytes have to be reproducible.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub effort: Option<Effort>,
    /// Who made the record, from what.
    pub origin: Origin,
}

/// What a verdict is about. Nothing else bears on it, so that its digest is the key of the store.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// The table.
    pub table: Part,
    /// The block; absent for a table that belongs to none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub block: Option<Part>,
    /// All that the block uses, by name.
    pub cone: Vec<Part>,
    /// Names that the cone uses and that no file of the tree declares.
    pub externals: Vec<String>,
    /// The cycle time in nanoseconds; absent where the table speaks of cycles alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cycle_ns: Option<u64>,
    /// `weak` or `strict`.
    pub conformance: String,
    /// What else was asked for.
    pub options: BTreeMap<String, String>,
    /// What is assumed and not shown: stubs, fixed inputs, the environment.
    pub assumptions: Vec<String>,
    /// The version of the tool's semantics.
    pub semantics: String,
}

/// A piece of source with both its digests.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// `table`, or the key of an entity's kind such as `function-block`.
    pub kind: String,
    /// Its name; of an entity, the qualified one.
    pub name: String,
    /// Its file below the root of the tree.
    pub file: String,
    /// The digest of the file's bytes.
    pub raw: Digest,
    /// The digest of the normalised model: nothing in it changes with layout, comments or the case of letters.
    pub model: Digest,
}

/// The verdict.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(tag = "word", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Verdict {
    /// The block conforms, in runs of every length.
    Verified,
    /// There is a run in which it does not.
    Violated,
    /// No violation in the first so many cycles.
    Bounded {
        /// How many.
        cycles: u64,
    },
    /// Something is not modelled.
    Unsupported {
        /// What, and where.
        reasons: Vec<String>,
    },
    /// The table has errors, or belongs to no block.
    Unusable {
        /// Why.
        reasons: Vec<String>,
    },
    /// There was a verdict for something else.
    Stale {
        /// The word that it was.
        was: String,
        /// What has changed since.
        changed: Vec<String>,
    },
    /// Nothing was tried.
    Unverified,
}

impl Verdict {
    /// All words, in the order in which reports list them.
    pub const WORDS: [&str; 7] = ["verified", "violated", "bounded", "unsupported", "unusable", "stale", "unverified"];

    /// The word for it.
    #[must_use]
    pub const fn word(&self) -> &'static str {
        match self {
            Self::Verified => "verified",
            Self::Violated => "violated",
            Self::Bounded { .. } => "bounded",
            Self::Unsupported { .. } => "unsupported",
            Self::Unusable { .. } => "unusable",
            Self::Stale { .. } => "stale",
            Self::Unverified => "unverified",
        }
    }

    /// What it says beyond its word; empty where that is all.
    #[must_use]
    pub fn detail(&self) -> String {
        match self {
            Self::Bounded { cycles } => format!("no violation in the first {cycles} cycles"),
            Self::Unsupported { reasons } | Self::Unusable { reasons } => reasons.join("; "),
            Self::Stale { was, changed } => format!("was {was}; changed since: {}", changed.join(", ")),
            Self::Verified | Self::Violated | Self::Unverified => String::new(),
        }
    }
}

/// Names a certificate or a run by its digest.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ArtefactRef {
    /// What it is.
    pub kind: ArtefactKind,
    /// The digest of its canonical JSON.
    pub digest: Digest,
}

/// What an artefact is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ArtefactKind {
    /// A proof that can be checked again.
    Certificate,
    /// A run that can be played again.
    Run,
}

impl ArtefactKind {
    /// The folder in stores and bundles.
    #[must_use]
    pub const fn folder(self) -> &'static str {
        match self {
            Self::Certificate => "certificates",
            Self::Run => "runs",
        }
    }
}

/// A certificate or a run: opaque here, understood by the prover and its checker.
#[derive(Clone, Debug, PartialEq)]
pub struct Artefact {
    /// What it is.
    pub kind: ArtefactKind,
    /// Its content.
    pub value: Value,
}

impl Artefact {
    /// The bytes that are kept.
    #[must_use]
    pub fn bytes(&self) -> Vec<u8> {
        canonical(&self.value)
    }

    /// How a record names it.
    #[must_use]
    pub fn reference(&self) -> ArtefactRef {
        ArtefactRef { kind: self.kind, digest: Digest::of(self.bytes()) }
    }
}

/// What an answer took; not the same in two runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Effort {
    /// Wall-clock time in milliseconds.
    pub milliseconds: u64,
}

/// Who made a record, from what.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Origin {
    /// The tool and its version.
    pub tool: String,
    /// The commit of the tree, with `+` if there are changes on top; empty if unknown.
    pub commit: String,
    /// The date of the stamp.
    pub date: String,
    /// Who ran the tool; empty if unknown.
    pub author: String,
}

/// The answer to a claim, as the prover gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The verdict.
    pub verdict: Verdict,
    /// What the proof covered.
    pub coverage: Option<Coverage>,
    /// The certificate or the run.
    pub artefact: Option<Artefact>,
    /// What it rests on besides the source.
    pub rests_on: Vec<String>,
    /// The engine.
    pub engine: String,
    /// What it took.
    pub effort: Option<Effort>,
}

impl Answer {
    /// An answer that no engine gave.
    #[must_use]
    pub const fn without_engine(verdict: Verdict) -> Self {
        Self { verdict, coverage: None, artefact: None, rests_on: Vec::new(), engine: String::new(), effort: None }
    }
}

impl Claim {
    /// The key of the store: all that bears on the verdict. File names, raw bytes and places do not.
    #[must_use]
    pub fn key(&self) -> Digest {
        let mut parts = vec![format!("rungbook-claim {VERSION}"), self.table.model.hex()];
        parts.push(self.block.as_ref().map_or_else(String::new, |block| block.model.hex()));
        parts.push(self.cone.len().to_string());
        parts.extend(self.cone.iter().flat_map(|part| [part.name.to_uppercase(), part.model.hex()]));
        parts.push(self.cycle_ns.map_or_else(String::new, |ns| ns.to_string()));
        parts.push(self.conformance.clone());
        parts.push(self.options.len().to_string());
        parts.extend(self.options.iter().flat_map(|(key, value)| [key.clone(), value.clone()]));
        parts.push(self.assumptions.len().to_string());
        parts.extend(self.assumptions.iter().cloned());
        parts.push(self.semantics.clone());
        Digest::of_parts(parts.iter().map(String::as_str))
    }

    /// What tells this claim from `old`: one word or name each.
    #[must_use]
    pub fn changed_since(&self, old: &Self) -> Vec<String> {
        let mut changed = Vec::new();
        let mut push = |differs: bool, what: &str| {
            if differs {
                changed.push(what.to_owned());
            }
        };
        push(self.table.model != old.table.model, "the table");
        push(self.block.as_ref().map(|b| b.model) != old.block.as_ref().map(|b| b.model), "the block");
        push(self.cycle_ns != old.cycle_ns, "the cycle time");
        push(self.conformance != old.conformance, "the conformance asked for");
        push(self.options != old.options, "the options");
        push(self.assumptions != old.assumptions, "the assumptions");
        push(self.semantics != old.semantics, "the tool's semantics");
        let models = |claim: &Self| -> BTreeMap<String, Digest> {
            claim.cone.iter().map(|part| (part.name.clone(), part.model)).collect()
        };
        let (new, old) = (models(self), models(old));
        let names: std::collections::BTreeSet<&String> = new.keys().chain(old.keys()).collect();
        names
            .into_iter()
            .filter(|name| new.get(*name) != old.get(*name))
            .for_each(|name| push(true, &format!("`{name}`")));
        changed
    }

    /// How people name it: block and table.
    #[must_use]
    pub fn subject(&self) -> String {
        self.block
            .as_ref()
            .map_or_else(|| self.table.name.clone(), |block| format!("{}: {}", block.name, self.table.name))
    }
}

impl Record {
    /// The record of `answer` to `claim`.
    #[must_use]
    pub fn new(claim: Claim, answer: &Answer, origin: Origin) -> Self {
        Self {
            record_version: VERSION,
            key: claim.key(),
            claim,
            verdict: answer.verdict.clone(),
            coverage: answer.coverage.clone(),
            artefact: answer.artefact.as_ref().map(Artefact::reference),
            rests_on: answer.rests_on.clone(),
            engine: answer.engine.clone(),
            effort: answer.effort,
            origin,
        }
    }

    /// The bytes that are kept.
    #[must_use]
    pub fn bytes(&self) -> Vec<u8> {
        canonical(self)
    }

    /// Reads what [`Record::bytes`] wrote.
    ///
    /// # Errors
    /// If `bytes` are no record of this version, are not in the canonical form, or carry a key that is not their claim's.
    pub fn parse(bytes: &[u8]) -> Result<Self, String> {
        let record: Self = serde_json::from_slice(bytes).map_err(|error| error.to_string())?;
        if record.record_version != VERSION {
            return Err(format!("the record has version {}; this tool reads {VERSION}", record.record_version));
        }
        if record.key != record.claim.key() {
            return Err("the key is not the digest of the claim".to_owned());
        }
        if record.bytes() != bytes {
            return Err("the record is not in the canonical form".to_owned());
        }
        Ok(record)
    }
}
