//! Entities as pages see them: a function block, function, program, interface, type or list of
//! globals, with its members inside.

use serde::Serialize;

use super::finding::FindingView;
use super::prose::{Block, Href, Inline};
use super::table::TableView;

/// A top-level entity: one page of the site, one section of the PDF.
#[derive(Clone, Debug, Serialize)]
pub struct EntityView {
    /// What every entity has.
    #[serde(flatten)]
    pub core: CoreView,
    /// The library it belongs to, as index into [`super::Book::libraries`].
    pub library: usize,
    /// The library's name.
    pub library_name: String,
    /// Namespace, outermost first; mostly empty.
    pub namespace: Vec<String>,
    /// Folder in its library, outermost first.
    pub folder: Vec<String>,
    /// What it extends, implements, is extended, implemented and used by, and uses; only those that hold something.
    pub relations: Vec<Relation>,
    /// The inheritance drawing, where there is any inheritance.
    pub inheritance: Option<Diagram>,
    /// Methods, properties, actions and transitions of its own, by kind and then in the order of the source.
    pub members: Vec<MemberView>,
    /// Members that it inherits and does not override.
    pub inherited: Vec<InheritedView>,
    /// Its test tables.
    pub tables: Vec<TableView>,
    /// Its source: declaration and body, and those of its members.
    pub sources: Vec<SourceView>,
    /// The findings in it, in the order of the source.
    pub findings: Vec<FindingView>,
}

/// What entities and members have in common.
#[derive(Clone, Debug, Default, Serialize)]
pub struct CoreView {
    /// `function-block`, `function`, `program`, `interface`, `class`, `method`, `property`, `action`,
    /// `transition`, `struct`, `enum`, `union`, `alias`, `subrange`, `gvl`, `task`.
    pub kind: &'static str,
    /// The kind as a title shows it: `Function block`.
    pub kind_label: &'static str,
    /// Name as declared.
    pub name: String,
    /// Name with namespace and owner.
    pub qualified_name: String,
    /// The page below the site's root, with an anchor for a member.
    pub url: String,
    /// The anchor on its page; empty for a top-level entity.
    pub anchor: String,
    /// The label in the PDF, unique in the book: letters, digits, `-`, `_`, `.` and `:`.
    pub label: String,
    /// File below the tree's root.
    pub file: String,
    /// Line of the name, from 1.
    pub line: u32,
    /// Whether it has documentation.
    pub documented: bool,
    /// `abstract`, `final`, `private`, `protected`, `internal`, `override`, `deprecated`, `external`.
    pub badges: Vec<String>,
    /// The brief description.
    pub brief: Vec<Inline>,
    /// The detail.
    pub detail: Vec<Block>,
    /// Since, see, examples, requirements, version and the like, in the order of the source.
    pub facts: Vec<Fact>,
    /// From whom the documentation is inherited, if it is.
    pub documentation_from: Option<EntityLink>,
    /// The signature as Structured Text, for highlighting; lines separated by `\n`.
    pub signature: String,
    /// The interface diagram, for what has an interface.
    pub diagram: Option<Diagram>,
    /// Return type (function, method), type (property), aliased type, base type (enum, subrange).
    pub type_label: Option<&'static str>,
    /// That type.
    pub type_: Vec<TypePart>,
    /// What is returned, as `@return` says.
    pub returns: Vec<Inline>,
    /// Inputs, outputs, in-outs, variables, fields, values: only those that hold something.
    pub sections: Vec<SectionView>,
    /// Attributes and other pragmas as written, such as `{attribute 'qualified_only'}`.
    pub pragmas: Vec<String>,
}

/// A titled fact with prose.
#[derive(Clone, Debug, Serialize)]
pub struct Fact {
    /// `Since`, `See also`, `Example`, `Requirements`, `Attributes`.
    pub title: String,
    /// What it says.
    pub content: Vec<Block>,
}

/// A method, property, action or transition.
#[derive(Clone, Debug, Serialize)]
pub struct MemberView {
    /// What every entity has.
    #[serde(flatten)]
    pub core: CoreView,
    /// The member that it overrides or implements.
    pub overrides: Vec<EntityLink>,
    /// `read-only`, `write-only` or `read/write` for a property.
    pub access: Option<&'static str>,
}

