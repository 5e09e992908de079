#![no_main]

use interchange::Format;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| fuzz::check_reader(bytes, Format::Off));
