//! A solid's surface as quads: naive surface nets.
//!
//! Gibson, "Constrained elastic surface nets" (1998), without the constraint:
//! one vertex a grid cell the surface passes, one quad a grid edge it crosses.
//! The quads are closed by construction; they are manifold where no cell holds
//! two sheets, which a grid finer than the thinnest part ensures (and a test of
//! each shape proves).

use crate::sdf::Solid;
use glam::DVec3;
use rayon::prelude::*;

/// Quads that share vertices, seen anticlockwise from outside.
#[derive(Clone, Debug, Default)]
pub struct Quads {
    /// Vertex positions.
    pub positions: Vec<DVec3>,
    /// Four vertices a quad.
    pub quads: Vec<[u32; 4]>,
}

/// Signed distances at the points of a regular grid.
struct Grid {
    low: DVec3,
    step: f64,
    size: [usize; 3],
    values: Vec<f64>,
}

impl Grid {
    fn index(&self, x: usize, y: usize, z: usize) -> usize {
        (z * self.size[1] + y) * self.size[0] + x
    }

    fn point(&self, x: usize, y: usize, z: usize) -> DVec3 {
        self.low + DVec3::new(x as f64, y as f64, z as f64) * self.step
    }
}

/// Samples blocks of this many points a side; far blocks cost one evaluation.
const BLOCK: usize = 4;

fn sample<P: Copy + PartialEq + Sync>(
    solid: &Solid<P>,
    low: DVec3,
    high: DVec3,
    step: f64,
) -> Grid {
    let cells = ((high - low) / step).ceil();
    let size = [cells.x, cells.y, cells.z].map(|n| n as usize + 1);
    let mut grid = Grid {
        low,
        step,
        size,
        values: vec![0.0; size[0] * size[1] * size[2]],
    };
    // Bounds may overestimate distance a little, hence the factor.
    let far = 2.0 * step * BLOCK as f64 * 0.87;
    let slab = size[0] * size[1] * BLOCK;
    let mut values = std::mem::take(&mut grid.values);
    values
        .par_chunks_mut(slab)
        .enumerate()
        .for_each(|(k, out)| {
            let z0 = k * BLOCK;
            let depth = out.len() / (size[0] * size[1]);
            for y0 in (0..size[1]).step_by(BLOCK) {
                for x0 in (0..size[0]).step_by(BLOCK) {
                    let middle = (BLOCK - 1) as f64 * 0.5 * step;
                    let d = solid.distance(grid.point(x0, y0, z0) + DVec3::splat(middle));
                    for z in 0..depth {
                        for y in y0..(y0 + BLOCK).min(size[1]) {
                            for x in x0..(x0 + BLOCK).min(size[0]) {
                                out[(z * size[1] + y) * size[0] + x] = if d.abs() > far {
                                    d
                                } else {
                                    solid.distance(grid.point(x, y, z0 + z))
                                };
                            }
                        }
                    }
                }
            }
        });
    grid.values = values;
    grid
}

/// Quads over the surface of `solid` between `low` and `high`, cells of `step`.
/// The solid has to lie inside the box with a cell to spare.
pub fn surface_nets<P: Copy + PartialEq + Sync>(
    solid: &Solid<P>,
    low: DVec3,
    high: DVec3,
    step: f64,
) -> Quads {
    let grid = sample(solid, low, high, step);
    let mut out = Quads::default();
    let mut vertex_of = vec![u32::MAX; grid.values.len()];
    let [nx, ny, nz] = grid.size;
    for z in 0..nz - 1 {
        for y in 0..ny - 1 {
            for x in 0..nx - 1 {
                if let Some(p) = cell_vertex(&grid, x, y, z) {
                    vertex_of[grid.index(x, y, z)] = out.positions.len() as u32;
                    out.positions.push(p);
                }
            }
        }
    }
    for z in 1..nz - 1 {
        for y in 1..ny - 1 {
            for x in 1..nx - 1 {
                cross_edges(&grid, &vertex_of, [x, y, z], &mut out.quads);
            }
        }
    }
    out
}

/// The mean of where the surface crosses the twelve edges of a cell.
fn cell_vertex(grid: &Grid, x: usize, y: usize, z: usize) -> Option<DVec3> {
    let corner = |c: usize| (x + (c & 1), y + (c >> 1 & 1), z + (c >> 2));
    let value = |c: usize| {
        let (x, y, z) = corner(c);
        grid.values[grid.index(x, y, z)]
    };
    let (mut sum, mut count) = (DVec3::ZERO, 0);
    for a in 0..8usize {
        for axis in [1usize, 2, 4] {
            let b = a | axis;
            let (va, vb) = (value(a), value(b));
            if a & axis != 0 || (va < 0.0) == (vb < 0.0) {
                continue;
            }
            let at = |c: usize| {
                let (x, y, z) = corner(c);
                grid.point(x, y, z)
            };
            sum += at(a).lerp(at(b), va / (va - vb));
            count += 1;
        }
    }
    (count > 0).then(|| sum / count as f64)
}

/// The quads around the three edges that leave a grid point upwards.
fn cross_edges(grid: &Grid, vertex_of: &[u32], at: [usize; 3], quads: &mut Vec<[u32; 4]>) {
    let value = |p: [usize; 3]| grid.values[grid.index(p[0], p[1], p[2])];
    let inside = value(at) < 0.0;
    for axis in 0..3 {
        let mut next = at;
        next[axis] += 1;
        if inside == (value(next) < 0.0) {
            continue;
        }
        let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
        let cell = |db: usize, dc: usize| {
            let mut p = at;
            p[b] -= db;
            p[c] -= dc;
            vertex_of[grid.index(p[0], p[1], p[2])]
        };
        let ring = [cell(1, 1), cell(0, 1), cell(0, 0), cell(1, 0)];
        quads.push(if inside {
            ring
        } else {
            [ring[3], ring[2], ring[1], ring[0]]
        });
    }
}
