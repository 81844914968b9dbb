//! Bundles: the same bytes twice, every flipped byte found and named, signatures that others check, another machine.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use proptest::prelude::*;
use rungbook::evidence::bundle::sign::{Public, Signer};
use rungbook::evidence::bundle::verify::verify;
use rungbook::evidence::bundle::write::{Contents, bundle};
use rungbook::evidence::bundle::{archive, sbom, statement};
use rungbook::evidence::digest::Digest;
use rungbook::evidence::record::{Answer, Record, Verdict};
use serde_json::Value;

use super::records::{claim, origin, part, verified};
use super::{rungbook, write};

pub(super) fn signer() -> Signer {
    Signer::from_seed(&[7; 32])
}

/// A bundle with a certificate, a run, sources and pages.
fn contents() -> Contents {
    let text = "FUNCTION_BLOCK FB_Cyl\nEND_FUNCTION_BLOCK\n";
    let source = |mut part: rungbook::evidence::record::Part, text: &str| {
        part.raw = Digest::of(text);
        part
    };
    let mut first = claim();
    first.table = source(first.table, "| 1 |");
    first.block = first.block.map(|block| source(block, text));
    first.cone = vec![source(part("gvl", "Globals", "g"), "VAR_GLOBAL\nEND_VAR\n")];
    let mut second = first.clone();
    second.table = source(part("table", "Jams", "| 2 |"), "| 2 |");
    let run = rungbook::evidence::record::Artefact {
        kind: rungbook::evidence::record::ArtefactKind::Run,
        value: serde_json::json!({"inputs": [[0, 1], [1, 1]]}),
    };
    let violated = Answer { verdict: Verdict::Violated, artefact: Some(run), ..verified() };
    let mut files = BTreeMap::from([
        ("manual/html/index.html".to_owned(), b"<!DOCTYPE html><title>x</title>".to_vec()),
        ("report/evidence.md".to_owned(), b"# Evidence\n".to_vec()),
        ("empty.txt".to_owned(), Vec::new()),
    ]);
    for (name, text) in
        [("Extends in time", "| 1 |"), ("Jams", "| 2 |"), ("FB_Cyl", text), ("Globals", "VAR_GLOBAL\nEND_VAR\n")]
    {
        files.insert(format!("sources/{name}.st"), text.as_bytes().to_vec());
    }
    Contents {
        title: "Cylinders".to_owned(),
        version: "1.2.0".to_owned(),
        origin: origin(),
        records: [(first, verified()), (second, violated)]
            .map(|(claim, answer)| (Record::new(claim, &answer, origin()), answer.artefact))
            .into(),
        sources: true,
        files,
    }
}

/// The part of the archive that each byte belongs to.
fn part_at(files: &BTreeMap<String, Vec<u8>>, at: usize) -> String {
    let mut start = 0;
    for (name, bytes) in files {
        start += 30 + name.len() + bytes.len();
        if at < start {
            return name.clone();
        }
    }
    archive::DIRECTORY.to_owned()
}

pub(super) fn check_flip(bytes: &[u8], at: usize, bit: u8, keys: &[Public]) -> Result<(), TestCaseError> {
    let (files, faults) = archive::read(bytes, &|_| 0);
    prop_assert!(faults.is_empty());
    let part = part_at(&files, at);
    let mut changed = bytes.to_vec();
    changed[at] ^= 1 << bit;
    let report = verify(&changed, keys, None);
    prop_assert!(!report.holds(), "byte {at} of {part}");
    prop_assert!(
        report.problems.iter().any(|problem| problem.part == part),
        "byte {at} of {part}: {:?}",
        report.problems
    );
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: super::cases(32), ..ProptestConfig::default() })]

    #[test]
    fn any_changed_byte_of_a_signed_bundle_is_named(at in any::<prop::sample::Index>(), bit in 0_u8..8) {
        let bytes = signed();
        check_flip(bytes, at.index(bytes.len()), bit, &[signer().public()])?;
    }

    #[test]
    fn any_changed_byte_of_an_unsigned_bundle_is_named(at in any::<prop::sample::Index>(), bit in 0_u8..8) {
        let bytes = unsigned();
        check_flip(bytes, at.index(bytes.len()), bit, &[])?;
    }
}

