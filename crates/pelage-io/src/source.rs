//! The bytes of a file, whole.
//!
//! Every reader here holds its file in memory before it looks at it: then "does
//! this count fit" is a comparison with a length, not a question to the disk.

use crate::{Blame, ReadError};
use std::fs;
use std::path::Path;

/// All bytes of the regular file `path`.
pub(crate) fn read_bytes(path: &Path) -> Result<Vec<u8>, ReadError> {
    open_file(path)?;
    fs::read(path).map_err(|error| ReadError::world(path, &error))
}

/// The regular file `path`, open. Folders, devices and pipes are refused: the
/// latter two may never end.
pub(crate) fn open_file(path: &Path) -> Result<fs::File, ReadError> {
    let found = fs::metadata(path).map_err(|error| ReadError::world(path, &error))?;
    if found.is_dir() {
        return Err(ReadError::new(
            path,
            Blame::World,
            "this is a folder, not a file",
        ));
    }
    if !found.is_file() {
        return Err(ReadError::new(
            path,
            Blame::World,
            "this is a device or pipe; only regular files can be read",
        ));
    }
    fs::File::open(path).map_err(|error| ReadError::world(path, &error))
}
