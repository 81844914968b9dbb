//! `rungbook diff`: compares two releases, and fails on what the gate denies.

use crate::cli::args::{DiffArgs, DiffFormat};
use crate::cli::report::diff;
use crate::cli::{Exit, Failure, print, release, say, tree};
use crate::evidence::diff::{Comparison, compare};
use crate::evidence::policy::gate::{self, Numbers};
use crate::evidence::{changelog, digest};

pub(crate) fn run(args: &DiffArgs) -> Result<Exit, Failure> {
    let old = release::snapshot(&args.old, &args.dir)?;
    let new = release::snapshot(&args.new, &args.dir)?;
    let comparison = compare(&old, &new);
    let gate = gate(args, &comparison)?;
    match args.format {
        DiffFormat::Text => print(&diff::text(&comparison)),
        DiffFormat::Json => print(&String::from_utf8_lossy(&digest::canonical(&comparison))),
        DiffFormat::Markdown => print(&changelog::markdown(&comparison)),
        DiffFormat::Html => print(&diff::html(&comparison)),
    }
    if !args.quiet {
        say(&summary(&comparison, &gate));
    }
    Ok(if gate.iter().all(|line| line.passed) { Exit::Ok } else { Exit::Findings })
}

/// The lines of the gate that speak of comparisons: those of the newer folder's configuration, and those of the command line.
fn gate(args: &DiffArgs, comparison: &Comparison) -> Result<Vec<gate::Line>, Failure> {
    let new = std::path::Path::new(&args.new);
    let dir = if new.is_dir() { new } else { &args.dir };
    let configured = tree::settings(dir, None)?.gate;
    let options = gate::Options {
        no_breaking: configured.no_breaking || args.deny_breaking,
        no_lost_evidence: configured.no_lost_evidence || args.deny_lost_evidence,
        ..gate::Options::default()
    };
    let numbers =
        Numbers { breaking: Some(comparison.breaking()), lost: Some(comparison.lost.len()), ..Numbers::default() };
    Ok(gate::judge(&options, &numbers))
}

fn summary(comparison: &Comparison, gate: &[gate::Line]) -> String {
    let breaking = comparison.breaking();
    let mut out = format!(
        "{breaking} incompatible, {} compatible, {} of documentation, {} tables, {} lost evidence: a {} release\n",
        comparison.interface.len() - breaking,
        comparison.documentation.len(),
        comparison.tables.len(),
        comparison.lost.len(),
        comparison.advice.word(),
    );
    for line in gate {
        let mark = if line.passed { "passed" } else { "failed" };
        out.push_str(&format!("gate {}: {mark}: wanted {}, found {}\n", line.key, line.wanted, line.found));
    }
    out
}
