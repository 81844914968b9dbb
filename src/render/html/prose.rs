//! Prose to markup: a walk over the tree that escapes every string it meets.

use std::cell::RefCell;
use std::collections::BTreeSet;

use super::context::{Place, push_link};
use super::escape;
use super::highlight::{Highlighter, Links};
use crate::book::view::prose::{Block, Href, Inline, ListItem};

/// Writes prose for one page.
pub(super) struct Prose<'a> {
    pub(super) place: &'a Place,
    pub(super) highlighter: &'a Highlighter,
    /// The anchors that the page's headings have so far.
    anchors: RefCell<BTreeSet<String>>,
}

impl<'a> Prose<'a> {
    /// For one page.
    pub(super) fn new(place: &'a Place, highlighter: &'a Highlighter) -> Self {
        Self { place, highlighter, anchors: RefCell::default() }
    }

    /// `anchor`, or, where a heading of the page has it already, one of its own.
    fn unique(&self, anchor: &str) -> String {
        let numbered = (2_u32..).map(|number| format!("{anchor}-{number}"));
        let mut taken = self.anchors.borrow_mut();
        let free = std::iter::once(anchor.to_owned()).chain(numbered).find(|one| taken.insert(one.clone()));
        free.unwrap_or_default()
    }

    /// Blocks, their headings lowered so that the highest is an `<h{top}>`.
    pub(super) fn blocks(&self, blocks: &[Block], top: u8) -> String {
        let mut out = String::new();
        self.push_blocks(&mut out, blocks, top);
        out
    }

    /// A run of inlines.
    pub(super) fn inlines(&self, inlines: &[Inline]) -> String {
        let mut out = String::new();
        self.push_inlines(&mut out, inlines);
        out
    }

    fn push_blocks(&self, out: &mut String, blocks: &[Block], top: u8) {
        for block in blocks {
            self.push_block(out, block, top);
        }
    }

    fn push_block(&self, out: &mut String, block: &Block, top: u8) {
        match block {
            Block::Paragraph { content } => self.element(out, "p", content),
            Block::Heading { level, anchor, content } => self.heading(out, level + top - 1, anchor, content),
            Block::List { start, items } => self.list(out, *start, items, top),
            Block::Code { language, text } => self.code(out, language, text),
            Block::Quote { content } => {
                out.push_str("<blockquote>");
                self.push_blocks(out, content, top);
                out.push_str("</blockquote>\n");
            }
            Block::Note { style, title, content } => self.note(out, style, title, content, top),
            Block::Table { align, head, rows } => self.table(out, align, head, rows),
            Block::Definitions { items } => self.definitions(out, items, top),
            Block::Rule => out.push_str("<hr>\n"),
        }
    }

    fn element(&self, out: &mut String, name: &str, content: &[Inline]) {
        out.push_str(&format!("<{name}>"));
        self.push_inlines(out, content);
        out.push_str(&format!("</{name}>\n"));
    }

    fn heading(&self, out: &mut String, level: u8, anchor: &str, content: &[Inline]) {
        let level = level.clamp(1, 6);
        let anchor = self.unique(anchor);
        let anchor = escape::text(&anchor);
        out.push_str(&format!("<h{level} id=\"{anchor}\"><a class=\"anchor\" href=\"#{anchor}\">"));
        self.push_inlines(out, &unlinked(content));
        out.push_str(&format!("</a></h{level}>\n"));
    }

    fn list(&self, out: &mut String, start: Option<u64>, items: &[ListItem], top: u8) {
        match start {
            Some(1) => out.push_str("<ol>\n"),
            Some(start) => out.push_str(&format!("<ol start=\"{start}\">\n")),
            None if items.iter().any(|item| item.checked.is_some()) => out.push_str("<ul class=\"tasks\">\n"),
            None => out.push_str("<ul>\n"),
        }
        for item in items {
            self.item(out, item, top);
        }
        out.push_str(if start.is_some() { "</ol>\n" } else { "</ul>\n" });
    }

    fn item(&self, out: &mut String, item: &ListItem, top: u8) {
        out.push_str("<li>");
        match item.checked {
            Some(true) => out.push_str("<span class=\"task done\" role=\"img\" aria-label=\"done\"></span>"),
            Some(false) => out.push_str("<span class=\"task\" role=\"img\" aria-label=\"to do\"></span>"),
            None => {}
        }
        // A tight item reads as a line, not as a paragraph.
        match item.content.as_slice() {
            [Block::Paragraph { content }, rest @ ..] => {
                self.push_inlines(out, content);
                self.push_blocks(out, rest, top);
            }
            content => self.push_blocks(out, content, top),
        }
        out.push_str("</li>\n");
    }

    fn code(&self, out: &mut String, language: &str, text: &str) {
        out.push_str("<pre class=\"code\" tabindex=\"0\"><code>");
        if Highlighter::knows(language) {
            out.push_str(&self.highlighter.highlight(text, &Links::default()));
        } else {
            escape::push(out, text);
        }
        out.push_str("</code></pre>\n");
    }

