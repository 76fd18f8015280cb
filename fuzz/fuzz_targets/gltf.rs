//! glTF text and binary files as meshes.

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    let _ = pelage_io::parse_gltf_mesh(bytes, Path::new("fuzz.gltf"));
});
