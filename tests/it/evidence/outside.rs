//! Other people's readers of what is written: validators of JSON Schema, SARIF, DSSE, in-toto, Sigstore, and of the pipelines in the
//! manual. `.ci/run` installs them in `tests/outside`; where one is missing, its test says that it was skipped.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use rungbook::evidence::bundle::{archive, sigstore};

use super::bundle::{have, signed};
use super::{rungbook, stdout};

fn outside() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/outside")
}

/// A tool that was installed, if it was.
fn tool(path: &str) -> Option<PathBuf> {
    let path = outside().join(path);
    if !path.exists() {
        println!("skipped: {} is not here; `.ci/run` installs it", path.display());
    }
    path.exists().then_some(path)
}

fn accepts(output: std::io::Result<Output>) {
    let output = output.expect("it runs");
    let said = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    assert!(output.status.success(), "{said}");
}

/// The files of a signed bundle, in a folder.
fn unpacked() -> tempfile::TempDir {
    let dir = tempfile::TempDir::new().expect("a folder");
    let (files, _) = archive::read(signed(), &|_| 0);
    for (path, bytes) in files {
        let path = dir.path().join(path);
        fs::create_dir_all(path.parent().expect("below")).expect("a folder");
        fs::write(path, bytes).expect("written");
    }
    dir
}

fn sample(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("samples").join(name)
}

#[test]
fn a_validator_of_json_schema_accepts_records_and_model() {
    let Some(check) = tool("venv/bin/check-jsonschema") else { return };
    let dir = unpacked();
    let schema = dir.path().join("record.schema.json");
    fs::write(&schema, stdout(rungbook().args(["evidence", "schema"]))).expect("written");
    let folders = fs::read_dir(dir.path().join("records")).expect("records").flatten();
    let records = folders.flat_map(|folder| fs::read_dir(folder.path()).expect("a folder").flatten());
    let records: Vec<PathBuf> = records.map(|entry| entry.path()).collect();
    assert!(!records.is_empty());
    let run = |schema: &Path, files: &[PathBuf]| {
        Command::new(&check).arg("--check-metaschema").arg(schema).output().and_then(|done| {
            assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stdout));
            Command::new(&check).arg("--schemafile").arg(schema).args(files).output()
        })
    };
    accepts(run(&schema, &records));
    let broken = dir.path().join("broken.json");
    fs::write(&broken, fs::read_to_string(&records[0]).expect("text").replace("\"key\"", "\"kay\"")).expect("written");
    assert!(!run(&schema, &[broken]).expect("it runs").status.success(), "the schema asks for nothing");
    rungbook().args(["build", "-q", "--json", "-o"]).arg(dir.path()).arg(sample("basics")).assert().code(0);
    let schema = dir.path().join("model.schema.json");
    fs::write(&schema, stdout(rungbook().arg("schema"))).expect("written");
    accepts(run(&schema, &[dir.path().join("model.json")]));
}

#[test]
fn the_pipelines_of_the_manual_are_what_the_forges_take() {
    let Some(check) = tool("venv/bin/check-jsonschema") else { return };
    let page = include_str!("../../../manual/pipelines.md");
    let files: Vec<&str> = page.split("```yaml\n").skip(1).filter_map(|rest| rest.split("```").next()).collect();
    assert_eq!(files.len(), 2, "one for each forge");
    let dir = tempfile::TempDir::new().expect("a folder");
    for (text, schema) in files.iter().zip(["vendor.gitlab-ci", "vendor.github-workflows"]) {
        let path = dir.path().join(format!("{schema}.yml"));
        fs::write(&path, text).expect("written");
        let mut command = Command::new(&check);
        command.args(["--builtin-schema", schema]);
        if schema == "vendor.gitlab-ci" {
            command.args(["--data-transform", "gitlab-ci"]);
        }
        accepts(command.arg(&path).output());
    }
}

#[test]
fn the_multitool_of_sarif_accepts_a_log() {
    let Some(multitool) = tool("node_modules/.bin/sarif-multitool") else { return };
    let dir = tempfile::TempDir::new().expect("a folder");
    let log = dir.path().join("log.sarif");
    fs::write(&log, stdout(rungbook().args(["check", "-q", "--format", "sarif"]).arg(sample("flawed"))))
        .expect("written");
    let run = |log: &Path| {
        let mut command = Command::new(&multitool);
        command.env("DOTNET_SYSTEM_GLOBALIZATION_INVARIANT", "1").arg("validate").arg(log).output()
    };
    let output = run(&log).expect("it runs");
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success() && !said.contains(": error "), "{said}");
    let text = fs::read_to_string(&log).expect("text").replace("\"ruleIndex\": 0", "\"ruleIndex\": 4000");
    fs::write(&log, text).expect("written");
    let output = run(&log).expect("it runs");
    assert!(String::from_utf8_lossy(&output.stdout).contains(": error "), "it sees what is wrong");
}

#[test]
fn sigstore_verifies_its_form_of_the_envelope() {
    if !have("node") || tool("node_modules/@sigstore/verify").is_none() {
        return;
    }
    let dir = unpacked();
    let at = |name: &str| dir.path().join(name);
    let run = || {
        let mut command = Command::new("node");
        command.arg(outside().join("sigstore.mjs")).arg(at(sigstore::PATH)).arg(at("signer.pem")).output()
    };
    accepts(run());
    let text = fs::read_to_string(at(sigstore::PATH)).expect("text");
    let start = text.find("\"payload\": \"").expect("a payload") + 60;
    let other = if text.as_bytes()[start] == b'A' { "B" } else { "A" };
    fs::write(at(sigstore::PATH), [&text[..start], other, &text[start + 1..]].concat()).expect("written");
    assert!(!run().expect("it runs").status.success(), "a changed payload has no signature");
}

#[test]
fn the_libraries_of_dsse_and_in_toto_read_the_statement() {
    let Some(python) = tool("venv/bin/python") else { return };
    let dir = unpacked();
    let run = || {
        let mut command = Command::new(&python);
        command.arg(outside().join("statement.py"));
        ["statement.json", "statement.dsse.json", "signer.pem"]
            .iter()
            .fold(&mut command, |command, name| command.arg(dir.path().join(name)));
        command.output()
    };
    accepts(run());
    let envelope = dir.path().join("statement.dsse.json");
    let text = fs::read_to_string(&envelope).expect("text").replace("vnd.in-toto+json", "vnd.in-toto+jsom");
    fs::write(envelope, text).expect("written");
    assert!(!run().expect("it runs").status.success(), "another type has no signature");
}
