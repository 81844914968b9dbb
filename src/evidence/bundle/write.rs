//! Puts a bundle together.

use std::collections::BTreeMap;

use super::manifest::{self, Manifest};
use super::sign::{self, Signer};
use super::statement::{self, Envelope};
use super::{archive, sbom, sigstore};
use crate::evidence::digest::Digest;
use crate::evidence::record::{Artefact, Origin, Record};

/// What goes into a bundle.
#[derive(Clone, Debug, Default)]
pub struct Contents {
    /// The title of what is released.
    pub title: String,
    /// Its version; empty if unknown.
    pub version: String,
    /// Who makes it, from what.
    pub origin: Origin,
    /// The records with their artefacts.
    pub records: Vec<(Record, Option<Artefact>)>,
    /// Whether the sources are among the files.
    pub sources: bool,
    /// All other files, by path: `sources/…`, `tables/…`, `manual/…`, `report/…`.
    pub files: BTreeMap<String, Vec<u8>>,
}

/// The path of a record in a bundle; people find a table by its block.
#[must_use]
pub fn record_path(record: &Record) -> String {
    let name = |text: &str| -> String {
        let plain = |c: char| if c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | '-') { c } else { '-' };
        text.chars().take(60).map(plain).collect()
    };
    let block = record.claim.block.as_ref().map_or_else(|| "no-block".to_owned(), |block| name(&block.name));
    // The digest tells tables of one name apart, also where only letters differ that the path does not hold.
    let unique = Digest::of_parts([record.claim.table.file.as_str(), &record.claim.table.name, &record.key.hex()]);
    format!("records/{block}/{}-{}.json", name(&record.claim.table.name), &unique.hex()[..12])
}

/// The path of an artefact in a bundle.
#[must_use]
pub fn artefact_path(reference: &crate::evidence::record::ArtefactRef) -> String {
    format!("{}/{}.json", reference.kind.folder(), reference.digest.hex())
}

/// The bytes of the bundle; the same contents and key give the same bytes.
///
/// # Errors
/// If two files would have one path, or there is more than an archive holds.
pub fn bundle(contents: Contents, signer: Option<&Signer>) -> Result<Vec<u8>, String> {
    let mut files = contents.files;
    let mut records = BTreeMap::new();
    for (record, artefact) in contents.records {
        if let Some(artefact) = artefact {
            files.insert(artefact_path(&artefact.reference()), artefact.bytes());
        }
        let path = record_path(&record);
        files.insert(path.clone(), record.bytes());
        if records.insert(path.clone(), record).is_some() {
            return Err(format!("two records have the path `{path}`"));
        }
    }
    files.insert(sbom::PATH.to_owned(), sbom::sbom()?);
    if let Some(signer) = signer {
        files.insert(sign::SIGNER.to_owned(), signer.public().line()?.into_bytes());
        files.insert("signer.pem".to_owned(), signer.public().pem()?.into_bytes());
    }
    for path in super::verify::OWN {
        if files.contains_key(path) {
            return Err(format!("the path `{path}` is taken by the bundle itself"));
        }
    }
    let Origin { tool, commit, date, author } = contents.origin;
    let listed = files.iter().map(|(path, bytes)| (path.clone(), manifest::File::of(bytes))).collect();
    let manifest = Manifest {
        bundle_version: manifest::VERSION,
        title: contents.title,
        version: contents.version,
        tool,
        commit,
        date,
        author,
        sources: contents.sources,
        files: listed,
    };
    let statement = statement::statement(&manifest, &records);
    let sign = signer.map(|signer| |message: &[u8]| (signer.public().fingerprint(), signer.sign(message)));
    let envelope = Envelope::new(&statement, sign.as_ref().map(|sign| sign as &statement::Sign<'_>));
    if let Some(signer) = signer {
        files.insert(sign::SSH_SIGNATURE.to_owned(), signer.sign_ssh(&statement)?.into_bytes());
        files.insert(sigstore::PATH.to_owned(), sigstore::bytes(&envelope, signer.public())?);
    }
    files.insert(manifest::PATH.to_owned(), manifest.bytes());
    files.insert(statement::PATH.to_owned(), statement);
    files.insert(statement::ENVELOPE.to_owned(), envelope.bytes());
    archive::write(&files)
}
