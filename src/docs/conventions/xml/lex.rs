//! Known elements and the text between them.

use std::ops::Range;

use crate::docs::conventions::tag_names::slot;
use crate::docs::mapped::Mapped;

/// Elements that only shape text, and those of lists, tables and links.
const SHAPES: [&str; 43] = [
    "docu",
    "doc",
    "member",
    "para",
    "p",
    "br",
    "b",
    "strong",
    "i",
    "em",
    "u",
    "c",
    "tt",
    "code",
    "literal",
    "h1",
    "h2",
    "h3",
    "h4",
    "h5",
    "h6",
    "ul",
    "ol",
    "li",
    "list",
    "item",
    "listheader",
    "term",
    "table",
    "thead",
    "tbody",
    "tr",
    "td",
    "th",
    "see",
    "seealso",
    "a",
    "paramref",
    "typeparamref",
    "typeparam",
    "note",
    "value",
    "inheritdoc",
];

/// A run of text or an element's tag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Piece<'a> {
    Text(Range<usize>),
    /// What a character reference stands for.
    Entity(&'a str),
    /// What is inside `<code>`.
    Code(Range<usize>),
    /// What is inside `<c>`, `<tt>`, `<literal>`.
    Inline(Range<usize>),
    Open {
        name: &'static str,
        attributes: Attributes,
        empty: bool,
    },
    Close(&'static str),
}

/// The attributes of a tag: their names and where their values stand.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Attributes(Vec<(String, Range<usize>)>);

impl Attributes {
    /// The value of `name`; empty if there is none.
    pub(super) fn get(&self, text: &Mapped, name: &str) -> Mapped {
        let found = self.0.iter().find(|(have, _)| have == name);
        found.map_or_else(|| Mapped::beside(text), |(_, range)| text.trimmed(range.clone()))
    }

    /// What a link leads to, without .NET's `T:` and `M:`.
    pub(super) fn target(&self, text: &Mapped) -> Mapped {
        let target =
            ["cref", "href", "uri", "name"].into_iter().map(|name| self.get(text, name)).find(|t| !t.is_blank());
        let Some(target) = target else { return Mapped::beside(text) };
        let source = target.as_str();
        let prefix = source.len() > 2 && source.as_bytes()[1] == b':' && source.as_bytes()[0].is_ascii_uppercase();
        target.slice(if prefix { 2 } else { 0 }..source.len())
    }

    /// Whether a link names something.
    pub(super) fn has_target(&self) -> bool {
        self.0.iter().any(|(name, range)| matches!(name.as_str(), "cref" | "href" | "uri") && !range.is_empty())
    }
}

/// The pieces of `text`; `None` if its elements do not nest.
pub(super) fn pieces(text: &str) -> Option<Vec<Piece<'static>>> {
    let mut out = Vec::new();
    let mut stack: Vec<&'static str> = Vec::new();
    let mut from = 0;
    let mut at = 0;
    while let Some(found) = text[at..].find(['<', '&']) {
        let open = at + found;
        let Some((piece, end)) = piece(text, open) else {
            at = open + 1;
            continue;
        };
        if from < open {
            out.push(Piece::Text(from..open));
        }
        match &piece {
            Piece::Open { name, empty: false, .. } if *name != "br" => {
                if matches!(*name, "code" | "c" | "tt" | "literal") {
                    let (range, end) = verbatim(text, end, name)?;
                    out.push(if *name == "code" { Piece::Code(range) } else { Piece::Inline(range) });
                    (from, at) = (end, end);
                    continue;
                }
                stack.push(name);
            }
            Piece::Close(name) if *name != "br" && stack.pop() != Some(name) => return None,
            _ => {}
        }
        out.push(piece);
        (from, at) = (end, end);
    }
    if from < text.len() {
        out.push(Piece::Text(from..text.len()));
    }
    stack.is_empty().then_some(out)
}

/// The text up to the tag that closes `name`, and where that ends.
fn verbatim(text: &str, start: usize, name: &str) -> Option<(Range<usize>, usize)> {
    let lower = text[start..].to_ascii_lowercase();
    let close = format!("</{name}>");
    let at = lower.find(&close)?;
    Some((start..start + at, start + at + close.len()))
}

/// The piece that begins with the `<` or `&` at `at`, and where it ends.
fn piece(text: &str, at: usize) -> Option<(Piece<'static>, usize)> {
    let rest = &text[at..];
    if rest.starts_with('&') {
        const ENTITIES: [(&str, &str); 6] =
            [("&lt;", "<"), ("&gt;", ">"), ("&amp;", "&"), ("&quot;", "\""), ("&apos;", "'"), ("&nbsp;", " ")];
        let (entity, meaning) = ENTITIES.iter().find(|(entity, _)| rest.starts_with(entity))?;
        return Some((Piece::Entity(meaning), at + entity.len()));
    }
    let close = rest[1..].starts_with('/');
    let start = at + 1 + usize::from(close);
    let len = text[start..].find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(text.len() - start);
    let name = known(&text[start..start + len])?;
    let mut i = start + len;
    if close {
        i += text[i..].len() - text[i..].trim_start().len();
        return text[i..].starts_with('>').then_some((Piece::Close(name), i + 1));
    }
    let mut attributes = Attributes::default();
    loop {
        i += text[i..].len() - text[i..].trim_start().len();
        let rest = &text[i..];
        if rest.starts_with('>') {
            return Some((Piece::Open { name, attributes, empty: false }, i + 1));
        }
        if rest.starts_with("/>") {
            return Some((Piece::Open { name, attributes, empty: true }, i + 2));
        }
        let (attribute, end) = attribute(text, i)?;
        attributes.0.push(attribute);
        i = end;
    }
}

/// `name="value"`, with any of the quotes that editors make.
fn attribute(text: &str, at: usize) -> Option<((String, Range<usize>), usize)> {
    let rest = &text[at..];
    let len = rest.find(|c: char| !c.is_ascii_alphanumeric()).filter(|len| *len > 0)?;
    let value = rest[len..].trim_start().strip_prefix('=')?.trim_start();
    let quote = value.chars().next()?;
    let close = match quote {
        '"' | '\'' => quote,
        '“' | '„' | '”' => '”',
        _ => return None,
    };
    let start = text.len() - value.len() + quote.len_utf8();
    let end = start + text[start..].find([close, '\n']).filter(|end| text[start + end..].starts_with(close))?;
    Some(((rest[..len].to_ascii_lowercase(), start..end), end + close.len_utf8()))
}

/// The known element of this name.
fn known(name: &str) -> Option<&'static str> {
    const SLOTS: [&str; 22] = [
        "summary",
        "brief",
        "description",
        "remarks",
        "remark",
        "param",
        "returns",
        "return",
        "example",
        "since",
        "deprecated",
        "todo",
        "version",
        "author",
        "req",
        "exception",
        "internal",
        "warning",
        "hint",
        "important",
        "history",
        "see",
    ];
    let lower = name.to_ascii_lowercase();
    let found = SHAPES.iter().chain(&SLOTS).find(|known| **known == lower)?;
    debug_assert!(SHAPES.contains(found) || slot(found).is_some(), "an element that no reader knows: {found}");
    Some(found)
}
