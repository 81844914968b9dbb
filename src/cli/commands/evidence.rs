//! `rungbook evidence`: packs a release with its evidence, signs it, checks it again.
#![expect(clippy::disallowed_methods, reason = "cli reads keys and bundles")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::args::{BundleArgs, BundleVerifyArgs, EvidenceCommand};
use crate::cli::commands::verify as decide;
use crate::cli::report::{progress::Progress, verdict};
use crate::cli::{Exit, Failure, print, release, say, stamp, store, tree, write};
use crate::config::Settings;
use crate::evidence::bundle::sign::{Public, Signer};
use crate::evidence::bundle::verify::{Recheck, Report, verify};
use crate::evidence::bundle::write::{Contents, bundle, record_path};
use crate::evidence::digest::canonical;
use crate::evidence::record::{self, Answer, Record};
use crate::evidence::{diff, snapshot};
use crate::pipeline::recheck::Checker;
use crate::pipeline::{self, Project, Stamp};
use crate::source::Disk;
use crate::table::write::gtt;

pub(crate) fn run(command: &EvidenceCommand) -> Result<Exit, Failure> {
    match command {
        EvidenceCommand::Bundle(args) => pack(args),
        EvidenceCommand::Verify(args) => check(args),
        EvidenceCommand::Keygen { file } => keygen(file),
        EvidenceCommand::Schema => {
            print(record::SCHEMA);
            Ok(Exit::Ok)
        }
    }
}

fn failure(path: &Path, message: impl std::fmt::Display) -> Failure {
    Failure(format!("`{}`: {message}", path.display()))
}

fn pack(args: &BundleArgs) -> Result<Exit, Failure> {
    let progress = Progress::new(args.tree.quiet);
    let dir = tree::folder(&args.tree.dir)?;
    let signer = args.key.as_deref().map(read_signer).transpose()?;
    let output = std::path::absolute(&args.output).map_err(|error| failure(&args.output, error))?;
    let mut read = tree::read(&args.tree, Some(&output), &progress)?;
    if args.verify {
        read = decide::settle(&dir, read, &progress)?;
    }
    let (mut project, settings) = read;
    let stamp = stamp::stamp(&dir);
    let records = store::known(&dir, &project, &settings, &stamp)?;
    pipeline::know(&mut project, &settings, records.iter().map(|(_, answer)| answer.clone()).collect());
    let offered = pipeline::snapshot::snapshot(&project, &settings, &stamp, &records);
    let old = args.previous.as_deref().map(|old| release::snapshot(old, &dir)).transpose()?;
    let changes = old.map(|old| diff::compare(&old, &offered));
    let pages = pipeline::evidence::pages(&project, &settings, &stamp, &records, changes.as_ref());
    let own = pages.len();
    project.narratives.extend(pages);
    let mut files = manual(args, &project, &settings, &stamp, &records, own, &progress)?;
    files.insert(snapshot::PATH.to_owned(), offered.bytes());
    if let Some(changes) = &changes {
        files.insert("report/changes.json".to_owned(), canonical(changes));
    }
    tables(&project, &records, &mut files);
    beside(&dir, &project, &records, &settings, &mut files)?;
    let contents = Contents {
        title: offered.title,
        version: offered.version,
        origin: pipeline::records::origin(&stamp),
        records: records.into_iter().map(|(record, answer)| (record, answer.artefact)).collect(),
        sources: settings.evidence.sources,
        files,
    };
    let verdicts: Vec<record::Verdict> = contents.records.iter().map(|(record, _)| record.verdict.clone()).collect();
    let bytes = bundle(contents, signer.as_ref()).map_err(Failure)?;
    progress.event(pipeline::Event::Done);
    write::file(&output, &bytes)?;
    if !args.tree.quiet {
        let signed =
            signer.map_or_else(|| "not signed".to_owned(), |key| format!("signed by {}", key.public().fingerprint()));
        let (counted, advice) = (verdict::counted(verdicts.iter()), verdict::advice(verdicts.iter()));
        say(&format!("`{}`: {counted}; {signed}\n{advice}", args.output.display()));
    }
    Ok(Exit::Ok)
}

/// The manual and the report, as pages and as PDF.
fn manual(
    args: &BundleArgs,
    project: &Project,
    settings: &Settings,
    stamp: &Stamp,
    records: &[(Record, Answer)],
    own: usize,
    progress: &Progress,
) -> Result<BTreeMap<String, Vec<u8>>, Failure> {
    let events = |event| progress.event(event);
    let mut files = BTreeMap::new();
    let book = pipeline::book(project, settings, stamp);
    let pages = pipeline::html(project, &book, &events).map_err(|error| Failure(error.to_string()))?;
    files.extend(pages.into_iter().map(|page| (format!("manual/html/{}", page.path), page.bytes)));
    files.insert("manual/model.json".to_owned(), pipeline::model(&book).into_bytes());
    for page in &project.narratives[project.narratives.len() - own..] {
        let name = page.path.rsplit('/').next().unwrap_or(&page.path);
        files.insert(format!("report/{name}"), page.text.clone().into_bytes());
    }
    if cfg!(feature = "pdf") && !args.no_pdf {
        files
            .insert("manual/manual.pdf".to_owned(), pipeline::pdf(project, &book, settings, &events).map_err(Failure)?);
        let report = pipeline::evidence::report_book(&book, own);
        let attached = records.iter().map(|(record, _)| (record_path(record).replace('/', "-"), record.bytes()));
        let bytes = pipeline::report_pdf(project, &report, settings, attached.collect()).map_err(Failure)?;
        files.insert("report/evidence.pdf".to_owned(), bytes);
    }
    Ok(files)
}

