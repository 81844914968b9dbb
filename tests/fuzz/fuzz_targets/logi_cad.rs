//! See `targets::logi_cad`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| rungbook_fuzz::targets::logi_cad(data));
