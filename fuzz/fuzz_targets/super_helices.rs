//! Super-Helices in JSON, and the curves that they decode to.

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::path::Path;

/// Decoding more takes memory beyond the size of the bytes, as it should.
const VERTICES: u32 = 1000;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(strands) = pelage_io::parse_super_helices(bytes, Path::new("fuzz.json")) {
        if strands.vertices.iter().all(|count| *count < VERTICES) {
            let curves = strands.decode(None);
            assert!(curves.points.iter().flatten().all(|x| x.is_finite()));
        }
    }
});
