//! USD text and crates, as meshes and as curves.

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::io::Write;

fuzz_target!(|bytes: &[u8]| {
    // The reader opens files by itself: USD files may name others.
    let named = tempfile::Builder::new().suffix(".usd").tempfile();
    let Ok(mut file) = named else { return };
    if file.write_all(bytes).is_err() {
        return;
    }
    let _ = pelage_io::read_usd_mesh(file.path(), None, None);
    let _ = pelage_io::read_usd_curves(file.path(), None);
});
