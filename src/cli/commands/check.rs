//! `rungbook check`: prints findings, and fails if one is bad enough or the gate is not reached.
#![expect(clippy::disallowed_methods, reason = "cli reads the baseline")]

use std::fs;
use std::path::{Path, PathBuf};

use crate::audit;
use crate::cli::args::{CheckArgs, Format, Level};
use crate::cli::commands::verify;
use crate::cli::report::outcome::{Input, Outcome, Standing};
use crate::cli::report::{self, progress::Progress, text, verdict};
use crate::cli::{Exit, Failure, print, say, stamp, store, tree, write};
use crate::config::Settings;
use crate::diagnostic::Severity;
use crate::evidence::policy::baseline::Baseline;
use crate::evidence::record::{Answer, Record};
use crate::pipeline;

pub(crate) fn run(args: &CheckArgs) -> Result<Exit, Failure> {
    let progress = Progress::new(args.tree.quiet);
    let dir = tree::folder(&args.tree.dir)?;
    let mut read = tree::read(&args.tree, None, &progress)?;
    if args.verify {
        read = verify::settle(&dir, read, &progress)?;
    }
    let (mut project, settings) = read;
    let stamp = stamp::stamp(&dir);
    let records = store::known(&dir, &project, &settings, &stamp)?;
    let answers = records.iter().map(|(_, answer)| answer.clone()).collect();
    pipeline::know(&mut project, &settings, answers);
    let path = baseline_path(args, &dir, &settings);
    if args.write_baseline {
        return write_baseline(&path, &project, &stamp);
    }
    let baseline = read_baseline(&path, args.baseline.is_some() || settings.baseline.is_some())?;
    let outcome = Outcome::new(&Input {
        project: &project,
        records: &records,
        stamp: &stamp,
        deny: args.deny.map_or(settings.deny, severity),
        gate: &settings.gate,
        baseline: baseline.as_ref(),
    });
    for (format, file) in &args.report {
        write::file(file, report::render(&outcome, *format)?.as_bytes())?;
    }
    match args.format {
        Format::Text => text::findings(outcome.new_ones().map(|reported| reported.finding), outcome.files),
        format => print(&report::render(&outcome, format)?),
    }
    if !args.tree.quiet {
        say(&totals(&outcome, &records));
    }
    Ok(if outcome.failed() { Exit::Findings } else { Exit::Ok })
}

pub(crate) const fn severity(level: Level) -> Severity {
    match level {
        Level::Info => Severity::Info,
        Level::Warning => Severity::Warning,
        Level::Error => Severity::Error,
    }
}

fn baseline_path(args: &CheckArgs, dir: &Path, settings: &Settings) -> PathBuf {
    let configured = || dir.join(settings.baseline.as_deref().unwrap_or("rungbook-baseline.json"));
    args.baseline.clone().unwrap_or_else(configured)
}

fn read_baseline(path: &Path, asked: bool) -> Result<Option<Baseline>, Failure> {
    if !asked {
        return Ok(None);
    }
    let failure = |message: String| Failure(format!("`{}`: {message}", path.display()));
    let bytes = fs::read(path).map_err(|error| failure(format!("{error}; `--write-baseline` makes it")))?;
    Baseline::parse(&bytes).map(Some).map_err(failure)
}

fn write_baseline(
    path: &Path,
    project: &crate::pipeline::Project,
    stamp: &crate::pipeline::Stamp,
) -> Result<Exit, Failure> {
    let codes = audit::codes().into_iter().map(|code| code.name);
    let baseline = Baseline::new(&stamp.tool, codes, &project.findings, &project.files);
    write::file(path, &baseline.bytes())?;
    say(&format!("`{}`: {} findings are allowed from now on", path.display(), baseline.findings.len()));
    Ok(Exit::Ok)
}

fn totals(outcome: &Outcome<'_>, records: &[(Record, Answer)]) -> String {
    let mut out = text::counts(|severity| outcome.count(severity, "new"));
    let standing = |name: &str| outcome.findings.iter().filter(|found| found.standing.name() == name).count();
    let others: Vec<String> = Standing::NAMES
        .iter()
        .skip(1)
        .map(|name| (name, standing(name)))
        .filter(|(_, count)| *count > 0)
        .map(|(name, count)| format!("{count} {name}"))
        .collect();
    if !others.is_empty() {
        out.push_str(&format!("not counted: {}\n", others.join(", ")));
    }
    if outcome.gone > 0 {
        out.push_str(&format!("{} of the baseline are gone; `--write-baseline` keeps them out\n", outcome.gone));
    }
    let verdicts = records.iter().map(|(record, _)| &record.verdict);
    if !records.is_empty() {
        out.push_str(&format!("{}\n{}", verdict::counted(verdicts.clone()), verdict::advice(verdicts)));
    }
    for line in &outcome.gate {
        let mark = if line.passed { "passed" } else { "failed" };
        out.push_str(&format!("gate {}: {mark}: wanted {}, found {}\n", line.key, line.wanted, line.found));
    }
    out
}
