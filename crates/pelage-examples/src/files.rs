//! An example as files in a folder.

use crate::example::Example;
use crate::obj::{curves_text, mesh_text};
use crate::usda;
use pelage_surface::ImageMap;
use std::io::{self, Cursor, Write};
use std::path::{Path, PathBuf};

/// Writes `groom.toml`, the mesh, the maps and the curves into `folder`, which is
/// made where it is missing; gives the paths written, the recipe first.
///
/// Each file is written beside its place and renamed into it, so that a reader
/// never meets half a file; the recipe, which names the others, comes last.
pub fn write(example: &Example, folder: &Path) -> io::Result<Vec<PathBuf>> {
    std::fs::create_dir_all(folder)
        .map_err(|e| io::Error::new(e.kind(), format!("{}: {e}", folder.display())))?;
    let mut written = Vec::new();
    let mut put = |name: &str, bytes: &[u8]| -> io::Result<()> {
        let path = folder.join(name);
        replace(&path, bytes)
            .map_err(|e| io::Error::new(e.kind(), format!("{}: {e}", path.display())))?;
        written.push(path);
        Ok(())
    };
    put(example.mesh_file, mesh_text(&example.mesh).as_bytes())?;
    for (name, map) in &example.maps {
        put(name, &png(map)?)?;
    }
    if let Some((name, guides)) = &example.guides {
        put(name, curves_text(guides).as_bytes())?;
    }
    if let Some((name, curves)) = &example.curves {
        put(name, usda::curves_text(curves).as_bytes())?;
    }
    put("groom.toml", example.recipe.as_bytes())?;
    written.rotate_right(1);
    Ok(written)
}

/// Writes `bytes` to a temporary file in the same folder, then renames it.
fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut file = tempfile::Builder::new()
        .prefix(".pelage-")
        .tempfile_in(folder)?;
    file.write_all(bytes)?;
    // Temporary files are private; the example is not.
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        file.as_file()
            .set_permissions(PermissionsExt::from_mode(0o644))?;
    }
    file.persist(path).map_err(|e| e.error)?;
    Ok(())
}

/// An 8-bit PNG of one or three channels.
pub fn png(map: &ImageMap) -> io::Result<Vec<u8>> {
    let color = match map.channels() {
        1 => image::ExtendedColorType::L8,
        3 => image::ExtendedColorType::Rgb8,
        n => return Err(io::Error::other(format!("a map of {n} channels"))),
    };
    let codes: Vec<u8> = map
        .texels()
        .iter()
        .map(|t: f32| (t * 255.0).round() as u8)
        .collect();
    let mut bytes = Cursor::new(Vec::new());
    image::write_buffer_with_format(
        &mut bytes,
        &codes,
        map.width(),
        map.height(),
        color,
        image::ImageFormat::Png,
    )
    .map_err(io::Error::other)?;
    Ok(bytes.into_inner())
}
