//! Structured Text as a plain text file: one object, whose declaration is the whole text.

use super::{Claim, Format, Input, Setting, Unwrapped};
use crate::text::{Fragment, Object, ObjectKind, Span, Vendor};

/// Plain Structured Text.
#[derive(Debug)]
pub(super) struct PlainText;

impl Format for PlainText {
    fn name(&self) -> &'static str {
        "Structured Text"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["st", "iec", "iecst"]
    }

    fn claims(&self, _: &Input<'_>) -> Claim {
        Claim::Likely
    }

    fn unwrap(&self, input: &Input<'_>) -> Unwrapped {
        let (vendor, nested_comments) = match input.setting {
            Setting::Plain => (Vendor::Standard, None),
            Setting::SimaticAx => (Vendor::SimaticAx, None),
            Setting::BAndR => (Vendor::BAndR, Some(false)),
        };
        Unwrapped { objects: vec![whole_text(input)], vendor, nested_comments, notes: Vec::new() }
    }
}

/// The whole of `input` as one object.
pub(super) fn whole_text(input: &Input<'_>) -> Object {
    let mut object = Object::new(ObjectKind::Text, None, Span::at(0));
    object.declaration = Some(Fragment::verbatim(input.text.clone(), 0));
    object
}
