//! Tags, read as Markdown and resolved.

use std::ops::Range;

use super::super::conventions::Draft;
use super::super::links::segments;
use super::super::mapped::{Mapped, trim};
use super::super::markdown::{Reader, flatten, is_external};
use super::super::model::{ParamTag, Tag, Tags};
use super::super::prose::{Block, Inline, LinkTarget};
use crate::text::Place;

/// The tags of `draft`.
pub(super) fn read(reader: &Reader<'_>, draft: Draft) -> Tags {
    let tag = |text: &Mapped| Tag { place: text.whole(), content: reader.blocks(text) };
    let all = |texts: &[Mapped]| texts.iter().map(tag).collect::<Vec<_>>();
    Tags {
        params: draft
            .params
            .iter()
            .map(|param| {
                let name = param.name.as_str().to_owned();
                ParamTag {
                    place: param.name.whole(),
                    target: reader.scope.and_then(|scope| reader.index.parameter(scope, &name)),
                    name,
                    note: param.note.clone(),
                    content: reader.blocks(&param.text),
                }
            })
            .collect(),
        returns: draft.returns.as_ref().map(tag),
        copy_of: draft.copies.iter().find_map(|text| match reader.index.resolve(reader.scope, text.as_str())? {
            LinkTarget::Item(id) => Some(id),
            _ => None,
        }),
        see: draft.see.iter().chain(&draft.copies).flat_map(|text| see(reader, text)).collect(),
        since: draft.since.as_ref().map(tag),
        deprecated: draft.deprecated.as_ref().map(tag),
        examples: draft.examples.iter().map(|text| example(reader, text)).collect(),
        todos: all(&draft.todos),
        version: draft.version.as_ref().map(tag),
        authors: all(&draft.authors),
        internal: draft.internal,
        requirements: draft.requirements.iter().flat_map(requirements).collect(),
        history: draft.history.iter().map(verbatim).collect(),
        facts: draft.facts,
        gtt_paths: Vec::new(),
    }
}

/// A history keeps its lines.
fn verbatim(text: &Mapped) -> Block {
    Block::Code { language: "text".to_owned(), text: text.as_str().to_owned() }
}

/// An example that is code but not in a fence becomes a code block.
fn example(reader: &Reader<'_>, text: &Mapped) -> Tag {
    let source = text.as_str();
    let code = source.lines().filter(|line| line.trim_end().ends_with(';')).count();
    let lines = source.lines().filter(|line| !line.trim().is_empty()).count();
    let content = if !source.contains("```") && code * 2 > lines {
        vec![Block::Code { language: "st".to_owned(), text: source.trim_matches('\n').to_owned() }]
    } else {
        reader.blocks(text)
    };
    Tag { place: text.whole(), content }
}

/// The identifiers, which commas or white space part.
fn requirements(text: &Mapped) -> Vec<(String, Place)> {
    let source = text.as_str();
    words(source).map(|range| (source[range.clone()].to_owned(), text.place(range))).collect()
}

fn words(source: &str) -> impl Iterator<Item = Range<usize>> {
    let parts = |c: char| c.is_whitespace() || matches!(c, ',' | ';');
    source.split(parts).filter(|word| !word.is_empty()).map(move |word| {
        let start = word.as_ptr() as usize - source.as_ptr() as usize;
        start..start + word.len()
    })
}

/// `@see A, B`, `@see A for details`: a path needs no brackets here.
fn see(reader: &Reader<'_>, text: &Mapped) -> Vec<Tag> {
    let source = text.as_str();
    let mut parts = Vec::new();
    let mut start = 0;
    for part in source.split(',') {
        parts.push(trim(source, start..start + part.len()));
        start += part.len() + 1;
    }
    let is_list = parts.iter().all(|part| segments(&source[part.clone()]).is_some());
    if !is_list {
        parts = vec![trim(source, 0..source.len())];
    }
    parts.into_iter().map(|part| see_one(reader, text, part)).collect()
}

fn see_one(reader: &Reader<'_>, text: &Mapped, part: Range<usize>) -> Tag {
    let source = &text.as_str()[part.clone()];
    let word = source.split_whitespace().next().unwrap_or("");
    let path = word.trim_matches(['`', '[', ']']).trim_end_matches([':', '.', ';']);
    let at = part.start + source.find(path).unwrap_or(0);
    let rest = text.slice(at + word.len().min(part.end - at)..part.end);
    let bare = !word.contains('(') || word.ends_with("()");
    let target = if is_external(path) {
        Some(LinkTarget::External(path.to_owned()))
    } else {
        segments(path).filter(|_| bare).and_then(|_| {
            let alone = word.len() == source.len();
            let broken = LinkTarget::Broken { text: path.to_owned() };
            reader.index.resolve(reader.scope, path).or_else(|| alone.then_some(broken))
        })
    };
    let content = match target {
        Some(target) => {
            let place = text.place(at..at + path.len());
            let mut content = vec![Inline::Link { target, place, content: vec![Inline::Text(path.to_owned())] }];
            let more = flatten(reader.blocks(&rest));
            if !more.is_empty() {
                content.push(Inline::Text(" ".to_owned()));
                content.extend(more);
            }
            vec![Block::Paragraph(content)]
        }
        None => reader.blocks(&text.slice(part.clone())),
    };
    Tag { place: text.place(part), content }
}
