//! Checks a bundle: its archive, its manifest, every digest, the statement, the signatures, every record, every artefact.
//!
//! Nothing but the bytes is needed, and no network. What a certificate proves is for `recheck/` to say; it comes in as a function.

use std::collections::BTreeMap;

use super::manifest::{self, File, Manifest};
use super::sign::{self, Public};
use super::statement::{self, Envelope};
use super::{archive, sigstore, write};
use crate::evidence::digest::Digest;
use crate::evidence::record::{Artefact, Record, Verdict};

/// Something in a bundle that is not as it was made.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Problem {
    /// The file in the bundle, or the archive's directory.
    pub part: String,
    /// What is wrong.
    pub message: String,
}

/// A record that was checked again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Checked {
    /// The path of the record.
    pub path: String,
    /// Block and table.
    pub subject: String,
    /// The word of its verdict.
    pub verdict: &'static str,
    /// What the check of its artefact said; `None` where there is none to check.
    pub recheck: Option<Result<(), String>>,
}

/// What was found.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// The manifest, if it could be read.
    pub manifest: Option<Manifest>,
    /// The records.
    pub records: Vec<Checked>,
    /// The fingerprint of the key that signed; `None` if nobody did.
    pub signer: Option<String>,
    /// Whether that key is one that the caller trusts.
    pub trusted: bool,
    /// What is wrong.
    pub problems: Vec<Problem>,
}

impl Report {
    /// Whether everything is as it was made, and every artefact that could be checked again holds.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.problems.is_empty() && self.records.iter().all(|checked| !matches!(checked.recheck, Some(Err(_))))
    }

    fn add(&mut self, part: &str, message: impl Into<String>) {
        self.problems.push(Problem { part: part.to_owned(), message: message.into() });
    }
}

/// What checks an artefact again: the record, the artefact, and the files of the bundle.
pub type Recheck<'a> = dyn Fn(&Record, &Artefact, &BTreeMap<String, Vec<u8>>) -> Result<(), String> + 'a;

/// Checks `bytes`. With `keys`, the signature has to be by one of them.
pub fn verify(bytes: &[u8], keys: &[Public], recheck: Option<&Recheck<'_>>) -> Report {
    let mut report = Report::default();
    let (files, faults) = archive::read(bytes, &unlisted);
    for fault in faults {
        report.add(&fault.part, fault.message);
    }
    let Some(manifest) = read_manifest(&files, &mut report) else { return report };
    digests(&manifest, &files, &mut report);
    let records = records(&files, &mut report);
    check_statement(&manifest, &records, &files, &mut report);
    signatures(&files, keys, &mut report);
    for (path, record) in &records {
        sources(record, path, &manifest, &files, &mut report);
        let recheck = artefact(record, path, &files, recheck, &mut report);
        let (subject, verdict) = (record.claim.subject(), record.verdict.word());
        report.records.push(Checked { path: path.clone(), subject, verdict, recheck });
    }
    report.manifest = Some(manifest);
    report.problems.sort();
    report.problems.dedup();
    report
}

/// How many names the manifest of `files` has and they have not, or the other way round.
fn unlisted(files: &Files) -> usize {
    let manifest = files.get(manifest::PATH).and_then(|bytes| Manifest::parse(bytes).ok());
    let Some(manifest) = manifest else { return usize::MAX };
    let missing = manifest.files.keys().filter(|path| !files.contains_key(*path)).count();
    let more = files.keys().filter(|path| !OWN.contains(&path.as_str()) && !manifest.files.contains_key(*path)).count();
    missing + more
}

/// The files that the manifest cannot list, since they follow from it.
pub(super) const OWN: [&str; 5] =
    [manifest::PATH, statement::PATH, statement::ENVELOPE, sign::SSH_SIGNATURE, sigstore::PATH];

type Files = BTreeMap<String, Vec<u8>>;

fn read_manifest(files: &Files, report: &mut Report) -> Option<Manifest> {
    let Some(bytes) = files.get(manifest::PATH) else {
        report.add(manifest::PATH, "it is missing");
        return None;
    };
    match Manifest::parse(bytes) {
        Ok(manifest) => Some(manifest),
        Err(message) => {
            report.add(manifest::PATH, message);
            None
        }
    }
}

/// Every listed file is there and as it was; every other file is one of those that the manifest cannot list.
fn digests(manifest: &Manifest, files: &Files, report: &mut Report) {
    for (path, listed) in &manifest.files {
        match files.get(path) {
            None => report.add(path, "it is in the manifest and not in the bundle"),
            Some(bytes) if File::of(bytes) != *listed => report.add(path, "its bytes are not those of the manifest"),
            Some(_) => {}
        }
    }
    for path in files.keys().filter(|path| !OWN.contains(&path.as_str()) && !manifest.files.contains_key(*path)) {
        report.add(path, "it is in the bundle and not in the manifest");
    }
}

fn records(files: &Files, report: &mut Report) -> BTreeMap<String, Record> {
    let mut records = BTreeMap::new();
    for (path, bytes) in files.iter().filter(|(path, _)| path.starts_with("records/")) {
        match Record::parse(bytes) {
            Ok(record) if write::record_path(&record) != *path => {
                report.add(path, "the record belongs to another path")
            }
            Ok(record) => _ = records.insert(path.clone(), record),
            Err(message) => report.add(path, message),
        }
    }
    records
}

