//! See `taxel_fuzz::store`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| taxel_fuzz::store::run(data));
