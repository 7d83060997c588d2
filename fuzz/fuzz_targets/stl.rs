#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| vaso_fuzz::stl(data));
