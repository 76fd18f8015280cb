//! A borrowed curve: vertices, basis and wrap, evaluated segment by segment.

use crate::{ArcLength, Basis, Wrap};
use glam::Vec3;

/// Why a slice of vertices is no curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{vertices} vertices make no {basis:?} curve with {wrap:?} ends")]
pub struct CurveError {
    /// Number of vertices given.
    pub vertices: usize,
    /// Basis asked for.
    pub basis: Basis,
    /// Ends asked for.
    pub wrap: Wrap,
}

/// A curve over borrowed control vertices.
#[derive(Clone, Copy, Debug)]
pub struct Curve<'a> {
    points: &'a [Vec3],
    basis: Basis,
    wrap: Wrap,
    segments: usize,
}

impl<'a> Curve<'a> {
    /// Reads `points` as a curve; fails where their number does not suit the
    /// basis and the ends (see [`Basis::segments`]).
    pub fn new(points: &'a [Vec3], basis: Basis, wrap: Wrap) -> Result<Self, CurveError> {
        match basis.segments(points.len(), wrap) {
            Some(segments) => Ok(Self {
                points,
                basis,
                wrap,
                segments,
            }),
            None => Err(CurveError {
                vertices: points.len(),
                basis,
                wrap,
            }),
        }
    }

    /// Number of polynomial pieces, at least 1.
    pub fn segments(&self) -> usize {
        self.segments
    }

    /// The four control vertices of piece `segment` in its own basis (the first
    /// two only, for linear curves).
    fn controls(&self, segment: usize) -> [Vec3; 4] {
        let n = self.points.len() as isize;
        // How far the window of this basis starts before the segment's own vertex.
        let lead = match (self.basis, self.wrap) {
            (Basis::BSpline, Wrap::Pinned) => 2,
            (Basis::CatmullRom, Wrap::Pinned) => 1,
            (Basis::CatmullRom | Basis::BSpline, Wrap::Periodic) => 1,
            _ => 0,
        };
        let first = (segment * self.basis.step()) as isize - lead;
        std::array::from_fn(|k| {
            let i = first + k as isize;
            let i = match self.wrap {
                Wrap::Periodic => i.rem_euclid(n),
                _ => i.clamp(0, n - 1),
            };
            self.points[i as usize]
        })
    }

    /// The four Bézier control points of piece `segment`; the curve is the same.
    pub fn bezier(&self, segment: usize) -> [Vec3; 4] {
        let [a, b, c, d] = self.controls(segment);
        match self.basis {
            Basis::Linear => [a, a + (b - a) / 3.0, b + (a - b) / 3.0, b],
            Basis::Bezier => [a, b, c, d],
            Basis::CatmullRom => [b, b + (c - a) / 6.0, c + (b - d) / 6.0, c],
            Basis::BSpline => {
                let (p, q) = ((2.0 * b + c) / 3.0, (b + 2.0 * c) / 3.0);
                let start = (a + 4.0 * b + c) / 6.0;
                let end = (b + 4.0 * c + d) / 6.0;
                [start, p, q, end]
            }
        }
    }

    /// Position on piece `segment` at `t` in 0..=1.
    pub fn position(&self, segment: usize, t: f32) -> Vec3 {
        let [a, b, c, d] = self.bezier(segment);
        let s = 1.0 - t;
        a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t)
    }

    /// Derivative with respect to `t` on piece `segment` at `t` in 0..=1.
    pub fn derivative(&self, segment: usize, t: f32) -> Vec3 {
        let [a, b, c, d] = self.bezier(segment);
        let s = 1.0 - t;
        ((b - a) * (s * s) + (c - b) * (2.0 * s * t) + (d - c) * (t * t)) * 3.0
    }

    /// `segments + 1` points at equal steps of arc length, ends included. A curve
    /// without length gives copies of its start.
    pub fn resample(&self, segments: usize) -> Vec<Vec3> {
        let length = ArcLength::new(self);
        let total = length.total();
        (0..=segments)
            .map(|i| {
                let (segment, t) = length.locate(total * i as f64 / segments.max(1) as f64);
                self.position(segment, t as f32)
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ZIGZAG: [Vec3; 5] = [
        Vec3::new(0.0, 0.0, 0.0),
        Vec3::new(1.0, 2.0, 0.0),
        Vec3::new(2.0, 0.0, 1.0),
        Vec3::new(3.0, 2.0, 1.0),
        Vec3::new(4.0, 0.0, 0.0),
    ];

    #[test]
    fn pieces_join_where_they_meet() {
        for basis in [Basis::Linear, Basis::BSpline, Basis::CatmullRom] {
            for wrap in [Wrap::Nonperiodic, Wrap::Periodic, Wrap::Pinned] {
                let curve = Curve::new(&ZIGZAG, basis, wrap).unwrap();
                for s in 1..curve.segments() {
                    let gap = curve.position(s - 1, 1.0).distance(curve.position(s, 0.0));
                    assert!(gap < 1e-6, "{basis:?} {wrap:?} piece {s}: gap {gap}");
                }
            }
        }
    }

    #[test]
    fn pinned_curves_reach_their_end_vertices() {
        for basis in [Basis::BSpline, Basis::CatmullRom] {
            let curve = Curve::new(&ZIGZAG, basis, Wrap::Pinned).unwrap();
            let last = curve.segments() - 1;
            assert!(curve.position(0, 0.0).distance(ZIGZAG[0]) < 1e-6);
            assert!(curve.position(last, 1.0).distance(ZIGZAG[4]) < 1e-6);
        }
    }

    #[test]
    fn the_derivative_is_the_limit_of_differences() {
        let curve = Curve::new(&ZIGZAG, Basis::CatmullRom, Wrap::Pinned).unwrap();
        for s in 0..curve.segments() {
            for t in [0.1f32, 0.5, 0.9] {
                let h = 1e-2;
                let d = (curve.position(s, t + h) - curve.position(s, t - h)) / (2.0 * h);
                assert!(d.distance(curve.derivative(s, t)) < 1e-2);
            }
        }
    }

    #[test]
    fn too_few_vertices_are_refused_and_named() {
        let error = Curve::new(&ZIGZAG[..3], Basis::CatmullRom, Wrap::Nonperiodic).unwrap_err();
        assert_eq!(
            error.to_string(),
            "3 vertices make no CatmullRom curve with Nonperiodic ends"
        );
    }
}
