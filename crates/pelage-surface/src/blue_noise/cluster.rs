//! Candidates that lie together, so that a root pushes many of them at once.

use super::ground::{Ground, LANES, Places, ROW, Site};
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

impl Near {
    pub(crate) const TAKEN: Near = Near([TAKEN; LANES]);
}

/// The same in registers.
#[derive(Clone, Copy)]
pub(crate) struct Distances<S: Simd> {
    simd: S,
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

/// Up to [`LANES`] candidates that follow each other along the curve.
#[derive(Clone)]
#[repr(align(64))]
pub(crate) struct Cluster {
    x: [f32; LANES],
    y: [f32; LANES],
    z: [f32; LANES],
    closeness: [f32; LANES],
    triangle: [u32; LANES],
    /// Number of each candidate in the pool, from `first` on.
    offset: [u16; LANES],
    first: u64,
    facing: Facing,
    pub bounds: Bounds,
}

impl Cluster {
    /// Without candidates yet; they will have numbers from `first` on.
    pub(crate) const fn new(first: u64) -> Self {
        Self {
            x: [0.0; LANES],
            y: [0.0; LANES],
            z: [0.0; LANES],
            closeness: [0.0; LANES],
            triangle: [0; LANES],
            offset: [0; LANES],
            first,
            facing: Facing::ALL,
            bounds: Bounds::EMPTY,
        }
    }

    /// Takes the candidates at `places`, the first of which has the number `offset` from
    /// the first number on.
    #[inline(always)]
    pub(crate) fn draw(&mut self, places: &Places, offset: u16, ground: &Ground) {
        self.x.copy_from_slice(&places.x[..LANES]);
        self.y.copy_from_slice(&places.y[..LANES]);
        self.z.copy_from_slice(&places.z[..LANES]);
        self.triangle.copy_from_slice(&places.triangle[..LANES]);
        self.closeness.copy_from_slice(&places.closeness[..LANES]);
        for lane in 0..LANES {
            self.offset[lane] = offset + lane as u16;
        }
        self.close(LANES, ground);
    }

    /// Copies a candidate of another cluster with the same `first`.
    #[inline(always)]
    pub(crate) fn copy(&mut self, lane: usize, other: &Cluster, from: usize) {
        self.x[lane] = other.x[from];
        self.y[lane] = other.y[from];
        self.z[lane] = other.z[from];
        self.closeness[lane] = other.closeness[from];
        self.triangle[lane] = other.triangle[from];
        self.offset[lane] = other.offset[from];
    }

    #[inline(always)]
    pub(crate) fn site(&self, lane: usize, normals: &[Vec3]) -> Site {
        Site {
            position: Vec3::new(self.x[lane], self.y[lane], self.z[lane]),
            closeness: self.closeness[lane],
            normal: normals[self.triangle[lane] as usize],
        }
    }

    /// Number of a candidate in its pool.
    #[inline(always)]
    pub(crate) fn number(&self, lane: usize) -> u64 {
        self.first + self.offset[lane] as u64
    }

    /// Takes the first `len` lanes as all there are, and measures them.
    #[inline(always)]
    pub(crate) fn close(&mut self, len: usize, ground: &Ground) {
        // Lanes without a candidate repeat one, so that they need no test of their own.
        for lane in len..LANES {
            self.x[lane] = self.x[0];
            self.y[lane] = self.y[0];
            self.z[lane] = self.z[0];
            self.closeness[lane] = self.closeness[0];
            self.triangle[lane] = self.triangle[0];
        }
        self.bounds = Bounds {
            low: Vec3::new(least(&self.x), least(&self.y), least(&self.z)),
            high: Vec3::new(most(&self.x), most(&self.y), most(&self.z)),
            least: least(&self.closeness),
        };
        self.facing = Facing::of(&self.triangle, ground.normals());
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
        let mut close = roots.near(near.simd, &self.bounds, reach);
        while close != 0 {
            let site = roots.site(close.trailing_zeros() as usize % LEAF);
            self.push(near, &site, normals);
            close &= close - 1;
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
        let (simd, triangles) = (near.simd, self.triangle.as_chunks::<ROW>().0);
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
            rows(simd, &self.x),
            rows(simd, &self.y),
            rows(simd, &self.z),
        );
        let mut distances = rows(simd, &self.closeness);
        for (k, distance) in distances.iter_mut().enumerate() {
            let (x, y, z) = (xs[k] - px, ys[k] - py, zs[k] - pz);
            *distance = (x * x + y * y + z * z) * (*distance * site.closeness);
        }
        distances
    }
}

#[inline(always)]
fn least(values: &[f32; LANES]) -> f32 {
    fold(values, |a, b| if b < a { b } else { a })
}

#[inline(always)]
fn most(values: &[f32; LANES]) -> f32 {
    fold(values, |a, b| if b > a { b } else { a })
}

/// Folds many lanes at once.
#[inline(always)]
fn fold(values: &[f32; LANES], with: impl Fn(f32, f32) -> f32) -> f32 {
    let mut sides = [0.0; 16];
    sides.copy_from_slice(&values[..16]);
    for row in values[16..].chunks_exact(16) {
        for (side, &value) in sides.iter_mut().zip(row) {
            *side = with(*side, value);
        }
    }
    // Half with half, since one after the other would each wait for the last.
    for half in [8, 4, 2, 1] {
        for k in 0..half {
            sides[k] = with(sides[k], sides[k + half]);
        }
    }
    sides[0]
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

    fn of(triangles: &[u32], normals: &[Vec3]) -> Self {
        let runs = || triangles.chunk_by(|a, b| a == b);
        let sum = runs().fold(Vec3::ZERO, |sum, run| sum + normals[run[0] as usize]);
        let Some(axis) = sum.try_normalize() else {
            return Self::ALL;
        };
        let cosine = runs()
            .map(|run| normals[run[0] as usize].dot(axis))
            .fold(1.0, f32::min);
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
