//! USD files written by OpenUSD's own library read as it reads them.
//!
//! `reference/make_usd.py` makes the files and `usd_expected.json`.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use pelage_curves::{Basis, Wrap};
use pelage_io::{CurveSet, read_usd_curves, read_usd_mesh, usd_mesh_frames};
use pelage_strands::UpAxis;
use serde_json::Value;
use std::path::{Path, PathBuf};

fn reference(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference");
    folder.join(name)
}

fn expected(part: &str) -> Value {
    let text = std::fs::read_to_string(reference("usd_expected.json")).unwrap();
    let all: Value = serde_json::from_str(&text).unwrap();
    all[part].clone()
}

fn numbers<T: serde::de::DeserializeOwned>(value: &Value) -> Vec<T> {
    serde_json::from_value(value.clone()).unwrap()
}

fn assert_near<const N: usize>(found: &[[f32; N]], expected: &[[f32; N]], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (i, (a, b)) in found.iter().zip(expected).enumerate() {
        for k in 0..N {
            let near = (a[k] - b[k]).abs() <= 1e-5 * b[k].abs().max(1.0);
            assert!(near, "{what}, entry {i}: {a:?}, not {b:?}");
        }
    }
}

/// Of `meshes` and `curves`. The package of the curves has two layers.
const FILES: [&str; 3] = ["usda", "usdc", "usdz"];

#[test]
fn meshes_are_moved_flipped_and_sampled_as_openusd_does() {
    for (time, prims) in expected("meshes").as_object().unwrap() {
        for (prim, wanted) in prims.as_object().unwrap() {
            for kind in FILES {
                let what = format!("{kind} {prim} at {time}");
                let file = reference(&format!("meshes.{kind}"));
                let read = read_usd_mesh(&file, Some(prim), time.parse().ok()).unwrap();
                assert_near(&read.mesh.positions, &numbers(&wanted["points"]), &what);
                let (sizes, corners) = (&wanted["sizes"], &wanted["corners"]);
                assert_eq!(read.mesh.face_sizes, numbers::<u32>(sizes), "{what}");
                assert_eq!(read.mesh.corner_vertices, numbers::<u32>(corners), "{what}");
                assert_near(&read.mesh.corner_uvs, &numbers(&wanted["uvs"]), &what);
                assert_eq!(read.up_axis, Some(UpAxis::Z));
                assert_eq!(read.meters_per_unit, Some(1.0));
            }
        }
    }
}

#[test]
fn all_meshes_come_as_one_without_proxies_and_classes() {
    let prims = expected("meshes")["None"].as_object().unwrap().len();
    for kind in FILES {
        let file = reference(&format!("meshes.{kind}"));
        let mesh = read_usd_mesh(&file, None, None).unwrap().mesh;
        assert_eq!(mesh.positions.len(), 8 * prims);
        assert_eq!(mesh.corner_uvs.len(), mesh.corner_vertices.len());
        assert!(mesh.corner_normals.is_empty());
        let body = read_usd_mesh(&file, Some("/World/body"), None).unwrap();
        assert_eq!(body.mesh.corner_normals.len(), 18);
    }
}

#[test]
fn frames_are_samples_of_points_and_transforms() {
    for kind in FILES {
        let file = reference(&format!("meshes.{kind}"));
        assert_eq!(usd_mesh_frames(&file, None).unwrap(), [0.0, 10.0]);
        let still = usd_mesh_frames(&file, Some("/World/free")).unwrap();
        assert_eq!(still, [0.0f64; 0]);
    }
}

#[test]
fn packages_are_referred_to_from_outside_whole_and_by_their_layers() {
    let package = reference("meshes.usdz");
    let folder = tempfile::tempdir().unwrap();
    // Brackets are no less a name of a folder than of a layer in a package.
    let folder = folder.path().join("a [1]");
    std::fs::create_dir(&folder).unwrap();
    std::fs::copy(&package, folder.join("b.usdz")).unwrap();
    let whole = read_usd_mesh(&package, None, None).unwrap().mesh;
    for asset in ["b.usdz", "./b.usdz[meshes.usdc]"] {
        let text = format!("#usda 1.0\ndef \"a\" (references = @{asset}@</World>) {{}}\n");
        let scene = folder.join("scene.usda");
        std::fs::write(&scene, text).unwrap();
        let read = read_usd_mesh(&scene, None, None).unwrap().mesh;
        assert_eq!(read.positions, whole.positions, "{asset}");
        assert_eq!(read.corner_uvs, whole.corner_uvs, "{asset}");
    }
}

#[test]
fn an_unknown_prim_is_refused_with_those_there_are() {
    let error = read_usd_mesh(&reference("meshes.usda"), Some("/Wrld"), None).unwrap_err();
    let text = error.to_string();
    assert!(text.contains("/Wrld: there is no mesh"), "{text}");
    assert!(text.contains("/World/body"), "{text}");
}

