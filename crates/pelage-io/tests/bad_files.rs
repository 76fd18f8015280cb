//! Files that readers must refuse, or put up with, without ever panicking.
//!
//! Cases are discovered from disk: `bad/FORMAT/*` must give an error that names
//! the file, `bad/FORMAT/tolerated/*` must be read. A new format is one line in
//! [`READERS`] and a folder of files.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use pelage_io::ReadError;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};

/// Reads a file and drops what it holds.
type Reader = fn(&Path) -> Result<(), ReadError>;

/// Folder name and the reader that its files are given to.
const READERS: &[(&str, Reader)] = &[
    ("gltf", |path| pelage_io::read_gltf_mesh(path).map(drop)),
    ("hair", |path| pelage_io::read_hair(path).map(drop)),
    ("image", |path| pelage_io::read_image(path).map(drop)),
    ("obj", |path| pelage_io::read_obj_mesh(path).map(drop)),
    ("obj_curves", |path| {
        pelage_io::read_obj_curves(path).map(drop)
    }),
    ("ply", |path| pelage_io::read_ply_mesh(path).map(drop)),
    ("super_helices", |path| {
        pelage_io::read_super_helices(path).map(|strands| drop(strands.decode(None)))
    }),
];

/// Folders tried by `bad_usd.rs`: scenes are read around what is wrong in them.
const ELSEWHERE: [&str; 4] = ["npz", "usda", "usdc", "usdz"];

fn bad() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bad")
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Vec::new();
    };
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files = entries(folder);
    files.retain(|path| path.is_file());
    files
}

/// What is wrong with how `reader` takes `path`, if anything.
fn complaint(reader: Reader, path: &Path, tolerated: bool) -> Option<String> {
    let name = path.file_name().unwrap().to_str().unwrap();
    match (catch_unwind(|| reader(path)), tolerated) {
        (Err(_), _) => Some(format!("{}: panic", path.display())),
        (Ok(Ok(())), false) => Some(format!("{}: read without an error", path.display())),
        (Ok(Err(error)), true) => Some(format!("refused: {error}")),
        (Ok(Err(error)), false) => {
            let text = error.to_string();
            let long = text.len() > path.as_os_str().len() + 400;
            (!text.contains(name) || long || text.contains('\n'))
                .then(|| format!("not a line that names {name}: {text}"))
        }
        (Ok(Ok(())), true) => None,
    }
}

#[test]
fn every_bad_file_is_refused_in_plain_words_and_every_odd_one_is_read() {
    let mut complaints = Vec::new();
    for (folder, reader) in READERS {
        let folder = bad().join(folder);
        let cases = files(&folder);
        assert!(!cases.is_empty(), "no files in {}", folder.display());
        let tolerated = files(&folder.join("tolerated"));
        complaints.extend(cases.iter().filter_map(|p| complaint(*reader, p, false)));
        complaints.extend(tolerated.iter().filter_map(|p| complaint(*reader, p, true)));
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn every_folder_of_bad_files_has_a_reader() {
    for folder in entries(&bad()).iter().filter(|path| path.is_dir()) {
        let name = folder.file_name().unwrap().to_str().unwrap();
        let known = READERS.iter().any(|(known, _)| *known == name);
        assert!(known || ELSEWHERE.contains(&name), "{name}");
    }
}

#[test]
fn no_reader_takes_a_folder_a_device_or_what_is_not_there() {
    let missing = Path::new("no/such/file");
    let device = Path::new("/dev/zero");
    for (name, reader) in READERS {
        for path in [&bad(), missing, device] {
            let error = reader(path).expect_err(name);
            assert_eq!(error.blame, pelage_io::Blame::World, "{name}: {error}");
        }
    }
}

#[test]
fn no_reader_takes_the_files_of_another() {
    for (folder, _) in READERS {
        for path in files(&bad().join(folder).join("tolerated")) {
            for (name, reader) in READERS.iter().filter(|(name, _)| name != folder) {
                let related = name.starts_with("obj") && folder.starts_with("obj");
                assert!(
                    related || reader(&path).is_err(),
                    "{name}: {}",
                    path.display()
                );
            }
        }
    }
}
