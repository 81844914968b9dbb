//! From the catalogue to its documentation, item by item.

use rayon::prelude::*;

use super::comment::{self, Marker};
use super::conventions::{self, Draft, Part};
use super::inherit;
use super::judge;
use super::links::Index;
use super::mapped::Mapped;
use super::markdown::Reader;
use super::model::{Considered, Convention, Docs, Documentation, Entry, ParamTag, Reason, Tags, Verdict};
use super::options::Options;
use super::placement::{Candidate, Habit, choose_for_item, choose_for_variable};
use super::prose::{Block, Inline};
use super::tables::{self, Tables};
use crate::library::names::Names;
use crate::library::{Catalogue, Comment, Item, ItemId, Placement, Pragma, Variable};
use crate::text::Place;

mod brief;
mod tags;

/// Reads the documentation of all items and variables of `catalogue`, whose names are `names`.
#[must_use]
pub fn read(catalogue: &Catalogue, names: &Names, options: &Options) -> Docs {
    let index = Index::new(catalogue, names);
    let ids: Vec<ItemId> = catalogue.iter().map(|(id, _)| id).collect();
    let read = ids.par_iter().map(|id| read_item(catalogue, &index, *id, options));
    let (items, variables) = read.collect::<Vec<_>>().into_iter().unzip();
    let mut docs = Docs { items, variables };
    inherit::inherit(catalogue, &mut docs);
    docs
}

/// What it takes to read the documentation of one item.
struct Context<'a> {
    catalogue: &'a Catalogue,
    reader: Reader<'a>,
    options: &'a Options,
}

fn read_item(catalogue: &Catalogue, index: &Index<'_>, id: ItemId, options: &Options) -> (Entry, Vec<Entry>) {
    let item = catalogue.item(id);
    let context = Context { catalogue, reader: Reader { index, scope: Some(id) }, options };
    let mut candidates = context.candidates(&item.comments, &item.name);
    choose_for_item(&mut candidates, item.kind, options);
    let entry = context.entry(candidates, &item.name, &item.pragmas);
    let habits: Vec<Candidates> =
        item.variables.iter().map(|variable| context.candidates(&variable.comments, &variable.name)).collect();
    let habit = habit(&habits);
    let mut variables: Vec<Entry> = habits
        .into_iter()
        .zip(&item.variables)
        .map(|(candidates, variable)| context.variable(candidates, variable, habit))
        .collect();
    if let Some(doc) = &entry.doc {
        describe_variables(doc, id, item, &mut variables);
    }
    (entry, variables)
}

type Candidates = Vec<Candidate>;

/// How the variables of an item are documented.
fn habit(all: &[Candidates]) -> Habit {
    let mut habit = Habit::default();
    for candidates in all {
        let has = |above: bool| {
            candidates.iter().any(|c| {
                c.prose.is_ok() && !(above && c.chunk.set_apart) && (c.chunk.placement == Placement::Above) == above
            })
        };
        habit.above += usize::from(has(true) && !has(false));
        habit.behind += usize::from(has(false) && !has(true));
    }
    habit
}

