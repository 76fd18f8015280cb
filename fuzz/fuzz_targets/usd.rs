//! USD text, crates and packages, as meshes and as curves.

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::io::Write;

/// Panics of `openusd` over contents that contradict each other are caught and become
/// errors; those of our own code are bugs.
fn abort_on_our_panics() {
    std::panic::set_hook(Box::new(|panic| {
        let file = panic.location().map_or("", |place| place.file());
        if !file.contains("/openusd-") {
            eprintln!("{panic}");
            std::process::abort();
        }
    }));
}

fuzz_target!(init: abort_on_our_panics(), |bytes: &[u8]| {
    // The reader opens files by itself: USD files may name others.
    let suffix = match bytes.starts_with(b"PK") {
        true => ".usdz",
        false => ".usd",
    };
    let named = tempfile::Builder::new().suffix(suffix).tempfile();
    let Ok(mut file) = named else { return };
    if file.write_all(bytes).is_err() {
        return;
    }
    let _ = pelage_io::read_usd_mesh(file.path(), None, None);
    let _ = pelage_io::read_usd_curves(file.path(), None);
});
