//! One shape placed many times: ordered exponentials made ahead.
//!
//! Source: document 000, section 3.1, equations 13–16. U(s) carries the first basis to
//! that at s, and R(s) = ∫U; the curve is ê₁ · R(s) · F(0), so only the first row of R is
//! kept (and that of U, for tangents). They are products of exact helix steps; U stays
//! orthogonal to rounding.

use super::{Frame, Segment, Step};
use fearless_simd::{Level, dispatch};
use glam::DVec3;

/// The first rows of R(s) and U(s) at the ends of segments.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// Of R: coordinates of the points in the first basis.
    points: Vec<DVec3>,
    /// Of U: coordinates of the tangents in the first basis.
    tangents: Vec<DVec3>,
}

impl Placed {
    /// Prepares the curve made of `segments`.
    pub fn new(segments: &[Segment]) -> Self {
        let (mut point, mut frame) = (DVec3::ZERO, Frame::IDENTITY);
        let mut placed = Self {
            points: vec![point],
            tangents: vec![frame.tangent],
        };
        for &segment in segments {
            let step = Step::new(segment);
            point += step.shift(&frame);
            frame = step.frame(&frame);
            placed.points.push(point);
            placed.tangents.push(frame.tangent);
        }
        placed
    }

    /// The points of the curve that starts at `start` with the basis `frame`: an inner
    /// product a coordinate.
    ///
    /// ```
    /// use pelage_curves::{DVec3, frenet::{Frame, Placed, Segment}};
    /// let straight = Placed::new(&[Segment { length: 2.0, ..Segment::default() }]);
    /// let points: Vec<_> = straight.points(DVec3::ONE, Frame::IDENTITY).collect();
    /// assert_eq!(points, [DVec3::ONE, DVec3::new(3.0, 1.0, 1.0)]);
    /// ```
    pub fn points(&self, start: DVec3, frame: Frame) -> impl Iterator<Item = DVec3> {
        self.points.iter().map(move |&p| start + frame.vector(p))
    }

    /// Writes what [`points`](Self::points) gives over `points`, as far as that goes.
    pub fn place(&self, start: DVec3, frame: Frame, points: &mut [DVec3]) {
        dispatch!(Level::new(), simd => {
            let _ = simd;
            for (point, &p) in points.iter_mut().zip(&self.points) {
                *point = start + frame.vector(p);
            }
        });
    }

    /// Unit tangents of the curve that starts with the basis `frame`.
    pub fn tangents(&self, frame: Frame) -> impl Iterator<Item = DVec3> {
        self.tangents.iter().map(move |&t| frame.vector(t))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frenet::Apparatus;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_placed_shape_is_the_synthesised_curve(
            parts in prop::collection::vec((0.0f64..1.0, -9.0f64..9.0, -9.0f64..9.0), 0..30),
            tangent in prop::array::uniform3(-1.0f64..1.0),
            normal in prop::array::uniform3(-1.0f64..1.0),
        ) {
            let segments: Vec<Segment> = parts
                .iter()
                .map(|&(length, curvature, torsion)| Segment { length, curvature, torsion })
                .collect();
            let (start, frame) = (DVec3::ONE, Frame::new(tangent.into(), normal.into()));
            let placed = Placed::new(&segments);
            let whole = Apparatus { start, frame, segments };
            for (p, q) in placed.points(start, frame).zip(whole.points()) {
                prop_assert!(p.distance(q) < 1e-13);
            }
            let mut written = vec![DVec3::NAN; placed.points.len()];
            placed.place(start, frame, &mut written);
            prop_assert_eq!(written, placed.points(start, frame).collect::<Vec<_>>());
            for (t, f) in placed.tangents(frame).zip(whole.frames()) {
                prop_assert!(t.distance(f.tangent) < 1e-13);
            }
        }
    }
}