pub(super) fn signed() -> &'static [u8] {
    static BYTES: std::sync::OnceLock<Vec<u8>> = std::sync::OnceLock::new();
    BYTES.get_or_init(|| bundle(contents(), Some(&signer())).expect("small"))
}

fn unsigned() -> &'static [u8] {
    static BYTES: std::sync::OnceLock<Vec<u8>> = std::sync::OnceLock::new();
    BYTES.get_or_init(|| bundle(contents(), None).expect("small"))
}

#[test]
fn a_flip_in_every_part_and_in_every_header_is_named() {
    let bytes = signed();
    let (files, _) = archive::read(bytes, &|_| 0);
    let mut start = 0;
    for (name, content) in &files {
        let header = start + 30 + name.len();
        let mut places = vec![start, start + 14, start + 23, start + 26, header - 1];
        places.extend((!content.is_empty()).then_some(header));
        places.extend((!content.is_empty()).then(|| header + content.len() / 2));
        for at in places {
            check_flip(bytes, at, 1, &[signer().public()]).unwrap_or_else(|error| panic!("{name}: {error}"));
        }
        start = header + content.len();
    }
    for at in (start..bytes.len()).step_by(41).chain(bytes.len() - 22..bytes.len()) {
        check_flip(bytes, at, 0, &[]).unwrap_or_else(|error| panic!("directory: {error}"));
    }
}

#[test]
fn a_whole_bundle_holds_and_two_runs_give_the_same_bytes() {
    let report = verify(signed(), &[signer().public()], None);
    assert!(report.holds(), "{:?}", report.problems);
    assert!(report.trusted);
    assert_eq!(report.records.len(), 2);
    assert_eq!(signed(), bundle(contents(), Some(&signer())).expect("small"));
    assert!(verify(unsigned(), &[], None).holds());
}

#[test]
fn bytes_that_are_cut_off_or_longer_are_found() {
    let bytes = signed();
    for length in [0, 10, 21, 22, bytes.len() / 2, bytes.len() - 1] {
        assert!(!verify(&bytes[..length], &[], None).holds(), "{length}");
    }
    let longer: Vec<u8> = bytes.iter().copied().chain([0]).collect();
    assert!(!verify(&longer, &[], None).holds());
}

#[test]
fn a_key_that_nobody_trusts_and_no_key_are_refused_where_one_is_asked_for() {
    let other = Signer::from_seed(&[8; 32]).public();
    let problems = verify(signed(), &[other], None).problems;
    assert!(problems.iter().any(|problem| problem.part == "signer.pub"), "{problems:?}");
    let problems = verify(unsigned(), &[other], None).problems;
    assert!(problems.iter().any(|problem| problem.message == "nobody signed it"), "{problems:?}");
}

/// Somebody who changes a verdict, and everything that follows from it, still lacks the key.
#[test]
fn a_forged_bundle_needs_the_key() {
    let mut forged = contents();
    for (record, _) in &mut forged.records {
        record.verdict = Verdict::Verified;
    }
    let forger = Signer::from_seed(&[9; 32]);
    let bytes = bundle(forged, Some(&forger)).expect("small");
    assert!(verify(&bytes, &[], None).holds(), "consistent in itself");
    assert!(!verify(&bytes, &[signer().public()], None).holds());
}

#[test]
fn an_artefact_that_does_not_hold_is_a_failure() {
    let recheck = |record: &Record, _: &_, files: &BTreeMap<String, Vec<u8>>| {
        assert!(files.contains_key("manifest.json"));
        if record.verdict == Verdict::Verified { Ok(()) } else { Err("the run does not lose".to_owned()) }
    };
    let report = verify(signed(), &[], Some(&recheck));
    assert!(report.problems.is_empty());
    assert!(!report.holds());
}

