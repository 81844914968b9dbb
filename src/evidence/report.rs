//! The evidence report, as a page in Markdown that the manual shows and the typesetter sets.

use std::collections::{BTreeMap, BTreeSet};

use super::coverage::{Coverage, Fate, Item, Kind, Mutant};
use super::diff::Comparison;
use super::policy::allow::Allowed;
use super::record::{Origin, Record, Verdict};
use super::results::Outside;
use super::trace::{Line, State};

/// The path of the page among the narrative pages.
pub const PATH: &str = "rungbook/evidence.md";

/// What the report tells of.
#[derive(Debug)]
pub struct Input<'a> {
    /// Title of what is released.
    pub title: &'a str,
    /// Its version; empty if unknown.
    pub version: &'a str,
    /// Who made the records, from what.
    pub origin: &'a Origin,
    /// The records.
    pub records: &'a [&'a Record],
    /// Entities, members included, and those with documentation.
    pub documented: (usize, usize),
    /// Kind and name of entities without documentation.
    pub undocumented: &'a [(String, String)],
    /// Findings that pass.
    pub allowed: &'a [Allowed],
    /// The traceability matrix.
    pub matrix: &'a [Line],
    /// Results of other tools, each with the block that it belongs to, if there is one.
    pub outside: &'a [(Outside, Option<String>)],
    /// What changed since the previous release, if one is compared.
    pub changes: Option<&'a Comparison>,
    /// Roles with names.
    pub sign_off: &'a [(String, String)],
}

/// The page.
#[must_use]
pub fn markdown(input: &Input<'_>) -> String {
    let mut out = String::from("# Evidence\n\n");
    sign_off(input, &mut out);
    scope(input, &mut out);
    claims(input, &mut out);
    tables(input, &mut out);
    uncovered(input, &mut out);
    holes(input, &mut out);
    assumptions(input, &mut out);
    traceability(input, &mut out);
    outside(input, &mut out);
    allowances(input, &mut out);
    if let Some(changes) = input.changes {
        out.push_str("## Changes since the previous release\n\n");
        out.push_str(&super::changelog::body(changes, "###"));
    }
    again(input, &mut out);
    out
}

/// Text in a cell of a table, or in a line of prose.
pub(super) fn cell(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '\\' | '|' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '~' | '#' | '$' => {
                out.push('\\');
                out.push(c);
            }
            '\n' | '\r' => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

fn or<'a>(text: &'a str, other: &'a str) -> &'a str {
    if text.is_empty() { other } else { text }
}

fn row(out: &mut String, cells: &[&str]) {
    out.push_str(&format!("| {} |\n", cells.join(" | ")));
}

fn head(out: &mut String, cells: &[&str]) {
    row(out, cells);
    out.push_str(&format!("|{}\n", "---|".repeat(cells.len())));
}

fn sign_off(input: &Input<'_>, out: &mut String) {
    out.push_str("## Sign-off\n\n");
    head(out, &["role", "name", "date", "signature"]);
    for (role, name) in input.sign_off {
        row(out, &[&cell(role), or(&cell(name), "…………………………"), "……………", "…………………………"]);
    }
    out.push('\n');
}

fn scope(input: &Input<'_>, out: &mut String) {
    out.push_str("## Scope\n\n");
    head(out, &["", ""]);
    let origin = input.origin;
    for (name, value) in [
        ("what", input.title),
        ("version", or(input.version, "not stated")),
        ("commit", or(&origin.commit, "not known")),
        ("date", &origin.date),
        ("tool", &origin.tool),
        ("run by", or(&origin.author, "not known")),
    ] {
        row(out, &[name, &cell(value)]);
    }
    if origin.commit.ends_with('+') {
        out.push_str("\nThe sources had changes on top of this commit; the digests tell what they were.\n");
    }
    out.push('\n');
}

fn counts(records: &[&Record]) -> BTreeMap<&'static str, usize> {
    let mut counts = BTreeMap::new();
    for record in records {
        *counts.entry(record.verdict.word()).or_default() += 1;
    }
    counts
}

fn meaning(word: &str) -> &'static str {
    match word {
        "verified" => "the block conforms to the table in runs of every length; a certificate is attached",
        "violated" => "there is a run in which the block does not do what the table says; it is attached",
        "bounded" => "no violation in the first cycles; nothing is claimed beyond them",
        "unsupported" => "the block or the table uses something that is not modelled; nothing is claimed",
        "unusable" => "the table has errors or belongs to no block; nothing is claimed",
        "stale" => "the sources changed since there was a verdict; nothing is claimed",
        _ => "nothing was tried; nothing is claimed",
    }
}

