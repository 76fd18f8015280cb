//! Files that other programs wrote. They are not part of this repository; without
//! them these tests say so and pass.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::{Path, PathBuf};

/// The folder of shared data: `PELAGE_DATA`, or `shared/data` beside or above the
/// repository.
fn data(name: &str) -> Option<PathBuf> {
    let places = match std::env::var_os("PELAGE_DATA") {
        Some(folder) => vec![PathBuf::from(folder)],
        None => Path::new(env!("CARGO_MANIFEST_DIR"))
            .ancestors()
            .map(|folder| folder.join("shared/data"))
            .collect(),
    };
    let found = places
        .into_iter()
        .map(|p| p.join(name))
        .find(|p| p.exists());
    if found.is_none() {
        eprintln!("skipped: no {name}; set PELAGE_DATA to the folder that has it");
    }
    found
}

#[test]
fn a_cow_is_read_whole() {
    let Some(path) = data("spot.obj") else { return };
    let mesh = pelage_io::read_obj_mesh(&path).unwrap();
    assert_eq!(mesh.positions.len(), 2930);
    assert_eq!(mesh.face_sizes.len(), 5856);
    assert_eq!(mesh.corner_uvs.len(), mesh.corner_vertices.len());
}

#[test]
fn a_head_keeps_its_quads() {
    let Some(path) = data("head.obj") else { return };
    let mesh = pelage_io::read_obj_mesh(&path).unwrap();
    assert!(mesh.face_sizes.iter().filter(|&&size| size == 4).count() > 1000);
    assert_eq!(mesh.corner_uvs.len(), mesh.corner_vertices.len());
}

#[test]
fn environment_maps_are_read_in_full() {
    for name in ["hdr/forest.exr", "hdr/night.exr", "hdr/studio.exr"] {
        let Some(path) = data(name) else { continue };
        let map = pelage_io::read_image(&path).unwrap();
        assert!(map.width() > 100 && map.channels() >= 3, "{name}");
        assert!(
            map.texels().iter().any(|t| t > 1.0),
            "{name}: no bright texel"
        );
    }
}
