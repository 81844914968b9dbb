//! CODESYS V2.3 exports (`.EXP`): objects one after the other, each behind a head of comments.
//!
//! ```text
//! (* @NESTEDCOMMENTS := 'Yes' *)
//! (* @PATH := '\/Drives\/Axis' *)
//! (* @OBJECTFLAGS := '0, 8' *)
//! FUNCTION_BLOCK FB_A … END_VAR
//! (* @END_DECLARATION := '0' *)
//! body
//! END_FUNCTION_BLOCK
//! ```
//!
//! A body in a graphical language begins with `_LD_BODY` or the like. Instruction List has no mark; a body whose first
//! statement is an instruction is taken for it. Actions follow their block or stand inside it. Visualisations,
//! configurations and the rest are told and left out.

use std::collections::BTreeSet;

use super::keyword::{leading, skip_trivia};
use super::{Claim, Format, Input, Unwrapped, note_if_empty};
use crate::source::codes;
use crate::source::note::Note;
use crate::text::{Body, Fragment, Language, Object, ObjectKind, Span, Vendor};

/// CODESYS V2.3 exports.
#[derive(Debug)]
pub(super) struct Codesys2;

impl Format for Codesys2 {
    fn name(&self) -> &'static str {
        "CODESYS V2.3"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["exp"]
    }

    fn claims(&self, input: &Input<'_>) -> Claim {
        // Linkers write `.exp` files as well.
        let text = input.text.trim_start();
        if text.starts_with("(* @") || leading(text).is_some() { Claim::Sure } else { Claim::No }
    }

    fn unwrap(&self, input: &Input<'_>) -> Unwrapped {
        let mut reader = Reader { text: input.text, objects: Vec::new(), left_out: BTreeSet::new(), notes: Vec::new() };
        for section in sections(input.text) {
            reader.section(&section);
        }
        let Reader { objects, mut notes, .. } = reader;
        notes.extend(note_if_empty(&objects, "POU, type or variable list"));
        let nesting: BTreeSet<_> = objects.iter().filter_map(|object| property(object, "nested_comments")).collect();
        let nested_comments = if nesting.len() == 1 { nesting.first().map(|value| *value == "yes") } else { None };
        Unwrapped { objects, vendor: Vendor::Codesys2, nested_comments, notes, ..Unwrapped::default() }
    }
}

fn property<'o>(object: &'o Object, key: &str) -> Option<&'o str> {
    object.properties.iter().find(|(name, _)| name == key).map(|(_, value)| value.as_str())
}

/// A comment `(* @KEY := 'value' *)` on a line of its own.
#[derive(Clone, Copy, Debug)]
struct Mark<'t> {
    key: &'t str,
    value: &'t str,
    span: Span,
}

/// No mark that matters is longer.
const LONGEST_MARK: usize = 1000;

fn marks(text: &str) -> impl Iterator<Item = Mark<'_>> {
    text.match_indices("(* @").filter_map(move |(start, opening)| {
        let at_line_start = start == 0 || text[..start].ends_with(['\n', '\r']);
        let inner = &text[start + opening.len()..];
        let end = inner[..inner.floor_char_boundary(LONGEST_MARK)].find("*)")?;
        let (key, value) = inner[..end].split_once(":=").filter(|_| at_line_start)?;
        let value = value.trim().trim_matches('\'');
        Some(Mark { key: key.trim(), value, span: Span::from(start..start + opening.len() + end + 2) })
    })
}

/// An object with the marks before and inside it.
#[derive(Debug)]
struct Section<'t> {
    head: Vec<Mark<'t>>,
    /// Where the declaration ends and the body begins.
    seam: Option<Span>,
    /// The text behind the head.
    span: Span,
}

/// Divides `text` before each head.
fn sections(text: &str) -> Vec<Section<'_>> {
    let whole = Span::from(0..text.len());
    let mut sections = vec![Section { head: Vec::new(), seam: None, span: whole }];
    for mark in marks(text) {
        let last = sections.len() - 1;
        let section = &mut sections[last];
        match mark.key {
            "END_DECLARATION" => section.seam = section.seam.or(Some(mark.span)),
            "OBJECT_END" => section.span.end = section.span.end.min(mark.span.start),
            "CONNECTIONS" => {}
            _ => {
                let still_head = Span::new(section.span.start, mark.span.start).of(text).trim().is_empty();
                if still_head {
                    section.head.push(mark);
                    section.span.start = mark.span.end;
                } else {
                    section.span.end = section.span.end.min(mark.span.start);
                    sections.push(Section { head: vec![mark], seam: None, span: Span::new(mark.span.end, whole.end) });
                }
            }
        }
    }
    sections
}

struct Reader<'t> {
    text: &'t str,
    objects: Vec<Object>,
    left_out: BTreeSet<String>,
    notes: Vec<Note>,
}

