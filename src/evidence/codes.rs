//! The findings of this room.

use crate::diagnostic::{Code, Severity};

macro_rules! codes {
    ($($constant:ident $name:literal $severity:ident;)*) => {
        $(
            #[doc = concat!("`", $name, "`")]
            pub static $constant: Code =
                Code { name: $name, severity: Severity::$severity, page: include_str!(concat!("pages/", $name, ".md")) };
        )*
        /// All codes of this room.
        pub static ALL: &[&Code] = &[$(&$constant),*];
    };
}

codes! {
    MALFORMED_ALLOWANCE "malformed-allowance" Warning;
    EXPIRED_ALLOWANCE "expired-allowance" Warning;
    UNUSED_ALLOWANCE "unused-allowance" Info;
    UNMET_REQUIREMENT "unmet-requirement" Warning;
    UNKNOWN_REQUIREMENT "unknown-requirement" Warning;
    UNREADABLE_RESULTS "unreadable-results" Warning;
}
