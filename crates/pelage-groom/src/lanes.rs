//! Numbers and vectors of hairs side by side.
//!
//! Processors do with eight or sixteen numbers at once what they do with one. Along one
//! hair a stage seldom has as many to do, and often each waits for the one before; hairs do
//! not wait for each other. What is done is done lane by lane, so a hair has the same bits
//! whatever its neighbours and whatever the processor's vectors.

use pelage_curves::Vec3;
use pelage_surface::RootFrame;

/// Hairs side by side: two of the widest common vectors.
pub const LANES: usize = 16;

/// One number of each of the hairs that are side by side.
pub type Row = [f32; LANES];

/// One vector of each: all x, all y, all z.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rows(pub [Row; 3]);

impl Rows {
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

/// Root frames side by side.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Frames {
    position: Rows,
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

    /// Where the local point `local` of `lane` is in the space of its frame.
    #[inline(always)]
    pub(crate) fn place(&self, lane: usize, local: Vec3) -> Vec3 {
        let frame = RootFrame {
            position: self.position.get(lane),
            tangent: self.tangent.get(lane),
            binormal: self.binormal.get(lane),
            normal: self.normal.get(lane),
        };
        frame.position + frame.vector(local)
    }
}
