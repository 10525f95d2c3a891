//! See `taxel_fuzz::recording`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| taxel_fuzz::recording::run(data));
