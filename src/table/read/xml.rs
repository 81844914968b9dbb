//! What the XML readers share: the document, texts and attributes with their places, and which format a file is in.

use roxmltree::{Attribute, Document, Node};

use super::{Options, Read, exteta, stvs, test_manager};
use crate::diagnostic::Finding;
use crate::table::codes;
use crate::table::model::Word;
use crate::table::piece::Piece;
use crate::text::Place;

/// Reads a table file in XML, whichever of the known formats it is in.
#[must_use]
pub fn read(piece: &Piece<'_>, options: &Options) -> Read {
    let mut read = Read::default();
    // geteta writes comments that hold `--`, which XML forbids.
    let blanked = without_comments(piece.text);
    match Document::parse(piece.text).or_else(|error| Document::parse(&blanked).map_err(|_| error)) {
        Ok(document) => {
            let root = document.root_element();
            let source = Source { piece };
            match root.tag_name().name() {
                "test-table" => exteta::table(&source, root, options, &mut read),
                "session" | "specification" => stvs::document(&source, root, options, &mut read),
                "tabletestspec" => test_manager::document(&source, root, options, &mut read),
                name => {
                    let message = format!("`{name}` is the root of no known form of a table");
                    let help = "`test-table` (exteta), `session` and `specification` (STVS) and `tabletestspec` are";
                    read.findings.push(Finding::new(&codes::TABLE_SYNTAX, source.head(root), message).help(help));
                }
            }
        }
        Err(error) => {
            let place = piece.at(offset(piece.text, error.pos()));
            let message = format!("this is no well-formed XML: {error}");
            read.findings.push(Finding::new(&codes::TABLE_SYNTAX, place, message));
        }
    }
    read.sort();
    read
}

/// The text with its comments replaced by as many blanks.
fn without_comments(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(begin) = rest.find("<!--") {
        let end = rest[begin..].find("-->").map_or(rest.len(), |end| begin + end + 3);
        out.push_str(&rest[..begin]);
        out.extend(std::iter::repeat_n(' ', end - begin));
        rest = &rest[end..];
    }
    out + rest
}

/// Line and column of an XML error as an empty range.
fn offset(text: &str, position: roxmltree::TextPos) -> std::ops::Range<usize> {
    let line = text.split_inclusive('\n').take(position.row.saturating_sub(1) as usize).map(str::len).sum::<usize>();
    let rest = text.get(line..).unwrap_or("");
    let column = rest.chars().take(position.col.saturating_sub(1) as usize).map(char::len_utf8).sum::<usize>();
    let at = (line + column).min(text.len());
    at..at
}

/// The text of a document.
pub(super) struct Source<'p, 't> {
    pub(super) piece: &'p Piece<'t>,
}

/// A text as it is meant, and for each run of it where it stands.
pub(super) struct Decoded {
    text: String,
    runs: Vec<(u32, u32)>,
}

impl Source<'_, '_> {
    /// The place of an element's start tag.
    pub(super) fn head(&self, node: Node<'_, '_>) -> Place {
        let range = node.range();
        let tag = self.piece.text.get(range.clone()).and_then(|text| text.find('>')).map_or(range.len(), |end| end + 1);
        self.piece.at(range.start..range.start + tag)
    }

    /// The place of a whole element.
    pub(super) fn whole(&self, node: Node<'_, '_>) -> Place {
        self.piece.at(node.range())
    }

    fn attribute_node<'n, 'i>(node: Node<'n, 'i>, name: &str) -> Option<Attribute<'n, 'i>> {
        node.attributes().find(|attribute| attribute.name() == name)
    }

    /// An attribute's value with its place.
    pub(super) fn attribute(&self, node: Node<'_, '_>, name: &str) -> Option<Word> {
        let attribute = Self::attribute_node(node, name)?;
        Some(Word { text: attribute.value().to_owned(), place: self.piece.at(attribute.range_value()) })
    }

    /// An attribute's value, decoded, for the parsers of cells and durations.
    pub(super) fn attribute_text(&self, node: Node<'_, '_>, name: &str) -> Option<Decoded> {
        Self::attribute_node(node, name).map(|attribute| self.decoded(attribute.range_value()))
    }

