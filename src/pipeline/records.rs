//! The claim of each table, with the digests of all that bears on it, and the records that answers make of them.

use std::collections::{BTreeMap, BTreeSet};

use super::{Project, Stamp};
use crate::evidence::digest::Digest;
use crate::evidence::record::{Answer, Claim, Origin, Part, Record, Verdict};
use crate::library::{Excerpt, ItemBody, ItemId, Target, TypeUse};
use crate::source::FileSystem;
use crate::syntax::TokenKind;
use crate::table::AttachedTable;
use crate::table::write;
use crate::text::FileId;

/// The version of the meaning that tables and programs are given; a change that can alter a verdict raises it.
pub const SEMANTICS: &str = "3";

/// The digests of files and items, each found once.
pub struct Digests<'a> {
    project: &'a Project,
    fs: &'a dyn FileSystem,
    files: BTreeMap<FileId, Digest>,
    items: BTreeMap<ItemId, Digest>,
}

impl std::fmt::Debug for Digests<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Digests").field("files", &self.files).finish_non_exhaustive()
    }
}

impl<'a> Digests<'a> {
    /// None yet; bytes are read from `fs`, the file system that `project` was read from.
    pub fn new(project: &'a Project, fs: &'a dyn FileSystem) -> Self {
        Self { project, fs, files: BTreeMap::new(), items: BTreeMap::new() }
    }

    /// The digest of a file's bytes; of its text, where it cannot be read any more.
    pub fn file(&mut self, id: FileId) -> Digest {
        let (project, fs) = (self.project, self.fs);
        *self.files.entry(id).or_insert_with(|| {
            let file = project.files.get(id);
            fs.read(&file.path, u64::MAX).map_or_else(|_| Digest::of(file.text.as_bytes()), Digest::of)
        })
    }

    /// The digest of an item with its members: its tokens without comments, layout and the case of names.
    pub fn item(&mut self, id: ItemId) -> Digest {
        if let Some(known) = self.items.get(&id) {
            return *known;
        }
        let mut words = Vec::new();
        self.words(id, &mut words);
        let digest = Digest::of_parts(words.iter().map(String::as_str));
        self.items.insert(id, digest);
        digest
    }

    fn words(&self, id: ItemId, out: &mut Vec<String>) {
        let catalogue = &self.project.catalogue;
        let item = catalogue.item(id);
        out.push(format!("{} {}", item.kind.key(), item.name.to_uppercase()));
        let body = match item.body {
            ItemBody::None => None,
            ItemBody::St(excerpt) | ItemBody::Il(excerpt) | ItemBody::Drawn(_, excerpt) => Some(excerpt),
        };
        for excerpt in item.declaration.into_iter().chain(body) {
            self.tokens(excerpt, out);
        }
        out.extend(item.properties.iter().map(|(key, value)| format!("{key}={value}")));
        for child in &item.children {
            self.words(*child, out);
        }
    }

    fn tokens(&self, excerpt: Excerpt, out: &mut Vec<String>) {
        let Some(tree) = self.project.catalogue.sources[excerpt.fragment.0 as usize].tree.as_deref() else {
            out.push(self.project.catalogue.excerpt(excerpt).to_owned());
            return;
        };
        let first = tree.token_at(excerpt.span.start);
        let tokens = std::iter::successors(first, |token| token.next());
        for token in tokens.take_while(|token| token.span().end <= excerpt.span.end) {
            let kind = token.kind();
            if kind.is_trivia() && kind != TokenKind::Pragma {
                continue;
            }
            let exact = matches!(kind, TokenKind::String | TokenKind::WString | TokenKind::Pragma);
            out.push(if exact { token.text().to_owned() } else { token.text().to_uppercase() });
        }
    }

    fn part(&mut self, id: ItemId) -> Part {
        let item = self.project.catalogue.item(id);
        Part {
            kind: item.kind.key().to_owned(),
            name: self.project.catalogue.qualified_name(id),
            file: self.project.files.get(item.place.file).path.clone(),
            raw: self.file(item.place.file),
            model: self.item(id),
        }
    }
}

