//! What a tree declares: entities, their variables, and the places of all their parts.

use std::fmt;

use crate::text::{FileId, Language, Place, Span};

/// Names an [`Item`] in its catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ItemId(pub u32);

/// Names a [`Library`](super::Library) in its catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LibraryId(pub u32);

/// Names a parsed fragment in its catalogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FragmentId(pub u32);

/// What an item is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ItemKind {
    /// `FUNCTION_BLOCK`.
    FunctionBlock,
    /// `CLASS`.
    Class,
    /// `FUNCTION`.
    Function,
    /// `PROGRAM`, and Siemens' `ORGANIZATION_BLOCK`.
    Program,
    /// `INTERFACE`.
    Interface,
    /// `STRUCT`.
    Struct,
    /// An enumeration.
    Enum,
    /// `UNION`.
    Union,
    /// A type that gives another one a name.
    Alias,
    /// A type that narrows another one.
    Subrange,
    /// A list of global variables, and Siemens' `DATA_BLOCK`.
    GlobalVariables,
    /// A task with what it calls.
    Task,
    /// `METHOD`.
    Method,
    /// `PROPERTY`.
    Property,
    /// `ACTION`.
    Action,
    /// `TRANSITION`.
    Transition,
    /// A property's `GET`.
    Getter,
    /// A property's `SET`.
    Setter,
}

impl ItemKind {
    /// All kinds, in the order in which manuals list them.
    pub const ALL: [Self; 18] = [
        Self::Program,
        Self::FunctionBlock,
        Self::Class,
        Self::Function,
        Self::Interface,
        Self::Struct,
        Self::Enum,
        Self::Union,
        Self::Alias,
        Self::Subrange,
        Self::GlobalVariables,
        Self::Task,
        Self::Method,
        Self::Property,
        Self::Action,
        Self::Transition,
        Self::Getter,
        Self::Setter,
    ];

    /// The key that JSON, templates and style sheets use.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::FunctionBlock => "function-block",
            Self::Class => "class",
            Self::Function => "function",
            Self::Program => "program",
            Self::Interface => "interface",
            Self::Struct => "struct",
            Self::Enum => "enum",
            Self::Union => "union",
            Self::Alias => "alias",
            Self::Subrange => "subrange",
            Self::GlobalVariables => "gvl",
            Self::Task => "task",
            Self::Method => "method",
            Self::Property => "property",
            Self::Action => "action",
            Self::Transition => "transition",
            Self::Getter => "getter",
            Self::Setter => "setter",
        }
    }

    /// The kind as a title shows it.
    #[must_use]
    pub const fn label(self) -> &'static str {
        match self {
            Self::FunctionBlock => "Function block",
            Self::Class => "Class",
            Self::Function => "Function",
            Self::Program => "Program",
            Self::Interface => "Interface",
            Self::Struct => "Structure",
            Self::Enum => "Enumeration",
            Self::Union => "Union",
            Self::Alias => "Alias",
            Self::Subrange => "Subrange",
            Self::GlobalVariables => "Global variables",
            Self::Task => "Task",
            Self::Method => "Method",
            Self::Property => "Property",
            Self::Action => "Action",
            Self::Transition => "Transition",
            Self::Getter => "Getter",
            Self::Setter => "Setter",
        }
    }

    /// Whether it stands inside another item.
    #[must_use]
    pub const fn is_member(self) -> bool {
        matches!(self, Self::Method | Self::Property | Self::Action | Self::Transition | Self::Getter | Self::Setter)
    }

    /// Whether it is an accessor, which has no page, documentation or count of its own.
    #[must_use]
    pub const fn is_accessor(self) -> bool {
        matches!(self, Self::Getter | Self::Setter)
    }

    /// Whether a variable can have it as its type.
    #[must_use]
    pub const fn is_type(self) -> bool {
        matches!(
            self,
            Self::FunctionBlock
                | Self::Class
                | Self::Interface
                | Self::Struct
                | Self::Enum
                | Self::Union
                | Self::Alias
                | Self::Subrange
        )
    }
}

