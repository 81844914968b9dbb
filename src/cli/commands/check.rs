//! `rungbook check`: prints findings, and fails if one is bad enough or the gate is not reached.
#![expect(clippy::disallowed_methods, reason = "cli reads the baseline")]

use std::fs;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use crate::audit;
use crate::cli::args::{CheckArgs, Format, Level};
use crate::cli::report::outcome::{Input, Outcome, Standing};
use crate::cli::report::{self, progress::Progress, text::Reporter};
use crate::cli::{Exit, Failure, print, say, stamp, store, tree, write};
use crate::config::Settings;
use crate::diagnostic::{Finding, Severity};
use crate::evidence::policy::baseline::Baseline;
use crate::pipeline;
use crate::text::Files;

pub(crate) fn run(args: &CheckArgs) -> Result<Exit, Failure> {
    let progress = Progress::new(args.tree.quiet);
    let dir = tree::folder(&args.tree.dir)?;
    let (mut project, settings) = tree::read(&args.tree, None, &progress)?;
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
        Format::Text => print_text(&outcome),
        format => print(&report::render(&outcome, format)?),
    }
    if !args.tree.quiet {
        say(&totals(&outcome));
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

fn print_text(outcome: &Outcome<'_>) {
    let colour = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    let reporter = Reporter::new(colour);
    let mut out = String::new();
    for reported in outcome.new_ones() {
        out.push_str(&reporter.render(reported.finding, outcome.files));
        out.push_str("\n\n");
        if out.len() > 1 << 16 {
            print(&out);
            out.clear();
        }
    }
    print(&out);
}

fn totals(outcome: &Outcome<'_>) -> String {
    let [errors, warnings, infos] =
        [Severity::Error, Severity::Warning, Severity::Info].map(|severity| outcome.count(severity, "new"));
    let mut out =
        format!("{errors} errors, {warnings} warnings, {infos} infos; `rungbook explain CODE` tells what one means\n");
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
    for line in &outcome.gate {
        let mark = if line.passed { "passed" } else { "failed" };
        out.push_str(&format!("gate {}: {mark}: wanted {}, found {}\n", line.key, line.wanted, line.found));
    }
    out
}

/// Prints findings for people.
pub(crate) fn print_findings(findings: &[Finding], files: &Files) {
    let colour = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    let reporter = Reporter::new(colour);
    for finding in findings {
        print(&format!("{}\n\n", reporter.render(finding, files)));
    }
}

/// How many findings there are, in a line.
pub(crate) fn count(findings: &[Finding]) -> String {
    let count = |severity| findings.iter().filter(|finding| finding.severity == severity).count();
    let [errors, warnings, infos] = [Severity::Error, Severity::Warning, Severity::Info].map(count);
    format!("{errors} errors, {warnings} warnings, {infos} infos; `rungbook explain CODE` tells what one means")
}