/// Every table as text, in one form whatever the form that it was written in.
fn tables(project: &Project, records: &[(Record, Answer)], files: &mut BTreeMap<String, Vec<u8>>) {
    for (attached, (record, _)) in project.tables.iter().zip(records) {
        let path = record_path(record).replacen("records/", "tables/", 1).replace(".json", ".gtt");
        files.insert(path, gtt(&attached.table).content.into_bytes());
    }
}

/// The sources that the records speak of, and what else the evidence was made from.
fn beside(
    dir: &Path,
    project: &Project,
    records: &[(Record, Answer)],
    settings: &Settings,
    files: &mut BTreeMap<String, Vec<u8>>,
) -> Result<(), Failure> {
    let fs = Disk::new(dir).map_err(|error| failure(dir, error))?;
    if settings.evidence.sources {
        let sources = pipeline::evidence::sources(&fs, records).map_err(Failure)?;
        files.extend(sources.into_iter().map(|(path, bytes)| (format!("sources/{path}"), bytes)));
    }
    if !project.beside.outside.is_empty() {
        let results: Vec<_> = project.beside.outside.iter().map(|(result, _)| result).collect();
        files.insert("results/outside.json".to_owned(), canonical(&results));
    }
    Ok(())
}

fn read_signer(path: &Path) -> Result<Signer, Failure> {
    let text = fs::read_to_string(path).map_err(|error| failure(path, error))?;
    Signer::parse(&text).map_err(|message| failure(path, message))
}

pub(crate) fn check(args: &BundleVerifyArgs) -> Result<Exit, Failure> {
    let key = |path: &PathBuf| {
        let text = fs::read_to_string(path).map_err(|error| failure(path, error))?;
        let lines = text.lines().filter(|line| !line.trim().is_empty() && !line.starts_with('#'));
        if text.contains("BEGIN PUBLIC KEY") {
            return Public::parse(&text).map(|key| vec![key]).map_err(|message| failure(path, message));
        }
        lines.map(|line| Public::parse(line).map_err(|message| failure(path, message))).collect::<Result<Vec<_>, _>>()
    };
    let keys: Vec<Public> = args.key.iter().map(key).collect::<Result<Vec<_>, _>>()?.into_iter().flatten().collect();
    if !args.key.is_empty() && keys.is_empty() {
        return Err(Failure("there is no key in the files that were given".to_owned()));
    }
    let bytes = fs::read(&args.file).map_err(|error| failure(&args.file, error))?;
    let checker = Checker::default();
    let recheck: &Recheck<'_> = &|record, artefact, files| checker.check(record, artefact, files);
    let report = verify(&bytes, &keys, Some(recheck));
    if !(args.quiet && report.holds()) {
        print(&tell(args, &report));
    }
    Ok(if report.holds() { Exit::Ok } else { Exit::Findings })
}

fn tell(args: &BundleVerifyArgs, report: &Report) -> String {
    let mut out = String::new();
    for problem in &report.problems {
        out.push_str(&format!("changed: {}: {}\n", problem.part, problem.message));
    }
    let mut unchecked = 0;
    for checked in &report.records {
        let again = match &checked.recheck {
            Some(Ok(())) => ", checked again".to_owned(),
            Some(Err(message)) => format!(", which does NOT hold: {message}"),
            None => String::new(),
        };
        unchecked += usize::from(checked.recheck.is_none() && matches!(checked.verdict, "verified" | "violated"));
        out.push_str(&format!("{}: {}{again}\n", checked.subject, checked.verdict));
    }
    if let Some(manifest) = &report.manifest {
        let what = [manifest.title.as_str(), &manifest.version, &manifest.commit].join(" ");
        out.push_str(&format!("{} files of {}, made by {}\n", manifest.files.len(), what.trim(), manifest.tool));
    }
    if unchecked > 0 {
        out.push_str(&format!("{unchecked} certificates and runs were not checked again: this rungbook cannot\n"));
    }
    match (&report.signer, report.trusted) {
        (Some(key), true) => out.push_str(&format!("signed by {key}, which you trust\n")),
        (Some(key), false) => out.push_str(&format!("signed by {key}; `--key` tells whether that is whom you trust\n")),
        (None, _) => out.push_str("nobody signed it\n"),
    }
    let state = if report.holds() { "nothing was changed" } else { "this is NOT as it was made" };
    out.push_str(&format!("{}: {state}\n", args.file.display()));
    out
}

fn keygen(file: &Path) -> Result<Exit, Failure> {
    let public = PathBuf::from(format!("{}.pub", file.display()));
    for path in [file, &public] {
        if path.exists() {
            return Err(failure(path, "it is there already, and a key is not overwritten"));
        }
    }
    let signer = Signer::from_seed(&seed()?);
    write::secret(file, signer.pem().map_err(Failure)?.as_bytes())?;
    write::file(&public, signer.public().line().map_err(Failure)?.as_bytes())?;
    say(&format!(
        "`{}` is the private key, `{}` the public one: {}",
        file.display(),
        public.display(),
        signer.public().fingerprint()
    ));
    Ok(Exit::Ok)
}

/// 32 random bytes of the system.
#[cfg(unix)]
fn seed() -> Result<[u8; 32], Failure> {
    use std::io::Read;
    let mut seed = [0; 32];
    let path = Path::new("/dev/urandom");
    fs::File::open(path).and_then(|mut file| file.read_exact(&mut seed)).map_err(|error| failure(path, error))?;
    Ok(seed)
}

/// 32 random bytes of the system.
#[cfg(not(unix))]
fn seed() -> Result<[u8; 32], Failure> {
    Err(Failure("keys are made on Unix only; `ssh-keygen -t ed25519 -N '' -f FILE` makes one here".to_owned()))
}
