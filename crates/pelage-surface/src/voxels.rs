//! Which hairs belong to which cell of a grid in space.

use crate::{BlueNoise, Mesh, RootSampler, part};
use pelage_curves::Vec3;

/// The hairs of each cell of a grid over a surface at rest (architecture.md, law 3).
///
/// A hair belongs to the cell that holds the centre of the piece its root lies on, so
/// the cells share out the hairs exactly, whatever the grid.
#[derive(Clone, Debug)]
pub struct VoxelRoots<'a> {
    resolution: [u32; 3],
    hairs: Hairs<'a>,
}

#[derive(Clone, Debug)]
enum Hairs<'a> {
    /// For each cell, its intervals of the first number.
    Drawn(&'a RootSampler, Vec<Vec<(u64, u128)>>),
    /// For each cell, its hairs, ascending.
    Listed(Vec<Vec<u32>>),
}

impl<'a> VoxelRoots<'a> {
    /// Sorts the pieces of `sampler`, made of `mesh`, into `resolution` cells over the
    /// bounds of the mesh. Each resolution is taken as at least 1.
    pub fn new(sampler: &'a RootSampler, mesh: &Mesh, resolution: [u32; 3]) -> Self {
        let resolution = resolution.map(|n| n.max(1));
        let mut intervals: Vec<Vec<(u64, u128)>> = vec![Vec::new(); cells(resolution)];
        for (i, cell) in cells_of(sampler, mesh, resolution).enumerate() {
            let (start, end) = sampler.distribution().share(i);
            match intervals[cell].last_mut() {
                Some(last) if last.1 == start as u128 => last.1 = end,
                _ => intervals[cell].push((start, end)),
            }
        }
        Self {
            resolution,
            hairs: Hairs::Drawn(sampler, intervals),
        }
    }

    /// As [`new`](Self::new), for the roots of `made` by `sampler`; takes 4 bytes a root.
    pub fn of_blue_noise(
        made: &BlueNoise,
        sampler: &RootSampler,
        mesh: &Mesh,
        resolution: [u32; 3],
    ) -> Self {
        let resolution = resolution.map(|n| n.max(1));
        let cell_of_piece: Vec<u32> = cells_of(sampler, mesh, resolution)
            .map(|cell| cell as u32)
            .collect();
        let mut listed = vec![Vec::new(); cells(resolution)];
        for hair in 0..made.len() as u32 {
            let piece = made.piece(hair as u64);
            listed[cell_of_piece[piece as usize] as usize].push(hair);
        }
        Self {
            resolution,
            hairs: Hairs::Listed(listed),
        }
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        cells(self.resolution)
    }

    /// Cells along each axis.
    pub fn resolution(&self) -> [u32; 3] {
        self.resolution
    }

    /// The hairs among the first `count` that belong to cell `cell` (x fastest),
    /// ascending, in time proportional to their number.
    pub fn hairs(&self, cell: usize, count: u64) -> Vec<u64> {
        match &self.hairs {
            Hairs::Drawn(sampler, intervals) => {
                let mut hairs = Vec::new();
                for &(low, high) in intervals.get(cell).map_or(&[][..], |i| &i[..]) {
                    let visit = &mut |hair| hairs.push(hair);
                    sampler.sequence().indices_in(low, high, 0..count, visit);
                }
                hairs.sort_unstable();
                hairs
            }
            Hairs::Listed(listed) => {
                let all = listed.get(cell).map_or(&[][..], |hairs| &hairs[..]);
                let wanted = all.partition_point(|&hair| (hair as u64) < count);
                all[..wanted].iter().map(|&hair| hair as u64).collect()
            }
        }
    }
}

fn cells(resolution: [u32; 3]) -> usize {
    resolution.iter().map(|&n| n as usize).product()
}

/// The cell of each piece of `sampler`, in their order.
fn cells_of(
    sampler: &RootSampler,
    mesh: &Mesh,
    resolution: [u32; 3],
) -> impl Iterator<Item = usize> {
    let (low, high) = mesh.bounds();
    let centres = sampler
        .pieces()
        .iter()
        .map(move |(triangle, part)| part::centre(mesh, triangle, part));
    centres.map(move |centre| cell_of(centre, low, high, resolution))
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
    use crate::fixture::{sheet, spots};
    use crate::{Density, Wrap};
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        #[test]
        fn the_voxels_share_out_the_hairs_exactly(
            resolution in prop::array::uniform3(1u32..5), count in 0u64..3000, seed: u64,
        ) {
            let (mesh, map) = (sheet(5), spots());
            let density = Density { value: 1.0, map: Some((&map, 0, Wrap::Repeat)) };
            let sampler = RootSampler::new(&mesh, &density, seed).unwrap();
            let made = BlueNoise::new(&mesh, &sampler, 3000);
            for voxels in [
                VoxelRoots::new(&sampler, &mesh, resolution),
                VoxelRoots::of_blue_noise(&made, &sampler, &mesh, resolution),
            ] {
                let mut all: Vec<u64> =
                    (0..voxels.cells()).flat_map(|c| voxels.hairs(c, count)).collect();
                all.sort_unstable();
                prop_assert_eq!(all, (0..count).collect::<Vec<_>>());
            }
        }
    }
}
