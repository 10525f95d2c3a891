//! See `taxel_fuzz::board`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| taxel_fuzz::board::run(data));
