//! Ed25519 keys (RFC 8032), as PEM files or as those of OpenSSH, and the two signatures that they give: one of DSSE, one as
//! `ssh-keygen -Y sign` writes it (PROTOCOL.sshsig).

use ed25519_dalek::pkcs8::spki::der::pem::LineEnding;
use ed25519_dalek::pkcs8::{DecodePrivateKey, DecodePublicKey, EncodePrivateKey, EncodePublicKey};
use ed25519_dalek::{Signer as _, SigningKey, VerifyingKey};
use ssh_key::private::{Ed25519Keypair, KeypairData};
use ssh_key::public::{Ed25519PublicKey, KeyData};
use ssh_key::{HashAlg, PrivateKey, PublicKey, SshSig};

/// The namespace of the signature in OpenSSH's form.
pub const NAMESPACE: &str = "rungbook";

/// Its path in a bundle.
pub const SSH_SIGNATURE: &str = "statement.json.sig";

/// The path of the public key in a bundle.
pub const SIGNER: &str = "signer.pub";

/// A key that signs.
#[derive(Clone)]
pub struct Signer(SigningKey);

impl std::fmt::Debug for Signer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Signer({})", self.public().fingerprint())
    }
}

/// A public key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Public(VerifyingKey);

impl Signer {
    /// The key that grows from 32 random bytes.
    #[must_use]
    pub fn from_seed(seed: &[u8; 32]) -> Self {
        Self(SigningKey::from_bytes(seed))
    }

    /// Reads a private key: PKCS #8 in PEM, or OpenSSH's own form.
    ///
    /// # Errors
    /// If it is neither, is no Ed25519 key, or is locked by a passphrase.
    pub fn parse(text: &str) -> Result<Self, String> {
        if !text.contains("OPENSSH PRIVATE KEY") {
            let key = SigningKey::from_pkcs8_pem(text.trim());
            return key.map(Self).map_err(|_| "no Ed25519 private key in PKCS #8 (PEM) or OpenSSH's form".to_owned());
        }
        let key = PrivateKey::from_openssh(text.trim_start()).map_err(|error| error.to_string())?;
        if key.is_encrypted() {
            return Err("the key is locked by a passphrase; give a copy without one (`ssh-keygen -p -N ''`)".to_owned());
        }
        match key.key_data() {
            KeypairData::Ed25519(pair) => Ok(Self(SigningKey::from_bytes(&pair.private.to_bytes()))),
            _ => {
                Err("not an Ed25519 key; make one with `rungbook evidence keygen` or `ssh-keygen -t ed25519`"
                    .to_owned())
            }
        }
    }

    /// The private key as PKCS #8 in PEM.
    ///
    /// # Errors
    /// Never in practice; the encoder reports errors of its buffer.
    pub fn pem(&self) -> Result<String, String> {
        self.0.to_pkcs8_pem(LineEnding::LF).map(|text| text.to_string()).map_err(|error| error.to_string())
    }

    /// Its public half.
    #[must_use]
    pub fn public(&self) -> Public {
        Public(self.0.verifying_key())
    }

    /// The signature of `message`, 64 bytes.
    #[must_use]
    pub fn sign(&self, message: &[u8]) -> Vec<u8> {
        self.0.sign(message).to_bytes().to_vec()
    }

    /// The signature of `message` in OpenSSH's form.
    ///
    /// # Errors
    /// If the library refuses the key; it does not for Ed25519.
    pub fn sign_ssh(&self, message: &[u8]) -> Result<String, String> {
        let pair = Ed25519Keypair::from_seed(&self.0.to_bytes());
        let key = PrivateKey::new(KeypairData::Ed25519(pair), "").map_err(|error| error.to_string())?;
        let signature = key.sign(NAMESPACE, HashAlg::Sha512, message).map_err(|error| error.to_string())?;
        signature.to_pem(ssh_key::LineEnding::LF).map_err(|error| error.to_string())
    }
}

impl Public {
    /// Reads a public key: PEM, a line of OpenSSH, or a line of an `allowed_signers` file.
    ///
    /// # Errors
    /// If there is no Ed25519 key in it.
    pub fn parse(text: &str) -> Result<Self, String> {
        if text.contains("BEGIN PUBLIC KEY") {
            let key = VerifyingKey::from_public_key_pem(text.trim());
            return key.map(Self).map_err(|_| "no Ed25519 public key in PEM".to_owned());
        }
        let words: Vec<&str> = text.split_whitespace().collect();
        let at = words.iter().position(|word| *word == "ssh-ed25519").ok_or("no Ed25519 public key")?;
        let line = words[at..].iter().take(2).copied().collect::<Vec<_>>().join(" ");
        let key = PublicKey::from_openssh(&line).map_err(|error| error.to_string())?;
        match key.key_data() {
            KeyData::Ed25519(key) => VerifyingKey::from_bytes(&key.0).map(Self).map_err(|error| error.to_string()),
            _ => Err("not an Ed25519 key".to_owned()),
        }
    }

    fn ssh(self) -> PublicKey {
        PublicKey::new(KeyData::Ed25519(Ed25519PublicKey(self.0.to_bytes())), "")
    }

    /// `SHA256:…`, as `ssh-keygen -l` prints it.
    #[must_use]
    pub fn fingerprint(self) -> String {
        self.ssh().fingerprint(HashAlg::Sha256).to_string()
    }

    /// The line of an OpenSSH public key, with a line break at its end.
    ///
    /// # Errors
    /// If the library refuses the key; it does not for Ed25519.
    pub fn line(self) -> Result<String, String> {
        self.ssh().to_openssh().map(|line| format!("{}\n", line.trim_end())).map_err(|error| error.to_string())
    }

    /// The key in PEM, as OpenSSL reads it.
    ///
    /// # Errors
    /// Never in practice; the encoder reports errors of its buffer.
    pub fn pem(self) -> Result<String, String> {
        self.0.to_public_key_pem(LineEnding::LF).map_err(|error| error.to_string())
    }

    /// The key as a `SubjectPublicKeyInfo` in DER.
    ///
    /// # Errors
    /// Never in practice; the encoder reports errors of its buffer.
    pub fn der(self) -> Result<Vec<u8>, String> {
        self.0.to_public_key_der().map(|der| der.as_bytes().to_vec()).map_err(|error| error.to_string())
    }

    /// Whether `signature` is this key's, of `message`. Strict: no second form of a signature is taken.
    #[must_use]
    pub fn verifies(self, message: &[u8], signature: &[u8]) -> bool {
        let signature = ed25519_dalek::Signature::from_slice(signature);
        signature.is_ok_and(|signature| self.0.verify_strict(message, &signature).is_ok())
    }

    /// Whether `text` is this key's signature of `message` in OpenSSH's form, and written in its canonical form.
    #[must_use]
    pub fn verifies_ssh(self, message: &[u8], text: &str) -> bool {
        let Ok(signature) = SshSig::from_pem(text) else { return false };
        let canonical = signature.to_pem(ssh_key::LineEnding::LF).is_ok_and(|again| again == text);
        canonical && signature.reserved().is_empty() && self.ssh().verify(NAMESPACE, message, &signature).is_ok()
    }
}
