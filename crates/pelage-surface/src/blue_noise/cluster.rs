//! Candidates that lie together, so that a root pushes many of them at once.

use super::ground::{Ground, LANES, Places, Site};
use super::hierarchy::Bounds;
use pelage_curves::Vec3;

/// How far the candidates of a cluster are from the nearest root: squared, scaled.
#[derive(Clone, Copy)]
pub(crate) struct Near {
    /// [`TAKEN`] for roots and for lanes without a candidate.
    pub distance: [f32; LANES],
    /// The largest, when they were last looked at.
    pub most: f32,
}

impl Near {
    /// All candidates are as far as `distance`.
    pub(crate) const fn all(distance: f32) -> Self {
        Self {
            distance: [distance; LANES],
            most: f32::INFINITY,
        }
    }

    /// The lane farthest from all roots; notes its distance.
    #[inline(always)]
    pub(crate) fn farthest(&mut self) -> usize {
        self.most = most(&self.distance);
        let most = self.most;
        // Sixteen at once, then one of sixteen.
        let holds = |row: &[f32]| row.iter().fold(false, |any, &d| any | (d == most));
        let row = self.distance.chunks_exact(16).position(holds).unwrap_or(0);
        let place = self.distance[16 * row..].iter().position(|&d| d == most);
        16 * row + place.unwrap_or(0)
    }
}

/// Nearer than any reach.
pub(crate) const TAKEN: f32 = -1.0;

/// Up to [`LANES`] candidates that follow each other along the curve.
#[derive(Clone)]
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

    /// The candidates learn of a root at `site`.
    #[inline(always)]
    pub(crate) fn push(&self, near: &mut Near, site: &Site, normals: &[Vec3]) {
        let seen = self.facing.sees(site.normal);
        if seen == Some(false) {
            return;
        }
        let mut distance = self.distances(site);
        if seen.is_none() {
            for (distance, &triangle) in distance.iter_mut().zip(&self.triangle) {
                if normals[triangle as usize].dot(site.normal) <= 0.0 {
                    *distance = f32::INFINITY;
                }
            }
        }
        for (near, distance) in near.distance.iter_mut().zip(distance) {
            *near = if distance < *near { distance } else { *near };
        }
    }

    #[inline(always)]
    fn distances(&self, site: &Site) -> [f32; LANES] {
        let mut distances = [0.0; LANES];
        let [px, py, pz] = site.position.to_array();
        for (k, distance) in distances.iter_mut().enumerate() {
            let (x, y, z) = (self.x[k] - px, self.y[k] - py, self.z[k] - pz);
            *distance = (x * x + y * y + z * z) * (self.closeness[k] * site.closeness);
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
