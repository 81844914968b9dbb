//! `rungbook check`: prints findings, and fails if one is bad enough.

use std::io::IsTerminal;

use crate::cli::args::{CheckArgs, Format, Level};
use crate::cli::report::{json, progress::Progress, text::Reporter};
use crate::cli::{Exit, Failure, print, say, tree};
use crate::diagnostic::{Finding, Severity};
use crate::text::Files;

pub(crate) fn run(args: &CheckArgs) -> Result<Exit, Failure> {
    let progress = Progress::new(args.tree.quiet);
    let (project, settings) = tree::read(&args.tree, None, &progress)?;
    let deny = args.deny.map_or(settings.deny, severity);
    let failed = project.findings.iter().any(|finding| finding.severity >= deny);
    match args.format {
        Format::Json => print(&format!("{}\n", json::render(&project.findings, &project.files, failed))),
        Format::Text => print_text(&project.findings, &project.files),
    }
    if !args.tree.quiet {
        say(&totals(&project.findings));
    }
    Ok(if failed { Exit::Findings } else { Exit::Ok })
}

pub(crate) const fn severity(level: Level) -> Severity {
    match level {
        Level::Info => Severity::Info,
        Level::Warning => Severity::Warning,
        Level::Error => Severity::Error,
    }
}

/// Prints findings for people.
pub(crate) fn print_text(findings: &[Finding], files: &Files) {
    let colour = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty());
    let reporter = Reporter::new(colour);
    let mut out = String::new();
    for finding in findings {
        out.push_str(&reporter.render(finding, files));
        out.push_str("\n\n");
        if out.len() > 1 << 16 {
            print(&out);
            out.clear();
        }
    }
    print(&out);
}

pub(crate) fn totals(findings: &[Finding]) -> String {
    let count = |severity| findings.iter().filter(|finding| finding.severity == severity).count();
    let [errors, warnings, infos] = [Severity::Error, Severity::Warning, Severity::Info].map(count);
    format!("{errors} errors, {warnings} warnings, {infos} infos; `rungbook explain CODE` tells what one means")
}
