//! The release bundle: one file that holds what was claimed, for which source, proven how, and signed.
//!
//! ```text
//! manifest.json         every other file with its part, its size and its digest
//! statement.json        an in-toto statement: the sources and the manifest as subjects, the verdicts as predicate
//! statement.dsse.json   the same in a DSSE envelope, signed
//! statement.json.sig    the same signed as `ssh-keygen -Y` does
//! statement.sigstore.json   the envelope again, as Sigstore's tools read it
//! signer.pub            the public key of all signatures
//! records/ certificates/ runs/ tables/ sources/ manual/ report/ results/ sbom.cdx.json snapshot.json
//! ```
//!
//! Every byte is determined by what is in it: the archive is stored without compression and has one canonical form,
//! all JSON of this room is canonical, and the statement follows from manifest and records. So a change of any byte is found, with
//! a key or without, and named; a signature says besides who made the whole.

pub mod archive;
pub mod manifest;
pub mod sbom;
pub mod sign;
pub mod sigstore;
pub mod statement;
pub mod verify;
pub mod write;
