//! The standard function blocks, IEC 61131-3 §6.6.3.5: Structured Text as any other, read when a block uses them. A block
//! of the same name in the user's tree wins.
//!
//! The folder `standard/` is a library of its own: `rungbook build src/machine/standard` makes its manual, and its tables say
//! what the standard's timing diagrams do. What only the machine can know is time: to a variable with
//! `{attribute 'rungbook.elapsed'}` it adds the cycle time at the beginning of each cycle, and the body reads it and sets it back.

/// The attribute of a variable, of type `TIME` or `LTIME`, that grows by the cycle time at the beginning of each cycle.
pub const ELAPSED: &str = "rungbook.elapsed";

macro_rules! sources {
    ($($name:literal)*) => {
        &[$(($name, include_str!(concat!("standard/", $name, ".st")))),*]
    };
}

/// The blocks by name, ascending, with their text: one declaration each.
pub const SOURCES: &[(&str, &str)] = sources! {
    "CTD" "CTD_DINT" "CTD_INT" "CTD_LINT" "CTD_UDINT" "CTD_ULINT"
    "CTU" "CTUD" "CTUD_DINT" "CTUD_INT" "CTUD_LINT" "CTUD_UDINT" "CTUD_ULINT"
    "CTU_DINT" "CTU_INT" "CTU_LINT" "CTU_UDINT" "CTU_ULINT"
    "F_TRIG" "LTOF" "LTON" "LTP" "RS" "RTC" "R_TRIG" "SEMA" "SR" "TOF" "TON" "TP"
};

/// The text of the block of that name; names are not case-sensitive.
#[must_use]
pub fn source(name: &str) -> Option<&'static str> {
    SOURCES.iter().find(|(other, _)| other.eq_ignore_ascii_case(name)).map(|(_, text)| *text)
}
