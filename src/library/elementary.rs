//! The names that IEC 61131-3 and its dialects define: elementary and generic types.
//!
//! IEC 61131-3:2013, 6.4.2 and table 10, 6.4.3 (generic types), and what TwinCAT, CODESYS and
//! Siemens add.

/// Lower case, sorted.
const NAMES: [&str; 91] = [
    "__system.anytype",
    "__uxint",
    "__xint",
    "__xstring",
    "__xword",
    "any",
    "any_bit",
    "any_chars",
    "any_date",
    "any_derived",
    "any_duration",
    "any_elementary",
    "any_int",
    "any_magnitude",
    "any_num",
    "any_real",
    "any_signed",
    "any_string",
    "any_unsigned",
    "array",
    "bit",
    "block_db",
    "block_fb",
    "block_fc",
    "bool",
    "byte",
    "char",
    "conn_any",
    "counter",
    "date",
    "date_and_time",
    "db_any",
    "db_dyn",
    "dint",
    "dt",
    "dtl",
    "dword",
    "hw_any",
    "hw_device",
    "hw_io",
    "hw_iosystem",
    "hw_submodule",
    "int",
    "ldate",
    "ldate_and_time",
    "ldt",
    "lint",
    "lreal",
    "ltime",
    "ltime_of_day",
    "ltod",
    "lword",
    "ob_any",
    "of",
    "pbool",
    "pointer",
    "pvoid",
    "pword",
    "real",
    "reference",
    "rtm",
    "s5time",
    "sint",
    "string",
    "struct",
    "time",
    "time_of_day",
    "timer",
    "to",
    "tod",
    "udint",
    "uint",
    "ulint",
    "usint",
    "uxint",
    "variant",
    "void",
    "wchar",
    "word",
    "wstring",
    "xint",
    "xword",
    "any_block",
    "any_pointer",
    "any_type",
    "bcd",
    "bcd16",
    "bcd32",
    "remote",
    "ulword",
    "wstring_const",
];

/// Whether `name` is one of them, in any letter case.
#[must_use]
pub fn is_elementary(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    NAMES.contains(&name.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letter_case_does_not_matter() {
        assert!(is_elementary("LReal") && is_elementary("BOOL") && is_elementary("Any_Num"));
        assert!(!is_elementary("FB_Cylinder") && !is_elementary(""));
    }
}
