//! Roots that keep their distance, at every prefix.
//!
//! Poisson-disk sets in a hierarchy (McCool and Fiume 1992, "Hierarchical Poisson Disk
//! Sampling Distributions"): a *reach* shrinks in small steps, and at each of these
//! *levels* candidates are taken until none is farther than the reach from all roots. So
//! the first n roots keep a distance near the largest that n roots can keep, for every
//! n, and no level asks how many roots are wanted: more only append.
//!
//! Distances are Euclidean and at rest, scaled to the local density; places whose normals
//! differ by 90 degrees or more, as on the two sides of an ear, do not see each other.
//! On a sharper edge than that roots of both sides may meet.
//!
//! Candidates come in *stages*, each for twice as many roots as there are: one in each
//! of many equal parts of the mass (`pool`), along a curve that keeps neighbours near
//! (`ground`), so that nothing needs sorting and boxes over runs of them (`hierarchy`)
//! adapt to any density. Those that lie too near a root for the whole stage are left out
//! at once, the others go into clusters of 64 (`cluster`). A root taken shortens the
//! distances of all candidates around it, a cluster at a time, and a level takes what is
//! still far enough (`stage`), so no candidate looks for its neighbours.

mod cluster;
mod ground;
pub(crate) mod hierarchy;
mod keeper;
mod leaf;
mod pool;
mod stage;
#[cfg(test)]
mod tests;

use crate::{Mesh, RootSampler, SurfacePoint};
use ground::{Ground, Places};
use pelage_curves::Vec3;
use pool::Pool;
use stage::Stage;
use std::ops::Range;

/// Roots that the first stage wants.
const FIRST: u64 = 32;

/// Factor of the squared reach from level to level: 2^(-1/8). Before a level the smallest
/// distance is by its root below what it is after.
const STEP: f64 = 0.917_004_043_204_671_2;

/// A stage ends at the latest where the squared reach has fallen by this factor.
const FLOOR: f64 = 0.4;

/// Roots that keep their distance, in the order of the hairs.
///
/// Root `i` depends on the mesh, the density, the seed and `i` alone: it is the same for
/// every count above `i` and any number of threads. The first n roots are about 0.65 to
/// 0.7 of the distance apart that the densest packing of n has
/// ([`quality`](crate::quality)), scaled to the local density.
///
/// ```
/// # use pelage_surface::{BlueNoise, Density, Mesh, PolygonMesh, RootSampler};
/// # let mesh = Mesh::new(PolygonMesh {
/// #     positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
/// #     face_sizes: vec![3],
/// #     corner_vertices: vec![0, 1, 2],
/// #     ..Default::default()
/// # })?;
/// let sampler = RootSampler::new(&mesh, &Density { value: 1.0, map: None }, 0).unwrap();
/// let few = BlueNoise::new(&mesh, &sampler, 10);
/// let many = BlueNoise::new(&mesh, &sampler, 100);
/// assert_eq!(few.root(9), many.root(9));
/// # Ok::<(), pelage_surface::MeshError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct BlueNoise {
    roots: Vec<Root>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Root {
    piece: u32,
    triangle: u32,
    /// Of the triangle's second and third corner.
    weights: [f32; 2],
}

impl BlueNoise {
    /// The first `count` roots on `mesh` at rest, by the density and the seed of
    /// `sampler`, which was made of `mesh`.
    ///
    /// Takes 16 bytes a root, and while it works some 170 more.
    pub fn new(mesh: &Mesh, sampler: &RootSampler, count: u64) -> Self {
        Self {
            roots: roots(&Ground::new(mesh, sampler), count, sampler.seed()),
        }
    }

    /// Root of hair `index`.
    ///
    /// # Panics
    /// Where `index` is not less than [`len`](Self::len).
    #[inline]
    pub fn root(&self, index: u64) -> SurfacePoint {
        self.roots[index as usize].point()
    }

    /// Appends the roots of `hairs`, all of which must be less than [`len`](Self::len),
    /// to `roots`.
    pub fn roots(&self, hairs: Range<u64>, roots: &mut Vec<SurfacePoint>) {
        let own = &self.roots[hairs.start as usize..hairs.end as usize];
        roots.extend(own.iter().map(Root::point));
    }

