//! What `check` found, once for all formats, so that their totals agree.

use std::collections::{BTreeMap, BTreeSet};

use crate::audit;
use crate::diagnostic::{Finding, Severity};
use crate::evidence::policy::allow::{Allowance, Allowed};
use crate::evidence::policy::baseline::{self, Baseline, State};
use crate::evidence::policy::gate::{self, Numbers};
use crate::evidence::record::{Answer, Record};
use crate::library::ItemKind;
use crate::pipeline::{Project, Stamp};
use crate::table::explain;
use crate::text::{Files, LineColumn, Place};

/// A finding, and whether it counts.
pub(crate) struct Reported<'a> {
    pub(crate) finding: &'a Finding,
    pub(crate) standing: Standing<'a>,
    pub(crate) fingerprint: String,
}

/// Whether a finding counts.
pub(crate) enum Standing<'a> {
    /// It does.
    New,
    /// The baseline has it.
    Old,
    /// Its rule is younger than the baseline.
    NewRule,
    /// The source allows it.
    Allowed(&'a Allowance),
}

impl Standing<'_> {
    pub(crate) const fn name(&self) -> &'static str {
        match self {
            Self::New => "new",
            Self::Old => "baseline",
            Self::NewRule => "new-rule",
            Self::Allowed(_) => "allowed",
        }
    }

    /// All names, in the order of reports.
    pub(crate) const NAMES: [&'static str; 4] = ["new", "baseline", "new-rule", "allowed"];
}

/// A table and what is known of it.
pub(crate) struct TableLine {
    pub(crate) name: String,
    pub(crate) block: String,
    pub(crate) file: String,
    pub(crate) line: u32,
    pub(crate) verdict: &'static str,
    pub(crate) detail: String,
    pub(crate) engine: String,
    pub(crate) rows: Vec<(String, String)>,
}

/// What `check` found.
pub(crate) struct Outcome<'a> {
    pub(crate) files: &'a Files,
    pub(crate) stamp: &'a Stamp,
    pub(crate) deny: Severity,
    pub(crate) findings: Vec<Reported<'a>>,
    pub(crate) tables: Vec<TableLine>,
    pub(crate) numbers: Numbers,
    pub(crate) gate: Vec<gate::Line>,
    /// Findings of the baseline that are gone.
    pub(crate) gone: usize,
}

/// What an outcome is made of.
pub(crate) struct Input<'a> {
    pub(crate) project: &'a Project,
    pub(crate) records: &'a [(Record, Answer)],
    pub(crate) stamp: &'a Stamp,
    pub(crate) deny: Severity,
    pub(crate) gate: &'a gate::Options,
    pub(crate) baseline: Option<&'a Baseline>,
}

impl<'a> Outcome<'a> {
    pub(crate) fn new(input: &Input<'a>) -> Self {
        let project = input.project;
        let (findings, gone) = reported(project, input.baseline);
        let numbers = numbers(project, input.records);
        Self {
            files: &project.files,
            stamp: input.stamp,
            deny: input.deny,
            tables: project
                .tables
                .iter()
                .zip(input.records)
                .map(|(table, (record, _))| line(project, table, record))
                .collect(),
            gate: gate::judge(input.gate, &numbers),
            numbers,
            findings,
            gone,
        }
    }

    /// Findings of a severity and standing.
    pub(crate) fn count(&self, severity: Severity, standing: &str) -> usize {
        let same = |f: &&Reported<'_>| f.finding.severity == severity && f.standing.name() == standing;
        self.findings.iter().filter(same).count()
    }

    /// Findings that count.
    pub(crate) fn new_ones(&self) -> impl Iterator<Item = &Reported<'a>> {
        self.findings.iter().filter(|reported| matches!(reported.standing, Standing::New))
    }

    /// Whether a finding makes `check` fail.
    pub(crate) fn denies(&self, reported: &Reported<'_>) -> bool {
        matches!(reported.standing, Standing::New) && reported.finding.severity >= self.deny
    }

    pub(crate) fn failed(&self) -> bool {
        self.findings.iter().any(|reported| self.denies(reported)) || self.gate.iter().any(|line| !line.passed)
    }

    pub(crate) fn path(&self, finding: &Finding) -> &'a str {
        &self.files.get(finding.place.file).path
    }

    pub(crate) fn at(&self, finding: &Finding) -> LineColumn {
        self.files.line_column(finding.place)
    }

    /// Rounded down, so that 100 means all.
    pub(crate) fn percent(part: usize, whole: usize) -> usize {
        (part * 100).checked_div(whole).unwrap_or(100)
    }
}