/// What a table claims; `cycle_ns` and `options` are what the run was asked for beyond the table itself.
pub fn claim(
    digests: &mut Digests<'_>,
    table: &AttachedTable,
    cycle_ns: Option<u64>,
    options: BTreeMap<String, String>,
) -> Claim {
    let project = digests.project;
    let top = table.item.map(|item| project.catalogue.top(item));
    let cone = top.map(|top| cone(project, top)).unwrap_or_default();
    let text = write::gtt(&table.table).content;
    let own_cycle = table.table.options.cycle.and_then(|cycle| u64::try_from(cycle.nanos).ok());
    let externals = externals(project, top.into_iter().chain(cone.iter().copied()));
    let assumptions = externals.iter().map(|name| format!("`{name}` is declared in no file of the tree"));
    Claim {
        table: Part {
            kind: "table".to_owned(),
            name: table.table.name.clone(),
            file: project.files.get(table.table.place.file).path.clone(),
            raw: digests.file(table.table.place.file),
            model: Digest::of(text),
        },
        block: table.item.map(|item| digests.part(item)),
        assumptions: assumptions.collect(),
        externals: externals.into_iter().collect(),
        cone: cone.into_iter().map(|id| digests.part(id)).collect(),
        cycle_ns: cycle_ns.or(own_cycle),
        conformance: if table.table.options.strict || project.asked.strict { "strict" } else { "weak" }.to_owned(),
        options,
        semantics: SEMANTICS.to_owned(),
    }
}

/// The top-level items that `top` uses, directly or through others, without itself; in the order of their names.
#[must_use]
pub fn cone(project: &Project, top: ItemId) -> Vec<ItemId> {
    let catalogue = &project.catalogue;
    let mut seen = BTreeSet::from([top]);
    let mut open = vec![top];
    while let Some(id) = open.pop() {
        let item = catalogue.item(id);
        let used = project.relations.uses.get(&id).into_iter().flatten().copied();
        let bases = item.extends.iter().chain(&item.implements).filter_map(TypeUse::item);
        for next in used.chain(bases.map(|base| catalogue.top(base))) {
            if seen.insert(next) {
                open.push(next);
            }
        }
    }
    seen.remove(&top);
    let mut cone: Vec<ItemId> = seen.into_iter().collect();
    cone.sort_by_cached_key(|id| (catalogue.qualified_name(*id), *id));
    cone
}

/// The names of types in `items` that no file of the tree declares.
fn externals(project: &Project, items: impl Iterator<Item = ItemId>) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    let mut open: Vec<ItemId> = items.collect();
    while let Some(id) = open.pop() {
        let item = project.catalogue.item(id);
        open.extend(&item.children);
        let types = item.type_.iter().chain(item.variables.iter().filter_map(|variable| variable.type_.as_ref()));
        for use_ in types.chain(&item.extends).chain(&item.implements) {
            let external = use_.names.iter().filter(|(_, target)| *target == Target::External);
            names.extend(external.map(|(span, _)| span.of(&use_.text).to_owned()));
        }
    }
    names
}

/// What can be said of a table before anybody tries to prove it: *unusable* where it has errors or no block.
#[must_use]
pub fn unusable(table: &AttachedTable) -> Option<Answer> {
    let mut reasons: Vec<String> = table.errors.iter().map(|error| error.message.clone()).collect();
    if reasons.is_empty() && table.table.has_errors() {
        reasons.push("the table has errors".to_owned());
    }
    if table.item.is_none() {
        reasons.push("the table belongs to no block".to_owned());
    }
    (!reasons.is_empty()).then(|| Answer::without_engine(Verdict::Unusable { reasons }))
}

/// Where records come from.
#[must_use]
pub fn origin(stamp: &Stamp) -> Origin {
    Origin {
        tool: stamp.tool.clone(),
        commit: stamp.commit.clone(),
        date: stamp.date.clone(),
        author: stamp.author.clone(),
    }
}

/// The record and the artefact of each table, in their order; `answer` says what is known of a claim.
pub fn records(
    project: &Project,
    fs: &dyn FileSystem,
    stamp: &Stamp,
    answer: &mut dyn FnMut(&Claim, &AttachedTable) -> Answer,
) -> Vec<(Record, Answer)> {
    let mut digests = Digests::new(project, fs);
    let mut one = |table: &AttachedTable| {
        let (cycle, options) = super::ready::asked(project, &table.table);
        let claim = claim(&mut digests, table, Some(cycle), options);
        let answer = unusable(table).unwrap_or_else(|| answer(&claim, table));
        (Record::new(claim, &answer, origin(stamp)), answer)
    };
    project.tables.iter().map(&mut one).collect()
}
