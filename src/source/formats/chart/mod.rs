//! Sequential function charts that a tool has drawn: written as text, as the standard has it (IEC 61131-3, §6.7), each word with the
//! place of the element that it comes from. So drawn charts and charts in text are one thing for everything behind.
//!
//! `plcopen` follows the connections of PLCopen XML, `twincat` the nested lists of TwinCAT. What CODESYS and TwinCAT call a step's own
//! actions is written with qualifiers of ours: `ON_EXIT`, `ON_ENTRY`, and `ACTIVE`, which has no final scan.
//! A chart that the text cannot say is refused, with the place.

mod plcopen;
mod twincat;

pub(super) use plcopen::read as plcopen;
pub(super) use twincat::read as twincat;

use super::super::codes;
use crate::source::fragment::FragmentBuilder;
use crate::source::note::Note;
use crate::source::xml::Element;
use crate::text::{Body, Fragment, Language, Object, Span};

/// A chart as it is drawn.
#[derive(Debug, Default)]
pub(super) struct Chart {
    steps: Vec<Step>,
    transitions: Vec<Transition>,
    /// Actions that are drawn inside of the chart.
    inner: Vec<Object>,
}

#[derive(Debug)]
struct Step {
    name: Fragment,
    span: Span,
    initial: bool,
    actions: Vec<Action>,
}

#[derive(Debug)]
struct Action {
    name: Fragment,
    span: Span,
    qualifier: Word,
    arguments: Vec<Fragment>,
}

#[derive(Debug)]
enum Word {
    Ours(&'static str),
    Theirs(Fragment),
}

#[derive(Debug, Default)]
struct Transition {
    from: Vec<Fragment>,
    to: Vec<Fragment>,
    priority: Option<Fragment>,
    condition: Option<Fragment>,
    negated: bool,
    span: Span,
}

/// Why a chart is not read.
#[derive(Debug)]
pub(super) struct Refusal {
    span: Span,
    what: String,
}

type Read<T> = Result<T, Refusal>;

impl Refusal {
    fn new(span: Span, what: impl Into<String>) -> Self {
        Self { span, what: what.into() }
    }

