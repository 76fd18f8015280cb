//! `cyclone`: figure 1 of document 000, by profiles of curvature and torsion.

use crate::example::Example;
use pelage_surface::PolygonMesh;

/// Faces a side, and its length.
const FACES: u32 = 8;
const SIDE: f64 = 3.0;

/// The example.
pub fn example() -> Example {
    Example {
        name: "cyclone",
        summary: "figure 1 of document 000: strands by ramps of curvature and torsion",
        recipe: include_str!("groom.toml").to_owned(),
        mesh_file: "ground.obj",
        mesh: ground(),
        maps: Vec::new(),
        guides: None,
        curves: None,
    }
}

/// A level square around the origin.
fn ground() -> PolygonMesh {
    let mut mesh = PolygonMesh::sheet(FACES, FACES, |u, v| {
        [SIDE * (u - 0.5), 0.0, SIDE * (0.5 - v)]
    });
    mesh.corner_normals = vec![[0.0, 1.0, 0.0]; mesh.corner_vertices.len()];
    mesh
}
