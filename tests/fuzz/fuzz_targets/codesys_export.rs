//! See `targets::codesys_export`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| rungbook_fuzz::targets::codesys_export(data));
