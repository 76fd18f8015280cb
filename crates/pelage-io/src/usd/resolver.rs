//! Finds layers and checks each before `openusd` parses it.

use super::cursor::Broken;
use super::{crate_guard, package, text_guard};
use crate::ReadError;
use crate::source::read_bytes;
use openusd::ar::{self, DefaultResolver, ResolvedPath, Resolver};
use std::cell::RefCell;
use std::io;
use std::path::Path;
use std::rc::Rc;

/// Finds files, and layers in packages.
#[derive(Default)]
pub(super) struct Files(DefaultResolver);

impl Files {
    /// The whole name of `asset`, as the layer at `anchor` means it.
    pub(super) fn identifier(&self, asset: &str, anchor: Option<&ResolvedPath>) -> String {
        self.0.create_identifier(asset, anchor)
    }

    /// Where the layer of that name is, if it is there.
    pub(super) fn resolve(&self, identifier: &str) -> Option<ResolvedPath> {
        match package::split(identifier) {
            Some((package, name)) => {
                package::has(package, name).then(|| ResolvedPath::new(identifier))
            }
            None => self.0.resolve(identifier).map(|found| layer_at(&found)),
        }
    }
}

/// The layer at `path`: of a package its root layer. One that cannot be opened stays as it
/// is, for [`load`] to say why.
pub(super) fn layer_at(path: &Path) -> ResolvedPath {
    let root = package::is_package(path).then(|| package::root_layer(path).ok());
    ResolvedPath::new(root.flatten().unwrap_or_else(|| path.into()))
}

/// Reads a layer and checks it.
pub(super) fn load(path: &Path) -> Result<Vec<u8>, ReadError> {
    if package::is_package(path) {
        return load(&package::root_layer(path)?);
    }
    let bytes = match path.to_str().and_then(package::split) {
        Some((package, name)) => package::read(package, name)?,
        None => read_bytes(path)?,
    };
    let checked = if bytes.starts_with(openusd::usdc::MAGIC) {
        crate_guard::check(&bytes)
    } else if bytes.trim_ascii_start().starts_with(b"#usda") {
        text_guard::check(&bytes)
    } else if bytes.starts_with(b"PK") {
        Err(Broken(
            "it is a zip archive; the names of USDZ packages end in .usdz".into(),
        ))
    } else {
        Err(Broken(
            "it starts neither with #usda nor with PXR-USDC".into(),
        ))
    };
    checked.map_err(|broken| unsound(path, broken))?;
    Ok(bytes)
}

/// The error that a layer cannot be what its name says.
pub(super) fn unsound(path: &Path, Broken(what): Broken) -> ReadError {
    ReadError::file(path, format!("no sound USD: {what}"))
}

/// Gives `openusd` its layers, checked.
#[derive(Default)]
pub(super) struct Guarded {
    files: Files,
    /// Why the last layer was refused.
    pub(super) refused: Rc<RefCell<Option<String>>>,
}

impl Resolver for Guarded {
    fn create_identifier(&self, asset_path: &str, anchor: Option<&ResolvedPath>) -> String {
        self.files.identifier(asset_path, anchor)
    }

    fn resolve(&self, asset_path: &str) -> Option<ResolvedPath> {
        self.files.resolve(asset_path)
    }

    fn resolve_for_new_asset(&self, asset_path: &str) -> Option<ResolvedPath> {
        self.files.0.resolve_for_new_asset(asset_path)
    }

    fn open_asset(&self, resolved: &ResolvedPath) -> io::Result<Box<dyn ar::Asset>> {
        match load(resolved) {
            Ok(bytes) => Ok(Box::new(io::Cursor::new(bytes))),
            Err(refusal) => {
                let message = refusal.to_string();
                *self.refused.borrow_mut() = Some(message.clone());
                Err(io::Error::other(message))
            }
        }
    }
}
