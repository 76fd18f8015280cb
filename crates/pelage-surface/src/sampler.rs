//! Roots of hairs on a surface, in proportion to a density.
//!
//! Source: document 004, section 2.1, with the errata applied and the laws of the
//! design: root `i` depends on the seed and `i` alone; more roots keep the old ones;
//! the roots of a region can be listed without making the others. Triangles lie along
//! a Hilbert curve through the rest pose, so that the stratification of the first
//! number becomes one in space, and a region becomes a few intervals of it.

use crate::distribution::Distribution;
use crate::hilbert::hilbert_index;
use crate::subdivide::{self, Density, MAX_DEPTH, Part, pieces};
use crate::{Mesh, RootSequence, SurfacePoint};
use pelage_curves::Vec3;

/// Draws roots on a mesh in proportion to a density.
#[derive(Clone, Debug)]
pub struct RootSampler {
    distribution: Distribution,
    /// Triangle and part of each piece.
    pieces: Vec<(u32, u32)>,
    parts: Vec<Part>,
    sequence: RootSequence,
}

impl RootSampler {
    /// A sampler of `mesh` at rest by `density`, for the hairs of `seed`; `None` where
    /// no piece of the surface has any density (no hair can grow).
    pub fn new(mesh: &Mesh, density: &Density, seed: u64) -> Option<Self> {
        let found = pieces(mesh, &order_along_curve(mesh), density);
        let weights: Vec<f64> = found.iter().map(|p| p.weight).collect();
        let distribution = Distribution::new(&weights)?;
        let deepest = found.iter().map(|p| p.part).max().unwrap_or(0);
        let depth = (0..MAX_DEPTH)
            .find(|d| (deepest as usize) < ((1usize << (2 * (d + 1))) - 1) / 3)
            .unwrap_or(MAX_DEPTH);
        Some(Self {
            distribution,
            pieces: found.iter().map(|p| (p.triangle, p.part)).collect(),
            parts: subdivide::parts(depth),
            sequence: RootSequence::new(seed),
        })
    }

    /// Root of hair `index`.
    #[inline]
    pub fn root(&self, index: u64) -> SurfacePoint {
        let [x, y] = self.sequence.sample(index);
        self.place(x, (y >> 11) as f64 * (1.0 / (1u64 << 53) as f64))
    }

    /// The place that the fraction `x` (of 2^64) and `y` in 0..1 lead to. Points that
    /// are evenly spread over the unit square come out in proportion to the density.
    #[inline]
    pub fn place(&self, x: u64, y: f64) -> SurfacePoint {
        let pick = self.distribution.pick(x);
        let (triangle, part) = self.pieces[pick.index];
        let root = pick.rest.sqrt();
        let barycentric =
            self.parts[part as usize].barycentric((1.0 - root) as f32, (y * root) as f32);
        SurfacePoint {
            triangle,
            barycentric,
        }
    }

    /// Area of the surface, each part weighed by its density.
    pub fn weighted_area(&self) -> f64 {
        self.distribution.total()
    }

    /// The centre of each piece, as a place on `mesh`: somewhere in every part of the
    /// surface where hair can grow.
    pub fn piece_centres(&self) -> impl Iterator<Item = SurfacePoint> {
        self.pieces.iter().map(|&(triangle, part)| SurfacePoint {
            triangle,
            barycentric: self.parts[part as usize].centre(),
        })
    }

    /// Pieces of constant density.
    pub fn pieces(&self) -> usize {
        self.pieces.len()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        self.distribution.bytes()
            + std::mem::size_of_val(&self.pieces[..])
            + std::mem::size_of_val(&self.parts[..])
    }
}

