//! A bundle of each sample: it verifies on another machine, and each of its parts is guarded.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use proptest::prelude::*;
use rungbook::evidence::bundle::archive;
use rungbook::evidence::bundle::sign::{Public, Signer};
use serde_json::Value;

use super::bundle::{check_flip, signer};
use super::rungbook;

const NAMES: [&str; 4] = ["basics", "flawed", "papers", "pick-and-place"];

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder").flatten().filter(|entry| entry.file_name() != "target") {
        let to = to.join(entry.file_name());
        if entry.path().is_dir() { copy(&entry.path(), &to) } else { _ = fs::copy(entry.path(), to).expect("copied") }
    }
}

/// The signed bundle of each sample, with what half a second a table proves; two runs give the same bytes.
fn bundles() -> &'static [(&'static str, Vec<u8>)] {
    static BUNDLES: OnceLock<Vec<(&str, Vec<u8>)>> = OnceLock::new();
    let make = |name: &'static str| {
        let dir = tempfile::TempDir::new().expect("a folder");
        let (tree, key) = (dir.path().join(name), dir.path().join("key.pem"));
        copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("samples").join(name), &tree);
        fs::write(&key, signer().pem().expect("a key")).expect("written");
        rungbook().args(["verify", "-q", "--timeout", "0.5"]).arg(&tree).output().expect("it runs");
        let run = |file: &str| {
            let path = dir.path().join(file);
            let mut command = rungbook();
            command.args(["evidence", "bundle", "-q", "--no-pdf", "--key"]).arg(&key).arg("-o").arg(&path);
            command.arg(&tree).assert().code(0);
            fs::read(path).expect("written")
        };
        let bytes = run("a.zip");
        assert_eq!(bytes, run("b.zip"), "{name}: two runs, the same bytes");
        (name, bytes)
    };
    BUNDLES.get_or_init(|| NAMES.map(make).into())
}

/// The command that checks `release.zip` by `key.pub` in `dir`, with nothing of this machine around it.
fn place(bytes: &[u8], key: Public) -> tempfile::TempDir {
    let dir = tempfile::TempDir::new().expect("a folder");
    fs::write(dir.path().join("release.zip"), bytes).expect("written");
    fs::write(dir.path().join("key.pub"), key.line().expect("a key")).expect("written");
    dir
}

const CHECK: [&str; 5] = ["evidence", "verify", "release.zip", "--key", "key.pub"];

#[test]
fn a_bundle_of_each_sample_verifies_in_another_folder() {
    for (name, bytes) in bundles() {
        let other = place(bytes, signer().public());
        let verify = || rungbook().current_dir(other.path()).env_clear().args(CHECK).output().expect("it runs");
        let whole = verify();
        let said = String::from_utf8_lossy(&whole.stdout).into_owned();
        assert!(whole.status.success(), "{name}: {said}");
        let (proven, again) = (said.matches(": verified").count(), said.matches(": verified, checked again").count());
        assert_eq!(proven, again, "{name}: {said}");
        assert!(*name != "flawed" || (again > 0 && said.contains("violated, checked again")), "{said}");
        let mut changed = bytes.clone();
        let at = changed.len() / 3;
        changed[at] ^= 4;
        fs::write(other.path().join("release.zip"), changed).expect("written");
        let output = verify();
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        assert_eq!(output.status.code(), Some(1), "{name}: {said}");
        assert!(said.contains("changed: ") && said.contains("NOT as it was made"), "{said}");
    }
    let stranger = place(&bundles()[0].1, Signer::from_seed(&[8; 32]).public());
    rungbook().current_dir(stranger.path()).args(CHECK).assert().code(1);
}

/// The manual in a bundle says of each table what its record says.
#[test]
fn the_manual_of_a_bundle_knows_the_verdicts() {
    for (name, bytes) in bundles() {
        let (files, _) = archive::read(bytes, &|_| 0);
        let json = |bytes: &[u8]| serde_json::from_slice::<Value>(bytes).expect("JSON");
        let mut counted = BTreeMap::<String, u64>::new();
        for (_, record) in files.iter().filter(|(path, _)| path.starts_with("records/")) {
            *counted.entry(json(record)["verdict"]["word"].as_str().expect("a word").to_owned()).or_default() += 1;
        }
        let totals = json(&files["manual/model.json"])["totals"]["verdicts"].clone();
        let told: Vec<(String, u64)> = serde_json::from_value(totals).expect("verdicts");
        assert_eq!(told, counted.into_iter().collect::<Vec<_>>(), "{name}");
        assert!(*name == "papers" || told.iter().any(|(word, _)| word == "verified"), "{name}: {told:?}");
    }
}

