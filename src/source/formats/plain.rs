//! Structured Text as a plain text file: one object, whose declaration is the whole text.

use super::keyword::{skip_trivia, word_at};
use super::{Claim, Format, Input, Unwrapped};
use crate::text::{Fragment, Object, ObjectKind, Span, Vendor};

/// Plain Structured Text.
#[derive(Debug)]
pub(super) struct PlainText;

impl Format for PlainText {
    fn name(&self) -> &'static str {
        "Structured Text"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["st", "iec", "il", "sfc"]
    }

    fn claims(&self, input: &Input<'_>) -> Claim {
        if is_guarded_chart(input.text) { Claim::No } else { Claim::Likely }
    }

    fn unwrap(&self, input: &Input<'_>) -> Unwrapped {
        Unwrapped { objects: vec![whole_text(input)], vendor: Vendor::Standard, ..Unwrapped::default() }
    }
}

/// Whether the text is `SFC name … GOTO guard :: step -> step; … END_SFC`: charts that research tools hand to each other.
pub(in crate::source) fn is_guarded_chart(text: &str) -> bool {
    word_at(text, skip_trivia(text, 0)).eq_ignore_ascii_case("SFC") && text.trim_end().ends_with("END_SFC")
}

/// The whole of `input` as one object.
pub(super) fn whole_text(input: &Input<'_>) -> Object {
    let mut object = Object::new(ObjectKind::Text, None, Span::at(0));
    object.declaration = Some(Fragment::verbatim(input.text.clone(), 0));
    object
}
