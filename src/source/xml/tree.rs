//! Nests tags into elements; what is not closed is closed where it must have ended.
//!
//! A closing tag closes the innermost open element of its name and everything inside that was left open; one
//! that matches nothing is skipped. The caller names the `leaves` of its format, elements
//! that hold text alone: a tag inside one means that its closing tag is lost.

use std::borrow::Cow;

use super::scan::{RawAttribute, Scanner, Token, index};
use super::{MAX_DEPTH, MAX_NODES, Problem, text};
use crate::source::fragment::FragmentBuilder;
use crate::text::{Fragment, Span};

const NONE: u32 = u32::MAX;

/// A parsed file.
#[derive(Debug)]
pub(crate) struct Xml<'t> {
    text: &'t str,
    nodes: Vec<Node>,
    attributes: Vec<RawAttribute>,
    problems: Vec<Problem>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    name: Span,
    span: Span,
    content: Span,
    attributes: (u32, u32),
    first: u32,
    last: u32,
    next: u32,
}

impl<'t> Xml<'t> {
    /// Reads `text`; elements called as one of `leaves` hold no elements.
    pub(crate) fn parse(text: &'t str, leaves: &[&str]) -> Self {
        let whole = Span::from(0..text.len());
        let mut builder = Builder {
            text,
            leaves,
            nodes: vec![Node::new(Span::at(0), whole, whole, (0, 0))],
            open: vec![0],
            problems: Vec::new(),
        };
        let mut scanner = Scanner::new(text, whole);
        while let Some(token) = scanner.next() {
            if builder.nodes.len() > MAX_NODES {
                builder.problem(
                    Span::at(token_span(token).start),
                    "the file holds too many elements; the rest is not read",
                );
                break;
            }
            if let Some(at) = builder.token(token) {
                scanner.seek(at);
            }
        }
        builder.close_the_rest(whole.end);
        let Builder { nodes, mut problems, .. } = builder;
        problems.append(&mut scanner.problems);
        problems.sort_by_key(|problem| problem.span);
        Self { text, nodes, attributes: scanner.attributes, problems }
    }

    /// What is wrong with the file, in its order.
    pub(crate) fn problems(&self) -> &[Problem] {
        &self.problems
    }

    /// The elements that no other holds: one, in a well-formed file.
    pub(crate) fn roots(&self) -> impl Iterator<Item = Element<'_>> {
        self.document().children()
    }

    /// The first root, whose name the caller knows or asks for.
    pub(crate) fn root(&self) -> Option<Element<'_>> {
        self.roots().next()
    }

    /// What holds the roots; a nameless element.
    pub(crate) fn document(&self) -> Element<'_> {
        Element { xml: self, index: 0 }
    }
}

impl Node {
    const fn new(name: Span, span: Span, content: Span, attributes: (u32, u32)) -> Self {
        Self { name, span, content, attributes, first: NONE, last: NONE, next: NONE }
    }
}

struct Builder<'t, 'l> {
    text: &'t str,
    leaves: &'l [&'l str],
    nodes: Vec<Node>,
    open: Vec<u32>,
    problems: Vec<Problem>,
}

impl Builder<'_, '_> {
    fn problem(&mut self, span: Span, message: impl Into<String>) {
        Problem::add(&mut self.problems, span, message);
    }

    /// Takes one token; gives the place where to go on, if not behind it.
    fn token(&mut self, token: Token) -> Option<u32> {
        match token {
            Token::Open { name, attributes, empty, span } => self.open(name, attributes, empty, span),
            Token::Close { name, span } => self.close(name, span),
            Token::Cdata(span, inner) => return self.cdata(span, inner),
            Token::Text(_) | Token::Other(_) => {}
        }
        None
    }

    fn top(&self) -> &Node {
        &self.nodes[self.open.last().map_or(0, |index| *index as usize)]
    }

