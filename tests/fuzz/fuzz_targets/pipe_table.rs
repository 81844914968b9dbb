//! See `targets::pipe_table`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| rungbook_fuzz::targets::pipe_table(data));