#[test]
fn the_statement_has_the_form_of_in_toto() {
    let (files, _) = archive::read(signed(), &|_| 0);
    let value: Value = serde_json::from_slice(&files[statement::PATH]).expect("JSON");
    let schema = r#"{"type": "object", "additionalProperties": false, "required": ["_type", "subject", "predicateType", "predicate"],
        "properties": {"_type": {"const": "https://in-toto.io/Statement/v1"}, "predicateType": {"type": "string", "pattern": "^[a-z]+:"},
        "predicate": {"type": "object"}, "subject": {"type": "array", "minItems": 1, "items": {"type": "object",
        "required": ["name", "digest"], "properties": {"digest": {"type": "object", "required": ["sha256"],
        "properties": {"sha256": {"type": "string", "pattern": "^[0-9a-f]{64}$"}}}}}}}}"#;
    super::validate(schema, &value);
    assert_eq!(value["predicate"]["totals"], serde_json::json!({"verified": 1, "violated": 1}));
}

#[test]
fn the_bill_of_materials_is_closed_and_names_this_tool() {
    let bill: Value = serde_json::from_slice(&sbom::sbom().expect("the lock file is ours")).expect("JSON");
    assert_eq!(bill["bomFormat"], "CycloneDX");
    let components = bill["components"].as_array().expect("a list");
    let names: std::collections::BTreeSet<&str> = components.iter().filter_map(|c| c["bom-ref"].as_str()).collect();
    assert!(names.iter().any(|name| name.starts_with("pkg:cargo/ed25519-dalek@")));
    assert!(!names.iter().any(|name| name.starts_with("pkg:cargo/proptest@")), "tests' dependencies are not shipped");
    assert_eq!(names.len(), components.len());
    for node in bill["dependencies"].as_array().expect("a list") {
        for on in node["dependsOn"].as_array().expect("a list") {
            assert!(names.contains(on.as_str().expect("a name")), "{on} is not listed");
        }
    }
}

pub(super) fn have(tool: &str) -> bool {
    let found = Command::new(tool).arg("-h").output().is_ok();
    if !found {
        println!("skipped: `{tool}` is not here");
    }
    found
}

pub(super) fn run(dir: &Path, tool: &str, args: &[&str], stdin: Option<&[u8]>) -> std::process::Output {
    use std::io::Write;
    let mut command = Command::new(tool);
    command.current_dir(dir).args(args);
    command
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped());
    let mut child = command.spawn().expect("it was there a moment ago");
    child.stdin.take().expect("piped").write_all(stdin.unwrap_or(b"")).expect("it reads");
    child.wait_with_output().expect("it ends")
}

