//! OBJ files as meshes and as curves.

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    let path = Path::new("fuzz.obj");
    let _ = pelage_io::parse_obj_mesh(bytes, path);
    let _ = pelage_io::parse_obj_curves(bytes, path);
});