    /// The piece of constant density that hair `index` grows on, as
    /// [`RootSampler::piece_centres`] lists them.
    #[inline]
    pub fn piece(&self, index: u64) -> u32 {
        self.roots[index as usize].piece
    }

    /// Number of roots.
    pub fn len(&self) -> usize {
        self.roots.len()
    }

    /// Whether there is no root.
    pub fn is_empty(&self) -> bool {
        self.roots.is_empty()
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.roots[..])
    }
}

impl Root {
    #[inline(always)]
    fn at(places: &Places, lane: usize) -> Self {
        Self {
            piece: places.piece[lane],
            triangle: places.triangle[lane],
            weights: [places.u[lane], places.v[lane]],
        }
    }

    #[inline(always)]
    fn point(&self) -> SurfacePoint {
        let [u, v] = self.weights;
        SurfacePoint {
            triangle: self.triangle,
            barycentric: [(1.0 - u - v).max(0.0), u, v],
        }
    }
}

/// A root on the curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed {
    /// Of the mass.
    fraction: u64,
    root: Root,
    /// On the surface of unit area.
    position: Vec3,
}

impl Placed {
    #[inline(always)]
    fn at(places: &Places, lane: usize, fraction: u64) -> Self {
        Self {
            fraction,
            root: Root::at(places, lane),
            position: Vec3::new(places.x[lane], places.y[lane], places.z[lane]),
        }
    }
}

fn roots(ground: &Ground, count: u64, seed: u64) -> Vec<Root> {
    let mut hairs = Vec::new();
    // The same roots along the curve.
    let mut along = Vec::new();
    let mut reach = ground.extent();
    while (hairs.len() as u64) < count {
        // From a quarter below a power of two on, the next: levels end where they end.
        let goal = (hairs.len() as u64 * 5 / 4).next_power_of_two().max(FIRST);
        let most = levels_of(hairs.len() as f64 / goal as f64);
        // Of the last level, which takes nothing that is nearer.
        let floor = (1..most).fold(reach, |reach, _| reach * STEP);
        let pool = Pool::new(ground, goal, seed);
        let (mut levels, mut reached) = (0, hairs.len() as u64);
        let taken = {
            let found = pool.clusters(&along, reach as f32, floor as f32);
            let mut stage = Stage::new(ground, &found, reach as f32);
            while reached < goal.min(count) && levels < most {
                reached += stage.level(reach as f32, (reach * STEP) as f32) as u64;
                reach *= STEP;
                levels += 1;
            }
            stage.taken()
        };
        let fractions: Vec<u64> = taken.iter().map(|t| pool.fraction(t.0)).collect();
        let placed = ground.rows(&fractions, Placed::at).concat();
        let mut by_level = vec![Vec::new(); levels];
        for ((_, level), placed) in taken.iter().zip(&placed) {
            by_level[*level].push(placed.root);
        }
        by_level.iter().for_each(|roots| spread(roots, &mut hairs));
        if reached < count {
            along = merged(&along, &placed);
        }
    }
    hairs.truncate(count as usize);
    hairs
}

/// Levels of a stage that begins with `share` of the roots it wants: a root keeps a part of
/// the squared distance that is to all as one to their number.
fn levels_of(share: f64) -> usize {
    let reaches = std::iter::successors(Some(1.0), |reach| Some(reach * STEP));
    reaches
        .take_while(|&reach| reach >= share.max(FLOOR))
        .count()
}

/// Appends all of `roots`, which lie along a curve, in an order of which every prefix is
/// well spread: van der Corput's.
fn spread(roots: &[Root], hairs: &mut Vec<Root>) {
    let bits = roots.len().next_power_of_two().trailing_zeros();
    let turned = |k: u64| k.reverse_bits().checked_shr(64 - bits).unwrap_or(0);
    let order = (0..1u64 << bits).map(turned);
    hairs.extend(order.filter_map(|i| roots.get(i as usize)));
}

/// Two lists along the curve as one.
fn merged(a: &[Placed], b: &[Placed]) -> Vec<Placed> {
    let mut all = Vec::with_capacity(a.len() + b.len());
    let mut a = a.iter().copied().peekable();
    for &y in b {
        while let Some(x) = a.next_if(|x| x.fraction <= y.fraction) {
            all.push(x);
        }
        all.push(y);
    }
    all.extend(a);
    all
}
