//! The in-toto statement of a bundle, and its DSSE envelope.
//!
//! The statement (in-toto Attestation Framework 1.0) has the sources and the manifest as subjects. Its predicate, [`PREDICATE`],
//! lists the verdict of every table; the `test-result` predicate of in-toto knows *passed* and *failed* alone, and so cannot
//! say that nothing was tried. The envelope is DSSE 1.0: what is signed is the pre-authentication encoding of type and payload.

use std::collections::BTreeMap;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::manifest::{self, Manifest};
use crate::evidence::digest::{Digest, canonical};
use crate::evidence::record::Record;

/// The type of the predicate; the manual's page on evidence describes it.
pub const PREDICATE: &str = "urn:rungbook:predicate:table-verdicts:v1";

/// The type of a DSSE payload that is an in-toto statement.
pub const PAYLOAD_TYPE: &str = "application/vnd.in-toto+json";

/// The statement's path in a bundle.
pub const PATH: &str = "statement.json";

/// The envelope's path in a bundle.
pub const ENVELOPE: &str = "statement.dsse.json";

/// The statement that follows from a manifest and the records that it lists, by path.
#[must_use]
pub fn statement(manifest: &Manifest, records: &BTreeMap<String, Record>) -> Vec<u8> {
    let mut subjects: BTreeMap<&str, Digest> = BTreeMap::new();
    for record in records.values() {
        let claim = &record.claim;
        let parts = std::iter::once(&claim.table).chain(&claim.block).chain(&claim.cone);
        subjects.extend(parts.map(|part| (part.file.as_str(), part.raw)));
    }
    let manifest_digest = Digest::of(manifest.bytes());
    let subject = |(name, digest): (&str, Digest)| json!({"name": name, "digest": {"sha256": digest.hex()}});
    let first = std::iter::once((manifest::PATH, manifest_digest));
    let subjects: Vec<Value> = first.chain(subjects).map(subject).collect();
    let mut totals: BTreeMap<&str, usize> = BTreeMap::new();
    for record in records.values() {
        *totals.entry(record.verdict.word()).or_default() += 1;
    }
    let tables: Vec<Value> = records.iter().map(|(path, record)| table(path, record)).collect();
    canonical(&json!({
        "_type": "https://in-toto.io/Statement/v1",
        "subject": subjects,
        "predicateType": PREDICATE,
        "predicate": {
            "product": {"title": manifest.title, "version": manifest.version},
            "tool": manifest.tool,
            "commit": manifest.commit,
            "date": manifest.date,
            "author": manifest.author,
            "totals": totals,
            "tables": tables,
        },
    }))
}

fn table(path: &str, record: &Record) -> Value {
    let mut value = json!({
        "table": record.claim.table.name,
        "block": record.claim.block.as_ref().map(|block| block.name.as_str()),
        "conformance": record.claim.conformance,
        "verdict": record.verdict.word(),
        "record": {"path": path, "sha256": Digest::of(record.bytes()).hex()},
    });
    let detail = record.verdict.detail();
    if !detail.is_empty() {
        value["detail"] = Value::String(detail);
    }
    if let Some(artefact) = &record.artefact {
        value["artefact"] = json!(artefact);
    }
    value
}

/// A DSSE envelope.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Envelope {
    /// The payload in base64.
    pub payload: String,
    /// [`PAYLOAD_TYPE`].
    #[serde(rename = "payloadType")]
    pub payload_type: String,
    /// The signatures; none in a bundle that nobody signed.
    pub signatures: Vec<Signature>,
}

/// A signature of an envelope.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Signature {
    /// The fingerprint of the key.
    pub keyid: String,
    /// The signature in base64.
    pub sig: String,
}

/// Signs a message, and gives the key's fingerprint with the signature.
pub type Sign<'a> = dyn Fn(&[u8]) -> (String, Vec<u8>) + 'a;

impl Envelope {
    /// An envelope with `payload`, signed by `sign`.
    pub fn new(payload: &[u8], sign: Option<&Sign<'_>>) -> Self {
        let signature = sign.map(|sign| {
            let (keyid, sig) = sign(&encoding(PAYLOAD_TYPE, payload));
            Signature { keyid, sig: STANDARD.encode(sig) }
        });
        Self {
            payload: STANDARD.encode(payload),
            payload_type: PAYLOAD_TYPE.to_owned(),
            signatures: signature.into_iter().collect(),
        }
    }

    /// Its bytes.
    #[must_use]
    pub fn bytes(&self) -> Vec<u8> {
        canonical(self)
    }

    /// Reads what [`Envelope::bytes`] wrote.
    ///
    /// # Errors
    /// If it is no envelope in the canonical form.
    pub fn parse(bytes: &[u8]) -> Result<Self, String> {
        let envelope: Self = serde_json::from_slice(bytes).map_err(|error| error.to_string())?;
        if envelope.bytes() != bytes {
            return Err("it is not in the canonical form".to_owned());
        }
        Ok(envelope)
    }

    /// The payload.
    ///
    /// # Errors
    /// If it is not base64.
    pub fn decoded(&self) -> Result<Vec<u8>, String> {
        STANDARD.decode(&self.payload).map_err(|error| error.to_string())
    }
}

impl Signature {
    /// Its bytes.
    ///
    /// # Errors
    /// If it is not base64.
    pub fn decoded(&self) -> Result<Vec<u8>, String> {
        STANDARD.decode(&self.sig).map_err(|error| error.to_string())
    }
}

/// The pre-authentication encoding of DSSE: `DSSEv1 LEN TYPE LEN BODY`.
#[must_use]
pub fn encoding(type_: &str, body: &[u8]) -> Vec<u8> {
    let mut out = format!("DSSEv1 {} {type_} {} ", type_.len(), body.len()).into_bytes();
    out.extend(body);
    out
}

#[cfg(test)]
mod tests {
    use super::encoding;

    #[test]
    fn the_encoding_is_that_of_the_specification() {
        // The test vector of the DSSE protocol.
        let expected = b"DSSEv1 29 http://example.com/HelloWorld 11 hello world";
        assert_eq!(encoding("http://example.com/HelloWorld", b"hello world"), expected);
    }
}
