//! Small files of results, written whole or not at all.

use anyhow::{Context, Result};
use pelage::io::AtomicFile;
use serde::Serialize;
use std::io::Write;
use std::path::Path;

/// `value` as JSON for people and programs, with a line break at the end.
pub fn json(value: &impl Serialize) -> Result<String> {
    Ok(serde_json::to_string_pretty(value)? + "\n")
}

/// Writes `text` to the file `path`.
pub fn write(path: &Path, text: &str) -> Result<()> {
    write_bytes(path, text.as_bytes())
}

/// Writes `bytes` to the file `path`.
pub fn write_bytes(path: &Path, bytes: &[u8]) -> Result<()> {
    let write = || {
        let mut file = AtomicFile::create(path)?;
        file.write_all(bytes)?;
        file.commit()
    };
    write().with_context(|| format!("cannot write {}", path.display()))
}
