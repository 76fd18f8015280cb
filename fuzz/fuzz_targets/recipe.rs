//! Recipes.

#![no_main]

use libfuzzer_sys::fuzz_target;
use std::path::Path;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(text) = std::str::from_utf8(bytes) {
        if let Err(error) = pelage_groom::recipe::Recipe::parse(text, Path::new("fuzz.toml")) {
            let _ = error.to_string();
        }
    }
});
