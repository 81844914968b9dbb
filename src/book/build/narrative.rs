//! Narrative pages: the user's own, and those that explain the codes that occur.

use std::collections::{BTreeMap, BTreeSet};

use super::address::{slug, unique};
use super::{Context, Narrative, prose};
use crate::book::view::Chapter;
use crate::book::view::prose::{Block, Href, Inline};

/// The page of each narrative, by its path.
pub(crate) fn addresses(narratives: &[Narrative]) -> BTreeMap<String, String> {
    let mut taken = BTreeSet::new();
    let stem = |path: &str| path.rsplit('/').next().unwrap_or(path).trim_end_matches(".md").to_owned();
    let address = |narrative: &Narrative| {
        let name = unique(&slug(&stem(&narrative.path)), &mut taken);
        (narrative.path.clone(), format!("chapters/{name}.html"))
    };
    narratives.iter().map(address).collect()
}

/// The user's pages, in order.
pub(crate) fn chapters(context: &Context<'_>) -> Vec<Chapter> {
    context.input.narratives.iter().map(|narrative| chapter(context, narrative)).collect()
}

fn chapter(context: &Context<'_>, narrative: &Narrative) -> Chapter {
    let url = context.narratives.get(&narrative.path).cloned().unwrap_or_default();
    let mut content = prose::markdown(context, &narrative.text);
    let folder = narrative.path.rsplit_once('/').map_or("", |(folder, _)| folder);
    content.iter_mut().for_each(|block| relink(context, folder, block));
    let title = title(&mut content).unwrap_or_else(|| narrative.path.clone());
    Chapter { title, label: label(&url), url, content }
}

/// The pages of the codes that occur, by name.
pub(crate) fn explanations(context: &Context<'_>) -> Vec<Chapter> {
    let mut seen = BTreeMap::new();
    for finding in context.input.findings {
        seen.entry(finding.code.name).or_insert(finding.code);
    }
    let page = |(name, code): (&str, &crate::diagnostic::Code)| {
        let mut content = prose::markdown(context, &code.text());
        let title = title(&mut content).unwrap_or_else(|| name.to_owned());
        let url = format!("codes/{}.html", slug(name));
        Chapter { title, label: label(&url), url, content }
    };
    seen.into_iter().map(page).collect()
}

fn label(url: &str) -> String {
    format!("c:{}", url.trim_end_matches(".html").replace('/', ":"))
}

/// Takes the heading at the top off.
fn title(content: &mut Vec<Block>) -> Option<String> {
    let Some(Block::Heading { content: heading, .. }) = content.first() else { return None };
    let title = Inline::plain(heading);
    content.remove(0);
    Some(title)
}

/// Links to other narrative pages, which were written as paths of files.
fn relink(context: &Context<'_>, folder: &str, block: &mut Block) {
    let inlines = |content: &mut Vec<Inline>| content.iter_mut().for_each(|inline| link(context, folder, inline));
    match block {
        Block::Paragraph { content } | Block::Heading { content, .. } => inlines(content),
        Block::Table { head, rows, .. } => head.iter_mut().chain(rows.iter_mut().flatten()).for_each(inlines),
        Block::List { items, .. } => {
            items.iter_mut().flat_map(|item| &mut item.content).for_each(|block| relink(context, folder, block));
        }
        Block::Quote { content } | Block::Note { content, .. } => {
            content.iter_mut().for_each(|block| relink(context, folder, block));
        }
        Block::Definitions { items } => {
            for (term, meaning) in items {
                inlines(term);
                meaning.iter_mut().for_each(|block| relink(context, folder, block));
            }
        }
        Block::Code { .. } | Block::Rule => {}
    }
}

fn link(context: &Context<'_>, folder: &str, inline: &mut Inline) {
    match inline {
        Inline::Link { to, content } => {
            if let Href::Broken { target } = to
                && let Some(url) = page(context, folder, target)
            {
                *to = Href::Page { label: label(url.split('#').next().unwrap_or(&url)), url };
            }
            content.iter_mut().for_each(|inline| link(context, folder, inline));
        }
        Inline::Emph { content } | Inline::Strong { content } | Inline::Strike { content } => {
            content.iter_mut().for_each(|inline| link(context, folder, inline));
        }
        Inline::Text { .. } | Inline::Code { .. } | Inline::Image { .. } | Inline::Break => {}
    }
}

/// The page that the path `target`, written in `folder`, means.
fn page(context: &Context<'_>, folder: &str, target: &str) -> Option<String> {
    let (path, anchor) = target.split_once('#').map_or((target, ""), |(path, anchor)| (path, anchor));
    let mut parts: Vec<&str> = folder.split('/').filter(|part| !part.is_empty()).collect();
    for part in path.split('/') {
        match part {
            "." | "" => {}
            ".." => _ = parts.pop(),
            part => parts.push(part),
        }
    }
    let url = context.narratives.get(&parts.join("/"))?;
    Some(if anchor.is_empty() { url.clone() } else { format!("{url}#h-{}", slug(anchor)) })
}
