//! logi.CAD 3 and Neuron Power Engineer: Structured Text in files of their own (`.iecst`, `.stu`), with pragmas that
//! describe what follows them.

use super::plain::whole_text;
use super::{Claim, Format, Input, Unwrapped};
use crate::source::paths;
use crate::text::Vendor;

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
