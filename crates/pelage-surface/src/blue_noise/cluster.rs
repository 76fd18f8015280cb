//! Candidates that lie together, so that a root pushes many of them at once.

use super::ground::{Ground, LANES, ROW, Site};
use super::hierarchy::Bounds;
use super::leaf::{LEAF, Leaf};
use fearless_simd::{Select, Simd, SimdBase, SimdMask, f32x16, mask32x16};
use pelage_curves::Vec3;

/// Nearer than any reach.
pub(crate) const TAKEN: f32 = -1.0;

/// How far the candidates of a cluster are from the nearest root, squared and scaled:
/// [`TAKEN`] for roots and for lanes without a candidate.
///
/// Aligned to cache lines, as all that is read in whole registers here: what lies across two
/// lines takes twice as long, and can not be read right after it was written.
#[derive(Clone, Copy)]
#[repr(align(64))]
pub(crate) struct Near(pub [f32; LANES]);

/// The same in registers.
#[derive(Clone, Copy)]
pub(crate) struct Distances<S: Simd> {
    pub simd: S,
    rows: [f32x16<S>; LANES / ROW],
}

impl<S: Simd> Distances<S> {
    /// All candidates are as far as `distance`.
    #[inline(always)]
    pub(crate) fn all(simd: S, distance: f32) -> Self {
        let rows = [f32x16::splat(simd, distance); LANES / ROW];
        Self { simd, rows }
    }

    #[inline(always)]
    pub(crate) fn load(simd: S, near: &Near) -> Self {
        let rows = rows(simd, &near.0);
        Self { simd, rows }
    }

    /// The distances of one row of lanes.
    #[inline(always)]
    pub(crate) fn row(&self, row: usize) -> f32x16<S> {
        self.rows[row]
    }

    #[inline(always)]
    pub(crate) fn store(&self, near: &mut Near) {
        for (to, row) in near.0.as_chunks_mut().0.iter_mut().zip(&self.rows) {
            row.store_array(to);
        }
    }

    /// The largest.
    #[inline(always)]
    pub(crate) fn most(&self) -> f32 {
        let [a, b, c, d] = self.rows;
        a.max(b).max(c.max(d)).reduce_max()
    }

    /// The first lane that has `distance`.
    #[inline(always)]
    pub(crate) fn lane_of(&self, distance: f32) -> usize {
        let mut lanes = 0;
        for (k, row) in self.rows.iter().enumerate() {
            lanes |= row.simd_eq(distance).to_bitmask() << (ROW * k);
        }
        lanes.trailing_zeros() as usize % LANES
    }

    /// Makes `lane` [`TAKEN`].
    #[inline(always)]
    pub(crate) fn take(&mut self, lane: usize) {
        for (k, row) in self.rows.iter_mut().enumerate() {
            let taken = mask32x16::from_bitmask(self.simd, (1 << lane) >> (ROW * k) & 0xffff);
            *row = taken.select(f32x16::splat(self.simd, TAKEN), *row);
        }
    }
}

/// The lanes of a cluster, a row each.
#[inline(always)]
fn rows<S: Simd>(simd: S, values: &[f32; LANES]) -> [f32x16<S>; LANES / ROW] {
    let mut rows = [f32x16::splat(simd, 0.0); LANES / ROW];
    for (row, values) in rows.iter_mut().zip(values.as_chunks().0) {
        *row = f32x16::load_array_ref(simd, values);
    }
    rows
}

/// Up to [`LANES`] candidates that follow each other along the curve. Lanes without a
/// candidate repeat one, so that they need no test of their own.
#[derive(Clone)]
#[repr(align(64))]
pub(crate) struct Columns {
    pub x: [f32; LANES],
    pub y: [f32; LANES],
    pub z: [f32; LANES],
    pub closeness: [f32; LANES],
    pub triangle: [u32; LANES],
    /// Number of each candidate in the pool, from the first of its cluster on.
    pub offset: [u16; LANES],
}

/// Candidates, and what they have in common.
#[derive(Clone)]
pub(crate) struct Cluster {
    columns: Columns,
    first: u64,
    facing: Facing,
    pub bounds: Bounds,
}

impl Cluster {
    /// Candidates whose numbers count from `first` on.
    #[inline(always)]
    pub(crate) fn new<S: Simd>(simd: S, columns: Columns, first: u64, ground: &Ground) -> Self {
        let Columns { x, y, z, .. } = &columns;
        Self {
            bounds: Bounds {
                low: Vec3::new(least(simd, x), least(simd, y), least(simd, z)),
                high: Vec3::new(most(simd, x), most(simd, y), most(simd, z)),
                least: least(simd, &columns.closeness),
            },
            facing: Facing::of(&columns.triangle, ground.normals()),
            columns,
            first,
        }
    }

    pub(crate) fn columns(&self) -> &Columns {
        &self.columns
    }

    #[inline(always)]
    pub(crate) fn site(&self, lane: usize, normals: &[Vec3]) -> Site {
        Site {
            position: Vec3::new(
                self.columns.x[lane],
                self.columns.y[lane],
                self.columns.z[lane],
            ),
            closeness: self.columns.closeness[lane],
            normal: normals[self.columns.triangle[lane] as usize],
        }
    }

