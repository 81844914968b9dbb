//! See `targets::table_xml`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| rungbook_fuzz::targets::table_xml(data));
