//! The guides nearest to a root, fast.
//!
//! Space around the surface is cut into cells; for each cell that the surface passes
//! through, the plan keeps the few guides that can be among the nearest of *some*
//! point in it. A query then looks at a dozen candidates instead of walking a tree
//! (which stays as the tool that makes the lists). The answer does not depend on the
//! cells: every guide that can matter is in the list, and ties go to the guide of
//! smaller index.

use crate::lanes::{LANES, Vectors};
use fearless_simd::{Simd, SimdBase, SimdFloat, i32x16};
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use pelage_curves::Vec3;
use pelage_surface::Mesh;
use rayon::prelude::*;
use std::num::NonZeroUsize;

/// Most cells of a grid. More would shorten the lists of very many guides but cost
/// memory of their own (4 bytes a cell).
const MAX_CELLS: f64 = (1 << 22) as f64;

/// Candidates in a line of the cache.
const CANDIDATES_A_LINE: u32 = 16;

/// A guide near a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// Index of the guide in its group.
    pub guide: u32,
    /// Squared distance from the point to its root, at rest.
    pub square: f32,
}

impl Near {
    /// Guide and distance as one number, which orders by distance, then by index:
    /// the bits of floats that are not negative order as the floats do.
    #[inline(always)]
    fn key(guide: u32, square: f32) -> u64 {
        (square.to_bits() as u64) << 32 | guide as u64
    }

    /// What guides are ordered by: distance, then index.
    #[inline]
    pub(crate) fn order(&self) -> u64 {
        Self::key(self.guide, self.square)
    }

    #[inline(always)]
    fn of_key(key: u64) -> Self {
        Self {
            guide: key as u32,
            square: f32::from_bits((key >> 32) as u32),
        }
    }
}

/// Finds the nearest of a set of guide roots.
#[derive(Clone, Debug)]
pub struct Locator {
    nearest: usize,
    low: Vec3,
    cells_a_unit: f32,
    resolution: [u32; 3],
    /// For each cell, where its candidates start; one more entry than cells.
    starts: Vec<u32>,
    /// Guides that can be among the nearest of a point in a cell, ascending. Their roots stand by
    /// themselves: so the lists of all cells take a quarter of the memory and stay in cache,
    /// as the roots of some thousands of guides do anyway.
    candidates: Vec<u32>,
    roots: Vec<Vec3>,
    /// All guides, for points in cells that have no list.
    all: Vec<u32>,
}

impl Locator {
    /// Prepares queries for the `nearest` guides among `roots`, at points of `mesh`.
    /// Fewer roots than that give all of them.
    pub fn new(mesh: &Mesh, roots: Vec<Vec3>, nearest: usize) -> Self {
        let nearest = nearest.clamp(1, roots.len().max(1));
        let (low, high) = mesh.bounds();
        let side = cell_side(mesh, low, high, roots.len(), nearest);
        let cells = ((high - low) / side).map(|x| x.floor().max(0.0));
        let resolution = [cells.x as u32 + 1, cells.y as u32 + 1, cells.z as u32 + 1];
        let mut locator = Self {
            nearest,
            low,
            cells_a_unit: 1.0 / side,
            resolution,
            starts: Vec::new(),
            candidates: Vec::new(),
            all: (0..roots.len() as u32).collect(),
            roots,
        };
        locator.fill(mesh, side);
        locator
    }

    /// How many guides a query gives.
    pub fn nearest(&self) -> usize {
        self.nearest.min(self.all.len())
    }

    /// Where the list of the guides near each of `points`, which are on the surface, begins and
    /// ends.
    #[inline(always)]
    pub(crate) fn lists<S: Simd>(&self, simd: S, points: Vectors<S>) -> [[u32; 2]; LANES] {
        let mut cells = i32x16::splat(simd, 0);
        for k in [2, 1, 0] {
            let at = (points.0[k] - self.low[k]) * self.cells_a_unit;
            let last = self.resolution[k] as i32 - 1;
            let at: i32x16<S> = at.to_int();
            cells = cells * self.resolution[k] as i32 + at.max(0).min(last);
        }
        let mut lists = [[0; 2]; LANES];
        for (list, &cell) in lists.iter_mut().zip(cells.as_array()) {
            *list = self.list(cell as usize);
        }
        lists
    }

    /// Where the list of a cell begins and ends.
    #[inline(always)]
    fn list(&self, cell: usize) -> [u32; 2] {
        [self.starts[cell], self.starts[cell + 1]]
    }

    /// Every guide that can be among the nearest of a point with that list, ascending.
    #[inline(always)]
    pub(crate) fn candidates(&self, [start, end]: [u32; 2]) -> &[u32] {
        let list = &self.candidates[start as usize..end as usize];
        // Rounding may put a point into a cell the surface only touches, and distances
        // beyond the range of floats are in no list.
        match list.len() < self.nearest() {
            true => &self.all,
            false => list,
        }
    }