#[test]
fn unzip_and_ssh_keygen_and_openssl_read_what_is_written() {
    let dir = tempfile::TempDir::new().expect("a folder");
    let at = dir.path();
    fs::write(at.join("release.zip"), signed()).expect("written");
    if have("unzip") {
        assert!(run(at, "unzip", &["-tq", "release.zip"], None).status.success());
    }
    let (files, _) = archive::read(signed(), &|_| 0);
    for name in ["statement.json", "statement.json.sig", "signer.pub", "signer.pem", "statement.dsse.json"] {
        fs::write(at.join(name), &files[name]).expect("written");
    }
    if have("ssh-keygen") {
        let key = String::from_utf8(files["signer.pub"].clone()).expect("text");
        write(at, "allowed_signers", &format!("rungbook {key}"));
        let args =
            ["-Y", "verify", "-f", "allowed_signers", "-I", "rungbook", "-n", "rungbook", "-s", "statement.json.sig"];
        let found = run(at, "ssh-keygen", &args, Some(&files["statement.json"]));
        assert!(found.status.success(), "{}", String::from_utf8_lossy(&found.stderr));
        assert!(!run(at, "ssh-keygen", &args, Some(b"something else")).status.success());
    }
    if have("openssl") {
        let envelope: Value = serde_json::from_slice(&files["statement.dsse.json"]).expect("JSON");
        let decode = |value: &Value| {
            use base64::Engine;
            base64::engine::general_purpose::STANDARD.decode(value.as_str().expect("text")).expect("base64")
        };
        let message = statement::encoding(statement::PAYLOAD_TYPE, &decode(&envelope["payload"]));
        fs::write(at.join("pae"), message).expect("written");
        fs::write(at.join("sig"), decode(&envelope["signatures"][0]["sig"])).expect("written");
        let args = ["pkeyutl", "-verify", "-pubin", "-inkey", "signer.pem", "-rawin", "-in", "pae", "-sigfile", "sig"];
        let found = run(at, "openssl", &args, None);
        assert!(found.status.success(), "{}", String::from_utf8_lossy(&found.stderr));
    }
}

#[test]
fn keys_of_ssh_keygen_and_openssl_sign() {
    let dir = tempfile::TempDir::new().expect("a folder");
    let mut keys = Vec::new();
    if have("ssh-keygen") {
        assert!(run(dir.path(), "ssh-keygen", &["-q", "-t", "ed25519", "-N", "", "-f", "ssh"], None).status.success());
        keys.push(("ssh", "ssh.pub"));
        assert!(
            run(dir.path(), "ssh-keygen", &["-q", "-t", "ed25519", "-N", "secret", "-f", "locked"], None)
                .status
                .success()
        );
        let locked = fs::read_to_string(dir.path().join("locked")).expect("written");
        assert!(Signer::parse(&locked).is_err_and(|message| message.contains("passphrase")));
    }
    if have("openssl") {
        assert!(
            run(dir.path(), "openssl", &["genpkey", "-algorithm", "ed25519", "-out", "pem"], None).status.success()
        );
        assert!(
            run(dir.path(), "openssl", &["pkey", "-in", "pem", "-pubout", "-out", "pem.pub"], None).status.success()
        );
        keys.push(("pem", "pem.pub"));
    }
    for (private, public) in keys {
        let read = |name: &str| fs::read_to_string(dir.path().join(name)).expect("written");
        let signer = Signer::parse(&read(private)).expect("a key");
        let public = Public::parse(&read(public)).expect("a key");
        assert_eq!(signer.public(), public);
        assert!(verify(&bundle(contents(), Some(&signer)).expect("small"), &[public], None).holds());
    }
    assert!(Signer::parse("nothing").is_err());
}

#[test]
fn records_of_a_bundle_meet_the_schema_and_name_no_absolute_path() {
    let out = tempfile::TempDir::new().expect("a folder");
    let path = out.path().join("release.zip");
    rungbook()
        .args(["evidence", "bundle", "-q", "--no-pdf", "-o"])
        .arg(&path)
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/basics"))
        .assert()
        .code(0);
    let (files, faults) = archive::read(&fs::read(path).expect("there"), &|_| 0);
    assert!(faults.is_empty());
    let records: Vec<_> = files.iter().filter(|(path, _)| path.starts_with("records/")).collect();
    assert!(records.len() > 5);
    let here = env!("CARGO_MANIFEST_DIR");
    for (path, bytes) in records {
        super::validate(rungbook::evidence::record::SCHEMA, &serde_json::from_slice(bytes).expect("JSON"));
        assert!(!String::from_utf8_lossy(bytes).contains(here), "{path}");
    }
    for name in [
        "manual/html/index.html",
        "manual/html/chapters/evidence.html",
        "report/evidence.md",
        "snapshot.json",
        "sbom.cdx.json",
    ] {
        assert!(files.contains_key(name), "{name}");
    }
}