fn basis_and_wrap(name: &str) -> (Basis, Wrap) {
    let (basis, wrap) = name.trim_start_matches("/Hair/").split_once('_').unwrap();
    let basis = match basis {
        "linear" => Basis::Linear,
        "bezier" => Basis::Bezier,
        "bspline" => Basis::BSpline,
        _ => Basis::CatmullRom,
    };
    let wrap = match wrap {
        "nonperiodic" => Wrap::Nonperiodic,
        "periodic" => Wrap::Periodic,
        _ => Wrap::Pinned,
    };
    (basis, wrap)
}

fn check_widths(set: &CurveSet, wanted: &Value) {
    let authored: Vec<f32> = numbers(&wanted["widths"]);
    let widths = &set.curves.widths;
    // The prims stand in a transform that doubles every length.
    let doubled: Vec<f32> = authored.iter().map(|w| 2.0 * w).collect();
    let first = set.curves.vertex_count(0);
    assert_eq!(widths.len(), set.curves.points.len(), "{}", set.name);
    match wanted["domain"].as_str().unwrap() {
        "constant" => assert!(widths.iter().all(|w| *w == doubled[0])),
        "uniform" => {
            assert!(widths[..first].iter().all(|w| *w == doubled[0]));
            assert!(widths[first..].iter().all(|w| *w == doubled[1]));
        }
        "vertex" => assert_eq!(*widths, doubled),
        _ => {
            assert_eq!(wanted["varying"], authored.len());
            assert_eq!(widths[0], doubled[0], "{}", set.name);
        }
    }
}

#[test]
fn curves_of_every_basis_keep_vertices_widths_and_attributes() {
    for (time, prims) in expected("curves").as_object().unwrap() {
        for kind in FILES {
            let file = reference(&format!("curves.{kind}"));
            let read = read_usd_curves(&file, time.parse().ok()).unwrap();
            assert_eq!(read.up_axis, Some(UpAxis::Y));
            assert_eq!(read.meters_per_unit, Some(0.01));
            assert_eq!(read.sets.len(), prims.as_object().unwrap().len());
            for set in &read.sets {
                assert_eq!(set.faults, [], "{kind} {}", set.name);
                let wanted = &prims[&set.name];
                assert_eq!((set.basis, set.wrap), basis_and_wrap(&set.name));
                assert_near(&set.curves.points, &numbers(&wanted["points"]), &set.name);
                let counts: Vec<usize> = (0..2).map(|i| set.curves.vertex_count(i)).collect();
                assert_eq!(counts, numbers::<usize>(&wanted["counts"]));
                check_widths(set, wanted);
                assert_eq!(set.curves.hair_id, [5_000_000_000, 7]);
                assert_eq!(set.curves.strand_id, [0, 1]);
                assert_eq!(set.curves.group, [3, 4]);
                assert_eq!(set.curves.root_uv, [[0.25, 0.5], [1.0, 0.0]]);
                assert_eq!(set.curves.root_rest, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
                assert_eq!(set.curves.colors[0], [0.5, 0.25, 0.125]);
                assert_eq!(set.curves.opacities[0], 0.5);
                assert_eq!(set.frames, [1.0, 2.0]);
                let mystery = set
                    .attributes
                    .iter()
                    .find(|a| a.name == "primvars:mystery")
                    .unwrap();
                assert_eq!((mystery.kind.as_str(), mystery.count), ("half[]", 2));
                assert_eq!(mystery.domain, "uniform");
            }
        }
    }
}

#[test]
fn arrays_that_pack_extremely_well_are_read() {
    let read = read_usd_curves(&reference("packed.usdc"), None).unwrap();
    let ones = &read.sets[0].attributes;
    let ones = ones.iter().find(|a| a.name == "primvars:ones").unwrap();
    assert_eq!(ones.count, 100_000);
    assert_eq!(read.sets[0].faults, []);
}

/// The folder of shared test data, if this checkout has one.
fn shared_data() -> Option<PathBuf> {
    if let Some(folder) = std::env::var_os("PELAGE_DATA") {
        return Some(folder.into());
    }
    let above = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors();
    let mut candidates = above.map(|folder| folder.join("shared/data"));
    candidates.find(|folder| folder.is_dir())
}

#[test]
fn hair_of_another_writer_reads_whole() {
    let file = shared_data().map(|data| data.join("refs/hair_cr_pinned.usda"));
    let Some(file) = file.filter(|file| file.is_file()) else {
        eprintln!("skipped: refs/hair_cr_pinned.usda is not there (see PELAGE_DATA)");
        return;
    };
    let read = read_usd_curves(&file, None).unwrap();
    let set = &read.sets[0];
    assert_eq!((set.basis, set.wrap), (Basis::CatmullRom, Wrap::Pinned));
    assert_eq!(set.faults, []);
    assert_eq!((set.curves.len(), set.curves.points.len()), (10, 80));
    assert_eq!(set.curves.widths.len(), 80);
    assert_eq!(set.curves.root_uv.len(), 10);
    assert_eq!(read.up_axis, Some(UpAxis::Z));
}
