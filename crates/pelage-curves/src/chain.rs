//! A chain of cubic Bézier pieces, f64: what every cubic curve can be turned into.
//!
//! Catmull-Rom curves of any exponent (after C. Yuksel, S. Schaefer and J. Keyser,
//! "Parameterization and Applications of Catmull-Rom Curves", 2011) become chains with the
//! knot interval |P(i+1) - P(i)|^alpha: 0 is the uniform curve, ½ the centripetal one, which
//! has neither cusps nor loops within a piece, and 1 the chordal one.
//!
//! Ends are duplicated with the interval of the piece beside them. For alpha = 0 that is
//! [`catmull_rom`](crate::catmull_rom); for all it is a start along the first edge. (Taking
//! the interval 0 between a vertex and its double instead would make the curve stand still
//! there.) Vertices that coincide are such ends: the piece between them is a point, and the
//! curve may have a corner there.

use crate::spline_error::check_points;
use crate::{Cubic, Curve, Jet, SplineError, frenet::SpaceCurve};
use glam::DVec3;

/// Cubic Bézier pieces that share their ends: `3 pieces + 1` points, at least one piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    points: Vec<DVec3>,
}

impl Chain {
    /// The chain of Bézier `points`: 4, 7, 10, … of them.
    ///
    /// # Errors
    ///
    /// [`SplineError::Points`] for another number, [`SplineError::NotFinite`].
    pub fn bezier(points: &[DVec3]) -> Result<Self, SplineError> {
        if points.len() < 4 || !(points.len() - 1).is_multiple_of(3) {
            return Err(SplineError::Points {
                found: points.len(),
                needs: "a Bézier chain has 4, 7, 10, …",
            });
        }
        check_points(points)?;
        Ok(Self {
            points: points.to_vec(),
        })
    }

    /// The Catmull-Rom curve through all `points`, with knot intervals that are their
    /// distances to the power of `alpha` in 0..=1. A single point is a curve without length.
    ///
    /// # Errors
    ///
    /// [`SplineError::Points`] for none, [`SplineError::NotFinite`], [`SplineError::Alpha`].
    ///
    /// ```
    /// use pelage_curves::{Chain, DVec3};
    /// let points = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 5.0, 0.0)];
    /// let curve = Chain::catmull_rom(&points, 0.5)?;
    /// assert_eq!(curve.piece(1).0[3], points[2]);
    /// # Ok::<(), pelage_curves::SplineError>(())
    /// ```
    pub fn catmull_rom(points: &[DVec3], alpha: f64) -> Result<Self, SplineError> {
        let first = check_through(points, alpha)?;
        let last = points.len() - 1;
        let intervals: Vec<f64> = points.windows(2).map(|p| interval(p, alpha)).collect();
        let mut chain = vec![first];
        for i in 0..last {
            let window = [
                points[i.saturating_sub(1)],
                points[i],
                points[i + 1],
                points[(i + 2).min(last)],
            ];
            let before = i.checked_sub(1).map_or(0.0, |k| intervals[k]);
            let after = intervals.get(i + 1).copied().unwrap_or(0.0);
            chain.extend(&through(window, [before, intervals[i], after])[1..]);
        }
        if last == 0 {
            chain.extend([first; 3]);
        }
        Ok(Self { points: chain })
    }

    /// As [`catmull_rom`](Self::catmull_rom), closed: one more piece leads from the last
    /// point back to the first.
    ///
    /// # Errors
    ///
    /// As for [`catmull_rom`](Self::catmull_rom).
    pub fn closed_catmull_rom(points: &[DVec3], alpha: f64) -> Result<Self, SplineError> {
        let first = check_through(points, alpha)?;
        let n = points.len();
        let edge = |i: usize| interval(&[points[i % n], points[(i + 1) % n]], alpha);
        let mut chain = vec![first];
        for i in 0..n {
            let window = [n - 1, 0, 1, 2].map(|k| points[(i + k) % n]);
            let intervals = [n - 1, 0, 1].map(|k| edge(i + k));
            chain.extend(&through(window, intervals)[1..]);
        }
        Ok(Self { points: chain })
    }

