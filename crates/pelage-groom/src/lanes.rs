//! Numbers and vectors of hairs side by side.
//!
//! Processors do with eight or sixteen numbers at once what they do with one. Along one
//! hair a stage seldom has as many to do, and often each waits for the one before; hairs do
//! not wait for each other. What is done is done lane by lane, so a hair has the same bits
//! whatever its neighbours and whatever the processor's vectors.

use crate::stages::weights::Axes;
use fearless_simd::{Bytes, Simd, SimdBase, SimdSplit, f32x4, f32x8, f32x16, f64x4};
use pelage_curves::Vec3;
use pelage_surface::RootFrame;
use std::ops::{Add, Mul};

/// Hairs side by side: two of the widest common vectors.
pub const LANES: usize = 16;

/// One number of each of the hairs that are side by side.
pub type Row = [f32; LANES];

/// A [`Row`] in the registers of processors with the instructions `S`.
pub(crate) type Number<S> = f32x16<S>;

/// [`Rows`] in registers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vectors<S: Simd>(pub [Number<S>; 3]);

impl<S: Simd> Vectors<S> {
    /// The same, to be kept in memory.
    #[inline(always)]
    pub(crate) fn rows(self) -> Rows {
        Rows(self.0.map(|number| number.to_array()))
    }
}

impl<S: Simd> Add for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a + x, b + y, c + z])
    }
}

/// Part by part.
impl<S: Simd> Mul for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a * x, b * y, c * z])
    }
}

impl<S: Simd> Mul<Number<S>> for Vectors<S> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: Number<S>) -> Self {
        Self(self.0.map(|part| part * factor))
    }
}

/// One vector of each: all x, all y, all z.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rows(pub [Row; 3]);

impl Rows {
    /// The same in registers.
    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, simd: S) -> Vectors<S> {
        Vectors([0, 1, 2].map(|k| Number::load_array_ref(simd, &self.0[k])))
    }

    /// The vectors of the first [`HALF`] of the lanes, and those of the others.
    #[inline(always)]
    pub(crate) fn halves<S: Simd>(&self, simd: S) -> [[Vec3; HALF]; 2] {
        let [x, y, z] = self.load(simd).0;
        let ((x, u), (y, v), (z, w)) = (x.split(), y.split(), z.split());
        [vectors([x, y, z]), vectors([u, v, w])]
    }

    /// The vector in `lane`.
    #[inline(always)]
    pub fn get(&self, lane: usize) -> Vec3 {
        Vec3::new(self.0[0][lane], self.0[1][lane], self.0[2][lane])
    }

    /// Puts a vector into `lane`.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, vector: Vec3) {
        for (row, x) in self.0.iter_mut().zip(vector.to_array()) {
            row[lane] = x;
        }
    }

    /// A vector of each of the things that are side by side, [`LANES`] at most; zero in the
    /// lanes behind them.
    #[inline(always)]
    pub fn of<T>(things: &[T], vector: impl Fn(&T) -> Vec3) -> Self {
        let mut rows = Self::default();
        for (lane, one) in things.iter().enumerate() {
            rows.set(lane, vector(one));
        }
        rows
    }

    /// The vectors that `vector` makes of each lane.
    #[inline(always)]
    pub fn from_fn(vector: impl Fn(usize) -> Vec3) -> Self {
        let mut rows = Self::default();
        for lane in 0..LANES {
            rows.set(lane, vector(lane));
        }
        rows
    }
}

/// Four rows of eight numbers turned: the first of each, their seconds, and so on.
#[inline(always)]
pub(crate) fn turned<S: Simd>([a, b, c, d]: [f32x8<S>; 4]) -> [f32x4<S>; 8] {
    // In pairs, and pairs of those; a pair is moved as one number of twice the size.
    let (low, high) = ((a.zip_low(b), c.zip_low(d)), (a.zip_high(b), c.zip_high(d)));
    let (low, high) = (pairs(low.0, low.1), pairs(high.0, high.1));
    let ((a, b), (c, d)) = (low[0].split(), low[1].split());
    let ((e, f), (g, h)) = (high[0].split(), high[1].split());
    [a, b, c, d, e, f, g, h]
}

#[inline(always)]
fn pairs<S: Simd>(a: f32x8<S>, b: f32x8<S>) -> [f32x8<S>; 2] {
    let (a, b): (f64x4<S>, f64x4<S>) = (a.bitcast(), b.bitcast());
    [a.zip_low(b).bitcast(), a.zip_high(b).bitcast()]
}

/// Half the [`LANES`].
pub(crate) const HALF: usize = LANES / 2;

/// Vectors of all x, all y and all z.
#[inline(always)]
fn vectors<S: Simd>([x, y, z]: [f32x8<S>; 3]) -> [Vec3; HALF] {
    let mut vectors = [Vec3::ZERO; HALF];
    for (vector, parts) in vectors.iter_mut().zip(turned([x, y, z, z])) {
        *vector = Vec3::new(parts[0], parts[1], parts[2]);
    }
    vectors
}

/// Root frames side by side.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Frames {
    pub position: Rows,
    tangent: Rows,
    binormal: Rows,
    normal: Rows,
}

impl Frames {
    /// The frames of a block, [`LANES`] at most.
    #[inline(always)]
    pub(crate) fn of(frames: &[RootFrame]) -> Self {
        Self {
            position: Rows::of(frames, |frame| frame.position),
            tangent: Rows::of(frames, |frame| frame.tangent),
            binormal: Rows::of(frames, |frame| frame.binormal),
            normal: Rows::of(frames, |frame| frame.normal),
        }
    }

    /// Their axes in registers.
    #[inline(always)]
    pub(crate) fn axes<S: Simd>(&self, simd: S) -> Axes<Number<S>> {
        Axes {
            tangent: self.tangent.load(simd).0,
            binormal: self.binormal.load(simd).0,
            normal: self.normal.load(simd).0,
        }
    }

    /// Where local points are in the space of their frames.
    #[inline(always)]
    pub(crate) fn place<S: Simd>(&self, simd: S, local: Vectors<S>) -> Vectors<S> {
        let [x, y, z] = local.0;
        let across = self.tangent.load(simd) * x + self.binormal.load(simd) * y;
        self.position.load(simd) + (across + self.normal.load(simd) * z)
    }
}