/// Who may use an item.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Access {
    /// Everybody.
    #[default]
    Public,
    /// The same library or namespace.
    Internal,
    /// The same block and what extends it.
    Protected,
    /// The same block.
    Private,
}

impl Access {
    /// The keyword in lower case.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Public => "public",
            Self::Internal => "internal",
            Self::Protected => "protected",
            Self::Private => "private",
        }
    }
}

impl fmt::Display for Access {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A range of a parsed fragment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Excerpt {
    /// The fragment.
    pub fragment: FragmentId,
    /// The range in its text.
    pub span: Span,
}

/// One declared entity or member.
#[derive(Clone, Debug)]
pub struct Item {
    /// What it is.
    pub kind: ItemKind,
    /// Name as declared, without quotes.
    pub name: String,
    /// The place of the name.
    pub place: Place,
    /// The item that it stands in.
    pub parent: Option<ItemId>,
    /// The items that stand in it, in the order of the source.
    pub children: Vec<ItemId>,
    /// The library that it belongs to.
    pub library: LibraryId,
    /// Its namespace, outermost first.
    pub namespace: Vec<String>,
    /// Its folder in the library, outermost first; for a member, its folder in the block.
    pub folder: Vec<String>,
    /// Who may use it.
    pub access: Access,
    /// `ABSTRACT`.
    pub is_abstract: bool,
    /// `FINAL`.
    pub is_final: bool,
    /// `OVERRIDE`.
    pub is_override: bool,
    /// The types after `EXTENDS`.
    pub extends: Vec<TypeUse>,
    /// The types after `IMPLEMENTS`.
    pub implements: Vec<TypeUse>,
    /// Return type, property type, aliased type, base type of an enumeration or subrange.
    pub type_: Option<TypeUse>,
    /// Variables, fields or values, in the order of the source.
    pub variables: Vec<Variable>,
    /// The pragmas that belong to the declaration.
    pub pragmas: Vec<Pragma>,
    /// Comments that may be its documentation, in the order of the source.
    pub comments: Vec<Comment>,
    /// The header with its variable sections.
    pub declaration: Option<Excerpt>,
    /// The body.
    pub body: ItemBody,
    /// Other facts that its container tells, as `(key, value)`.
    pub properties: Vec<(String, String)>,
}

impl Item {
    /// The file that it stands in.
    #[must_use]
    pub const fn file(&self) -> FileId {
        self.place.file
    }
}

/// The body of an item.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ItemBody {
    /// None.
    #[default]
    None,
    /// Structured Text.
    St(Excerpt),
    /// Instruction List.
    Il(Excerpt),
    /// A drawn language, kept as the container has it.
    Drawn(Language, Excerpt),
}

/// A type as written, with the names in it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TypeUse {
    /// The text with white space and comments folded.
    pub text: String,
    /// Where it stands.
    pub place: Option<Place>,
    /// The names in it, ascending: the range in `text`, and what it means.
    pub names: Vec<(Span, Target)>,
}

/// What a name means.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// An item of this tree.
    Item(ItemId),
    /// A type that IEC 61131-3 or the dialect defines.
    Elementary,
    /// Nothing of this tree: a vendor's library, most likely.
    External,
}

/// A pragma.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pragma {
    /// As written, with its braces.
    pub text: String,
    /// Where.
    pub place: Place,
}

impl Pragma {
    /// Name and value of `{attribute 'name' := 'value'}`; the value is empty where there is none.
    #[must_use]
    pub fn attribute(&self) -> Option<(&str, &str)> {
        let inner = self.text.strip_prefix('{')?.strip_suffix('}')?.trim();
        let (head, rest) = inner.split_at_checked("attribute".len())?;
        if !head.eq_ignore_ascii_case("attribute") {
            return None;
        }
        let mut parts = rest.splitn(2, ":=").map(|part| part.trim().trim_matches('\''));
        Some((parts.next()?, parts.next().unwrap_or("")))
    }
}