    /// As a finding of the file.
    fn note(self) -> Note {
        Note::new(&codes::UNREAD_CHART, self.span, format!("the chart is not read: {}", self.what))
    }
}

/// The chart of `element` as a body; one that is not read is kept as it stands, and noted.
pub(super) fn body(read: Read<Chart>, element: Element<'_>, inner: &mut Vec<Object>, notes: &mut Vec<Note>) -> Body {
    let empty = |chart: Chart| match chart.steps.is_empty() {
        true => Err(Refusal::new(element.name_span(), "it has no steps")),
        false => Ok(chart),
    };
    match read.and_then(empty) {
        Ok(chart) => {
            let (text, own) = chart.finish(element.span().start);
            inner.extend(own);
            Body::St(text)
        }
        Err(refusal) => {
            notes.push(refusal.note());
            Body::Other(Language::Sfc, element.raw())
        }
    }
}

impl Chart {
    /// The chart as text, and the actions drawn inside of it.
    fn finish(self, start: u32) -> (Fragment, Vec<Object>) {
        let mut out = FragmentBuilder::new();
        for step in &self.steps {
            step.write(&mut out);
        }
        for transition in &self.transitions {
            transition.write(&mut out);
        }
        (out.finish(start), self.inner)
    }
}

impl Step {
    fn write(&self, out: &mut FragmentBuilder) {
        out.standing_for(if self.initial { "INITIAL_STEP " } else { "STEP " }, self.span);
        out.fragment(&self.name);
        out.standing_for(":\n", self.span);
        for action in &self.actions {
            out.standing_for("\t", action.span);
            out.fragment(&action.name);
            out.standing_for("(", action.span);
            match &action.qualifier {
                Word::Ours(word) => out.standing_for(word, action.span),
                Word::Theirs(word) => out.fragment(word),
            };
            for argument in &action.arguments {
                out.standing_for(", ", action.span);
                out.fragment(argument);
            }
            out.standing_for(");\n", action.span);
        }
        out.standing_for("END_STEP\n\n", self.span);
    }
}

impl Transition {
    fn write(&self, out: &mut FragmentBuilder) {
        out.standing_for("TRANSITION ", self.span);
        if let Some(priority) = &self.priority {
            out.standing_for("(PRIORITY := ", self.span).fragment(priority).standing_for(") ", self.span);
        }
        out.standing_for("FROM ", self.span);
        names(&self.from, self.span, out);
        out.standing_for(" TO ", self.span);
        names(&self.to, self.span, out);
        out.standing_for(if self.negated { " := NOT (" } else { " := " }, self.span);
        if let Some(condition) = &self.condition {
            out.fragment(condition);
            // A comment at the end must not swallow what follows.
            out.standing_for(if condition.text.contains("//") { "\n" } else { "" }, self.span);
        }
        out.standing_for(if self.negated { ");\n" } else { ";\n" }, self.span);
        out.standing_for("END_TRANSITION\n\n", self.span);
    }
}

fn names(names: &[Fragment], span: Span, out: &mut FragmentBuilder) {
    let several = names.len() > 1;
    out.standing_for(if several { "(" } else { "" }, span);
    for (index, name) in names.iter().enumerate() {
        out.standing_for(if index > 0 { ", " } else { "" }, span);
        out.fragment(name);
    }
    out.standing_for(if several { ")" } else { "" }, span);
}

/// `fragment` without white space around it and without a semicolon at its end; `None` where nothing is left.
fn trimmed(fragment: &Fragment) -> Option<Fragment> {
    let text: &str = &fragment.text;
    let start = text.len() - text.trim_start().len();
    let end = text.trim_end().trim_end_matches(';').trim_end().len();
    between(fragment, start, end)
}

/// The bytes from `start` to `end`; `None` where there are none.
fn between(fragment: &Fragment, start: usize, end: usize) -> Option<Fragment> {
    let mut out = FragmentBuilder::new();
    out.piece(fragment, start, end);
    (start < end).then(|| out.finish(fragment.map.offset(u32::try_from(start).unwrap_or(0))))
}

/// What CODESYS and TwinCAT know of an element, by the identities of these facts; both use the same.
mod fact {
    pub(super) const NAME: &str = "38391c6d-6d4a-42f8-8ee7-9f45e5adafa8";
    pub(super) const INITIAL: &str = "6844a48e-46c2-4cc8-a185-a478f3b99cc0";
    pub(super) const ACTIVE: &str = "700a583f-b4d4-43e4-8c14-629c7cd3bec8";
    pub(super) const ENTRY: &str = "a6b08bd8-b696-47e3-9cbf-7408b61c9ff8";
    pub(super) const EXIT: &str = "a2621e18-7de3-4ea6-ae6d-89e9e0b7befd";
    pub(super) const PARALLEL: &str = "23bdaa98-72ec-41f7-817b-9dede5697086";
    pub(super) const QUALIFIER: &str = "e174fc0d-80b0-4a9e-a530-ca239c249a50";
    pub(super) const EXCLUDED: &str = "01580b27-6378-448b-8ecb-0e4b795b58d6";
    pub(super) const MINIMUM: &str = "cacf1a68-236e-47c2-b7b1-1cf9199718cb";
}

/// The facts of an element, by identity in lower case.
struct Facts(Vec<(String, Fragment)>);

impl Facts {
    fn get(&self, identity: &str) -> Option<&Fragment> {
        self.0.iter().find(|(known, value)| known == identity && !value.text.trim().is_empty()).map(|(_, value)| value)
    }

    fn holds(&self, identity: &str) -> bool {
        self.get(identity).is_some_and(|value| value.text.eq_ignore_ascii_case("true"))
    }

    /// Refuses what has no text.
    fn check(&self, element: Element<'_>) -> Read<()> {
        if self.holds(fact::EXCLUDED) {
            return Err(Refusal::new(element.name_span(), "an element of it is excluded from the build"));
        }
        match self.get(fact::MINIMUM) {
            Some(_) => Err(Refusal::new(element.name_span(), "a step has a minimal time")),
            None => Ok(()),
        }
    }

    /// The actions of a step itself, in the order in which CODESYS calls them.
    fn actions(&self, span: Span) -> Vec<Action> {
        let own = [(fact::EXIT, "ON_EXIT"), (fact::ENTRY, "ON_ENTRY"), (fact::ACTIVE, "ACTIVE")];
        let named = own.into_iter().filter_map(|(identity, word)| Some((self.get(identity)?, word)));
        let action = |(name, word): (&Fragment, _)| Action {
            name: name.clone(),
            span,
            qualifier: Word::Ours(word),
            arguments: Vec::new(),
        };
        named.map(action).collect()
    }
}
