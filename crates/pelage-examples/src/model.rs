//! A mesh with its atlas, and what the maps and guides ask of it.

use crate::charts::cut_into_charts;
use crate::flatten::{Start, flatten};
use crate::lift::lift_overlaps;
use crate::pack::pack;
use crate::raster::Texel;
use crate::relax::Triangles;
use crate::sheet::Sheet;
use crate::untangle::untangle;
use glam::{DVec2, DVec3};
use pelage_surface::PolygonMesh;

/// Triangles with texture coordinates.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// The triangles.
    pub mesh: Triangles,
    /// What each triangle belongs to, as the example numbers its parts.
    pub labels: Vec<u8>,
    /// Texture coordinates of each corner.
    pub uvs: Vec<[DVec2; 3]>,
}

/// Space between charts as a fraction of the atlas: 8 texels of 1024.
const GUTTER: f64 = 8.0 / 1024.0;

/// Rounds of as-rigid-as-possible flattening: more change little.
const FLATTENING_ROUNDS: usize = 16;

impl Model {
    /// Cuts the mesh along labels and `cut`, flattens and packs the charts.
    /// `start_of` gives where the flattening of a label's charts starts.
    pub fn unwrapped<'a>(
        mesh: Triangles,
        labels: Vec<u8>,
        cut: impl Fn(usize, usize) -> bool,
        start_of: impl Fn(u8) -> Start<'a>,
    ) -> Self {
        let mut waiting = cut_into_charts(&mesh, &labels, cut);
        let (mut charts, mut flat) = (Vec::new(), Vec::new());
        while let Some(chart) = waiting.pop() {
            let sheet = Sheet::new(&chart, &mesh.positions);
            let mut uv = flatten(&sheet, &start_of(chart.label), FLATTENING_ROUNDS);
            untangle(&sheet, &mut uv);
            uv.truncate(chart.vertices.len());
            match lift_overlaps(&chart, &uv) {
                // A piece is smaller than what it was lifted from: this ends.
                Some((kept, kept_uv, pieces)) if !kept.triangles.is_empty() => {
                    charts.push(kept);
                    flat.push(kept_uv);
                    waiting.extend(pieces);
                }
                Some(_) => waiting.extend(chart.halves()),
                None => {
                    charts.push(chart);
                    flat.push(uv);
                }
            }
        }
        pack(&charts, &mut flat, GUTTER);
        let mut uvs = vec![[DVec2::ZERO; 3]; mesh.triangles.len()];
        for (chart, uv) in charts.iter().zip(&flat) {
            for (&t, corners) in chart.triangles.iter().zip(&chart.corners) {
                uvs[t as usize] = corners.map(|c| uv[c as usize]);
            }
        }
        Self { mesh, labels, uvs }
    }

    /// Position and unit normal under a texel.
    pub fn place(&self, texel: &Texel) -> (DVec3, DVec3) {
        let mix = |of: &[DVec3]| {
            let tri = self.mesh.triangles[texel.triangle as usize];
            (0..3)
                .map(|k| of[tri[k] as usize] * texel.weights[k])
                .sum::<DVec3>()
        };
        let normal = mix(&self.mesh.normals).normalize_or(DVec3::Y);
        (mix(&self.mesh.positions), normal)
    }

    /// The mesh as files hold it.
    pub fn polygon_mesh(&self) -> PolygonMesh {
        let f = |p: &DVec3| p.as_vec3().to_array();
        let corners = || self.mesh.triangles.iter().flatten();
        PolygonMesh {
            positions: self.mesh.positions.iter().map(f).collect(),
            face_sizes: vec![3; self.mesh.triangles.len()],
            corner_vertices: corners().copied().collect(),
            corner_uvs: (self.uvs.iter().flatten())
                .map(|p| p.as_vec2().to_array())
                .collect(),
            corner_normals: corners()
                .map(|&v| f(&self.mesh.normals[v as usize]))
                .collect(),
        }
    }
}