    /// Where guide number `guide` grows.
    #[inline(always)]
    pub(crate) fn root(&self, guide: u32) -> Vec3 {
        self.roots[guide as usize]
    }

    /// Reads the memory of a list, and gives something that depends on it.
    #[inline(always)]
    pub(crate) fn peek(&self, [start, end]: [u32; 2]) -> u32 {
        // Hardly a list has more than a line and a half.
        [start, start + CANDIDATES_A_LINE]
            .map(|at| self.candidates.get(at.min(end) as usize))
            .into_iter()
            .flatten()
            .fold(0, |read, guide| read ^ guide)
    }

    /// Puts the guides nearest to `point` into `found`, which is emptied first; nearest
    /// first.
    #[inline]
    pub fn query(&self, point: Vec3, found: &mut Vec<Near>) {
        found.clear();
        let (list, roots) = (
            self.candidates(self.list(self.cell(point))),
            &self.roots[..],
        );
        // A fixed number of slots lives in registers; those numbers are the usual ones.
        match self.nearest() {
            1 => nearest_of(list, roots, point, &mut [u64::MAX; 1], found),
            2 => nearest_of(list, roots, point, &mut [u64::MAX; 2], found),
            3 => nearest_of(list, roots, point, &mut [u64::MAX; 3], found),
            4 => nearest_of(list, roots, point, &mut [u64::MAX; 4], found),
            5 => nearest_of(list, roots, point, &mut [u64::MAX; 5], found),
            6 => nearest_of(list, roots, point, &mut [u64::MAX; 6], found),
            n => nearest_of_many(list, roots, point, n, found),
        }
    }

    fn cell(&self, point: Vec3) -> usize {
        let at = (point - self.low) * self.cells_a_unit;
        let [x, y, z]: [usize; 3] =
            std::array::from_fn(|k| (at[k] as u32).min(self.resolution[k] - 1) as usize);
        (z * self.resolution[1] as usize + y) * self.resolution[0] as usize + x
    }

    /// Lists the candidates of every cell that a triangle passes through.
    fn fill(&mut self, mesh: &Mesh, side: f32) {
        let touched = self.touched(mesh, side);
        let entries: Vec<[f32; 3]> = self.roots.iter().map(|root| root.to_array()).collect();
        let tree = ImmutableKdTree::new_from_slice(&entries).ok();
        let lists: Vec<Vec<u32>> = touched
            .par_iter()
            .map(|&cell| match &tree {
                Some(tree) => self.candidates_of(self.centre(cell, side), side, tree),
                None => Vec::new(),
            })
            .collect();
        let cells = self
            .resolution
            .iter()
            .map(|&n| n as usize)
            .product::<usize>();
        self.starts = vec![0; cells + 1];
        for (&cell, list) in touched.iter().zip(&lists) {
            self.starts[cell + 1] = list.len() as u32;
        }
        for cell in 0..cells {
            self.starts[cell + 1] += self.starts[cell];
        }
        self.candidates = lists.concat();
    }

    /// Every guide that can be among the nearest of a point within half a diagonal of
    /// `centre`: no farther than the last of the nearest of `centre` plus a diagonal.
    fn candidates_of(&self, centre: Vec3, side: f32, tree: &ImmutableKdTree<f32, 3>) -> Vec<u32> {
        let centre = centre.to_array();
        let nearest = NonZeroUsize::new(self.nearest).unwrap_or(NonZeroUsize::MIN);
        let last = tree
            .query(&centre)
            .nearest_n::<SquaredEuclidean<f32>>(nearest)
            .execute()
            .iter()
            .map(|n| n.distance)
            .fold(0.0, f32::max);
        // A little more than the bound, for the rounding of either side.
        let reach = (last.sqrt() + side * 3f32.sqrt()) * 1.0001;
        let within = tree
            .query(&centre)
            .within::<SquaredEuclidean<f32>>(reach * reach)
            .unsorted()
            .execute();
        let mut guides: Vec<u32> = within.iter().map(|n| n.item).collect();
        guides.sort_unstable();
        guides
    }

    fn centre(&self, cell: usize, side: f32) -> Vec3 {
        let [nx, ny] = [self.resolution[0] as usize, self.resolution[1] as usize];
        let at = [cell % nx, cell / nx % ny, cell / nx / ny].map(|i| i as f32 + 0.5);
        self.low + Vec3::from(at) * side
    }

