//! Listings for the fixture, with runs found by a few words: enough to colour a page.

use rungbook::book::view::entity::{Run, RunClass, SourceView};

pub(crate) const DECLARATION: &str = "\
(*
  Drives a double-acting cylinder and watches that it arrives in time.
*)
{attribute 'reflection'}
FUNCTION_BLOCK FINAL FB_Cylinder EXTENDS FB_Actuator IMPLEMENTS I_Drive
VAR_INPUT
    bExtend  : BOOL; // Extends on a rising edge.
    bRetract : BOOL; // Retracts on a rising edge.
    tTimeout : TIME := T#2s;
END_VAR
VAR_OUTPUT
    bError : BOOL;
    eState : E_CylinderState := E_CylinderState.Idle;
END_VAR
";

pub(crate) const BODY: &str = "\
CASE eState OF
    E_CylinderState.Idle:
        qValve := FALSE;
        IF bExtend AND NOT bError THEN
            eState := E_CylinderState.Extending; // on its way out, and this remark is long enough to need scrolling
        END_IF
END_CASE
";

const WORDS: &[(&str, RunClass)] = &[
    ("FUNCTION_BLOCK", RunClass::Keyword),
    ("FINAL", RunClass::Keyword),
    ("EXTENDS", RunClass::Keyword),
    ("IMPLEMENTS", RunClass::Keyword),
    ("VAR_INPUT", RunClass::Keyword),
    ("VAR_OUTPUT", RunClass::Keyword),
    ("END_VAR", RunClass::Keyword),
    ("END_CASE", RunClass::Keyword),
    ("END_IF", RunClass::Keyword),
    ("CASE", RunClass::Keyword),
    ("THEN", RunClass::Keyword),
    ("BOOL", RunClass::Type),
    ("TIME", RunClass::Type),
    ("T#2s", RunClass::Number),
    (":=", RunClass::Operator),
    ("FB_Actuator", RunClass::Name),
    ("E_CylinderState", RunClass::Name),
];

/// A listing, its tokens marked.
pub(crate) fn listing(title: &str, file: &str, first_line: u32, text: &str) -> SourceView {
    let mut runs = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        let (length, class) = token(rest);
        if let Some(class) = class {
            let link = match &rest[..length] {
                "FB_Actuator" => Some(0),
                "E_CylinderState" => Some(1),
                _ => None,
            };
            runs.push(Run { start: at as u32, end: (at + length) as u32, class, link });
        }
        at += length;
    }
    SourceView {
        title: title.to_owned(),
        anchor: String::new(),
        file: file.to_owned(),
        first_line,
        text: text.to_owned(),
        runs,
        links: vec!["handling/base/fb_actuator.html".to_owned(), "handling/types/e_cylinderstate.html".to_owned()],
        note: None,
    }
}

/// Length and class of what `rest` begins with.
fn token(rest: &str) -> (usize, Option<RunClass>) {
    let until = |end: &str| rest.find(end).map_or(rest.len(), |at| at + end.len());
    if rest.starts_with("(*") {
        return (until("*)"), Some(RunClass::Comment));
    }
    if rest.starts_with("//") {
        return (rest.find('\n').unwrap_or(rest.len()), Some(RunClass::Comment));
    }
    if rest.starts_with('{') {
        return (until("}"), Some(RunClass::Pragma));
    }
    let word = WORDS.iter().find(|(word, _)| rest.starts_with(word));
    let one = rest.chars().next().map_or(1, char::len_utf8);
    word.map_or((one, None), |(word, class)| (word.len(), Some(*class)))
}