fn claims(input: &Input<'_>, out: &mut String) {
    out.push_str("## What is claimed\n\n");
    let counts = counts(input.records);
    head(out, &["verdict", "tables", "what it claims"]);
    for word in Verdict::WORDS {
        if let Some(count) = counts.get(word) {
            row(out, &[word, &count.to_string(), meaning(word)]);
        }
    }
    let (documented, entities) = input.documented;
    out.push_str(&format!("\n{documented} of {entities} entities are documented.\n\n"));
    out.push_str(
        "Only *verified* is evidence. It says that in every run that the table covers, for all inputs that the table admits, \
         the block never gives outputs that the table forbids, by the rules of IEC 61131-3, in cycles of equal length. It does \
         not say that the table is what was wanted, that the block behaves well in runs that no table covers, that a compiler or \
         a controller has no fault, or that a machine is safe.\n\n",
    );
}

fn tables(input: &Input<'_>, out: &mut String) {
    out.push_str("## Table by table\n\n");
    if input.records.is_empty() {
        out.push_str("There is no test table.\n\n");
        return;
    }
    head(out, &["block", "table", "verdict", "covered", "engine", "record"]);
    for record in input.records {
        let block = record.claim.block.as_ref().map_or_else(String::new, |block| cell(&block.name));
        let covered = record.coverage.as_ref().map_or_else(String::new, covered);
        let verdict = format!("**{}**", record.verdict.word());
        let key = format!("`{}`", record.key.short());
        row(out, &[&block, &cell(&record.claim.table.name), &verdict, &covered, &cell(&record.engine), &key]);
    }
    out.push('\n');
}

/// What a proof covered, in a cell.
fn covered(coverage: &Coverage) -> String {
    let vacuous = coverage.vacuous.iter().map(|reason| format!("**proves nothing:** {}; ", cell(reason)));
    vacuous.collect::<String>() + &cell(&coverage.line())
}

/// What of a block no run within any of its verified tables reaches, and which changes none of them notices. What one table
/// leaves out and another one covers is no hole: each table's own share stands in its line above.
fn uncovered(input: &Input<'_>, out: &mut String) {
    let mut blocks: BTreeMap<String, Vec<(&Record, &Coverage)>> = BTreeMap::new();
    for record in input.records {
        if let (Some(block), Some(coverage)) = (&record.claim.block, &record.coverage) {
            blocks.entry(block.name.clone()).or_default().push((record, coverage));
        }
    }
    let rows: Vec<[String; 4]> = blocks.iter().flat_map(|(block, tables)| holes_of(block, tables)).collect();
    if rows.is_empty() {
        return;
    }
    out.push_str("## What verified tables do not cover\n\n");
    out.push_str(
        "A row that no run of its table reaches; a statement or a way of a branch that no run within any verified table of the \
         block reaches; a change to the block that none of them notices.\n\n",
    );
    head(out, &["block", "what", "where", "fate"]);
    for [block, what, place, fate] in &rows {
        row(out, &[&cell(block), &cell(what), &cell(place), &cell(fate)]);
    }
    out.push('\n');
}

/// A line for each hole of a block: what it is in, what it is, where, and what is known of it.
fn holes_of(block: &str, tables: &[(&Record, &Coverage)]) -> Vec<[String; 4]> {
    let mut out = Vec::new();
    for (record, coverage) in tables {
        for item in coverage.missed().filter(|item| item.kind == Kind::Row) {
            let place = format!("{}:{}", item.file, item.line);
            out.push([record.claim.subject(), format!("row {}", item.name), place, item.fate.text()]);
        }
    }
    let reached = |item: &Item| {
        tables.iter().any(|(_, coverage)| {
            let same = |other: &&Item| other.kind == item.kind && other.line == item.line && other.name == item.name;
            let found = coverage.items.iter().find(|other| same(other) && other.file == item.file);
            found.is_some_and(|other| matches!(other.fate, Fate::Reached { .. }))
        })
    };
    let mut seen = BTreeSet::new();
    for item in tables.iter().flat_map(|(_, coverage)| coverage.missed()) {
        let kind = match item.kind {
            Kind::Row => continue,
            Kind::Statement => "statement",
            Kind::Branch => "branch",
        };
        let place = format!("{}:{}", item.file, item.line);
        if !reached(item) && seen.insert((kind, item.name.clone(), place.clone())) {
            let fate = if tables.len() == 1 { item.fate.text() } else { "by none of its tables".to_owned() };
            out.push([block.to_owned(), format!("{kind} {}", item.name), place, fate]);
        }
    }
    let with_mutants: Vec<_> = tables.iter().filter_map(|(_, coverage)| coverage.mutants.as_ref()).collect();
    let Some((one, others)) = with_mutants.split_first() else { return out };
    for mutant in one.survivors() {
        let same =
            |other: &&Mutant| (other.line, &other.file, &other.change) == (mutant.line, &mutant.file, &mutant.change);
        if others.iter().all(|mutants| mutants.survivors().any(|other| same(&other))) {
            let place = format!("{}:{}", mutant.file, mutant.line);
            out.push([block.to_owned(), format!("mutant {}", mutant.change), place, mutant.outcome.text()]);
        }
    }
    out
}

