//! The Catmull-Rom curve through points, in f64, with its derivatives.

use super::{FrenetError, SpaceCurve};
use glam::DVec3;

/// The curve through its vertices, its ends duplicated
/// ([`catmull_rom`](crate::catmull_rom) has the rule).
#[derive(Clone, Copy, Debug)]
pub struct CatmullRom<'a>(&'a [DVec3]);

impl<'a> CatmullRom<'a> {
    /// The curve through `points`: a single one is a curve without length.
    ///
    /// # Errors
    ///
    /// [`FrenetError::Empty`] for no points, [`FrenetError::NotFinite`] for one that is
    /// not.
    pub fn new(points: &'a [DVec3]) -> Result<Self, FrenetError> {
        if points.is_empty() {
            return Err(FrenetError::Empty);
        }
        match points.iter().position(|p| !p.is_finite()) {
            Some(index) => Err(FrenetError::NotFinite { index }),
            None => Ok(Self(points)),
        }
    }
}

impl SpaceCurve for CatmullRom<'_> {
    fn pieces(&self) -> usize {
        (self.0.len() - 1).max(1)
    }

    fn at(&self, piece: usize, t: f64) -> [DVec3; 3] {
        let last = self.0.len() - 1;
        let point = |i: usize| self.0[i.min(last)];
        let (a, b) = (point(piece.saturating_sub(1)), point(piece));
        let (c, d) = (point(piece + 1), point(piece + 2));
        let linear = (c - a) * 0.5;
        let square = a - b * 2.5 + c * 2.0 - d * 0.5;
        let cube = (d - a) * 0.5 + (b - c) * 1.5;
        [
            b + (linear + (square + cube * t) * t) * t,
            linear + (square * 2.0 + cube * (3.0 * t)) * t,
            square * 2.0 + cube * (6.0 * t),
        ]
    }
}
