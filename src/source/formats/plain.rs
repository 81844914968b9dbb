//! Structured Text as a plain text file: one object, whose declaration is the whole text.

use super::{Claim, Format, Input, Setting, Unwrapped};
use crate::source::paths;
use crate::text::{Fragment, Object, ObjectKind, Span, Vendor};

/// Plain Structured Text.
#[derive(Debug)]
pub(super) struct PlainText;

impl Format for PlainText {
    fn name(&self) -> &'static str {
        "Structured Text"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["st", "iec"]
    }

    fn claims(&self, _: &Input<'_>) -> Claim {
        Claim::Likely
    }

    fn unwrap(&self, input: &Input<'_>) -> Unwrapped {
        let vendor = if input.setting == Setting::SimaticAx { Vendor::SimaticAx } else { Vendor::Standard };
        Unwrapped { objects: vec![whole_text(input)], vendor, ..Unwrapped::default() }
    }
}

/// Structured Text of logi.CAD 3 and Neuron Power Engineer.
#[derive(Debug)]
pub(super) struct LogiCad;

impl Format for LogiCad {
    fn name(&self) -> &'static str {
        "logi.CAD 3"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["iecst", "stu"]
    }

    fn claims(&self, input: &Input<'_>) -> Claim {
        let is_text = paths::extension(input.path) == "iecst" || !input.head().trim_start().starts_with('<');
        if is_text { Claim::Likely } else { Claim::No }
    }

    fn unwrap(&self, input: &Input<'_>) -> Unwrapped {
        Unwrapped { objects: vec![whole_text(input)], vendor: Vendor::LogiCad, ..Unwrapped::default() }
    }
}

/// The whole of `input` as one object.
pub(super) fn whole_text(input: &Input<'_>) -> Object {
    let mut object = Object::new(ObjectKind::Text, None, Span::at(0));
    object.declaration = Some(Fragment::verbatim(input.text.clone(), 0));
    object
}
