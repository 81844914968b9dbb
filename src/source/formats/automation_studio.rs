//! B&R Automation Studio: functions (`.fun`), types (`.typ`) and variables (`.var`) as text; comments do not nest.
//!
//! A `.var` holds bare `VAR` sections: those of the program whose `.prg` lies in the same folder, or global ones.

use super::plain::whole_text;
use super::{Claim, Format, Input, Setting, Unwrapped};
use crate::source::paths;
use crate::text::{ObjectKind, Vendor};

/// B&R Automation Studio.
#[derive(Debug)]
pub(super) struct AutomationStudio;

impl Format for AutomationStudio {
    fn name(&self) -> &'static str {
        "B&R Automation Studio"
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["st", "fun", "typ", "var"]
    }

    fn claims(&self, input: &Input<'_>) -> Claim {
        if input.setting == Setting::BAndR { Claim::Sure } else { Claim::No }
    }

    fn unwrap(&self, input: &Input<'_>) -> Unwrapped {
        let mut object = whole_text(input);
        if paths::extension(input.path) == "var" {
            object.kind = ObjectKind::GlobalVariables;
            object.name = Some(paths::stem(input.path).to_owned());
        }
        Unwrapped { objects: vec![object], vendor: Vendor::BAndR, nested_comments: Some(false), ..Unwrapped::default() }
    }
}
