//! Meshes that we write, read by us and by others.

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too")]

mod support;

use pelage_curves::{Vec2, Vec3};
use pelage_io::{MESH_EXTENSIONS, Triangles, read_mesh, write_mesh};
use std::path::{Path, PathBuf};
use support::python;

/// A tetrahedron, each face with corners of its own.
fn tetrahedron() -> (Vec<Vec3>, Vec<Vec3>, Vec<Vec2>, Vec<[u32; 3]>) {
    let p = [Vec3::ZERO, Vec3::X, Vec3::Y * 2.0, Vec3::Z * 3.0];
    let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let (mut positions, mut normals, mut uvs) = (Vec::new(), Vec::new(), Vec::new());
    for face in faces {
        let [a, b, c] = face.map(|i: usize| p[i]);
        positions.extend([a, b, c]);
        normals.extend([(b - a).cross(c - a).normalize(); 3]);
        uvs.extend([Vec2::new(0.25, 0.0), Vec2::X, Vec2::Y]);
    }
    let triangles = (0..4).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    (positions, normals, uvs, triangles)
}

fn written(folder: &Path, extension: &str) -> PathBuf {
    let path = folder.join(format!("mesh.{extension}"));
    let (positions, normals, uvs, triangles) = tetrahedron();
    let mesh = Triangles {
        positions: &positions,
        normals: &normals,
        uvs: &uvs,
        triangles: &triangles,
    };
    write_mesh(&path, &mesh).unwrap();
    path
}

#[test]
fn every_format_is_read_back_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let (positions, normals, uvs, triangles) = tetrahedron();
    for extension in MESH_EXTENSIONS {
        let mesh = read_mesh(&written(folder.path(), extension), None)
            .unwrap()
            .mesh;
        assert_eq!(mesh.face_sizes, [3; 4], "{extension}");
        for (corner, &vertex) in mesh.corner_vertices.iter().enumerate() {
            let ours = triangles.as_flattened()[corner] as usize;
            let place = Vec3::from(mesh.positions[vertex as usize]);
            assert_eq!(place, positions[ours], "{extension}");
            let normal = Vec3::from(mesh.corner_normals[corner]);
            assert!(normal.distance(normals[ours]) < 1e-6, "{extension}");
            let uv = Vec2::from(mesh.corner_uvs[corner]);
            assert!(uv.distance(uvs[ours]) < 1e-6, "{extension}: {uv}");
        }
    }
}

#[test]
fn other_programs_read_a_closed_solid() {
    let folder = tempfile::tempdir().unwrap();
    for extension in ["obj", "ply", "glb"] {
        let path = written(folder.path(), extension);
        // Its own textures would need another package; places alone tell a solid.
        let body = "import sys, trimesh\n\
            loaded = trimesh.load(sys.argv[1])\n\
            if isinstance(loaded, trimesh.Scene): loaded = list(loaded.geometry.values())[0]\n\
            mesh = trimesh.Trimesh(loaded.vertices, loaded.faces)\n\
            assert mesh.is_watertight and abs(mesh.volume - 1) < 1e-6, (mesh, mesh.volume)\n";
        python("trimesh", body, &[&path]);
    }
    let [text, binary] = ["usda", "usdc"].map(|extension| written(folder.path(), extension));
    let body = "import sys\nfrom pxr import Sdf, Usd, UsdGeom\n\
        texts = []\n\
        for path in sys.argv[1:]:\n\
        \x20   stage = Usd.Stage.Open(path)\n\
        \x20   mesh = UsdGeom.Mesh(stage.GetDefaultPrim())\n\
        \x20   assert len(mesh.GetPointsAttr().Get()) == 12\n\
        \x20   assert UsdGeom.Mesh.ValidateTopology(mesh.GetFaceVertexIndicesAttr().Get(),\n\
        \x20       mesh.GetFaceVertexCountsAttr().Get(), 12)[0]\n\
        \x20   texts.append(stage.GetRootLayer().ExportToString())\n\
        assert texts[0] == texts[1], texts\n";
    python("pxr", body, &[&text, &binary]);
}

#[test]
fn what_cannot_be_written_is_refused_in_words_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mesh.stl");
    let (positions, normals, uvs, triangles) = tetrahedron();
    let whole = Triangles {
        positions: &positions,
        normals: &normals,
        uvs: &uvs,
        triangles: &triangles,
    };
    let words = write_mesh(&path, &whole).unwrap_err().to_string();
    assert!(words.contains(".stl; there are .obj, .ply"), "{words}");
    let path = folder.path().join("mesh.obj");
    for (mesh, expected) in [
        (
            Triangles {
                normals: &normals[1..],
                ..whole
            },
            "11 normals for 12 positions",
        ),
        (Triangles { uvs: &[], ..whole }, "0 UVs for 12 positions"),
        (
            Triangles {
                triangles: &[[0, 1, 12]],
                ..whole
            },
            "names vertex 12 of 12",
        ),
        (
            Triangles {
                triangles: &[],
                ..whole
            },
            "without triangles",
        ),
    ] {
        let words = write_mesh(&path, &mesh).unwrap_err().to_string();
        assert!(words.contains(expected), "{words}");
        assert!(!path.exists());
    }
}