/// All findings with their standing, and how many of the baseline are gone.
fn reported<'a>(project: &'a Project, baseline: Option<&Baseline>) -> (Vec<Reported<'a>>, usize) {
    let prints = baseline::fingerprints(&project.findings, &project.files);
    let (states, gone) = match baseline {
        Some(baseline) => baseline.compare(&project.findings, &project.files),
        None => (vec![State::New; project.findings.len()], 0),
    };
    let own = project.findings.iter().zip(states).zip(prints).map(|((finding, state), fingerprint)| {
        let standing = match state {
            State::New => Standing::New,
            State::Old => Standing::Old,
            State::NewRule => Standing::NewRule,
        };
        Reported { finding, standing, fingerprint }
    });
    let passed: Vec<Finding> = project.allowed.iter().map(|allowed| allowed.finding.clone()).collect();
    let prints = baseline::fingerprints(&passed, &project.files);
    let allowed = project.allowed.iter().zip(prints).map(|(Allowed { finding, allowance }, fingerprint)| Reported {
        finding,
        standing: Standing::Allowed(allowance),
        fingerprint,
    });
    (own.chain(allowed).collect(), gone)
}

/// What the gate looks at.
pub(crate) fn numbers(project: &Project, records: &[(Record, Answer)]) -> Numbers {
    let described = project.catalogue.iter().filter(|(_, item)| !item.kind.is_accessor());
    let (mut entities, mut documented) = (0, 0);
    for (id, item) in described {
        entities += 1;
        documented += usize::from(item.kind == ItemKind::Task || project.docs.item(id).doc.is_some());
    }
    let mut verdicts: BTreeMap<String, usize> = BTreeMap::new();
    for (record, _) in records {
        *verdicts.entry(record.verdict.word().to_owned()).or_default() += 1;
    }
    let is_bare = |allowed: &&Allowed| allowed.allowance.owner.is_empty() || allowed.allowance.until.is_empty();
    let bare: BTreeSet<Place> = project.allowed.iter().filter(is_bare).map(|allowed| allowed.allowance.place).collect();
    let named =
        |place: Place| format!("{}:{}", project.files.get(place.file).path, project.files.line_column(place).line);
    let proves_nothing = |answer: &Answer| {
        let coverage = answer.coverage.as_ref().filter(|_| answer.verdict.word() == "verified");
        coverage.is_some_and(|coverage| !coverage.vacuous.is_empty())
    };
    Numbers {
        entities,
        documented,
        tables: records.len(),
        verdicts,
        vacuous: records.iter().filter(|(_, answer)| proves_nothing(answer)).count(),
        allowed_without_owner: bare.into_iter().map(named).collect(),
        breaking: None,
        lost: None,
    }
}

fn line(project: &Project, attached: &crate::table::AttachedTable, record: &Record) -> TableLine {
    let table = &attached.table;
    let rows = table.rows().into_iter().map(|row| row.id.clone()).zip(explain::sentences(table));
    TableLine {
        name: table.name.clone(),
        block: attached.item.map_or_else(String::new, |item| project.catalogue.qualified_name(item)),
        file: project.files.get(table.place.file).path.clone(),
        line: project.files.line_column(table.place).line,
        verdict: record.verdict.word(),
        detail: record.verdict.detail(),
        engine: record.engine.clone(),
        rows: rows.collect(),
    }
}

/// The codes that occur, by name.
pub(crate) fn codes_of(outcome: &Outcome<'_>) -> Vec<&'static crate::diagnostic::Code> {
    let mut names: Vec<&str> = outcome.findings.iter().map(|reported| reported.finding.code.name).collect();
    names.sort_unstable();
    names.dedup();
    names.into_iter().filter_map(audit::code).collect()
}
