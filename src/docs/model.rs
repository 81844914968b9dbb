//! What a comment says: prose, tags, test tables, and how it was chosen.

use super::prose::{Block, Inline, LinkTarget};
use crate::library::{ItemId, Placement};
use crate::text::{Place, SpanMap};

/// The documentation of a catalogue.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Docs {
    /// One entry for each item, in the order of the catalogue.
    pub items: Vec<Entry>,
    /// For each item one entry for each of its variables.
    pub variables: Vec<Vec<Entry>>,
}

impl Docs {
    /// The entry of an item.
    ///
    /// # Panics
    /// If `id` comes from another catalogue.
    #[must_use]
    pub fn item(&self, id: ItemId) -> &Entry {
        &self.items[id.0 as usize]
    }

    /// The entry of a variable; `None` if the item has no such variable.
    #[must_use]
    pub fn variable(&self, id: ItemId, index: usize) -> Option<&Entry> {
        self.variables.get(id.0 as usize)?.get(index)
    }
}

/// What is known about the documentation of one item or variable.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Entry {
    /// The documentation, its own or an inherited one.
    pub doc: Option<Documentation>,
    /// The item whose documentation was inherited. Its links and tags were judged there.
    pub inherited_from: Option<ItemId>,
    /// A comment that only holds the place of documentation, such as `TODO: add your comment here`.
    pub placeholder: Option<Place>,
    /// The text of the pragma that calls it obsolete, such as `{attribute 'obsolete' := '…'}`.
    pub obsolete: Option<(String, Place)>,
    /// The comments that were looked at, in the order of the source, with what became of them.
    pub considered: Vec<Considered>,
}

/// A comment that may be documentation, and what became of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Considered {
    /// Where it stands, seen from what it may document.
    pub placement: Placement,
    /// Its place in the file, from its first delimiter to its last.
    pub place: Place,
    /// What became of it.
    pub verdict: Verdict,
}

/// What became of a comment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It is documentation, in this convention.
    Taken(Convention),
    /// It is not.
    Rejected(Reason),
}

/// Why a comment is not documentation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Reason {
    /// It holds no word.
    Separator,
    /// An instruction to a tool, such as `#CMD#`, `@OBJECTFLAGS := …` or `<Region>`.
    Directive,
    /// A copyright notice or a licence.
    Licence,
    /// A header that speaks of its file and not of what it declares.
    FileHeader,
    /// A revision history; kept as such.
    History,
    /// Code that was commented out.
    Code,
    /// A placeholder.
    Placeholder,
    /// The heading of a group of declarations.
    Heading,
    /// An empty line sets it apart from the declaration.
    SetApart,
    /// It speaks of the statement below it.
    Statement,
    /// Another placement is preferred.
    OtherPlacement(Placement),
    /// Another comment carries a documentation mark such as `///`, and this one does not.
    Unmarked,
    /// The options ask for another placement or mark.
    NotAsked,
}

impl Reason {
    /// One line that `explain` prints.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Separator => "a separator",
            Self::Directive => "an instruction to a tool",
            Self::Licence => "a licence header",
            Self::FileHeader => "a header of the file, which says nothing of what is declared",
            Self::History => "a revision history",
            Self::Code => "commented-out code",
            Self::Placeholder => "a placeholder",
            Self::Heading => "the heading of a group",
            Self::SetApart => "an empty line sets it apart from the declaration",
            Self::Statement => "it belongs to the statement below it",
            Self::OtherPlacement(placement) => match placement {
                Placement::Container => "documentation that the container keeps is preferred",
                Placement::Above => "a comment above the declaration is preferred",
                Placement::Trailing => "a comment on the line of the declaration is preferred",
                Placement::BelowHeader => "a comment below the header is preferred",
                Placement::BetweenSections => "a comment between the sections is preferred",
                Placement::AfterSections => "a comment after the last section is preferred",
                Placement::FirstInBody => "the first comment of the body is preferred",
                Placement::Below => "a comment below the declaration is preferred",
            },
            Self::Unmarked => "a comment with a documentation mark is preferred",
            Self::NotAsked => "the configuration asks for another placement or mark",
        }
    }
}

/// A way to write documentation in comments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Convention {
    /// Plain prose, read as Markdown.
    Markdown,
    /// Markdown with tags such as `@param` or `\return`.
    Javadoc,
    /// XML elements such as `<summary>`, also in TcOpen's `(*~ <docu> … ~*)`.
    Xml,
    /// Beckhoff TE1030: `//!` and `(*! *)` with elements or `@` forms.
    Te1030,
    /// CODESYS LibDoc: a subset of reStructuredText.
    LibDoc,
    /// The field lists of plcdoc.
    Plcdoc,
    /// `{description := "…"}` of Neuron Power Engineer and logi.CAD.
    Neuron,
    /// OSCAT: version, programmer, tested by, then prose.
    Oscat,
    /// A header of `Key: value` lines with a description.
    FileHeader,
}

impl Convention {
    /// All conventions.
    pub const ALL: [Self; 9] = [
        Self::Markdown,
        Self::Javadoc,
        Self::Xml,
        Self::Te1030,
        Self::LibDoc,
        Self::Plcdoc,
        Self::Neuron,
        Self::Oscat,
        Self::FileHeader,
    ];