/// Where a comment stands, seen from what it may document.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Placement {
    /// Kept by the container, outside the declaration's text.
    Container,
    /// Before the header, above or between its pragmas.
    Above,
    /// On the line of the declaration, behind it.
    Trailing,
    /// Behind the header, before the first section.
    BelowHeader,
    /// Between two sections.
    BetweenSections,
    /// Behind the last `END_VAR`.
    AfterSections,
    /// At the beginning of the body.
    FirstInBody,
    /// On the line or lines below the declaration of a variable, aligned behind it.
    Below,
}

/// A run of comments that stand together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Comment {
    /// Where it stands.
    pub placement: Placement,
    /// The fragment that it stands in.
    pub fragment: FragmentId,
    /// The comment tokens with their delimiters, in order; only white space is between them.
    pub spans: Vec<Span>,
}

/// The section that a variable is declared in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Section {
    /// `VAR_INPUT`.
    Input,
    /// `VAR_OUTPUT`.
    Output,
    /// `VAR_IN_OUT`.
    InOut,
    /// `VAR`.
    Var,
    /// `VAR_TEMP`.
    Temp,
    /// `VAR_STAT`.
    Stat,
    /// `VAR_INST`.
    Inst,
    /// `VAR_GLOBAL`.
    Global,
    /// `VAR_EXTERNAL`.
    External,
    /// `VAR_CONFIG`.
    Config,
    /// `VAR_ACCESS`.
    AccessPath,
    /// A field of a structure or union.
    Field,
    /// A value of an enumeration.
    Value,
}

impl Section {
    /// All sections, in the order in which manuals list them.
    pub const ALL: [Self; 13] = [
        Self::Input,
        Self::InOut,
        Self::Output,
        Self::Field,
        Self::Value,
        Self::Global,
        Self::Var,
        Self::Inst,
        Self::Stat,
        Self::Temp,
        Self::External,
        Self::Config,
        Self::AccessPath,
    ];

    /// The key that JSON, templates and style sheets use.
    #[must_use]
    pub const fn key(self) -> &'static str {
        match self {
            Self::Input => "input",
            Self::Output => "output",
            Self::InOut => "in-out",
            Self::Var => "var",
            Self::Temp => "temp",
            Self::Stat => "stat",
            Self::Inst => "inst",
            Self::Global => "global",
            Self::External => "external",
            Self::Config => "config",
            Self::AccessPath => "access",
            Self::Field => "field",
            Self::Value => "value",
        }
    }

    /// The title of its table.
    #[must_use]
    pub const fn title(self) -> &'static str {
        match self {
            Self::Input => "Inputs",
            Self::Output => "Outputs",
            Self::InOut => "In-outs",
            Self::Var => "Internal variables",
            Self::Temp => "Temporary variables",
            Self::Stat => "Static variables",
            Self::Inst => "Instance variables",
            Self::Global => "Variables",
            Self::External => "External variables",
            Self::Config => "Configured variables",
            Self::AccessPath => "Access paths",
            Self::Field => "Fields",
            Self::Value => "Values",
        }
    }

    /// Whether it belongs to the interface.
    #[must_use]
    pub const fn is_interface(self) -> bool {
        matches!(self, Self::Input | Self::Output | Self::InOut | Self::Global | Self::Field | Self::Value)
    }
}

/// A variable, field or enumeration value.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Name as declared, without quotes.
    pub name: String,
    /// The place of the name.
    pub place: Place,
    /// Its section.
    pub section: Section,
    /// `CONSTANT`.
    pub constant: bool,
    /// `RETAIN`.
    pub retain: bool,
    /// `PERSISTENT`.
    pub persistent: bool,
    /// `R_EDGE` or `F_EDGE`, in lower case.
    pub edge: Option<&'static str>,
    /// Type; `None` for an enumeration value.
    pub type_: Option<TypeUse>,
    /// Initial value as written.
    pub initial: Option<String>,
    /// Direct address as written.
    pub address: Option<String>,
    /// The pragmas above it.
    pub pragmas: Vec<Pragma>,
    /// Comments that may be its documentation.
    pub comments: Vec<Comment>,
}