impl Context<'_> {
    fn candidates(&self, comments: &[Comment], name: &str) -> Candidates {
        let chunks = comments.iter().flat_map(|comment| comment::chunks(self.catalogue, comment));
        let judged = chunks.map(|chunk| {
            let judged = judge::judge(&chunk, name);
            Candidate { prose: judged.prose, history: judged.history, chunk }
        });
        judged.collect()
    }

    fn variable(&self, mut candidates: Candidates, variable: &Variable, habit: Habit) -> Entry {
        choose_for_variable(&mut candidates, habit, self.options);
        join_lines(&mut candidates);
        self.entry(candidates, &variable.name, &variable.pragmas)
    }

    /// The documentation in what was left open of `candidates`.
    fn entry(&self, candidates: Candidates, name: &str, pragmas: &[Pragma]) -> Entry {
        let mut entry = Entry { obsolete: obsolete(pragmas), ..Entry::default() };
        let mut draft = Draft::default();
        let mut found = Tables::default();
        let mut places = Vec::new();
        let mut first: Option<(Convention, Placement)> = None;
        for candidate in candidates {
            let Candidate { chunk, prose, history } = candidate;
            draft.history.extend(history);
            let verdict = match prose {
                Ok(prose) => {
                    let rest = tables::cut(&prose, &mut found);
                    let used = conventions::read(&rest, chunk.marker, self.options.profile, &mut draft);
                    first.get_or_insert((used, chunk.placement));
                    places.push(chunk.place);
                    Verdict::Taken(used)
                }
                Err(reason) => {
                    if reason == Reason::Placeholder {
                        entry.placeholder.get_or_insert(chunk.place);
                    }
                    Verdict::Rejected(reason)
                }
            };
            entry.considered.push(Considered { placement: chunk.placement, place: chunk.place, verdict });
        }
        if first.is_none() {
            first = self.pragma_text(pragmas, &mut draft, &mut places);
        }
        let has_history = !draft.history.is_empty();
        if let Some((convention, placement)) = first.or_else(|| {
            // A history alone is worth keeping.
            has_history.then_some((Convention::Markdown, Placement::AfterSections))
        }) {
            let doc = self.document(draft, found, name);
            let doc = Documentation { convention, placement, places, ..doc };
            self.settle(doc, name, &mut entry);
        }
        entry
    }

    /// Takes `doc` unless all that it says is a placeholder.
    fn settle(&self, doc: Documentation, name: &str, entry: &mut Entry) {
        let silent = doc.detail.is_empty() && judge::is_placeholder(&doc.brief_text(), name);
        let tagged = doc.tags != Tags::default() || !doc.tables.is_empty();
        if silent && !doc.brief.is_empty() {
            entry.placeholder = entry.placeholder.or(doc.place());
            for considered in &mut entry.considered {
                if matches!(considered.verdict, Verdict::Taken(_)) && !tagged {
                    considered.verdict = Verdict::Rejected(Reason::Placeholder);
                }
            }
        }
        if !silent {
            entry.doc = Some(doc);
        } else if tagged {
            entry.doc = Some(Documentation { brief: Vec::new(), ..doc });
        }
    }

    /// The description that a pragma holds.
    fn pragma_text(
        &self,
        pragmas: &[Pragma],
        draft: &mut Draft,
        places: &mut Vec<Place>,
    ) -> Option<(Convention, Placement)> {
        for (text, place) in pragmas.iter().flat_map(conventions::description) {
            let mut mapped = Mapped::new(place.file);
            mapped.push(&text, place.span.start);
            let mapped = mapped.within(place);
            conventions::read(&mapped, Marker::None, Some(Convention::Neuron), draft);
            places.push(place);
        }
        (!places.is_empty()).then_some((Convention::Neuron, Placement::Trailing))
    }

    /// Reads a draft as Markdown.
    fn document(&self, draft: Draft, found: Tables, name: &str) -> Documentation {
        let mut detail = Vec::new();
        let single =
            draft.parts.first().is_some_and(|part| matches!(part, Part::Text(text) if brief::is_one_line(text)));
        for part in &draft.parts {
            match part {
                Part::Text(text) => detail.extend(self.reader.blocks(text)),
                Part::Note { style, title, text } => detail.push(Block::Note {
                    style: (*style).to_owned(),
                    title: title.clone(),
                    content: self.reader.blocks(text),
                }),
            }
        }
        let brief = match &draft.brief {
            Some(text) => {
                let mut blocks = self.reader.blocks(text);
                let brief = brief::take_paragraph(&mut blocks);
                detail.splice(0..0, blocks);
                brief
            }
            None => brief::take(&mut detail, name, single),
        };
        let mut tags = tags::read(&self.reader, draft);
        tags.gtt_paths = found.paths;
        Documentation {
            brief,
            detail,
            tags,
            tables: found.tables,
            convention: Convention::Markdown,
            placement: Placement::Above,
            places: Vec::new(),
        }
    }
}

/// Makes the lines below a variable one text with the comment behind it.
fn join_lines(candidates: &mut Candidates) {
    let behind = |candidate: &Candidate| matches!(candidate.chunk.placement, Placement::Trailing | Placement::Below);
    let mut i = 1;
    while i < candidates.len() {
        let joins = behind(&candidates[i - 1]) && candidates[i].chunk.placement == Placement::Below;
        if joins && candidates[i - 1].prose.is_ok() && candidates[i].prose.is_ok() {
            let below = candidates.remove(i);
            let above = &mut candidates[i - 1];
            if let (Ok(text), Ok(more)) = (&mut above.prose, below.prose) {
                text.add("\n");
                text.append_all(&more);
            }
            above.chunk.place.span = above.chunk.place.span.cover(below.chunk.place.span);
        } else {
            i += 1;
        }
    }
}

/// The pragma that calls a declaration obsolete.
fn obsolete(pragmas: &[Pragma]) -> Option<(String, Place)> {
    pragmas.iter().find_map(|pragma| {
        let (name, value) = pragma.attribute()?;
        name.eq_ignore_ascii_case("obsolete").then(|| (value.to_owned(), pragma.place))
    })
}

/// Gives variables without a comment what the tags of their item say of them; adds it to the detail of others.
fn describe_variables(doc: &Documentation, id: ItemId, item: &Item, variables: &mut [Entry]) {
    for param in &doc.tags.params {
        let Some((_, i)) = param.target.filter(|(owner, _)| *owner == id) else { continue };
        let Some(entry) = variables.get_mut(i) else { continue };
        match &mut entry.doc {
            Some(own) => {
                if Inline::plain(&own.brief) != Block::plain(&param.content).trim() {
                    own.detail.extend(param.content.iter().cloned());
                }
            }
            None => entry.doc = described(param, doc, &item.variables[i].name),
        }
    }
}

fn described(param: &ParamTag, doc: &Documentation, name: &str) -> Option<Documentation> {
    let mut detail = param.content.clone();
    let brief = brief::take(&mut detail, name, true);
    (!brief.is_empty() || !detail.is_empty()).then(|| Documentation {
        brief,
        detail,
        tags: Tags::default(),
        tables: Vec::new(),
        convention: doc.convention,
        placement: doc.placement,
        places: vec![param.place],
    })
}
