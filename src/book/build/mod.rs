//! From the catalogue and what is known of it to a [`Book`].

mod address;
mod aids;
mod coverage;
mod diagrams;
mod entity;
mod findings;
mod links;
mod lists;
mod narrative;
mod prose;
mod relations;
mod run;
mod signature;
mod sources;
mod tables;
mod variables;

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::view::entity::EntityView;
use super::view::finding::ReadingView;
use super::view::{Book, Front, Totals};
use crate::diagnostic::{Finding, Severity};
use crate::docs::{Docs, Narrator};
use crate::evidence::record::Answer;
use crate::library::names::Names;
use crate::library::relations::Relations;
use crate::library::{Catalogue, ItemId, ItemKind};
use crate::table::AttachedTable;
use crate::text::{FileId, Files};
use address::Addresses;

/// What a book is made of.
#[derive(Debug)]
pub struct Input<'a> {
    /// The title page.
    pub front: Front,
    /// The files.
    pub files: &'a Files,
    /// How many were read as source.
    pub source_files: usize,
    /// How many are no PLC source.
    pub other_files: usize,
    /// What they declare.
    pub catalogue: &'a Catalogue,
    /// What names mean.
    pub names: &'a Names,
    /// Who extends, implements and uses whom.
    pub relations: &'a Relations,
    /// What the comments say.
    pub docs: &'a Docs,
    /// The test tables.
    pub tables: &'a [AttachedTable],
    /// What is known of each table, in their order.
    pub answers: &'a [Answer],
    /// All findings, by file and place.
    pub findings: &'a [Finding],
    /// How the files were read, each way once.
    pub readings: &'a [ReadingView],
    /// Files that should be here and are not: path and reason.
    pub skipped: &'a [(String, String)],
    /// The narrative pages.
    pub narratives: &'a [Narrative],
}

/// A narrative page.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Narrative {
    /// Its path below the root.
    pub path: String,
    /// Its Markdown.
    pub text: String,
}

/// What the builders share.
pub(crate) struct Context<'a> {
    pub(crate) input: &'a Input<'a>,
    pub(crate) addresses: Addresses,
    tables: BTreeMap<ItemId, Vec<usize>>,
    findings: BTreeMap<FileId, Vec<usize>>,
    narratives: BTreeMap<String, String>,
    narrator: Narrator<'a>,
}

impl<'a> Context<'a> {
    fn new(input: &'a Input<'a>) -> Self {
        let mut tables: BTreeMap<ItemId, Vec<usize>> = BTreeMap::new();
        for (i, table) in input.tables.iter().enumerate() {
            if let Some(item) = table.item {
                tables.entry(input.catalogue.top(item)).or_default().push(i);
            }
        }
        let mut findings: BTreeMap<FileId, Vec<usize>> = BTreeMap::new();
        for (i, finding) in input.findings.iter().enumerate() {
            findings.entry(finding.place.file).or_default().push(i);
        }
        let addresses = Addresses::new(input.catalogue);
        Self {
            input,
            addresses,
            tables,
            findings,
            narratives: narrative::addresses(input.narratives),
            narrator: Narrator::new(input.catalogue, input.names),
        }
    }

    pub(crate) fn catalogue(&self) -> &'a Catalogue {
        self.input.catalogue
    }
}

/// The book.
#[must_use]
pub fn build(input: &Input<'_>) -> Book {
    let context = Context::new(input);
    let order = order(input.catalogue);
    let entities: Vec<EntityView> = order.par_iter().map(|id| entity::view(&context, *id)).collect();
    let coverage = coverage::coverage(&context, &order);
    let totals = totals(input, &coverage.total);
    Book {
        chapters: narrative::chapters(&context),
        libraries: lists::libraries(&context, &order),
        kinds: lists::kinds(&context, &order),
        index: lists::index(&context, &order),
        findings: input.findings.iter().map(|finding| findings::view(finding, input.files)).collect(),
        codes: findings::codes(input.findings),
        readings: input.readings.to_vec(),
        skipped: findings::skipped(input.skipped),
        externals: lists::externals(input.relations),
        explanations: narrative::explanations(&context),
        front: input.front.clone(),
        totals,
        coverage,
        entities,
    }
}

/// The top-level items: by library, folder, kind and name.
fn order(catalogue: &Catalogue) -> Vec<ItemId> {
    let rank = |kind: ItemKind| ItemKind::ALL.iter().position(|k| *k == kind);
    let mut order: Vec<ItemId> = catalogue.iter().filter(|(_, item)| item.parent.is_none()).map(|(id, _)| id).collect();
    order.sort_by_cached_key(|id| {
        let item = catalogue.item(*id);
        let folder: Vec<String> = item.folder.iter().map(|part| part.to_lowercase()).collect();
        (item.library, folder, rank(item.kind), item.name.to_lowercase(), *id)
    });
    order
}

fn totals(input: &Input<'_>, all: &super::view::coverage::CoverageRow) -> Totals {
    let count = |severity| input.findings.iter().filter(|finding| finding.severity == severity).count();
    let mut verdicts: Vec<(String, usize)> = Vec::new();
    for (index, table) in input.tables.iter().enumerate() {
        let key = tables::verdict(table, input.answers.get(index)).key;
        match verdicts.iter_mut().find(|(name, _)| name == key) {
            Some((_, n)) => *n += 1,
            None => verdicts.push((key.to_owned(), 1)),
        }
    }
    verdicts.sort();
    Totals {
        files: input.source_files,
        files_skipped: input.skipped.len(),
        files_other: input.other_files,
        libraries: input.catalogue.libraries.len(),
        entities: all.entities,
        documented: all.documented,
        undocumented: all.entities - all.documented,
        tables: input.tables.len(),
        verdicts,
        errors: count(Severity::Error),
        warnings: count(Severity::Warning),
        infos: count(Severity::Info),
    }
}
