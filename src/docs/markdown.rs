//! Markdown to blocks, with links resolved.
//!
//! `CommonMark` with tables, task lists, strikethrough, footnotes and alerts (`> [!NOTE]`), read by pulldown-cmark. PLC
//! comments were not written for it, so the text is prepared first:
//!
//! * indentation means nothing outside lists and fences (comments are indented with tabs at will),
//!   so there are no indented code blocks;
//! * `a*b*c` is a product, not emphasis; `>5` is a comparison, not a quotation;
//! * raw HTML is text.
//!
//! A line break inside a paragraph is a space if wrapping explains it: if the next word would not
//! have fitted on the line. Otherwise it was meant, and stays.

mod builder;
mod prepare;

use std::ops::Range;

use pulldown_cmark::{BrokenLink, CowStr, Event, Options, Parser, Tag};

use super::links::Index;
use super::mapped::Mapped;
use super::prose::{Block, Inline, LinkTarget};
use crate::library::ItemId;
use builder::Builder;

/// The address that stands for a path resolved by [`Index::shortcut`].
const SHORTCUT: &str = "rungbook-entity:";

/// Reads Markdown in the documentation of one item.
pub(super) struct Reader<'a> {
    /// The names of the tree.
    pub(super) index: &'a Index<'a>,
    /// The documented item; `None` for a page, which was written as Markdown and is read as it stands.
    pub(super) scope: Option<ItemId>,
}

impl Reader<'_> {
    /// The blocks of `text`.
    pub(super) fn blocks(&self, text: &Mapped) -> Vec<Block> {
        if text.is_blank() {
            return Vec::new();
        }
        match self.scope {
            Some(_) => self.parse(&prepare::prepare(text), true),
            None => self.parse(text, true),
        }
    }

    fn parse(&self, text: &Mapped, html: bool) -> Vec<Block> {
        let source = text.as_str();
        let options = Options::ENABLE_TABLES
            | Options::ENABLE_TASKLISTS
            | Options::ENABLE_STRIKETHROUGH
            | Options::ENABLE_FOOTNOTES
            | Options::ENABLE_GFM;
        let callback = |link: BrokenLink<'_>| {
            self.is_link(source, &link)
                .then(|| (CowStr::from(format!("{SHORTCUT}{}", link.reference)), CowStr::from("")))
        };
        let parser = Parser::new_with_broken_link_callback(source, options, Some(callback)).into_offset_iter();
        let mut builder = Builder::new(source, self.scope.is_some());
        let mut raw: Option<Range<usize>> = None;
        for (event, range) in parser {
            match event {
                Event::Start(Tag::HtmlBlock) => raw = Some(range),
                Event::End(pulldown_cmark::TagEnd::HtmlBlock) => {
                    let Some(range) = raw.take() else { continue };
                    let part = text.trimmed(range);
                    if html {
                        builder.blocks(self.parse(&prepare::without_html(&part), false));
                    } else {
                        builder.blocks(vec![Block::Paragraph(vec![Inline::Text(part.as_str().to_owned())])]);
                    }
                }
                _ if raw.is_some() => {}
                Event::Start(Tag::Link { dest_url, .. }) => {
                    builder.open_link(self.target(&dest_url), text.place(range));
                }
                Event::Start(tag) => builder.open(tag),
                Event::End(_) => builder.close(),
                Event::SoftBreak => builder.soft_break(range.start),
                event => builder.leaf(event),
            }
        }
        builder.finish()
    }

    /// Whether `[text]`, which no definition explains, is a link.
    fn is_link(&self, source: &str, link: &BrokenLink<'_>) -> bool {
        // `values[i]` is an index, and so is `m[0][1]`.
        let before = source[..link.span.start].chars().next_back();
        let is_index = before.is_some_and(|c| c.is_alphanumeric() || matches!(c, '_' | ')' | ']' | '^'));
        !is_index && self.index.shortcut(self.scope, &link.reference).is_some()
    }

    /// Where an address leads; `None` for one that is only shown, such as a relative file.
    fn target(&self, url: &str) -> Option<LinkTarget> {
        if let Some(path) = url.strip_prefix(SHORTCUT) {
            return self.index.shortcut(self.scope, path);
        }
        if is_external(url) {
            return Some(LinkTarget::External(url.to_owned()));
        }
        let path = url.trim_start_matches('#');
        let names = super::links::segments(path)?;
        let found = self.index.resolve(self.scope, path);
        found.or_else(|| (!is_file(&names)).then(|| LinkTarget::Broken { text: url.to_owned() }))
    }
}

/// Whether an address may be linked: `http:`, `https:` and `mailto:` alone.
pub(super) fn is_external(url: &str) -> bool {
    let lower = url.get(..8).unwrap_or(url).to_ascii_lowercase();
    let scheme = lower.split(':').next().unwrap_or("");
    url.contains(':') && matches!(scheme, "http" | "https" | "mailto") && !url.contains(char::is_whitespace)
}

/// Whether the path ends as the name of a file does.
fn is_file(names: &[&str]) -> bool {
    const EXTENSIONS: [&str; 20] = [
        "md", "txt", "pdf", "png", "jpg", "jpeg", "svg", "gif", "html", "htm", "st", "scl", "xml", "csv", "xlsx",
        "gtt", "tcpou", "tcdut", "tcgvl", "tcio",
    ];
    names.len() > 1 && names.last().is_some_and(|last| EXTENSIONS.contains(&last.to_lowercase().as_str()))
}

/// All inlines of `blocks`, parted by spaces.
pub(super) fn flatten(blocks: Vec<Block>) -> Vec<Inline> {
    let mut out = Vec::new();
    for block in blocks {
        let part = match block {
            Block::Paragraph(content) | Block::Heading(_, content) => content,
            Block::Quote(content) | Block::Note { content, .. } => flatten(content),
            Block::List { items, .. } => flatten(items.into_iter().flat_map(|item| item.content).collect()),
            Block::Code { text, .. } => vec![Inline::Code(text)],
            Block::Table { head, rows, .. } => std::iter::once(head).chain(rows).flatten().flat_map(spaced).collect(),
            Block::Definitions(items) => {
                items.into_iter().flat_map(|(term, meaning)| [spaced(term), flatten(meaning)].concat()).collect()
            }
            Block::Rule => Vec::new(),
        };
        if !out.is_empty() && !part.is_empty() {
            out.push(Inline::Text(" ".to_owned()));
        }
        out.extend(part);
    }
    out
}

fn spaced(mut cell: Vec<Inline>) -> Vec<Inline> {
    cell.push(Inline::Text(" ".to_owned()));
    cell
}
