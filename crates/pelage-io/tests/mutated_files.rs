//! Sound files, damaged at random: whatever comes of them, no reader panics.
//!
//! The files are the seeds of the fuzz targets, which do the same for hours; this
//! is the quick form that runs with every test (`PROPTEST_CASES=100000` for more).

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use proptest::prelude::*;
use std::path::{Path, PathBuf};

/// Parses bytes and drops what they hold.
type Parser = fn(&[u8], &Path);

/// Folder of seeds and the parsers that its files are given to.
const PARSERS: &[(&str, Parser)] = &[
    ("gltf", |bytes, path| {
        let _ = pelage_io::parse_gltf_mesh(bytes, path);
    }),
    ("hair", |bytes, path| {
        let _ = pelage_io::parse_hair(bytes, path);
    }),
    ("image", |bytes, path| {
        let _ = pelage_io::parse_image(bytes, path);
    }),
    ("obj", |bytes, path| {
        let _ = pelage_io::parse_obj_mesh(bytes, path);
        let _ = pelage_io::parse_obj_curves(bytes, path);
    }),
    ("ply", |bytes, path| {
        let _ = pelage_io::parse_ply_mesh(bytes, path);
    }),
    ("super_helices", |bytes, path| {
        let strands = pelage_io::parse_super_helices(bytes, path);
        // A digit more may be a million vertices more.
        let few = strands
            .ok()
            .filter(|s| s.vertices.iter().all(|n| *n < 10_000));
        let decoded = few.map(|strands| strands.decode(None));
        let finite = |p: &[f32; 3]| p.iter().all(|x| x.is_finite());
        assert!(decoded.is_none_or(|strands| strands.points.iter().all(finite)));
    }),
];

fn seeds() -> Vec<(PathBuf, Vec<u8>, Parser)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds");
    let mut seeds = Vec::new();
    for (folder, parser) in PARSERS {
        let before = seeds.len();
        for entry in std::fs::read_dir(root.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            let bytes = std::fs::read(&path).unwrap();
            seeds.push((path, bytes, *parser));
        }
        assert!(seeds.len() > before, "no seeds for {folder}");
    }
    seeds
}

#[test]
fn every_seed_is_sound() {
    for (path, bytes, _) in seeds() {
        let folder = path.parent().and_then(Path::file_name).unwrap();
        let result = match folder.to_str().unwrap() {
            "gltf" => pelage_io::parse_gltf_mesh(&bytes, &path).map(drop),
            "hair" => pelage_io::parse_hair(&bytes, &path).map(drop),
            "image" => pelage_io::parse_image(&bytes, &path).map(drop),
            "ply" => pelage_io::parse_ply_mesh(&bytes, &path).map(drop),
            "super_helices" => pelage_io::parse_super_helices(&bytes, &path).map(drop),
            _ => pelage_io::parse_obj_mesh(&bytes, &path)
                .map(drop)
                .or_else(|_| pelage_io::parse_obj_curves(&bytes, &path).map(drop)),
        };
        result.unwrap();
    }
}

#[test]
fn every_truncation_is_survived() {
    for (path, bytes, parse) in seeds() {
        for cut in 0..bytes.len() {
            parse(&bytes[..cut], &path);
        }
    }
}

/// Where (as a fraction of the length) a byte changes, and to what.
fn changes() -> impl Strategy<Value = Vec<(f64, u8)>> {
    let byte = prop_oneof![any::<u8>(), Just(0), Just(255), Just(128), Just(b'9')];
    prop::collection::vec((0.0..1.0, byte), 1..8)
}

proptest! {
    #[test]
    fn random_changes_are_survived(changes in changes(), cut in 0.5..1.5) {
        for (path, mut bytes, parse) in seeds() {
            for (at, byte) in &changes {
                let at = (at * bytes.len() as f64) as usize;
                bytes[at] = *byte;
            }
            bytes.truncate((cut * bytes.len() as f64) as usize);
            parse(&bytes, &path);
        }
    }
}