    fn open(&mut self, name: Span, attributes: (u32, u32), empty: bool, span: Span) {
        while self.open.len() > 1 && self.leaves.contains(&local(self.top().name.of(self.text))) {
            let lost = self.top().name;
            self.problem(lost, format!("`{}` is not closed", lost.of(self.text)));
            self.pop(span.start, span.start);
        }
        if self.open.len() > MAX_DEPTH {
            let again = self.problems.last().is_some_and(|last| last.message.starts_with("elements nest"));
            if !again {
                self.problem(name, format!("elements nest more than {MAX_DEPTH} deep; what lies deeper is not read"));
            }
            return;
        }
        let child = index(self.nodes.len());
        self.nodes.push(Node::new(name, span, Span::at(span.end), attributes));
        let parent = &mut self.nodes[self.open.last().map_or(0, |index| *index as usize)];
        let before = std::mem::replace(&mut parent.last, child);
        if before == NONE {
            parent.first = child;
        } else {
            self.nodes[before as usize].next = child;
        }
        if !empty {
            self.open.push(child);
        }
    }

    fn close(&mut self, name: Span, span: Span) {
        let wanted = name.of(self.text);
        let found =
            self.open.iter().skip(1).rposition(|index| self.nodes[*index as usize].name.of(self.text) == wanted);
        let Some(depth) = found.map(|found| found + 1) else {
            // Elements that nest too deep were not opened, so their ends match nothing.
            if self.open.len() <= MAX_DEPTH {
                self.problem(span, format!("`</{wanted}>` closes nothing"));
            }
            return;
        };
        while self.open.len() > depth + 1 {
            let lost = self.top().name;
            self.problem(lost, format!("`{}` is not closed", lost.of(self.text)));
            self.pop(span.start, span.start);
        }
        self.pop(span.start, span.end);
    }

    /// A CDATA section without its end reaches to the closing tag of the element that it stands in. It has none
    /// if the file ends, or if that closing tag and the beginning of another section come first.
    fn cdata(&mut self, span: Span, inner: Span) -> Option<u32> {
        if self.open.len() < 2 {
            return None;
        }
        let mut text = inner.of(self.text);
        let closed = span.end > inner.end;
        if closed {
            text = &text[..text.find("<![CDATA[")?];
        }
        let close = text.find(&format!("</{}>", self.top().name.of(self.text)))?;
        if closed {
            self.problem(Span::new(span.start, inner.start), "the CDATA section is not closed");
        }
        Some(inner.start + index(close))
    }

    fn pop(&mut self, content_end: u32, end: u32) {
        if let Some(top) = self.open.pop() {
            let node = &mut self.nodes[top as usize];
            node.content.end = content_end.max(node.content.start);
            node.span.end = end.max(node.span.end);
        }
    }

    fn close_the_rest(&mut self, end: u32) {
        while self.open.len() > 1 {
            let lost = self.top().name;
            self.problem(lost, format!("`{}` is not closed", lost.of(self.text)));
            self.pop(end, end);
        }
    }
}

fn token_span(token: Token) -> Span {
    match token {
        Token::Open { span, .. } | Token::Close { span, .. } => span,
        Token::Text(span) | Token::Cdata(span, _) | Token::Other(span) => span,
    }
}

fn local(name: &str) -> &str {
    name.rsplit_once(':').map_or(name, |(_, local)| local)
}

/// One element.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Element<'x> {
    xml: &'x Xml<'x>,
    index: u32,
}

/// What an element holds.
#[derive(Clone, Debug)]
pub(crate) enum Mixed<'x> {
    Text(Fragment),
    Element(Element<'x>),
}

/// The value of an attribute and where it stands.
#[derive(Clone, Debug)]
pub(crate) struct Attribute<'x> {
    pub(crate) value: Cow<'x, str>,
    pub(crate) span: Span,
}

