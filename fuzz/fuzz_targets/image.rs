//! Images of every format, told apart by their first bytes.

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    let _ = pelage_io::parse_image(bytes, Path::new("fuzz.image"));
});
