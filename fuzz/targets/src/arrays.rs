//! See `taxel_fuzz::arrays`.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| taxel_fuzz::arrays::run(data));
