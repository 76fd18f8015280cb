//! Whatever a USD or NumPy file holds, readers answer with data or an error.
//!
//! `bad/make_bad.py` makes the files in `bad/usda`, `bad/usdc`, `bad/usdz`
//! and `bad/npz`.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use pelage_io::{Blame, inspect, read_curves, read_mesh, read_usd_mesh};
use proptest::prelude::*;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests")
        .join(name)
}

fn files(name: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder(name)).unwrap();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

/// Reads a file in every way; gives what is wrong with it, if anything.
fn read_all(path: &Path) -> Option<String> {
    let start = Instant::now();
    for error in [
        read_mesh(path, None).err(),
        read_mesh(path, Some(1.5)).err(),
        read_curves(path, None).err(),
        read_curves(path, Some(1.5)).err(),
    ]
    .into_iter()
    .flatten()
    {
        let text = error.to_string();
        assert!(!error.message.is_empty() && text.len() < 2000, "{text}");
        assert!(!text.contains('\n'), "{text}");
        assert!(text.contains(&path.display().to_string()), "{text}");
    }
    let problem = match inspect(path) {
        Err(error) => Some(error.to_string()),
        Ok(inspection) if inspection.is_sound() => None,
        Ok(inspection) => Some(inspection.to_string()),
    };
    assert!(
        start.elapsed() < Duration::from_secs(20),
        "{path:?} takes {:?}",
        start.elapsed()
    );
    problem
}

fn all_are_bad(name: &str) {
    let files = files(name);
    assert!(files.len() > 10);
    for path in files {
        let problem = read_all(&path);
        println!("{}", problem.as_deref().unwrap_or("").trim_end());
        assert!(problem.is_some(), "nothing is wrong with {path:?}");
    }
}

#[test]
fn every_bad_usda_is_told_of() {
    all_are_bad("bad/usda");
}

#[test]
fn every_bad_usdc_is_read_or_refused() {
    // Some patches hit what nobody reads: then the file is as good as before.
    for path in files("bad/usdc") {
        println!("{}", read_all(&path).unwrap_or_default().trim_end());
    }
}

#[test]
fn every_bad_usdz_is_told_of() {
    all_are_bad("bad/usdz");
}

#[test]
fn every_bad_npz_is_told_of() {
    all_are_bad("bad/npz");
}

#[test]
fn folders_and_missing_files_are_refused_by_whose_fault_it_is() {
    let missing = read_mesh(&folder("bad/missing.usda"), None).unwrap_err();
    assert_eq!(missing.blame, Blame::World);
    assert_eq!(
        read_mesh(&folder("bad"), None).unwrap_err().blame,
        Blame::World
    );
    let straight = read_usd_mesh(&folder("bad"), None, None).unwrap_err();
    assert_eq!(straight.blame, Blame::World);
    let unknown = folder("bad/make_bad.py");
    let error = read_curves(&unknown, None).unwrap_err();
    assert_eq!(error.blame, Blame::Unsupported);
    assert!(error.to_string().contains(".usdc"), "{error}");
}

#[test]
fn long_chains_of_prims_and_references_are_read_while_they_end() {
    let mut nested = String::from("#usda 1.0\n");
    (0..60).for_each(|_| nested += "def Xform \"x\" {\n");
    nested += "def Mesh \"m\" { int[] faceVertexCounts = [3]\n";
    nested += "int[] faceVertexIndices = [0, 1, 2]\n";
    nested += "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)] }\n";
    nested += &"}".repeat(60);
    let mut chain = nested.clone();
    for i in 0..90 {
        let target = if i == 89 {
            "x".into()
        } else {
            format!("r{}", i + 1)
        };
        chain += &format!("\ndef \"r{i}\" (references = </{target}>) {{}}");
    }
    for (text, meshes) in [
        (nested, 1),
        (chain.replace("\"x\"", "\"y\"").replace("</x>", "</y>"), 0),
    ] {
        let file = tempfile::Builder::new().suffix(".usda").tempfile().unwrap();
        std::fs::write(file.path(), text).unwrap();
        match read_mesh(file.path(), None) {
            Ok(read) => assert_eq!(read.mesh.face_sizes.len(), meshes),
            Err(error) => assert!(meshes == 0, "{error}"),
        }
    }
}

/// Breaks a sound file at random places and reads what is left.
fn read_broken(name: &str, changes: &[(usize, u8)], cut: usize) {
    let mut bytes = std::fs::read(folder("reference").join(name)).unwrap();
    for (place, value) in changes {
        let place = place % bytes.len();
        bytes[place] = *value;
    }
    bytes.truncate(bytes.len() - cut % bytes.len());
    let extension = name.rsplit('.').next().unwrap();
    let file = tempfile::Builder::new()
        .suffix(&format!(".{extension}"))
        .tempfile()
        .unwrap();
    std::fs::write(file.path(), &bytes).unwrap();
    read_all(file.path());
}

fn changes() -> impl Strategy<Value = Vec<(usize, u8)>> {
    let value = prop_oneof![Just(0u8), Just(255), Just(127), any::<u8>()];
    prop::collection::vec((any::<usize>(), value), 1..6)
}

fn cut() -> impl Strategy<Value = usize> {
    prop_oneof![4 => Just(0usize), 1 => any::<usize>()]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..Default::default() })]

    #[test]
    fn broken_crates_do_no_harm(changes in changes(), cut in cut()) {
        read_broken("curves.usdc", &changes, cut);
        read_broken("meshes.usdc", &changes, cut);
    }

    #[test]
    fn broken_text_does_no_harm(changes in changes(), cut in cut()) {
        read_broken("meshes.usda", &changes, cut);
        read_broken("curves.usda", &changes, cut);
    }

    #[test]
    fn broken_packages_do_no_harm(changes in changes(), cut in cut()) {
        read_broken("meshes.usdz", &changes, cut);
        read_broken("curves.usdz", &changes, cut);
    }

    #[test]
    fn broken_archives_do_no_harm(changes in changes(), cut in cut()) {
        read_broken("hair.npz", &changes, cut);
        read_broken("hair_wide.npz", &changes, cut);
    }
}
