//! The envelope as a Sigstore bundle (`dev.sigstore.bundle.v1`, media type version 0.3), for verifiers that read nothing else: `cosign`,
//! policy controllers, `@sigstore/verify`.
//!
//! It holds the very signature of the envelope, and names the key by the SHA-256 of its `SubjectPublicKeyInfo`, as `cosign` does for a
//! key of one's own. Sigstore's short-lived certificates and its transparency log are services; they have no part in evidence that is made and
//! checked offline, so a verifier has to be told to ask for no entry of the log.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::json;

use super::sign::Public;
use super::statement::Envelope;
use crate::evidence::digest::{Digest, canonical};

/// Its path in a bundle.
pub const PATH: &str = "statement.sigstore.json";

/// The version of the format.
pub const MEDIA_TYPE: &str = "application/vnd.dev.sigstore.bundle.v0.3+json";

/// The bytes of the bundle that follows from an envelope and the key that signed it.
///
/// # Errors
/// If the library refuses the key; it does not for Ed25519.
pub fn bytes(envelope: &Envelope, key: Public) -> Result<Vec<u8>, String> {
    let hint = STANDARD.encode(Digest::of(key.der()?).bytes());
    Ok(canonical(&json!({
        "mediaType": MEDIA_TYPE,
        "verificationMaterial": {"publicKey": {"hint": hint}, "tlogEntries": []},
        "dsseEnvelope": envelope,
    })))
}
