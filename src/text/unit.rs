//! What a file holds once its container is taken off: objects with declarations and bodies.
//!
//! A plain text file is one object whose declaration is the whole text. A TwinCAT or PLCopen file
//! is a tree of objects, each with a declaration and a body in some language. A [`Fragment`]
//! keeps, for each run of its text, where in the file that run stands.

use std::sync::Arc;

use super::{FileId, Span};

/// One file, unwrapped.
#[derive(Clone, Debug)]
pub struct Unit {
    /// The file.
    pub file: FileId,
    /// The format's name, as the manual's page on formats calls it, such as `TwinCAT 3`.
    pub format: &'static str,
    /// Whose dialect the text is written in.
    pub vendor: Vendor,
    /// Whether comments nest, if the container says so.
    pub nested_comments: Option<bool>,
    /// The project that names the file (its `.plcproj`, its package), as index into `Tree::projects`.
    pub project: Option<usize>,
    /// What the file holds, in its order.
    pub objects: Vec<Object>,
}

/// Whose dialect a text is written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Vendor {
    /// The standard, and whatever the dialects agree on.
    #[default]
    Standard,
    /// Beckhoff TwinCAT 3.
    TwinCat,
    /// CODESYS V3, and PLCopen XML.
    Codesys,
    /// CODESYS V2.3.
    Codesys2,
    /// Siemens SCL and its relatives.
    Siemens,
    /// SIMATIC AX.
    SimaticAx,
    /// B&R Automation Studio.
    BAndR,
    /// Eclipse 4diac (IEC 61499).
    FourDiac,
    /// logi.CAD and Neuron.
    LogiCad,
}

/// What an object of a container is, as the container says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ObjectKind {
    /// Any number of declarations, as in a plain text file.
    Text,
    /// A program organisation unit; its declaration says which.
    Pou,
    /// A data type.
    DataType,
    /// A list of global variables; the name is the object's, the declaration only holds sections.
    GlobalVariables,
    /// An interface.
    Interface,
    /// A method.
    Method,
    /// A property.
    Property,
    /// A property's `GET`.
    Getter,
    /// A property's `SET`.
    Setter,
    /// An action; usually without a declaration.
    Action,
    /// A transition; usually without a declaration.
    Transition,
    /// A task, with what it calls.
    Task,
}

/// One object: a POU, a type, a member of one, or a whole text.
#[derive(Clone, Debug)]
pub struct Object {
    /// What the container says it is.
    pub kind: ObjectKind,
    /// Its name as the container says; `None` for a whole text.
    pub name: Option<String>,
    /// The place of the name, or of the element that holds the object, in the file.
    pub span: Span,
    /// The folder inside the container (TwinCAT's `Folder`), outermost first.
    pub folder: Vec<String>,
    /// The text of its declaration.
    pub declaration: Option<Fragment>,
    /// Its body.
    pub body: Body,
    /// Documentation that the container keeps apart from the declaration (PLCopen's `xhtml`, 61499's `Comment`), as Markdown.
    pub documentation: Option<Fragment>,
    /// Methods, properties, actions, transitions, accessors.
    pub children: Vec<Object>,
    /// Other facts of the container, as `(key, value)`, in its order.
    pub properties: Vec<(String, String)>,
}

impl Object {
    /// An object of `kind` with nothing in it.
    #[must_use]
    pub const fn new(kind: ObjectKind, name: Option<String>, span: Span) -> Self {
        Self {
            kind,
            name,
            span,
            folder: Vec::new(),
            declaration: None,
            body: Body::None,
            documentation: None,
            children: Vec::new(),
            properties: Vec::new(),
        }
    }
}

/// The body of an object.
#[derive(Clone, Debug, Default)]
pub enum Body {
    /// There is none, or it is part of the declaration's text.
    #[default]
    None,
    /// Structured Text.
    St(Fragment),
    /// Instruction List.
    Il(Fragment),
    /// A language that is kept and listed, and not shown yet.
    Other(Language, Fragment),
}

/// A language of IEC 61131-3 (or of a vendor) that is no text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Language {
    /// Sequential Function Chart.
    Sfc,
    /// Function Block Diagram.
    Fbd,
    /// Ladder Diagram.
    Ld,
    /// Continuous Function Chart.
    Cfc,
    /// An IEC 61499 execution control chart or network.
    Ecc,
    /// Something else.
    Unknown,
}

/// A piece of text taken out of a file, with the way back.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fragment {
    /// The text as it is to be parsed.
    pub text: Arc<str>,
    /// Where it stands in the file.
    pub map: SpanMap,
}

