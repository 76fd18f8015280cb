//! NumPy archives as curves.

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::io::Write;

fuzz_target!(|bytes: &[u8]| {
    // The reader opens files by itself: USD files may name others.
    let named = tempfile::Builder::new().suffix(".npz").tempfile();
    let Ok(mut file) = named else { return };
    if file.write_all(bytes).is_err() {
        return;
    }
    for time in [None, Some(1.5)] {
        let _ = pelage_io::read_npz_curves(file.path(), time);
    }
});
