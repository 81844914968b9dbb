//! See `targets::codesys_v23`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| rungbook_fuzz::targets::codesys_v23(data));