/// A member of a base.
#[derive(Clone, Debug, Serialize)]
pub struct InheritedView {
    /// The member.
    pub link: EntityLink,
    /// Its kind as a title shows it.
    pub kind_label: &'static str,
    /// Whose it is.
    pub from: EntityLink,
    /// Its brief description.
    pub brief: Vec<Inline>,
}

/// A link to an entity, or the name of one that is not in this tree.
#[derive(Clone, Debug, Serialize)]
pub struct EntityLink {
    /// The name to show.
    pub name: String,
    /// Its kind as a title shows it; empty for one that is not in this tree.
    pub kind_label: &'static str,
    /// Where to; `None` for one that is not in this tree.
    pub to: Option<Href>,
}

/// A titled list of links.
#[derive(Clone, Debug, Serialize)]
pub struct Relation {
    /// `extends`, `implements`, `extended-by`, `implemented-by`, `uses`, `used-by`.
    pub key: &'static str,
    /// The title.
    pub title: &'static str,
    /// Whereto.
    pub links: Vec<EntityLink>,
}

/// A drawing as SVG.
#[derive(Clone, Debug, Serialize)]
pub struct Diagram {
    /// A complete `<svg>` element. Colours are CSS custom properties with a fallback, so that a page may
    /// theme it and a renderer without CSS still draws it.
    pub svg: String,
    /// What it shows, for those who cannot see it.
    pub alt: String,
    /// Natural width in points.
    pub width: f64,
    /// Natural height in points.
    pub height: f64,
}

/// A part of a type's text; linked where it names an entity of this tree.
#[derive(Clone, Debug, Serialize)]
pub struct TypePart {
    /// The text.
    pub text: String,
    /// Where it is declared.
    pub to: Option<Href>,
}

/// A group of variables, fields or values.
#[derive(Clone, Debug, Serialize)]
pub struct SectionView {
    /// `input`, `output`, `in-out`, `var`, `temp`, `stat`, `inst`, `global`, `external`, `config`, `access`, `field`, `value`.
    pub key: &'static str,
    /// The title: `Inputs`.
    pub title: String,
    /// Whether these belong to the interface; others are internals that a page may fold.
    pub public: bool,
    /// The variables.
    pub variables: Vec<VariableView>,
}

/// A variable, field or enumeration value.
#[derive(Clone, Debug, Serialize)]
pub struct VariableView {
    /// Name.
    pub name: String,
    /// Anchor on the page.
    pub anchor: String,
    /// The label in the PDF.
    pub label: String,
    /// Type, empty for an enumeration value.
    pub type_: Vec<TypePart>,
    /// Initial value as written; empty if none.
    pub initial: String,
    /// Direct address as written; empty if none.
    pub address: String,
    /// `constant`, `retain`, `persistent`.
    pub badges: Vec<String>,
    /// The brief description.
    pub brief: Vec<Inline>,
    /// The rest of its documentation.
    pub detail: Vec<Block>,
    /// Pragmas as written.
    pub pragmas: Vec<String>,
    /// Line, from 1.
    pub line: u32,
    /// Whose it is, if it is inherited.
    pub inherited_from: Option<EntityLink>,
}

/// A listing.
#[derive(Clone, Debug, Serialize)]
pub struct SourceView {
    /// `Declaration`, `Body`, or a member's name and which of its two.
    pub title: String,
    /// The member's anchor; empty for the entity itself.
    pub anchor: String,
    /// File below the tree's root.
    pub file: String,
    /// The line in the file at which it begins, from 1.
    pub first_line: u32,
    /// The text.
    pub text: String,
    /// Its tokens that are not plain, ascending and disjoint.
    pub runs: Vec<Run>,
    /// The addresses that [`Run::link`] means.
    pub links: Vec<String>,
    /// Why it is not shown, where it cannot be (a drawn language).
    pub note: Option<String>,
}

/// A highlighted token of a listing.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Run {
    /// First byte in the text.
    pub start: u32,
    /// One past its last byte.
    pub end: u32,
    /// What it is.
    pub class: RunClass,
    /// Index into [`SourceView::links`].
    pub link: Option<u32>,
}

/// What a token of a listing is; the names are those of the highlighter's CSS classes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum RunClass {
    /// A word of the language.
    Keyword,
    /// An elementary type.
    Type,
    /// A comment.
    Comment,
    /// A pragma or attribute.
    Pragma,
    /// A string.
    String,
    /// A number, duration, date or direct address.
    Number,
    /// An operator.
    Operator,
    /// A name; only those with a link are listed.
    Name,
}
