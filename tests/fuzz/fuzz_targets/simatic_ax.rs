//! See `targets::simatic_ax`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| rungbook_fuzz::targets::simatic_ax(data));