    /// The text inside an element, decoded.
    pub(super) fn text(&self, node: Node<'_, '_>) -> Decoded {
        let children: Vec<_> = node.children().filter(|child| child.is_text()).collect();
        match children.as_slice() {
            [] => {
                let end = self.head(node).span.end - self.piece.span(crate::text::Span::at(0)).start;
                self.decoded(end as usize..end as usize)
            }
            texts => {
                let range = texts[0].range().start..texts[texts.len() - 1].range().end;
                self.decoded(range)
            }
        }
    }

    /// The text in `range` with entities and CDATA sections replaced by what they mean, comments left out.
    fn decoded(&self, range: std::ops::Range<usize>) -> Decoded {
        let raw = self.piece.text.get(range.clone()).unwrap_or("");
        let mut out = Decoded { text: String::new(), runs: Vec::new() };
        let mut at = 0;
        while at < raw.len() {
            let rest = &raw[at..];
            let (meant, len, begin) = unit(rest);
            out.push(meant, range.start + at + begin);
            at += len;
        }
        if !raw.ends_with("]]>") || out.runs.is_empty() {
            let end = u32::try_from(out.text.len()).unwrap_or(u32::MAX);
            out.runs.push((end, u32::try_from(range.end).unwrap_or(u32::MAX)));
        }
        out
    }
}

/// What the beginning of `rest` means, how long it is, and where in it the meant text begins.
fn unit(rest: &str) -> (Meant<'_>, usize, usize) {
    if let Some(inner) = rest.strip_prefix("<![CDATA[") {
        let end = inner.find("]]>").unwrap_or(inner.len());
        return (Meant::Text(&inner[..end]), (end + 12).min(rest.len()), 9);
    }
    if let Some(inner) = rest.strip_prefix("<!--") {
        return (Meant::Text(""), inner.find("-->").map_or(rest.len(), |end| end + 7), 0);
    }
    if rest.starts_with('&')
        && let Some(end) = rest.find(';')
        && let Some(c) = entity(&rest[1..end])
    {
        return (Meant::Char(c), end + 1, 0);
    }
    let first = rest.chars().next().map_or(0, char::len_utf8);
    let next = rest[first..].find(['&', '<']).map_or(rest.len(), |at| at + first);
    (Meant::Text(&rest[..next]), next, 0)
}

enum Meant<'a> {
    Text(&'a str),
    Char(char),
}

fn entity(name: &str) -> Option<char> {
    match name {
        "lt" => Some('<'),
        "gt" => Some('>'),
        "amp" => Some('&'),
        "apos" => Some('\''),
        "quot" => Some('"'),
        _ => {
            let number = name.strip_prefix('#')?;
            let code = match number.strip_prefix('x') {
                Some(hex) => u32::from_str_radix(hex, 16),
                None => number.parse(),
            };
            char::from_u32(code.ok()?)
        }
    }
}

impl Decoded {
    fn push(&mut self, meant: Meant<'_>, at: usize) {
        let run = (u32::try_from(self.text.len()).unwrap_or(u32::MAX), u32::try_from(at).unwrap_or(u32::MAX));
        match meant {
            Meant::Text("") => return,
            Meant::Text(text) => self.text.push_str(text),
            Meant::Char(c) => self.text.push(c),
        }
        self.runs.push(run);
    }

    /// As a piece of the file that `source` reads.
    pub(super) fn piece<'d>(&'d self, source: &Source<'_, '_>) -> Piece<'d> {
        source.piece.rewritten(&self.text, &self.runs)
    }

    /// The text alone.
    pub(super) fn as_str(&self) -> &str {
        &self.text
    }
}

/// The first child element of that name.
pub(super) fn child<'n, 'i>(node: Node<'n, 'i>, name: &str) -> Option<Node<'n, 'i>> {
    node.children().find(|child| child.tag_name().name() == name)
}

/// The child elements.
pub(super) fn elements<'n, 'i>(node: Node<'n, 'i>) -> impl Iterator<Item = Node<'n, 'i>> {
    node.children().filter(Node::is_element)
}
