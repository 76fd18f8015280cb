//! The frames of many places.
//!
//! Roots that follow each other lie far apart on the surface. So each array of the mesh is read
//! for all roots of a batch before the next one, with little to do between two readings:
//! processors then wait for many of them at once. What is computed afterwards goes side by
//! side.

use crate::frame::weigh;
use crate::{Mesh, RootFrame, SurfacePoint};
use fearless_simd::{Level, dispatch};
use pelage_curves::Vec3;

/// Places whose frames are made together.
const BATCH: usize = 64;

/// Vectors of a batch: all x, all y, all z.
#[derive(Clone, Copy)]
struct Vectors([[f32; BATCH]; 3]);

impl Vectors {
    const ZERO: Self = Self([[0.0; BATCH]; 3]);

    #[inline(always)]
    fn get(&self, k: usize) -> Vec3 {
        Vec3::new(self.0[0][k], self.0[1][k], self.0[2][k])
    }

    #[inline(always)]
    fn set(&mut self, k: usize, vector: Vec3) {
        for (all, x) in self.0.iter_mut().zip(vector.to_array()) {
            all[k] = x;
        }
    }
}

impl Mesh {
    /// Appends [`frame`](Self::frame) at each of `places` to `frames`: the same, in a fraction
    /// of the time.
    ///
    /// ```
    /// # use pelage_surface::{Mesh, PolygonMesh, SurfacePoint};
    /// # let mesh = Mesh::new(PolygonMesh {
    /// #     positions: vec![[0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
    /// #     face_sizes: vec![3],
    /// #     corner_vertices: vec![0, 1, 2],
    /// #     ..PolygonMesh::default()
    /// # })?;
    /// let corner = SurfacePoint { triangle: 0, barycentric: [1.0, 0.0, 0.0] };
    /// let mut frames = Vec::new();
    /// mesh.frames([corner, corner], &mut frames);
    /// assert_eq!(frames, [mesh.frame(&corner); 2]);
    /// # Ok::<(), pelage_surface::MeshError>(())
    /// ```
    pub fn frames(
        &self,
        places: impl IntoIterator<Item = SurfacePoint>,
        frames: &mut Vec<RootFrame>,
    ) {
        let mut places = places.into_iter();
        let mut batch = [SurfacePoint::default(); BATCH];
        loop {
            let mut filled = 0;
            for (slot, place) in batch.iter_mut().zip(&mut places) {
                *slot = place;
                filled += 1;
            }
            if filled == 0 {
                return;
            }
            dispatch!(Level::new(), simd => {
                let _ = simd;
                self.batch_of_frames(&batch[..filled], frames)
            });
            if filled < BATCH {
                return;
            }
        }
    }

    /// Appends the frames at `places`, [`BATCH`] at most.
    #[inline(always)]
    fn batch_of_frames(&self, places: &[SurfacePoint], frames: &mut Vec<RootFrame>) {
        let mut corners = [[0; 3]; BATCH];
        let [mut positions, mut normals, mut tangents] = [Vectors::ZERO; 3];
        for (corners, place) in corners.iter_mut().zip(places) {
            *corners = self.triangles()[place.triangle as usize];
        }
        for (k, (corners, place)) in corners.iter().zip(places).enumerate() {
            let corners = corners.map(|vertex| self.positions()[vertex as usize]);
            positions.set(k, weigh(corners, place.barycentric));
        }
        for (k, place) in places.iter().enumerate() {
            let corners = self.normals()[place.triangle as usize];
            normals.set(k, weigh(corners, place.barycentric));
        }
        for (k, place) in places.iter().enumerate() {
            tangents.set(k, self.tangent(place));
        }
        let mut binormals = Vectors::ZERO;
        for k in 0..BATCH {
            let frame = RootFrame::new(Vec3::ZERO, tangents.get(k), normals.get(k));
            tangents.set(k, frame.tangent);
            binormals.set(k, frame.binormal);
            normals.set(k, frame.normal);
        }
        frames.extend((0..places.len()).map(|k| RootFrame {
            position: positions.get(k),
            tangent: tangents.get(k),
            binormal: binormals.get(k),
            normal: normals.get(k),
        }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::sheet;

    #[test]
    fn many_frames_at_once_are_the_same_frames() {
        let mesh = sheet(6);
        let triangles = mesh.triangles().len() as u32;
        for count in [0, 1, 63, 64, 65, 1000] {
            let places = (0..count).map(|i: u32| {
                let [u, v] = [17, 29].map(|step| (i * step % 31) as f32 / 62.0);
                SurfacePoint {
                    triangle: i * 7 % triangles,
                    barycentric: [1.0 - u - v, u, v],
                }
            });
            let mut frames = Vec::new();
            mesh.frames(places.clone(), &mut frames);
            let expected: Vec<RootFrame> = places.map(|place| mesh.frame(&place)).collect();
            assert_eq!(frames, expected);
        }
    }
}