    fn note(&self, out: &mut String, style: &str, title: &str, content: &[Block], top: u8) {
        out.push_str(&format!("<div class=\"note note-{}\"><p class=\"note-title\">", escape::text(style)));
        escape::push(out, title);
        out.push_str("</p>\n");
        self.push_blocks(out, content, top);
        out.push_str("</div>\n");
    }

    fn table(&self, out: &mut String, align: &[&str], head: &[Vec<Inline>], rows: &[Vec<Vec<Inline>>]) {
        out.push_str("<div class=\"scroll\" tabindex=\"0\"><table class=\"prose-table\">\n");
        if !head.is_empty() {
            out.push_str("<thead>");
            self.row(out, "th", align, head);
            out.push_str("</thead>\n");
        }
        out.push_str("<tbody>");
        for row in rows {
            self.row(out, "td", align, row);
        }
        out.push_str("</tbody></table></div>\n");
    }

    fn row(&self, out: &mut String, cell: &str, align: &[&str], cells: &[Vec<Inline>]) {
        out.push_str("<tr>");
        for (i, content) in cells.iter().enumerate() {
            let class = match align.get(i) {
                Some(&"right") => " class=\"right\"",
                Some(&"center") => " class=\"center\"",
                _ => "",
            };
            out.push_str(&format!("<{cell}{class}>"));
            self.push_inlines(out, content);
            out.push_str(&format!("</{cell}>"));
        }
        out.push_str("</tr>\n");
    }

    fn definitions(&self, out: &mut String, items: &[(Vec<Inline>, Vec<Block>)], top: u8) {
        out.push_str("<dl>\n");
        for (term, meaning) in items {
            self.element(out, "dt", term);
            out.push_str("<dd>");
            self.push_blocks(out, meaning, top);
            out.push_str("</dd>\n");
        }
        out.push_str("</dl>\n");
    }

    fn push_inlines(&self, out: &mut String, inlines: &[Inline]) {
        for inline in inlines {
            self.push_inline(out, inline);
        }
    }

    fn push_inline(&self, out: &mut String, inline: &Inline) {
        match inline {
            Inline::Text { text } => escape::push(out, text),
            Inline::Code { text } => {
                out.push_str("<code>");
                escape::push(out, text);
                out.push_str("</code>");
            }
            Inline::Emph { content } => self.wrapped(out, "em", content),
            Inline::Strong { content } => self.wrapped(out, "strong", content),
            Inline::Strike { content } => self.wrapped(out, "s", content),
            Inline::Link { to, content } => self.link(out, to, content),
            Inline::Image { source, alt } => {
                out.push_str("<span class=\"picture\" title=\"");
                escape::push(out, source);
                out.push_str("\">");
                escape::push(out, if alt.is_empty() { source } else { alt });
                out.push_str("</span>");
            }
            Inline::Break => out.push_str("<br>\n"),
        }
    }

    fn wrapped(&self, out: &mut String, name: &str, content: &[Inline]) {
        out.push_str(&format!("<{name}>"));
        self.push_inlines(out, content);
        out.push_str(&format!("</{name}>"));
    }

    fn link(&self, out: &mut String, to: &Href, content: &[Inline]) {
        let inner = self.inlines(&unlinked(content));
        match (self.place.target(to), to) {
            (Some(href), _) => push_link(out, &href, &inner),
            (None, Href::Broken { target }) => {
                out.push_str("<span class=\"broken\" title=\"not found: ");
                escape::push(out, target);
                out.push_str(&format!("\">{inner}</span>"));
            }
            (None, _) => out.push_str(&inner),
        }
    }
}

/// A message as markup: what stands between backticks is code.
pub(super) fn message(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 32);
    let mut rest = text;
    while let Some((before, (code, after))) = rest.split_once('`').and_then(|(b, r)| Some((b, r.split_once('`')?))) {
        escape::push(&mut out, before);
        out.push_str("<code>");
        escape::push(&mut out, code);
        out.push_str("</code>");
        rest = after;
    }
    escape::push(&mut out, rest);
    out
}

/// The same without links, for what stands in a link already.
fn unlinked(inlines: &[Inline]) -> Vec<Inline> {
    let mut out = Vec::new();
    for inline in inlines {
        match inline {
            Inline::Link { content, .. } => out.extend(unlinked(content)),
            Inline::Emph { content } => out.push(Inline::Emph { content: unlinked(content) }),
            Inline::Strong { content } => out.push(Inline::Strong { content: unlinked(content) }),
            Inline::Strike { content } => out.push(Inline::Strike { content: unlinked(content) }),
            other => out.push(other.clone()),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn backticks_in_messages_make_code() {
        assert_eq!(message("`a<b` is `c`"), "<code>a&lt;b</code> is <code>c</code>");
        assert_eq!(message("a ` b & ``"), "a <code> b &amp; </code>`");
        assert_eq!(message("plain"), "plain");
    }

    #[test]
    fn links_do_not_nest() {
        let link = |content| Inline::Link { to: Href::External { url: "https://x".to_owned() }, content };
        let strong = Inline::Strong { content: vec![link(vec![Inline::text("a")])] };
        assert_eq!(unlinked(&[strong]), [Inline::Strong { content: vec![Inline::text("a")] }]);
    }
}
