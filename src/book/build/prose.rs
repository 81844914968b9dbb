//! Prose of comments to prose of pages: the same tree with its links as addresses.

use super::Context;
use super::address::slug;
use crate::book::view::prose::{Block, Href, Inline, ListItem};
use crate::docs;

/// Blocks.
pub(crate) fn blocks(context: &Context<'_>, blocks: &[docs::Block]) -> Vec<Block> {
    blocks.iter().map(|block| self::block(context, block)).collect()
}

/// Inlines.
pub(crate) fn inlines(context: &Context<'_>, inlines: &[docs::Inline]) -> Vec<Inline> {
    inlines.iter().map(|inline| self::inline(context, inline)).collect()
}

/// Prose that stands in no comment, such as a project's description, as paragraphs.
pub(crate) fn markdown(context: &Context<'_>, text: &str) -> Vec<Block> {
    blocks(context, &context.narrator.blocks(text))
}

fn block(context: &Context<'_>, block: &docs::Block) -> Block {
    match block {
        docs::Block::Paragraph(content) => Block::Paragraph { content: inlines(context, content) },
        docs::Block::Heading(level, content) => Block::Heading {
            level: *level,
            anchor: format!("h-{}", slug(&docs::Inline::plain(content))),
            content: inlines(context, content),
        },
        docs::Block::List { start, items } => {
            let item =
                |item: &docs::ListItem| ListItem { checked: item.checked, content: blocks(context, &item.content) };
            Block::List { start: *start, items: items.iter().map(item).collect() }
        }
        docs::Block::Code { language, text } => Block::Code { language: language.clone(), text: text.clone() },
        docs::Block::Quote(content) => Block::Quote { content: blocks(context, content) },
        docs::Block::Note { style, title, content } => {
            Block::Note { style: style.clone(), title: title.clone(), content: blocks(context, content) }
        }
        docs::Block::Table { align, head, rows } => Block::Table {
            align: align.iter().copied().map(alignment).collect(),
            head: cells(context, head),
            rows: rows.iter().map(|row| cells(context, row)).collect(),
        },
        docs::Block::Definitions(items) => Block::Definitions {
            items: items.iter().map(|(term, is)| (inlines(context, term), blocks(context, is))).collect(),
        },
        docs::Block::Rule => Block::Rule,
    }
}

fn cells(context: &Context<'_>, row: &[Vec<docs::Inline>]) -> Vec<Vec<Inline>> {
    row.iter().map(|cell| inlines(context, cell)).collect()
}

const fn alignment(align: docs::Align) -> &'static str {
    match align {
        docs::Align::None => "none",
        docs::Align::Left => "left",
        docs::Align::Center => "center",
        docs::Align::Right => "right",
    }
}

fn inline(context: &Context<'_>, inline: &docs::Inline) -> Inline {
    match inline {
        docs::Inline::Text(text) => Inline::Text { text: text.clone() },
        docs::Inline::Code(text) => Inline::Code { text: text.clone() },
        docs::Inline::Emph(content) => Inline::Emph { content: inlines(context, content) },
        docs::Inline::Strong(content) => Inline::Strong { content: inlines(context, content) },
        docs::Inline::Strike(content) => Inline::Strike { content: inlines(context, content) },
        docs::Inline::Link { target, content, .. } => {
            Inline::Link { to: href(context, target), content: inlines(context, content) }
        }
        docs::Inline::Image { source, alt } => Inline::Image { source: source.clone(), alt: alt.clone() },
        docs::Inline::Break => Inline::Break,
    }
}

fn href(context: &Context<'_>, target: &docs::LinkTarget) -> Href {
    match target {
        docs::LinkTarget::Item(id) => context.addresses.item(*id).href(),
        docs::LinkTarget::Variable(id, index) => context.addresses.variable(*id, *index).href(),
        docs::LinkTarget::External(url) => Href::External { url: url.clone() },
        docs::LinkTarget::Broken { text } => Href::Broken { target: text.clone() },
    }
}