impl Reader<'_> {
    fn section(&mut self, section: &Section<'_>) {
        let text = section.span.of(self.text);
        if text.trim().is_empty() {
            return;
        }
        let Some(found) = leading(text) else { return self.leave_out(section) };
        let start = section.span.start;
        let named = |key: &str| section.head.iter().find(|mark| mark.key == key).map(|mark| mark.value);
        let (name, span) = match found.name {
            Some((name, span)) => (Some(name), span.shifted(start)),
            None => (named("GLOBAL_VARIABLE_LIST").map(str::to_owned), Span::at(start)),
        };
        let mut object = Object::new(found.kind, name, span);
        object.folder = named("PATH").map(folder).unwrap_or_default();
        if let Some(value) = named("NESTEDCOMMENTS") {
            object.properties.push(("nested_comments".to_owned(), value.to_ascii_lowercase()));
        }
        match found.kind {
            ObjectKind::Action => self.actions(section.span),
            ObjectKind::Pou => {
                let end = self.pou(section, &mut object);
                self.objects.push(object);
                self.actions(Span::new(end, section.span.end));
            }
            _ => {
                let end = section.seam.map_or(section.span.end, |seam| seam.start);
                object.declaration = Some(self.fragment(Span::new(start, end)));
                self.objects.push(object);
            }
        }
    }

    /// Fills in declaration and body; gives the place behind them.
    fn pou(&self, section: &Section<'_>, object: &mut Object) -> u32 {
        let Some(seam) = section.seam else {
            // Without a seam the object is a text like any other.
            object.kind = ObjectKind::Text;
            object.declaration = Some(self.fragment(section.span));
            return section.span.end;
        };
        object.declaration = Some(self.fragment(Span::new(section.span.start, seam.start)));
        let rest = Span::new(seam.end, section.span.end);
        let ends = ["END_PROGRAM", "END_FUNCTION_BLOCK", "END_FUNCTION", "ACTION"];
        let end = self.line_with(rest, &ends).map_or(rest, |line| line);
        let (code, after) = if end == rest { (rest, rest.end) } else { (Span::new(rest.start, end.start), end.start) };
        object.body = self.body(code);
        if matches!(object.body, Body::Il(_)) {
            object.properties.push(("language_guessed".to_owned(), "IL".to_owned()));
        }
        after
    }

    /// The actions in `span`, as members of the last POU.
    fn actions(&mut self, span: Span) {
        let mut at = span;
        while let Some(line) = self.line_with(at, &["ACTION"]) {
            let rest = Span::new(line.start, span.end);
            let end = self.line_with(rest, &["END_ACTION"]).unwrap_or(Span::at(span.end));
            let text = Span::new(line.start, end.start);
            let name = leading(text.of(self.text)).and_then(|found| found.name);
            let (name, name_span) =
                name.map_or((None, Span::at(line.start)), |(name, at)| (Some(name), at.shifted(line.start)));
            let head = line.of(self.text);
            let code = head.find(':').map_or(line.end, |colon| line.start + u32::try_from(colon + 1).unwrap_or(0));
            let mut action = Object::new(ObjectKind::Action, name, name_span);
            action.body = self.body(Span::new(code, end.start));
            match self.objects.iter_mut().rev().find(|object| object.kind == ObjectKind::Pou) {
                Some(owner) => owner.children.push(action),
                None => self.objects.push(action),
            }
            at = Span::new(end.end, span.end);
        }
    }

    /// The first line in `span` that begins with one of `words`.
    fn line_with(&self, span: Span, words: &[&str]) -> Option<Span> {
        let mut start = span.start;
        for line in span.of(self.text).split_inclusive('\n') {
            let line_span = Span::new(start, start + u32::try_from(line.len()).unwrap_or(0));
            let word = line.trim_start().split(|c: char| !(c.is_alphanumeric() || c == '_')).next().unwrap_or("");
            if words.iter().any(|wanted| word.eq_ignore_ascii_case(wanted)) {
                return Some(line_span);
            }
            start = line_span.end;
        }
        None
    }

    fn fragment(&self, span: Span) -> Fragment {
        Fragment::verbatim(span.of(self.text), span.start)
    }

    fn body(&self, span: Span) -> Body {
        let text = span.of(self.text);
        let code = &text[skip_trivia(text, 0)..];
        let fragment = self.fragment(span);
        let word: String = code.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        match word.to_ascii_uppercase().as_str() {
            "_LD_BODY" => Body::Other(Language::Ld, fragment),
            "_FBD_BODY" => Body::Other(Language::Fbd, fragment),
            "_CFC_BODY" => Body::Other(Language::Cfc, fragment),
            "_SFC_BODY" | "INITIAL_STEP" | "_ELEMENTLIST" => Body::Other(Language::Sfc, fragment),
            other if other.starts_with('_') && other.ends_with("_BODY") => Body::Other(Language::Unknown, fragment),
            other if is_instruction(other, code) => Body::Il(fragment),
            _ => Body::St(fragment),
        }
    }

    fn leave_out(&mut self, section: &Section<'_>) {
        let text = section.span.of(self.text);
        let at = skip_trivia(text, 0);
        let word: String = text[at..].chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        if word.is_empty() || !self.left_out.insert(word.clone()) {
            return;
        }
        let start = section.span.start + u32::try_from(at).unwrap_or(0);
        let span = Span::new(start, start + u32::try_from(word.len()).unwrap_or(0));
        let message = format!("`{word}` is a part of a CODESYS V2.3 export that is not read");
        self.notes.push(Note::new(&codes::UNKNOWN_OBJECT, span, message));
    }
}

/// `\/Drives\/Axis` as its parts.
fn folder(path: &str) -> Vec<String> {
    path.split("\\/").filter(|part| !part.is_empty()).map(str::to_owned).collect()
}

/// Whether `code`, which begins with `word`, is Instruction List: an operator, and its line no statement.
fn is_instruction(word: &str, code: &str) -> bool {
    const OPERATORS: [&str; 12] = ["LD", "LDN", "ST", "STN", "S", "R", "CAL", "CALC", "CALCN", "JMP", "JMPC", "RET"];
    let line = code.lines().next().unwrap_or("");
    let rest = line.get(word.len()..).unwrap_or("");
    let is_statement = rest.trim_start().starts_with([':', '(', '.', '[', ';']) || line.contains(":=");
    OPERATORS.contains(&word) && !is_statement
}
