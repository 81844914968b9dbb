//! The names of tags, whatever sign or bracket they are written with.

/// What a tag is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::docs) enum Slot {
    Brief,
    Body,
    Param { note: &'static str },
    Returns,
    See,
    Copy,
    Since,
    Deprecated,
    Example,
    Todo,
    Version,
    Author,
    Req,
    History,
    Note(&'static str, &'static str),
    Internal,
    Fact(&'static str),
}

impl Slot {
    /// Whether an empty line ends it when it is written as `@tag text`.
    pub(super) const fn ends_with_paragraph(&self) -> bool {
        !matches!(self, Self::Body | Self::Example | Self::Internal | Self::History)
    }
}

/// What the tag `name` is about; `None` for a word that is no tag.
pub(super) fn slot(name: &str) -> Option<Slot> {
    let slot = match name.to_ascii_lowercase().as_str() {
        "brief" | "summary" | "short" => Slot::Brief,
        "details" | "detail" | "description" | "desc" | "remark" | "remarks" | "value" => Slot::Body,
        "param" | "parameter" | "arg" | "argument" | "tparam" => Slot::Param { note: "" },
        "input" | "in" => Slot::Param { note: "in" },
        "output" | "out" => Slot::Param { note: "out" },
        "inout" | "in_out" => Slot::Param { note: "in,out" },
        "return" | "returns" | "result" | "retval" | "ret" => Slot::Returns,
        "see" | "sa" | "seealso" => Slot::See,
        "copydoc" | "inheritdoc" => Slot::Copy,
        "since" | "versionadded" => Slot::Since,
        "deprecated" | "obsolete" => Slot::Deprecated,
        "example" | "examples" | "usage" => Slot::Example,
        "todo" | "fixme" => Slot::Todo,
        "version" => Slot::Version,
        "author" | "authors" | "programmer" => Slot::Author,
        "req" | "requirement" | "requirements" | "satisfies" => Slot::Req,
        "history" | "changelog" | "versionchanged" => Slot::History,
        "note" | "info" => Slot::Note("note", "Note"),
        "hint" | "tip" => Slot::Note("note", "Hint"),
        "important" => Slot::Note("warning", "Important"),
        "warning" | "attention" | "caution" | "danger" => Slot::Note("warning", "Warning"),
        "bug" => Slot::Note("warning", "Known fault"),
        "pre" | "precondition" | "requires" => Slot::Note("remark", "Precondition"),
        "post" | "postcondition" | "ensures" => Slot::Note("remark", "Postcondition"),
        "invariant" => Slot::Note("remark", "Invariant"),
        "throws" | "throw" | "exception" | "raises" | "error" => Slot::Note("remark", "Errors"),
        "internal" | "private" | "hidden" => Slot::Internal,
        "date" => Slot::Fact("date"),
        "file" => Slot::Fact("file"),
        "copyright" => Slot::Fact("copyright"),
        "license" | "licence" => Slot::Fact("licence"),
        "name" | "class" | "struct" | "fn" | "function" | "method" => Slot::Fact("name"),
        "ingroup" | "defgroup" | "addtogroup" | "category" => Slot::Fact("group"),
        _ => return None,
    };
    Some(slot)
}