    /// The key that the configuration and JSON use.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Markdown => "markdown",
            Self::Javadoc => "javadoc",
            Self::Xml => "xml",
            Self::Te1030 => "te1030",
            Self::LibDoc => "libdoc",
            Self::Plcdoc => "plcdoc",
            Self::Neuron => "neuron",
            Self::Oscat => "oscat",
            Self::FileHeader => "file-header",
        }
    }

    /// The convention that `key` names.
    #[must_use]
    pub fn from_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|convention| convention.key() == key)
    }
}

/// The documentation of one item or variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Documentation {
    /// One line or sentence; empty if there is none.
    pub brief: Vec<Inline>,
    /// All else.
    pub detail: Vec<Block>,
    /// What the tags say.
    pub tags: Tags,
    /// The test tables, which are cut out of the prose.
    pub tables: Vec<TableText>,
    /// How it is written.
    pub convention: Convention,
    /// Where the first comment of it stands.
    pub placement: Placement,
    /// The comments that it was read from.
    pub places: Vec<Place>,
}

impl Documentation {
    /// Where it begins.
    #[must_use]
    pub fn place(&self) -> Option<Place> {
        self.places.first().copied()
    }

    /// Whether it says nothing in prose.
    #[must_use]
    pub const fn is_silent(&self) -> bool {
        self.brief.is_empty() && self.detail.is_empty()
    }

    /// The brief as plain text.
    #[must_use]
    pub fn brief_text(&self) -> String {
        Inline::plain(&self.brief)
    }

    /// Every link, those in tags too, with its place.
    #[must_use]
    pub fn links(&self) -> Vec<(&LinkTarget, Place)> {
        let mut out = Vec::new();
        Inline::collect_links(&self.brief, &mut out);
        Block::collect_links(&self.detail, &mut out);
        for tag in self.tags.all() {
            Block::collect_links(&tag.content, &mut out);
        }
        for param in &self.tags.params {
            Block::collect_links(&param.content, &mut out);
        }
        Block::collect_links(&self.tags.history, &mut out);
        out
    }

    /// The links that lead nowhere: what was written, and where.
    #[must_use]
    pub fn broken_links(&self) -> Vec<(&str, Place)> {
        let links = self.links().into_iter();
        let broken = links.filter_map(|(target, place)| match target {
            LinkTarget::Broken { text } => Some((text.as_str(), place)),
            _ => None,
        });
        broken.collect()
    }
}

/// What the tags of a comment say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tags {
    /// `@param`, and its relatives.
    pub params: Vec<ParamTag>,
    /// `@return`.
    pub returns: Option<Tag>,
    /// `@see`.
    pub see: Vec<Tag>,
    /// The item whose documentation `@copydoc` asks for.
    pub copy_of: Option<ItemId>,
    /// `@since`.
    pub since: Option<Tag>,
    /// `@deprecated`.
    pub deprecated: Option<Tag>,
    /// `@example`.
    pub examples: Vec<Tag>,
    /// `@todo`.
    pub todos: Vec<Tag>,
    /// `@version`.
    pub version: Option<Tag>,
    /// `@author`.
    pub authors: Vec<Tag>,
    /// `@internal`.
    pub internal: bool,
    /// What else a header says, such as `tested by`.
    pub facts: Vec<Fact>,
    /// The identifiers after `@req`.
    pub requirements: Vec<(String, Place)>,
    /// A revision history.
    pub history: Vec<Block>,
    /// The paths after `@gtt`.
    pub gtt_paths: Vec<(String, Place)>,
}

impl Tags {
    /// All tags that hold prose, but the parameters.
    pub fn all(&self) -> impl Iterator<Item = &Tag> {
        let single = [&self.returns, &self.since, &self.deprecated, &self.version];
        let several = [&self.see, &self.examples, &self.todos, &self.authors];
        single.into_iter().flatten().chain(several.into_iter().flatten())
    }
}

/// A line of a header: its key and its value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fact {
    /// The key as written, without the colon.
    pub key: String,
    /// The value as written.
    pub value: String,
    /// Where the value stands.
    pub place: Place,
}

/// A tag with its prose.
#[derive(Clone, Debug, PartialEq)]
pub struct Tag {
    /// Where its text stands.
    pub place: Place,
    /// What it says.
    pub content: Vec<Block>,
}

/// What a comment says of a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct ParamTag {
    /// The name as written.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// The variable that it names; `None` if it names nothing.
    pub target: Option<(ItemId, usize)>,
    /// The direction or type that the tag gives, such as `in`; empty if none.
    pub note: String,
    /// What it says.
    pub content: Vec<Block>,
}

/// A test table in a comment: `@gtt NAME (…)` with the lines of a pipe table, or a fenced `gtt` block.
#[derive(Clone, Debug, PartialEq)]
pub struct TableText {
    /// What follows `@gtt` on its line, or the name of the fence; empty if nothing.
    pub heading: String,
    /// The heading line and the lines of the table, without gutters, as they are to be parsed.
    pub text: String,
    /// From offsets in `text` to offsets in the file.
    pub map: SpanMap,
    /// Where it stands, from the heading to the last line.
    pub place: Place,
}
