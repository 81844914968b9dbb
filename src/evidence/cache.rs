//! The store of records: a folder whose paths are digests, so that a lookup is one file and nothing ever goes stale unnoticed.
//!
//! ```text
//! records/ab/abcd….json     the record, by the key of its claim
//! certificates/…, runs/…    artefacts, by the digest of their bytes
//! latest/12/1234….json      the last record of a block and table, by the digest of both names
//! ```
//!
//! Only the functions that name paths and read bytes are here; the disk is `cli/`'s. A file that was tampered with, or
//! was half written, is no entry: its digest does not fit, and the verdict is found again.

use serde::{Deserialize, Serialize};

use super::digest::{Digest, canonical};
use super::record::{Answer, Artefact, ArtefactRef, Claim, Record, Verdict};

/// What the store knows of a claim.
#[derive(Clone, Debug, PartialEq)]
pub enum Found {
    /// Its answer.
    Fresh(Box<Record>, Option<Artefact>),
    /// An answer to an earlier claim of the same block and table.
    Old(Box<Record>),
    /// Nothing.
    Nothing,
}

#[derive(Serialize, Deserialize)]
struct Latest {
    subject: String,
    key: Digest,
}

fn path(folder: &str, digest: &Digest) -> String {
    let hex = digest.hex();
    format!("{folder}/{}/{hex}.json", &hex[..2])
}

/// The path of a record.
#[must_use]
pub fn record_path(key: &Digest) -> String {
    path("records", key)
}

/// The path of an artefact.
#[must_use]
pub fn artefact_path(artefact: &ArtefactRef) -> String {
    path(artefact.kind.folder(), &artefact.digest)
}

/// The path of what names the last record of a claim's block and table.
#[must_use]
pub fn latest_path(claim: &Claim) -> String {
    path("latest", &Digest::of_parts([claim.subject().to_uppercase().as_str()]))
}

/// The files to write for `record`, in the order in which to write them: an interrupted run leaves no dangling name.
#[must_use]
pub fn entries(record: &Record, artefact: Option<&Artefact>) -> Vec<(String, Vec<u8>)> {
    let latest = Latest { subject: record.claim.subject(), key: record.key };
    let artefact = artefact.map(|artefact| (artefact_path(&artefact.reference()), artefact.bytes()));
    let own = [(record_path(&record.key), record.bytes()), (latest_path(&record.claim), canonical(&latest))];
    artefact.into_iter().chain(own).collect()
}

/// Whether an answer is worth keeping: only what a longer try, or another one, cannot change without a new claim.
#[must_use]
pub const fn keeps(verdict: &Verdict) -> bool {
    matches!(verdict, Verdict::Verified | Verdict::Violated | Verdict::Bounded { .. } | Verdict::Unsupported { .. })
}

/// Looks `claim` up in the store whose files `read` gives.
pub fn lookup(claim: &Claim, read: &dyn Fn(&str) -> Option<Vec<u8>>) -> Found {
    if let Some((record, artefact)) = get(&claim.key(), read) {
        return Found::Fresh(Box::new(record), artefact);
    }
    let latest = read(&latest_path(claim)).and_then(|bytes| serde_json::from_slice::<Latest>(&bytes).ok());
    match latest.and_then(|latest| get(&latest.key, read)) {
        Some((record, _)) => Found::Old(Box::new(record)),
        None => Found::Nothing,
    }
}

/// The answer to `claim` that follows from what was found: its own, *stale*, or *unverified*.
#[must_use]
pub fn answer(claim: &Claim, found: Found) -> Answer {
    match found {
        Found::Fresh(record, artefact) => Answer {
            verdict: record.verdict,
            coverage: record.coverage,
            artefact,
            rests_on: record.rests_on,
            engine: record.engine,
            effort: record.effort,
        },
        Found::Old(record) => Answer::without_engine(Verdict::Stale {
            was: record.verdict.word().to_owned(),
            changed: claim.changed_since(&record.claim),
        }),
        Found::Nothing => Answer::without_engine(Verdict::Unverified),
    }
}

/// The record under `key` with its artefact, if both are whole.
fn get(key: &Digest, read: &dyn Fn(&str) -> Option<Vec<u8>>) -> Option<(Record, Option<Artefact>)> {
    let record = Record::parse(&read(&record_path(key))?).ok()?;
    if record.key != *key {
        return None;
    }
    let Some(reference) = &record.artefact else { return Some((record, None)) };
    let bytes = read(&artefact_path(reference))?;
    if Digest::of(&bytes) != reference.digest {
        return None;
    }
    let value = serde_json::from_slice(&bytes).ok()?;
    let artefact = Artefact { kind: reference.kind, value };
    Some((record, Some(artefact)))
}