/// Triangles along a Hilbert curve through their centres.
fn order_along_curve(mesh: &Mesh) -> Vec<u32> {
    let (low, high) = mesh.bounds();
    let side = (high - low).max_element().max(f32::MIN_POSITIVE);
    let mut order: Vec<(u64, u32)> = (0..mesh.triangles().len() as u32)
        .map(|t| {
            let [a, b, c] = mesh.corners(t as usize);
            (hilbert_index((a + b + c) / 3.0, low, side), t)
        })
        .collect();
    order.sort_unstable();
    order.into_iter().map(|(_, t)| t).collect()
}

/// The hairs of each cell of a grid over a surface at rest (architecture.md, law 3).
///
/// A hair belongs to the cell that holds the centre of the piece its root lies on, so
/// the cells share out the hairs exactly, whatever the grid.
#[derive(Clone, Debug)]
pub struct VoxelRoots<'a> {
    sampler: &'a RootSampler,
    resolution: [u32; 3],
    /// For each cell, its intervals of the first number.
    intervals: Vec<Vec<(u64, u128)>>,
}

impl<'a> VoxelRoots<'a> {
    /// Sorts the pieces of `sampler`, made of `mesh`, into `resolution` cells over the
    /// bounds of the mesh. Each resolution is taken as at least 1.
    pub fn new(sampler: &'a RootSampler, mesh: &Mesh, resolution: [u32; 3]) -> Self {
        let resolution = resolution.map(|n| n.max(1));
        let (low, high) = mesh.bounds();
        let cells = resolution.iter().map(|&n| n as usize).product();
        let mut intervals: Vec<Vec<(u64, u128)>> = vec![Vec::new(); cells];
        for (i, &(triangle, part)) in sampler.pieces.iter().enumerate() {
            let centre = subdivide::centre(mesh, triangle, sampler.parts[part as usize]);
            let cell = cell_of(centre, low, high, resolution);
            let (start, end) = sampler.distribution.share(i);
            match intervals[cell].last_mut() {
                Some(last) if last.1 == start as u128 => last.1 = end,
                _ => intervals[cell].push((start, end)),
            }
        }
        Self {
            sampler,
            resolution,
            intervals,
        }
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.intervals.len()
    }

    /// Cells along each axis.
    pub fn resolution(&self) -> [u32; 3] {
        self.resolution
    }

    /// The hairs among the first `count` that belong to cell `cell` (x fastest),
    /// ascending, in time proportional to their number.
    pub fn hairs(&self, cell: usize, count: u64) -> Vec<u64> {
        let mut hairs = Vec::new();
        for &(low, high) in self.intervals.get(cell).map_or(&[][..], |i| &i[..]) {
            self.sampler
                .sequence
                .indices_in(low, high, count, &mut |i| hairs.push(i));
        }
        hairs.sort_unstable();
        hairs
    }
}

