//! The files of a map: one, or those of a UDIM set that are in its folder.

use pelage_groom::recipe::FilePath;
use pelage_io::{Blame, ReadError};
use std::path::{Path, PathBuf};

/// The files that `path` names, in the order of their tiles; at least one.
pub fn files(path: &FilePath) -> Result<Vec<PathBuf>, ReadError> {
    if !path.is_tiled() {
        return Ok(vec![path.resolved.clone()]);
    }
    let folder = path.resolved.parent().unwrap_or(Path::new(""));
    let opened = match folder.as_os_str().is_empty() {
        true => Path::new("."),
        false => folder,
    };
    let world = |error| ReadError::world(opened, &error);
    let mut files = Vec::new();
    for entry in std::fs::read_dir(opened).map_err(world)? {
        let file = folder.join(entry.map_err(world)?.file_name());
        if path.tile_number(&file).is_some() {
            files.push(file);
        }
    }
    if files.is_empty() {
        let message = format!(
            "no file in the folder {} has such a name, with a number from 1001 to 9999 for <UDIM>",
            opened.display()
        );
        return Err(ReadError::new(&path.resolved, Blame::World, message)
            .help("put the tiles there, or correct the path"));
    }
    files.sort();
    Ok(files)
}