fn holes(input: &Input<'_>, out: &mut String) {
    out.push_str("## What is not verified\n\n");
    let mut none = true;
    for record in input.records.iter().filter(|record| record.verdict != Verdict::Verified) {
        none = false;
        let detail = record.verdict.detail();
        let detail = if detail.is_empty() { String::new() } else { format!(": {}", cell(&detail)) };
        out.push_str(&format!("* {}: **{}**{detail}\n", cell(&record.claim.subject()), record.verdict.word()));
    }
    out.push_str(if none { "Every table is verified.\n\n" } else { "\n" });
    out.push_str("## What is not documented\n\n");
    for (kind, name) in input.undocumented {
        out.push_str(&format!("* {} {}\n", cell(kind), cell(name)));
    }
    out.push_str(if input.undocumented.is_empty() { "Everything is documented.\n\n" } else { "\n" });
}

fn assumptions(input: &Input<'_>, out: &mut String) {
    out.push_str("## Assumptions and stubs\n\n");
    let mut by_text: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for record in input.records {
        for text in record.claim.assumptions.iter().chain(&record.rests_on) {
            by_text.entry(text).or_default().push(record.claim.subject());
        }
    }
    if by_text.is_empty() {
        out.push_str("None beyond the input columns of the tables.\n\n");
        return;
    }
    out.push_str("Besides the input columns of the tables, which are assumptions:\n\n");
    for (text, subjects) in by_text {
        out.push_str(&format!("* {} (in {})\n", cell(text), cell(&subjects.join("; "))));
    }
    out.push('\n');
}

fn traceability(input: &Input<'_>, out: &mut String) {
    if input.matrix.is_empty() {
        return;
    }
    out.push_str("## Traceability\n\n");
    head(out, &["requirement", "title", "block", "table", "verdict", "state"]);
    for line in input.matrix {
        let (id, title) = (cell(&line.requirement.id), cell(&line.requirement.title));
        let state = match line.state {
            State::Justified => format!("{}: {}", line.state.word(), cell(&line.requirement.justification)),
            State::Hole => format!("**{}**", line.state.word()),
            state => state.word().to_owned(),
        };
        if line.blocks.is_empty() {
            row(out, &[&id, &title, "", "", "", &state]);
        }
        for (n, block) in line.blocks.iter().enumerate() {
            let first = |text: &str| if n == 0 { text.to_owned() } else { String::new() };
            let tables: Vec<String> = block.tables.iter().map(|(name, _)| cell(name)).collect();
            let verdicts: Vec<&str> = block.tables.iter().map(|(_, verdict)| *verdict).collect();
            let none = if tables.is_empty() { "no table" } else { "" };
            row(
                out,
                &[
                    &first(&id),
                    &first(&title),
                    &cell(&block.name),
                    &format!("{}{none}", tables.join("; ")),
                    &verdicts.join("; "),
                    &first(&state),
                ],
            );
        }
    }
    let count = |state| input.matrix.iter().filter(|line| line.state == state).count();
    out.push_str(&format!(
        "\n{} verified, {} not verified, {} violated, {} justified exceptions, {} holes.\n\n",
        count(State::Verified),
        count(State::Open),
        count(State::Violated),
        count(State::Justified),
        count(State::Hole),
    ));
}

fn outside(input: &Input<'_>, out: &mut String) {
    if input.outside.is_empty() {
        return;
    }
    out.push_str("## Results of other tools\n\nAs these tools reported them. rungbook has checked none of this, and none of it counts as *verified*.\n\n");
    head(out, &["block", "suite", "case", "outcome", "tool", "file"]);
    for (result, block) in input.outside {
        let block = block.as_deref().unwrap_or("");
        let outcome = or(&result.outcome, "not stated");
        row(
            out,
            &[block, &result.suite, &result.case, outcome, &result.tool, &result.file]
                .map(cell)
                .each_ref()
                .map(String::as_str),
        );
    }
    out.push('\n');
}

fn allowances(input: &Input<'_>, out: &mut String) {
    if input.allowed.is_empty() {
        return;
    }
    out.push_str("## Findings that are allowed\n\n");
    head(out, &["finding", "what", "reason", "owner", "until"]);
    for allowed in input.allowed {
        let allowance = &allowed.allowance;
        let cells = [
            allowed.finding.code.name,
            &allowed.finding.message,
            &allowance.reason,
            &allowance.owner,
            &allowance.until,
        ];
        row(out, &cells.map(cell).each_ref().map(String::as_str));
    }
    out.push('\n');
}

fn again(input: &Input<'_>, out: &mut String) {
    let tool = cell(&input.origin.tool);
    out.push_str(&format!(
        "## Tool, and how to check again\n\nMade by {tool}. What it consists of is listed in `sbom.cdx.json` (CycloneDX) in the \
         release bundle.\n\n```sh\nrungbook evidence verify release.zip --key signer.pub\n```\n\nThis needs no network. It checks the \
         signature, the manifest, every digest and every record, and checks every certificate and every run again. Without rungbook: \
         `unzip` opens the bundle, `sha256sum` gives the digests that `manifest.json` lists, and\n\n```sh\nssh-keygen -Y verify -f \
         allowed_signers -I rungbook -n rungbook -s statement.json.sig < statement.json\n```\n\nchecks the signature.\n"
    ));
}
