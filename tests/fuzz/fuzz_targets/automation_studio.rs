//! See `targets::automation_studio`.

#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| rungbook_fuzz::targets::automation_studio(data));