fn cell_of(point: Vec3, low: Vec3, high: Vec3, resolution: [u32; 3]) -> usize {
    let mut cell = 0;
    for k in (0..3).rev() {
        let n = resolution[k];
        let side = high[k] - low[k];
        let along = if side > 0.0 {
            (point[k] - low[k]) / side
        } else {
            0.0
        };
        cell = cell * n as usize + ((along * n as f32) as usize).min(n as usize - 1);
    }
    cell
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ImageMap, PolygonMesh, Wrap};
    use proptest::prelude::*;

    /// A wavy sheet of `n × n` squares over the unit square, with UVs.
    fn sheet(n: u32) -> Mesh {
        let at = |i: u32| i as f32 / n as f32;
        let grid = |x: u32, y: u32| y * (n + 1) + x;
        let mut mesh = PolygonMesh::default();
        for y in 0..=n {
            for x in 0..=n {
                mesh.positions
                    .push([at(x), at(y), 0.2 * libm::sinf(5.0 * at(x))]);
            }
        }
        for y in 0..n {
            for x in 0..n {
                mesh.face_sizes.push(4);
                for (dx, dy) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
                    mesh.corner_vertices.push(grid(x + dx, y + dy));
                    mesh.corner_uvs.push([at(x + dx), at(y + dy)]);
                }
            }
        }
        Mesh::new(mesh).unwrap()
    }

    fn spots() -> ImageMap {
        let texels = (0..64 * 64)
            .map(|i| {
                if (i / 7 + i / 64 / 5) % 3 == 0 {
                    0.0
                } else {
                    (i % 11) as f32
                }
            })
            .collect();
        ImageMap::new(64, 64, 1, texels, false).unwrap()
    }

    #[test]
    fn roots_follow_area_times_density() {
        let (mesh, map) = (sheet(9), spots());
        let density = Density {
            value: 2.0,
            map: Some((&map, 0, Wrap::Clamp)),
        };
        let sampler = RootSampler::new(&mesh, &density, 3).unwrap();
        let n = 40_000u64;
        let triangles = mesh.triangles().len();
        let mut counts = vec![0f64; triangles];
        (0..n).for_each(|i| counts[sampler.root(i).triangle as usize] += 1.0);
        let mut expected = vec![0.0; triangles];
        for piece in pieces(&mesh, &(0..triangles as u32).collect::<Vec<_>>(), &density) {
            expected[piece.triangle as usize] += piece.weight;
        }
        let scale = n as f64 / expected.iter().sum::<f64>();
        let chi_square: f64 = counts
            .iter()
            .zip(&expected)
            .filter(|(_, e)| **e > 0.0)
            .map(|(c, e)| (c - e * scale) * (c - e * scale) / (e * scale))
            .sum();
        // A stratified sequence stays far below the number of degrees of freedom.
        assert!(
            chi_square < triangles as f64,
            "{chi_square} for {triangles} triangles"
        );
        assert!(
            counts
                .iter()
                .zip(&expected)
                .all(|(c, e)| *e > 0.0 || *c == 0.0)
        );
    }

    #[test]
    fn where_the_map_is_black_nothing_grows() {
        let mesh = sheet(3);
        let black = ImageMap::new(2, 2, 1, vec![0.0; 4], false).unwrap();
        let density = Density {
            value: 1.0,
            map: Some((&black, 0, Wrap::Repeat)),
        };
        assert!(RootSampler::new(&mesh, &density, 0).is_none());
    }

    #[test]
    fn constant_maps_cost_one_piece_a_triangle() {
        let mesh = sheet(3);
        let grey = ImageMap::new(64, 64, 1, vec![0.5; 4096], false).unwrap();
        let density = Density {
            value: 1.0,
            map: Some((&grey, 0, Wrap::Repeat)),
        };
        let sampler = RootSampler::new(&mesh, &density, 0).unwrap();
        assert_eq!(sampler.pieces(), mesh.triangles().len());
    }

    #[test]
    fn barycentrics_are_weights() {
        let (mesh, map) = (sheet(4), spots());
        let density = Density {
            value: 1.0,
            map: Some((&map, 0, Wrap::Repeat)),
        };
        let sampler = RootSampler::new(&mesh, &density, 11).unwrap();
        for i in 0..5000 {
            let b = sampler.root(i).barycentric;
            assert!(b.iter().all(|w| (0.0..=1.0).contains(w)), "{b:?}");
            assert!((b.iter().sum::<f32>() - 1.0).abs() < 1e-6);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn the_voxels_share_out_the_hairs_exactly(
            resolution in prop::array::uniform3(1u32..5), count in 0u64..3000, seed: u64,
        ) {
            let (mesh, map) = (sheet(5), spots());
            let density = Density { value: 1.0, map: Some((&map, 0, Wrap::Repeat)) };
            let sampler = RootSampler::new(&mesh, &density, seed).unwrap();
            let voxels = VoxelRoots::new(&sampler, &mesh, resolution);
            let mut all: Vec<u64> =
                (0..voxels.cells()).flat_map(|c| voxels.hairs(c, count)).collect();
            all.sort_unstable();
            prop_assert_eq!(all, (0..count).collect::<Vec<_>>());
        }
    }
}