    /// Cells that a triangle passes through, ascending; a few more than that, since a
    /// triangle is taken as the part of its box near its plane.
    fn touched(&self, mesh: &Mesh, side: f32) -> Vec<usize> {
        let mut touched = vec![false; self.resolution.iter().map(|&n| n as usize).product()];
        let reach = side * 3f32.sqrt() / 2.0 * 1.001;
        for t in 0..mesh.triangles().len() {
            let corners = mesh.corners(t);
            let [a, b, c] = corners;
            let normal = (b - a).cross(c - a).normalize_or_zero();
            let low = (a.min(b).min(c) - self.low) * self.cells_a_unit;
            let high = (a.max(b).max(c) - self.low) * self.cells_a_unit;
            let range = |k: usize| {
                let last = self.resolution[k] - 1;
                ((low[k] as u32).saturating_sub(1).min(last))..=((high[k] as u32 + 1).min(last))
            };
            for z in range(2) {
                for y in range(1) {
                    for x in range(0) {
                        let cell = ((z * self.resolution[1] + y) * self.resolution[0] + x) as usize;
                        let offset = (self.centre(cell, side) - a).dot(normal);
                        if offset.abs() <= reach {
                            touched[cell] = true;
                        }
                    }
                }
            }
        }
        touched
            .iter()
            .enumerate()
            .filter(|(_, t)| **t)
            .map(|(cell, _)| cell)
            .collect()
    }
}

/// Appends the guides of the least keys; `best` has a slot for each, filled with the
/// largest number. Every candidate passes all slots, so that nothing can be guessed
/// wrong: that is cheaper than leaving early.
#[inline(always)]
fn nearest_of(list: &[u32], roots: &[Vec3], point: Vec3, best: &mut [u64], found: &mut Vec<Near>) {
    for &guide in list {
        let mut key = Near::key(guide, roots[guide as usize].distance_squared(point));
        for slot in best.iter_mut() {
            (*slot, key) = ((*slot).min(key), (*slot).max(key));
        }
    }
    found.extend(best.iter().map(|&key| Near::of_key(key)));
}

/// The same for more than a few, `nearest`, by sorting.
fn nearest_of_many(
    list: &[u32],
    roots: &[Vec3],
    point: Vec3,
    nearest: usize,
    found: &mut Vec<Near>,
) {
    found.extend(list.iter().map(|&guide| Near {
        guide,
        square: roots[guide as usize].distance_squared(point),
    }));
    if nearest < found.len() {
        found.select_nth_unstable_by_key(nearest, Near::order);
        found.truncate(nearest);
    }
    found.sort_unstable_by_key(Near::order);
}

/// Half the mean distance between guides on the surface: a dozen candidates a cell.
/// Shorter lists would need more cells than they save. More than a few `nearest` have
/// long lists in any case: larger cells keep what all cells hold together small.
fn cell_side(mesh: &Mesh, low: Vec3, high: Vec3, guides: usize, nearest: usize) -> f32 {
    let area = mesh.surface_area();
    let size = (high - low)
        .as_dvec3()
        .max(pelage_curves::DVec3::splat(f64::MIN_POSITIVE));
    let long = (nearest as f64 / 8.0).max(1.0);
    let mut side = 0.5 * (area * long / guides.max(1) as f64).sqrt();
    // At least a 256th of the largest extent, so that a flat sheet stays flat.
    side = side.max(size.max_element() / 256.0);
    while (size / side + 1.0).element_product() > MAX_CELLS {
        side *= 1.25;
    }
    if side > 0.0 && side.is_finite() {
        side as f32
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pelage_surface::PolygonMesh;
    use proptest::prelude::*;

    /// An icosahedron-like bag of triangles around the origin.
    fn octahedron() -> Mesh {
        let positions = vec![
            [1., 0., 0.],
            [-1., 0., 0.],
            [0., 1., 0.],
            [0., -1., 0.],
            [0., 0., 1.],
            [0., 0., -1.],
        ];
        let faces = [
            [0, 2, 4],
            [2, 1, 4],
            [1, 3, 4],
            [3, 0, 4],
            [2, 0, 5],
            [1, 2, 5],
            [3, 1, 5],
            [0, 3, 5],
        ];
        Mesh::new(PolygonMesh {
            positions,
            face_sizes: vec![3; 8],
            corner_vertices: faces.concat(),
            ..Default::default()
        })
        .unwrap()
    }

    proptest! {
        #[test]
        fn the_cells_find_what_trying_every_guide_finds(
            guides in prop::collection::vec(prop::array::uniform3(-8i8..9), 1..60),
            triangle in 0usize..8,
            u in 0.0f32..1.0, v in 0.0f32..1.0,
            nearest in 1usize..20,
        ) {
            let mesh = octahedron();
            let roots: Vec<Vec3> = guides
                .iter()
                .map(|g| Vec3::new(g[0] as f32, g[1] as f32, g[2] as f32) / 8.0)
                .collect();
            let [a, b, c] = mesh.corners(triangle);
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let point = a * (1.0 - u - v) + b * u + c * v;
            let mut expected: Vec<Near> = roots
                .iter()
                .enumerate()
                .map(|(g, r)| Near { guide: g as u32, square: r.distance_squared(point) })
                .collect();
            expected.sort_by(|a, b| a.square.total_cmp(&b.square).then(a.guide.cmp(&b.guide)));
            let locator = Locator::new(&mesh, roots, nearest);
            expected.truncate(locator.nearest());
            let mut found = Vec::new();
            locator.query(point, &mut found);
            prop_assert_eq!(found, expected);
        }
    }
}
