//! USDZ packages: zip archives of layers and of what they use, all stored as they are.
//!
//! A layer in a package is called `model.usdz[geometry.usd]`, as OpenUSD calls it. Layers
//! are read here, checked like any other and given to `openusd` one by one; it never opens
//! a package itself. What is compressed is refused, so nothing is larger than its file.
//!
//! Source: the USDZ File Format Specification of OpenUSD: entries are neither compressed
//! nor encrypted, and the first is the root layer.

use crate::ReadError;
use crate::source::open_file;
use openusd::ar::join_package_relative_path;
use std::fmt::Display;
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use zip::{CompressionMethod, ZipArchive};

/// Extensions of layers that a package may begin with.
const LAYERS: [&str; 3] = ["usd", "usda", "usdc"];

/// Whether the name of `path` is that of a package.
pub(super) fn is_package(path: &Path) -> bool {
    has_extension(path, &["usdz"])
}

fn has_extension(path: &Path, wanted: &[&str]) -> bool {
    let extension = path.extension().and_then(|e| e.to_str());
    extension.is_some_and(|e| wanted.iter().any(|w| e.eq_ignore_ascii_case(w)))
}

/// The package and the name in it, where `path` is of the form `PACKAGE.usdz[NAME]`.
pub(super) fn split(path: &str) -> Option<(&Path, &str)> {
    let inside = path.strip_suffix(']')?;
    // Not just the first bracket: folders may have some.
    let brackets = inside.match_indices('[').map(|(at, _)| at);
    let mut splits = brackets.map(|at| (Path::new(&inside[..at]), &inside[at + 1..]));
    splits.find(|(package, _)| is_package(package))
}

/// The path of the layer that `package` stands for: its first entry.
pub(super) fn root_layer(package: &Path) -> Result<PathBuf, ReadError> {
    let archive = open(package)?;
    let Some(name) = archive.name_for_index(0) else {
        return Err(unsound(package, "there is nothing in it"));
    };
    if !has_extension(Path::new(name), &LAYERS) {
        let message = format!("its first entry is {name:?}, where its root layer should be");
        return Err(unsound(package, message));
    }
    match package.to_str() {
        Some(package) => Ok(join_package_relative_path(package, name).into()),
        None => Err(ReadError::unsupported(package, "its name is not UTF-8")),
    }
}

/// Whether `package` has the entry `name`, or cannot be opened: then reading it will say why.
pub(super) fn has(package: &Path, name: &str) -> bool {
    open(package).map_or(true, |archive| archive.index_for_name(name).is_some())
}

/// The entry `name` of `package`.
pub(super) fn read(package: &Path, name: &str) -> Result<Vec<u8>, ReadError> {
    if is_package(Path::new(name)) || split(name).is_some() {
        let message = format!("a package in a package ({name:?}) is not read");
        return Err(ReadError::unsupported(package, message).help("unpack the outer one"));
    }
    let mut archive = open(package)?;
    let broken = |error: &dyn Display| unsound(package, format!("its entry {name:?}: {error}"));
    let mut entry = archive.by_name(name).map_err(|error| broken(&error))?;
    if entry.compression() != CompressionMethod::Stored {
        return Err(broken(&"it is compressed, which USDZ does not allow"));
    }
    let mut bytes = Vec::new();
    let read = entry.read_to_end(&mut bytes);
    read.map_err(|error| broken(&error))?;
    Ok(bytes)
}

fn open(package: &Path) -> Result<ZipArchive<BufReader<File>>, ReadError> {
    let file = BufReader::new(open_file(package)?);
    ZipArchive::new(file).map_err(|error| unsound(package, error))
}

fn unsound(package: &Path, what: impl Display) -> ReadError {
    ReadError::file(package, format!("no sound USDZ package: {what}"))
        .help("pack it with usdzip, or by the export of the program that made it")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_splits_where_a_package_ends() {
        let split = |path| split(path).map(|(package, name)| (package.to_str(), name));
        assert_eq!(split("a.usdz[b.usd]"), Some((Some("a.usdz"), "b.usd")));
        assert_eq!(
            split("x[1]/a.USDZ[b/c.usd]"),
            Some((Some("x[1]/a.USDZ"), "b/c.usd"))
        );
        assert_eq!(
            split("a.usdz[b.usdz[c.usd]]"),
            Some((Some("a.usdz"), "b.usdz[c.usd]"))
        );
        for whole in [
            "a.usdz",
            "x[1]/a.usd",
            "x[1]",
            "a.usd[b.usd]",
            "a.usdz[b.usd",
        ] {
            assert_eq!(split(whole), None, "{whole}");
        }
    }
}
