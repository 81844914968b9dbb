//! See `targets::projects`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| rungbook_fuzz::targets::projects(data));
