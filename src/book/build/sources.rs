//! Listings: declaration and body of an item and of its members, highlighted and linked.

use std::collections::BTreeMap;

use super::Context;
use crate::book::view::entity::{Run, RunClass, SourceView};
use crate::library::listing::{self, Class};
use crate::library::names::Found;
use crate::library::{Excerpt, ItemBody, ItemId, ItemKind};
use crate::text::Language;

/// The excerpt of a body.
pub(crate) const fn excerpt(body: ItemBody) -> Option<Excerpt> {
    match body {
        ItemBody::None => None,
        ItemBody::St(excerpt) | ItemBody::Il(excerpt) | ItemBody::Drawn(_, excerpt) => Some(excerpt),
    }
}

/// The listings of a top-level item.
pub(crate) fn of(context: &Context<'_>, top: ItemId) -> Vec<SourceView> {
    let catalogue = context.catalogue();
    let mut views = listings(context, top, "");
    for child in &catalogue.item(top).children {
        let member = catalogue.item(*child);
        let anchor = context.addresses.item(*child).anchor.clone();
        for mut view in listings(context, *child, &member.name) {
            view.anchor.clone_from(&anchor);
            views.push(view);
        }
        if member.kind == ItemKind::Property {
            for accessor in &member.children {
                let name = format!("{}.{}", member.name, catalogue.item(*accessor).name);
                for mut view in listings(context, *accessor, &name) {
                    view.anchor.clone_from(&anchor);
                    views.push(view);
                }
            }
        }
    }
    views
}

fn listings(context: &Context<'_>, id: ItemId, owner: &str) -> Vec<SourceView> {
    let item = context.catalogue().item(id);
    let title =
        |part: &str| if owner.is_empty() { part.to_owned() } else { format!("{owner}: {}", part.to_lowercase()) };
    let mut views = Vec::new();
    if let Some(excerpt) = item.declaration {
        views.push(listing(context, id, excerpt, title("Declaration")));
    }
    match item.body {
        ItemBody::None => {}
        ItemBody::St(excerpt) | ItemBody::Il(excerpt) => {
            if !context.catalogue().excerpt(excerpt).trim().is_empty() {
                views.push(listing(context, id, excerpt, title("Body")));
            }
        }
        ItemBody::Drawn(language, excerpt) => views.push(drawn(context, excerpt, language, title("Body"))),
    }
    views
}

fn bare(context: &Context<'_>, excerpt: Excerpt, title: String) -> SourceView {
    let place = context.catalogue().place(excerpt.fragment, excerpt.span);
    SourceView {
        title,
        anchor: String::new(),
        file: context.input.files.get(place.file).path.clone(),
        first_line: context.input.files.line_column(place).line,
        text: String::new(),
        runs: Vec::new(),
        links: Vec::new(),
        note: None,
    }
}

fn listing(context: &Context<'_>, id: ItemId, excerpt: Excerpt, title: String) -> SourceView {
    let text = context.catalogue().excerpt(excerpt).to_owned();
    let mut links: Vec<String> = Vec::new();
    let mut known: BTreeMap<String, u32> = BTreeMap::new();
    let tokens = listing::tokens(context.catalogue(), context.input.names, id, excerpt);
    let runs = tokens.into_iter().map(|token| Run {
        start: token.span.start,
        end: token.span.end,
        class: class(token.class),
        link: token.target.map(|target| {
            let url = url(context, target);
            *known.entry(url.clone()).or_insert_with(|| {
                links.push(url);
                u32::try_from(links.len() - 1).unwrap_or(u32::MAX)
            })
        }),
    });
    let runs = runs.collect();
    SourceView { text, runs, links, ..bare(context, excerpt, title) }
}

fn url(context: &Context<'_>, target: Found) -> String {
    match target {
        Found::Item(id) => context.addresses.item(id).url(),
        Found::Variable(id, index) => context.addresses.variable(id, index).url(),
    }
}

const fn class(class: Class) -> RunClass {
    match class {
        Class::Keyword => RunClass::Keyword,
        Class::Type => RunClass::Type,
        Class::Comment => RunClass::Comment,
        Class::Pragma => RunClass::Pragma,
        Class::String => RunClass::String,
        Class::Number => RunClass::Number,
        Class::Operator => RunClass::Operator,
        Class::Name => RunClass::Name,
    }
}

fn drawn(context: &Context<'_>, excerpt: Excerpt, language: Language, title: String) -> SourceView {
    let name = match language {
        Language::Sfc => "Sequential Function Chart",
        Language::Fbd => "Function Block Diagram",
        Language::Ld => "Ladder Diagram",
        Language::Cfc => "Continuous Function Chart",
        Language::Ecc => "Execution Control Chart",
        Language::Unknown => "a language that is not known",
    };
    SourceView { note: Some(format!("Drawn in {name}; not shown.")), ..bare(context, excerpt, title) }
}
