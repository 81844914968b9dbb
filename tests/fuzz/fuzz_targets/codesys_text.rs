//! See `targets::codesys_text`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| rungbook_fuzz::targets::codesys_text(data));
