//! See `taxel_fuzz::page`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| taxel_fuzz::page::run(data));