impl<'x> Element<'x> {
    fn node(self) -> &'x Node {
        &self.xml.nodes[self.index as usize]
    }

    fn at(self, index: u32) -> Option<Self> {
        (index != NONE).then_some(Element { xml: self.xml, index })
    }

    /// The name without its prefix.
    pub(crate) fn name(self) -> &'x str {
        local(self.node().name.of(self.xml.text))
    }

    /// From the opening tag to the closing one, both included.
    pub(crate) fn span(self) -> Span {
        self.node().span
    }

    /// Where the name stands in the opening tag.
    pub(crate) fn name_span(self) -> Span {
        self.node().name
    }

    /// What stands between the tags.
    pub(crate) fn content(self) -> Span {
        self.node().content
    }

    /// The elements directly inside.
    pub(crate) fn children(self) -> impl Iterator<Item = Self> {
        std::iter::successors(self.at(self.node().first), |child| child.at(child.node().next))
    }

    /// The first element inside called `name`.
    pub(crate) fn child(self, name: &str) -> Option<Self> {
        self.children().find(|child| child.name() == name)
    }

    /// The elements directly inside that are called `name`.
    pub(crate) fn children_named(self, name: &str) -> impl Iterator<Item = Self> {
        self.children().filter(move |child| child.name() == name)
    }

    /// The elements inside at any depth, in the order of the file, without the element itself.
    pub(crate) fn descendants(self) -> impl Iterator<Item = Self> {
        let end = self.node().span.end;
        let first = self.index as usize + 1;
        let inside = move |node: &&(usize, &Node)| node.1.span.start < end;
        self.xml
            .nodes
            .iter()
            .enumerate()
            .skip(first)
            .take_while(move |node| inside(&node))
            .map(move |(index, _)| Element { xml: self.xml, index: super::scan::index(index) })
    }

    /// The attribute called `name`, with or without a prefix.
    pub(crate) fn attribute(self, name: &str) -> Option<Attribute<'x>> {
        let (first, end) = self.node().attributes;
        let all = self.xml.attributes.get(first as usize..end as usize)?;
        let found = all.iter().find(|attribute| local(attribute.name.of(self.xml.text)) == name)?;
        let raw = found.value.of(self.xml.text);
        let value = if raw.contains('&') { Cow::Owned(self.decode(found.value)) } else { Cow::Borrowed(raw) };
        Some(Attribute { value, span: found.value })
    }

    /// The value of the attribute called `name`.
    pub(crate) fn value(self, name: &str) -> Option<String> {
        self.attribute(name).map(|attribute| attribute.value.into_owned())
    }

    /// The value of the attribute called `name`, with the way back.
    pub(crate) fn attribute_fragment(self, name: &str) -> Option<Fragment> {
        let span = self.attribute(name)?.span;
        let mut out = FragmentBuilder::new();
        text::decoded(self.xml.text, span, &mut out);
        Some(out.finish(span.start))
    }

    fn decode(self, span: Span) -> String {
        let mut out = FragmentBuilder::new();
        text::decoded(self.xml.text, span, &mut out);
        out.finish(span.start).text.to_string()
    }

    /// The character data directly inside, with the way back.
    pub(crate) fn text(self) -> Fragment {
        let mut out = FragmentBuilder::new();
        let content = self.content();
        let mut at = content.start;
        for child in self.children() {
            text::character_data(self.xml.text, Span::new(at, child.span().start), &mut out);
            at = child.span().end;
        }
        text::character_data(self.xml.text, Span::new(at, content.end), &mut out);
        out.finish(content.start)
    }

    /// Text and elements directly inside, in the order of the file.
    pub(crate) fn mixed(self) -> Vec<Mixed<'x>> {
        let mut out = Vec::new();
        let mut at = self.content().start;
        let text = |start: u32, end: u32, out: &mut Vec<Mixed<'x>>| {
            let mut piece = FragmentBuilder::new();
            text::character_data(self.xml.text, Span::new(start, end), &mut piece);
            if !piece.is_empty() {
                out.push(Mixed::Text(piece.finish(start)));
            }
        };
        for child in self.children() {
            text(at, child.span().start, &mut out);
            out.push(Mixed::Element(child));
            at = child.span().end;
        }
        text(at, self.content().end, &mut out);
        out
    }

    /// The character data directly inside, without the white space around it; `None` where it is blank.
    pub(crate) fn trimmed(self) -> Option<String> {
        let fragment = self.text();
        let text = fragment.text.trim();
        (!text.is_empty()).then(|| text.to_owned())
    }

    /// The character data of the child called `name`, as [`Element::trimmed`] gives it.
    pub(crate) fn child_text(self, name: &str) -> Option<String> {
        self.child(name)?.trimmed()
    }

    /// What stands between the tags, markup and all.
    pub(crate) fn raw(self) -> Fragment {
        Fragment::verbatim(self.content().of(self.xml.text), self.content().start)
    }
}