    /// Number of a candidate in its pool.
    #[inline(always)]
    pub(crate) fn number(&self, lane: usize) -> u64 {
        self.first + self.columns.offset[lane] as u64
    }

    /// The candidates learn of those of `roots` that may be within `reach`.
    #[inline(always)]
    pub(crate) fn learn<S: Simd>(
        &self,
        near: &mut Distances<S>,
        roots: &Leaf,
        reach: f32,
        normals: &[Vec3],
    ) {
        for root in bits(roots.near(near.simd, &self.bounds, reach)) {
            self.push(near, &roots.site(root % LEAF), normals);
        }
    }

    /// The candidates learn of a root at `site`.
    #[inline(always)]
    pub(crate) fn push<S: Simd>(&self, near: &mut Distances<S>, site: &Site, normals: &[Vec3]) {
        match self.facing.sees(site.normal) {
            Some(true) => {
                let distances = self.distances(near.simd, site);
                for (near, distance) in near.rows.iter_mut().zip(&distances) {
                    *near = distance.min(*near);
                }
            }
            Some(false) => {}
            None => self.push_seen(near, site, normals),
        }
    }

    /// The same where only some candidates may see the root.
    #[inline(always)]
    fn push_seen<S: Simd>(&self, near: &mut Distances<S>, site: &Site, normals: &[Vec3]) {
        let (simd, triangles) = (near.simd, self.columns.triangle.as_chunks::<ROW>().0);
        let distances = self.distances(simd, site);
        for (row, (near, distance)) in near.rows.iter_mut().zip(&distances).enumerate() {
            let sees = |k: usize| normals[triangles[row][k] as usize].dot(site.normal) > 0.0;
            let seen = (0..ROW).fold(0, |seen, k| seen | (sees(k) as u64) << k);
            let seen = mask32x16::from_bitmask(simd, seen);
            *near = seen.select(distance.min(*near), *near);
        }
    }

    #[inline(always)]
    fn distances<S: Simd>(&self, simd: S, site: &Site) -> [f32x16<S>; LANES / ROW] {
        let [px, py, pz] = site.position.to_array();
        let (xs, ys, zs) = (
            rows(simd, &self.columns.x),
            rows(simd, &self.columns.y),
            rows(simd, &self.columns.z),
        );
        let mut distances = rows(simd, &self.columns.closeness);
        for (k, distance) in distances.iter_mut().enumerate() {
            let (x, y, z) = (xs[k] - px, ys[k] - py, zs[k] - pz);
            *distance = (x * x + y * y + z * z) * (*distance * site.closeness);
        }
        distances
    }
}

#[inline(always)]
fn least<S: Simd>(simd: S, values: &[f32; LANES]) -> f32 {
    let [a, b, c, d] = rows(simd, values);
    a.min(b).min(c.min(d)).reduce_min()
}

#[inline(always)]
fn most<S: Simd>(simd: S, values: &[f32; LANES]) -> f32 {
    let [a, b, c, d] = rows(simd, values);
    a.max(b).max(c.max(d)).reduce_max()
}

/// The numbers of the bits that are set, ascending.
#[inline(always)]
pub(crate) fn bits(mut word: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = word.trailing_zeros() as usize;
        word &= word.wrapping_sub(1);
        (bit < 64).then_some(bit)
    })
}

/// Where the normals of a cluster point: a cone.
#[derive(Clone, Copy, Debug)]
struct Facing {
    axis: Vec3,
    /// Sine of the angle between the axis and the sides; more than 1 where they may
    /// point anywhere.
    sine: f32,
}

impl Facing {
    const ALL: Facing = Facing {
        axis: Vec3::Z,
        sine: 2.0,
    };

    #[inline(always)]
    fn of(triangles: &[u32; LANES], normals: &[Vec3]) -> Self {
        // Bits where runs of one triangle begin.
        let mut begins = 1;
        for lane in 1..LANES {
            begins |= ((triangles[lane] != triangles[lane - 1]) as u64) << lane;
        }
        let runs = || bits(begins).map(|lane| normals[triangles[lane % LANES] as usize]);
        let sum = runs().fold(Vec3::ZERO, |sum, normal| sum + normal);
        let Some(axis) = sum.try_normalize() else {
            return Self::ALL;
        };
        let cosine = runs().fold(1.0, |least: f32, normal| least.min(normal.dot(axis)));
        // Some more than the sine, so that rounding never decides.
        match cosine > 0.0 {
            true => Self {
                axis,
                sine: (1.0 - cosine * cosine).max(0.0).sqrt() + 1e-3,
            },
            false => Self::ALL,
        }
    }

    /// Whether `normal` is within 90 degrees of all normals, of none, or of some.
    #[inline(always)]
    fn sees(&self, normal: Vec3) -> Option<bool> {
        let cosine = self.axis.dot(normal);
        match cosine.abs() > self.sine {
            true => Some(cosine > 0.0),
            false => None,
        }
    }
}
