//! Formats are recognised, NumPy archives read, and reports say what is there.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use pelage_curves::{Basis, Wrap};
use pelage_io::{FileKind, inspect, mesh_frames, read_curves, read_mesh, sniff};
use std::path::{Path, PathBuf};

fn tests() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests")
}

fn written(name: &str, text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

#[test]
fn archives_of_numpy_read_the_same_in_single_and_double_width() {
    let single = read_curves(&tests().join("reference/hair.npz"), None).unwrap();
    let double = read_curves(&tests().join("reference/hair_wide.npz"), None).unwrap();
    let (set, wide) = (&single.sets[0], &double.sets[0]);
    assert_eq!(set.name, "hair");
    assert_eq!((set.basis, set.wrap), (Basis::CatmullRom, Wrap::Pinned));
    assert_eq!((set.faults.len(), wide.faults.len()), (0, 0));
    assert_eq!(set.curves, wide.curves);
    assert_eq!(set.curves.offsets, [0, 2, 5, 9]);
    assert_eq!(set.curves.points[8], [24.0, 25.0, 26.0]);
    assert_eq!(set.curves.hair_id[2], 5_000_000_002);
    assert_eq!(set.curves.barycentric[1], [0.5, 0.25, 0.25]);
    assert_eq!(set.curves.root_rest[1], [4.0, 5.0, 6.0]);
    let unknown = wide.attributes.iter().find(|a| a.name == "mystery");
    assert_eq!(unknown.unwrap().count, 2);
}

#[test]
fn what_a_file_starts_with_counts_more_than_its_extension() {
    let (_folder, path) = written("mesh.obj", "#usda 1.0\n");
    assert_eq!(sniff(&path).unwrap(), FileKind::Usd);
    let (_folder, path) = written("mesh.OBJ", "v 0 0 0\n");
    assert_eq!(sniff(&path).unwrap(), FileKind::Obj);
    let (_folder, path) = written("mesh.fbx", "");
    let error = read_mesh(&path, None).unwrap_err().to_string();
    let listed = ".usd, .usda, .usdc, .usdz, .obj, .ply, .gltf, .glb";
    assert!(
        error.ends_with(&format!(".fbx is not read; read are {listed}")),
        "{error}"
    );
}

#[test]
fn a_format_without_meshes_is_refused_with_those_that_have_them() {
    let error = read_mesh(&tests().join("reference/hair.npz"), None).unwrap_err();
    assert!(error.to_string().contains("holds no meshes"), "{error}");
    let error = mesh_frames(&tests().join("reference/hair.npz")).unwrap_err();
    assert!(error.to_string().contains(".ply"), "{error}");
}

#[test]
fn a_report_of_curves_counts_and_measures() {
    let report = inspect(&tests().join("reference/hair.npz")).unwrap();
    assert!(report.is_sound(), "{report}");
    let set = &report.curves[0];
    assert_eq!((set.curves, set.vertices), (3, 9));
    let width = set.width.unwrap();
    assert!((width.min - 0.1).abs() < 1e-6 && (width.max - 0.2).abs() < 1e-6);
    let text = report.to_string();
    assert!(
        text.contains("hair_id") && text.contains("nothing wrong"),
        "{text}"
    );
    let json = serde_json::to_value(&report).unwrap();
    assert_eq!(json["curves"][0]["attributes"][0]["type"], "<f4×3");
}

#[test]
fn a_report_of_a_stage_holds_meshes_curves_and_frames() {
    let report = inspect(&tests().join("reference/meshes.usdc")).unwrap();
    let mesh = report.mesh.as_ref().unwrap();
    assert_eq!(report.up_axis, Some("Z"));
    assert_eq!((mesh.vertices, mesh.frames.len()), (48, 2));
    let report = inspect(&tests().join("reference/curves.usda")).unwrap();
    assert!(report.is_sound(), "{report}");
    assert_eq!(report.curves.len(), 11);
}

#[test]
fn an_obj_file_of_faces_only_is_sound() {
    let (_folder, path) = written("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let report = inspect(&path).unwrap();
    assert!(report.is_sound(), "{report}");
    assert_eq!(report.mesh.unwrap().open_edges, 3);
}

#[test]
fn problems_are_listed_ten_of_a_kind() {
    let mut text = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    (0..25).for_each(|i| text += &format!("v {i} 1 1\n"));
    let (_folder, path) = written("m.obj", &text);
    let report = inspect(&path).unwrap();
    let text = report.to_string();
    assert!(text.contains("problem: unused vertex (25)"), "{text}");
    assert!(text.contains("and 15 more"), "{text}");
    assert!(!report.is_sound());
}