impl Fragment {
    /// `text`, which stands in the file as it is, from byte `start` on.
    #[must_use]
    pub fn verbatim(text: impl Into<Arc<str>>, start: u32) -> Self {
        Self { text: text.into(), map: SpanMap::verbatim(start) }
    }
}

/// One run of a [`SpanMap`]: from offset `from` of the fragment up to the next run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Run {
    /// Where the run begins in the fragment.
    pub from: u32,
    /// Where it stands in the file.
    pub to: u32,
    /// `None` where the run stands in the file byte for byte; otherwise the length of what it stands for
    /// there: an entity, an attribute, the element that a synthesised declaration was made from.
    pub stands_for: Option<u32>,
}

impl Run {
    /// A run that stands in the file byte for byte, from `to` on.
    #[must_use]
    pub const fn verbatim(from: u32, to: u32) -> Self {
        Self { from, to, stands_for: None }
    }

    /// A run that stands for `span` of the file as a whole.
    #[must_use]
    pub const fn standing_for(from: u32, span: Span) -> Self {
        Self { from, to: span.start, stands_for: Some(span.len()) }
    }
}

impl From<(u32, u32)> for Run {
    /// A verbatim run: from the fragment's offset, to the file's.
    fn from((from, to): (u32, u32)) -> Self {
        Self::verbatim(from, to)
    }
}

/// From offsets in a fragment to offsets in its file, by runs that ascend.
///
/// Between verbatim runs the container may have had text of its own (the seam of a split CDATA
/// section); a run that is not verbatim maps as a whole (see [`Run::stands_for`]).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SpanMap {
    runs: Vec<Run>,
}

impl SpanMap {
    /// One run: the fragment stands in the file as it is, from `start` on.
    #[must_use]
    pub fn verbatim(start: u32) -> Self {
        Self { runs: vec![Run::verbatim(0, start)] }
    }

    /// The map of `runs`, which are sorted here.
    #[must_use]
    pub fn new(runs: Vec<impl Into<Run>>) -> Self {
        let mut runs: Vec<Run> = runs.into_iter().map(Into::into).collect();
        runs.sort_unstable();
        if runs.first().is_none_or(|run| run.from != 0) {
            let start = runs.first().map_or(0, |run| run.to);
            runs.insert(0, Run::standing_for(0, Span::at(start)));
        }
        Self { runs }
    }

    /// The runs, in ascending order.
    #[must_use]
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// The file's offset for the fragment's `offset`.
    #[must_use]
    pub fn offset(&self, offset: u32) -> u32 {
        let run = self.run(offset);
        if run.stands_for.is_some() { run.to } else { run.to + (offset - run.from) }
    }

    /// The file's span for the fragment's `span`: the smallest that holds all that its bytes stand for.
    #[must_use]
    pub fn span(&self, span: Span) -> Span {
        if span.is_empty() {
            return Span::at(self.offset(span.start));
        }
        let first = self.runs.partition_point(|run| run.from <= span.start).saturating_sub(1);
        let until = self.runs.partition_point(|run| run.from < span.end).max(first + 1);
        let piece = |index: usize| {
            let run = self.runs[index];
            let from = run.from.max(span.start);
            let end = self.runs.get(index + 1).map_or(span.end, |next| next.from.min(span.end));
            match run.stands_for {
                Some(length) => Span::new(run.to, run.to + length),
                None => Span::new(run.to + (from - run.from), run.to + (end - run.from)),
            }
        };
        (first + 1..until).map(piece).fold(piece(first), Span::cover)
    }

    fn run(&self, offset: u32) -> Run {
        let after = self.runs.partition_point(|run| run.from <= offset);
        self.runs[after.saturating_sub(1)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seam_in_the_middle_is_stepped_over() {
        let map = SpanMap::new(vec![Run::verbatim(0, 100), Run::verbatim(10, 150)]);
        assert_eq!(map.span(Span::new(2, 5)), Span::new(102, 105));
        assert_eq!(map.span(Span::new(8, 12)), Span::new(108, 152));
        assert_eq!(map.span(Span::new(5, 10)), Span::new(105, 110));
        assert_eq!(map.span(Span::at(10)), Span::at(150));
    }

    #[test]
    fn a_synthesised_run_maps_to_what_it_stands_for() {
        let runs = vec![Run::standing_for(0, Span::new(40, 60)), Run::verbatim(15, 70)];
        let map = SpanMap::new(runs);
        assert_eq!(map.span(Span::new(3, 9)), Span::new(40, 60));
        assert_eq!(map.span(Span::new(15, 18)), Span::new(70, 73));
        assert_eq!(map.span(Span::new(4, 16)), Span::new(40, 71));
    }
}