/// The report is a PDF/A-3 with the records inside it.
#[test]
#[cfg(feature = "pdf")]
fn the_report_of_a_bundle_is_archival() {
    let dir = tempfile::TempDir::new().expect("a folder");
    let (tree, path) = (dir.path().join("flawed"), dir.path().join("release.zip"));
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/flawed"), &tree);
    rungbook().args(["verify", "-q", "--timeout", "0.5"]).arg(&tree).output().expect("it runs");
    rungbook().args(["evidence", "bundle", "-q", "-o"]).arg(&path).arg(&tree).assert().code(0);
    let (files, faults) = archive::read(&fs::read(&path).expect("written"), &|_| 0);
    assert!(faults.is_empty(), "{faults:?}");
    let report = &files.iter().find(|(name, _)| name.as_str() == "report/evidence.pdf").expect("a report").1;
    let records = files.keys().filter(|name| name.starts_with("records/")).count();
    assert!(crate::archival::attached(report).is_none_or(|inside| records > 0 && inside >= records), "{records}");
    let judges = [crate::archival::faults(report), crate::archival::preflight(report, false)];
    for faults in judges.into_iter().flatten() {
        assert_eq!(faults, Vec::<String>::new());
    }
}

/// A root that holds the tool, the libraries that it is linked with, the bundle and the key, and nothing else; no
/// network, no variables, no home.
#[test]
fn a_bundle_verifies_in_a_root_of_its_own_without_a_network() {
    let namespace = ["--net", "--map-root-user"];
    let can = Command::new("unshare").args(namespace).arg("true").output();
    let tool = Path::new(env!("CARGO_BIN_EXE_rungbook"));
    let Some(libraries) = can.is_ok_and(|done| done.status.success()).then(|| libraries(tool)).flatten() else {
        println!("skipped: no namespaces here, or no `ldd`");
        return;
    };
    let root = place(&bundles()[1].1, signer().public());
    fs::copy(tool, root.path().join("rungbook")).expect("copied");
    for library in libraries {
        let to = root.path().join(library.strip_prefix("/").expect("absolute"));
        fs::create_dir_all(to.parent().expect("below the root")).expect("a folder");
        fs::copy(&library, to).expect("copied");
    }
    let mut command = Command::new("unshare");
    command.args(namespace).arg("--root").arg(root.path()).args(["--wd", "/", "/rungbook"]).args(CHECK).env_clear();
    let output = command.env("PATH", std::env::var_os("PATH").unwrap_or_default()).output().expect("it runs");
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{said}{}", String::from_utf8_lossy(&output.stderr));
    assert!(said.contains("verified, checked again") && said.contains("which you trust"), "{said}");
}

/// The files that the loader takes in for `tool`.
fn libraries(tool: &Path) -> Option<Vec<PathBuf>> {
    let output = Command::new("ldd").arg(tool).output().ok()?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let paths = text.split_whitespace().filter(|word| word.starts_with('/')).map(PathBuf::from);
    output.status.success().then(|| paths.collect())
}

/// Where each part of a bundle is: its header with its name, and its bytes.
fn parts(bytes: &[u8]) -> Vec<(String, std::ops::Range<usize>, std::ops::Range<usize>)> {
    let (files, faults) = archive::read(bytes, &|_| 0);
    assert!(faults.is_empty());
    let mut at = 0;
    let mut parts = Vec::new();
    for (name, content) in files {
        let (header, end) = (at + 30 + name.len(), at + 30 + name.len() + content.len());
        parts.push((name, at..header, header..end));
        at = end;
    }
    parts.push((archive::DIRECTORY.to_owned(), at..bytes.len(), at..bytes.len()));
    parts
}

/// Of every folder of each bundle the largest file, of every file with `RUNGBOOK_CASES` at 1000: a bit of its header and a bit
/// of its bytes.
#[test]
fn a_change_in_every_part_of_each_sample_is_named() {
    let every = super::cases(0) >= 1000;
    for (name, bytes) in bundles() {
        let mut chosen: BTreeMap<String, _> = BTreeMap::new();
        for part in parts(bytes) {
            let kind = if every { part.0.as_str() } else { part.0.split('/').next().unwrap_or_default() };
            let known = chosen.entry(kind.to_owned()).or_insert_with(|| part.clone());
            if part.2.len() > known.2.len() {
                *known = part;
            }
        }
        for (number, (part, header, content)) in chosen.into_values().enumerate() {
            let places = [header, content].map(|range| range.start + (number * 7919 + 13) % range.len().max(1));
            for at in if every { &places[..] } else { &places[1..] } {
                let flipped = check_flip(bytes, *at, u8::try_from(number % 8).unwrap_or(0), &[signer().public()]);
                flipped.unwrap_or_else(|error| panic!("{name}: {part}: {error}"));
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: super::cases(8), ..ProptestConfig::default() })]

    #[test]
    fn a_changed_byte_of_a_sample_is_named(sample in 0..NAMES.len(), at in any::<prop::sample::Index>(), bit in 0_u8..8) {
        let bytes = &bundles()[sample].1;
        check_flip(bytes, at.index(bytes.len()), bit, &[signer().public()])?;
    }
}
