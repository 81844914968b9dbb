//! SIMATIC AX: Structured Text (`.st`) below an `apax.yml`, with namespaces, classes and tests.

use super::plain::whole_text;
use super::{Claim, Format, Input, Setting, Unwrapped};
use crate::text::Vendor;

/// SIMATIC AX.
#[derive(Debug)]
pub(super) struct SimaticAx;

impl Format for SimaticAx {
    fn name(&self) -> &'static str {
        "SIMATIC AX"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["st"]
    }

    fn claims(&self, input: &Input<'_>) -> Claim {
        if input.setting == Setting::SimaticAx { Claim::Sure } else { Claim::No }
    }

    fn unwrap(&self, input: &Input<'_>) -> Unwrapped {
        Unwrapped { objects: vec![whole_text(input)], vendor: Vendor::SimaticAx, ..Unwrapped::default() }
    }
}
