//! The recipes on disk, and texts that are checked in.

use std::path::{Path, PathBuf};

/// The folder of this crate's tests.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests")
}

/// Name and text of every `.toml` in a folder of the tests, by name.
pub fn recipes(name: &str) -> Vec<(PathBuf, String)> {
    let entries = std::fs::read_dir(folder().join(name)).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ext| ext == "toml"));
    paths.sort();
    let read = |path: PathBuf| (path.clone(), std::fs::read_to_string(path).unwrap());
    paths.into_iter().map(read).collect()
}

/// Name and text of the recipes of the example grooms.
pub fn examples() -> Vec<(PathBuf, String)> {
    let root = folder().join("../../pelage-examples/src");
    let names = ["animal", "ball", "cyclone", "grass", "head", "tree"];
    let paths = names.map(|name| root.join(name).join("groom.toml"));
    let read = |path: PathBuf| (path.clone(), std::fs::read_to_string(path).unwrap());
    paths.into_iter().map(read).collect()
}

/// Whether `found` is what the file `path` holds. With `PELAGE_BLESS=1` the
/// file is written instead.
pub fn is_checked_in(path: &Path, found: &str) -> bool {
    if std::env::var_os("PELAGE_BLESS").is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, found).unwrap();
        return true;
    }
    std::fs::read_to_string(path).is_ok_and(|expected| expected.replace("\r\n", "\n") == found)
}