    /// The polygon through `points`, an edge a piece. A single point is a curve without
    /// length.
    ///
    /// # Errors
    ///
    /// [`SplineError::Points`] for none, [`SplineError::NotFinite`].
    pub fn polygon(points: &[DVec3]) -> Result<Self, SplineError> {
        let first = check_through(points, 0.0)?;
        let edge = |p: &[DVec3]| [p[0] + (p[1] - p[0]) / 3.0, p[1] + (p[0] - p[1]) / 3.0, p[1]];
        let mut chain = vec![first];
        chain.extend(points.windows(2).flat_map(edge));
        if points.len() == 1 {
            chain.extend([first; 3]);
        }
        Ok(Self { points: chain })
    }

    /// `curve` piece by piece, whatever its basis.
    ///
    /// # Errors
    ///
    /// [`SplineError::NotFinite`] naming the Bézier point that is not.
    pub fn of_curve(curve: &Curve) -> Result<Self, SplineError> {
        let mut points = vec![curve.bezier(0)[0].as_dvec3()];
        for segment in 0..curve.segments() {
            points.extend(curve.bezier(segment)[1..].iter().map(|p| p.as_dvec3()));
        }
        Self::bezier(&points)
    }

    /// The Bézier points, `3 pieces + 1`.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Piece `index`, which is below [`pieces`](SpaceCurve::pieces).
    #[inline]
    pub fn piece(&self, index: usize) -> Cubic {
        let p = &self.points[3 * index..][..4];
        Cubic([p[0], p[1], p[2], p[3]])
    }

    /// The curve up to `t` in 0..=1 of `piece`, and the rest: the same curve, exactly.
    pub fn split(&self, piece: usize, t: f64) -> [Self; 2] {
        let [before, after] = self.piece(piece).split(t.clamp(0.0, 1.0));
        let mut left = self.points[..3 * piece].to_vec();
        left.extend(before.0);
        let mut right = after.0.to_vec();
        right.extend(&self.points[3 * piece + 4..]);
        [left, right].map(|points| Self { points })
    }

    /// Smallest axis-aligned box `(min, max)` around the curve.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let start = (self.points[0], self.points[0]);
        (0..self.pieces()).fold(start, |(low, high), i| {
            let (l, h) = self.piece(i).bounds();
            (low.min(l), high.max(h))
        })
    }
}

impl SpaceCurve for Chain {
    fn pieces(&self) -> usize {
        self.points.len() / 3
    }

    #[inline]
    fn at(&self, piece: usize, t: f64) -> [DVec3; 3] {
        let [position, first, second, _] = self.jet(piece, t);
        [position, first, second]
    }
}

impl Jet for Chain {
    #[inline]
    fn jet(&self, piece: usize, t: f64) -> [DVec3; 4] {
        self.piece(piece).jet(t)
    }
}

/// The first of points that a curve can pass through.
fn check_through(points: &[DVec3], alpha: f64) -> Result<DVec3, SplineError> {
    let &first = points.first().ok_or(SplineError::Points {
        found: 0,
        needs: "a curve passes through one at least",
    })?;
    if !(0.0..=1.0).contains(&alpha) {
        return Err(SplineError::Alpha { found: alpha });
    }
    check_points(points)?;
    Ok(first)
}

/// Knot interval between two points. It is 0 where they coincide, but for the uniform curve.
fn interval(ends: &[DVec3], alpha: f64) -> f64 {
    if alpha == 0.0 {
        return 1.0;
    }
    let edge = ends[1] - ends[0];
    let largest = edge.abs().max_element();
    if largest <= 0.0 {
        return 0.0;
    }
    let distance = (edge / largest).length() * largest;
    match alpha {
        0.5 => distance.sqrt(),
        1.0 => distance,
        _ => libm::pow(distance, alpha),
    }
}

/// Bézier points of the piece between the middle two of a window, whose knots lie apart by
/// `intervals`; a first or last interval of 0 is an end.
fn through([a, b, c, d]: [DVec3; 4], [before, own, after]: [f64; 3]) -> [DVec3; 4] {
    if own <= 0.0 {
        return [b, b, c, c];
    }
    let edge = c - b;
    // Slope of the parabola through three points at the middle one, times the own interval.
    let slope = |beyond: DVec3, interval: f64| match interval > 0.0 {
        true => {
            let part = own / (own + interval);
            beyond / interval * (own * part) + edge * (1.0 - part)
        }
        false => edge * 0.5,
    };
    let (leaving, arriving) = (slope(b - a, before), slope(d - c, after));
    [b, b + leaving / 3.0, c - arriving / 3.0, c]
}

#[cfg(test)]
#[path = "chain_tests.rs"]
mod tests;
