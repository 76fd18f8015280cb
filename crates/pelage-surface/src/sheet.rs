//! Surfaces that a formula gives over the unit square.

use crate::PolygonMesh;

impl PolygonMesh {
    /// A grid of `columns × rows` quadrilaterals over the unit square of texture space,
    /// whose vertices stand where `position` puts their (u, v), both 0..=1.
    ///
    /// Vertices and faces follow u first, from the lower left; faces turn from u to v.
    /// It may have up to 2^32 vertices; without columns or rows it has no face. Where the
    /// formula closes on itself, the vertices of the seam are there twice, so that texture
    /// coordinates may jump.
    ///
    /// ```
    /// use pelage_surface::{Mesh, PolygonMesh};
    /// let ground = PolygonMesh::sheet(4, 2, |u, v| [4.0 * u, 0.0, -2.0 * v]);
    /// assert_eq!(ground.positions.len(), 15);
    /// assert_eq!(Mesh::new(ground).unwrap().triangles().len(), 16);
    /// ```
    pub fn sheet(columns: u32, rows: u32, position: impl Fn(f64, f64) -> [f64; 3]) -> Self {
        let [across, up] = [columns, rows].map(|n| move |i: u32| i as f64 / n as f64);
        let mut mesh = Self::default();
        for y in 0..=rows {
            for x in 0..=columns {
                let point = position(across(x), up(y));
                mesh.positions.push(point.map(|c| c as f32));
            }
        }
        for y in 0..rows {
            for x in 0..columns {
                mesh.face_sizes.push(4);
                for [x, y] in [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]] {
                    mesh.corner_vertices.push(y * (columns + 1) + x);
                    mesh.corner_uvs.push([across(x) as f32, up(y) as f32]);
                }
            }
        }
        mesh
    }
}