/// The statement is what follows from manifest and records, and the envelope holds it.
fn check_statement(manifest: &Manifest, records: &BTreeMap<String, Record>, files: &Files, report: &mut Report) {
    let expected = statement::statement(manifest, records);
    match files.get(statement::PATH) {
        None => report.add(statement::PATH, "it is missing"),
        Some(found) if *found != expected => {
            report.add(statement::PATH, "it is not the statement of this manifest and these records");
        }
        Some(_) => {}
    }
    let Some(bytes) = files.get(statement::ENVELOPE) else {
        report.add(statement::ENVELOPE, "it is missing");
        return;
    };
    match Envelope::parse(bytes).and_then(|envelope| Ok((envelope.decoded()?, envelope))) {
        Err(message) => report.add(statement::ENVELOPE, message),
        Ok((_, envelope)) if envelope.payload_type != statement::PAYLOAD_TYPE => {
            report.add(statement::ENVELOPE, "its payload is no in-toto statement");
        }
        Ok((payload, _)) if Some(&payload) != files.get(statement::PATH) => {
            report.add(statement::ENVELOPE, "its payload is not the statement");
        }
        Ok(_) => {}
    }
}

/// All signatures are by the key in the bundle, and that is one of `keys` where there are any.
fn signatures(files: &Files, keys: &[Public], report: &mut Report) {
    let envelope = files.get(statement::ENVELOPE).and_then(|bytes| Envelope::parse(bytes).ok());
    let signed = envelope.as_ref().is_some_and(|envelope| !envelope.signatures.is_empty());
    let (ssh, sigstore) = (files.get(sign::SSH_SIGNATURE), files.get(sigstore::PATH));
    let Some(signer) = files.get(sign::SIGNER) else {
        if signed || ssh.is_some() || sigstore.is_some() {
            report.add(sign::SIGNER, "the bundle is signed and does not hold the key");
        } else if !keys.is_empty() {
            report.add(statement::ENVELOPE, "nobody signed it");
        }
        return;
    };
    let public = match std::str::from_utf8(signer).map_err(|error| error.to_string()).and_then(Public::parse) {
        Ok(public) => public,
        Err(message) => return report.add(sign::SIGNER, message),
    };
    report.signer = Some(public.fingerprint());
    report.trusted = keys.contains(&public);
    if !keys.is_empty() && !report.trusted {
        report
            .add(sign::SIGNER, format!("it is signed by {}, which is not a key that was given", public.fingerprint()));
    }
    if let Some(envelope) = envelope {
        dsse(&envelope, public, report);
        if sigstore::bytes(&envelope, public).ok().as_ref() != sigstore {
            report.add(sigstore::PATH, "it is not the envelope as a Sigstore bundle, by the key in the bundle");
        }
    }
    let statement = files.get(statement::PATH).map_or(&[][..], Vec::as_slice);
    let text = ssh.and_then(|bytes| std::str::from_utf8(bytes).ok());
    if !text.is_some_and(|text| public.verifies_ssh(statement, text)) {
        report.add(sign::SSH_SIGNATURE, "it is not the signature of the statement by the key in the bundle");
    }
}

fn dsse(envelope: &Envelope, public: Public, report: &mut Report) {
    let [signature] = envelope.signatures.as_slice() else {
        return report.add(statement::ENVELOPE, "it has not one signature");
    };
    if signature.keyid != public.fingerprint() {
        report.add(statement::ENVELOPE, "its signature names another key than the one in the bundle");
    }
    let message = envelope.decoded().map(|payload| statement::encoding(&envelope.payload_type, &payload));
    let holds = message.is_ok_and(|message| signature.decoded().is_ok_and(|sig| public.verifies(&message, &sig)));
    if !holds {
        report.add(statement::ENVELOPE, "its signature is not by the key in the bundle");
    }
}

/// The sources that a record speaks of are those in the bundle.
fn sources(record: &Record, path: &str, manifest: &Manifest, files: &Files, report: &mut Report) {
    if !manifest.sources {
        return;
    }
    let claim = &record.claim;
    for part in std::iter::once(&claim.table).chain(&claim.block).chain(&claim.cone) {
        let at = format!("sources/{}", part.file);
        match files.get(&at) {
            None => report.add(path, format!("it speaks of `{}`, which is not in the bundle", part.file)),
            Some(bytes) if Digest::of(bytes) != part.raw => {
                report.add(&at, format!("it is not the file that `{path}` speaks of"));
            }
            Some(_) => {}
        }
    }
}

/// The artefact of a record is there and whole; then whether it holds.
fn artefact(
    record: &Record,
    path: &str,
    files: &Files,
    recheck: Option<&Recheck<'_>>,
    report: &mut Report,
) -> Option<Result<(), String>> {
    let Some(reference) = &record.artefact else {
        if matches!(record.verdict, Verdict::Verified | Verdict::Violated) {
            report.add(path, format!("it says {} and names neither certificate nor run", record.verdict.word()));
        }
        return None;
    };
    let at = write::artefact_path(reference);
    let Some(bytes) = files.get(&at) else {
        report.add(path, format!("it names `{at}`, which is not in the bundle"));
        return None;
    };
    if Digest::of(bytes) != reference.digest {
        report.add(&at, "its bytes are not those that the record names");
        return None;
    }
    match serde_json::from_slice(bytes) {
        Ok(value) => recheck.map(|recheck| recheck(record, &Artefact { kind: reference.kind, value }, files)),
        Err(error) => {
            report.add(&at, error.to_string());
            None
        }
    }
}
