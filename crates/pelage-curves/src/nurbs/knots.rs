//! Knots: what they must be, one more of them, and cutting a curve at one.

use super::Nurbs;
use crate::SplineError;
use crate::spline_error::{LARGEST, NEAREST_KNOTS};

/// Refuses knots that make no curve of `points` control points.
pub(super) fn check(knots: &[f64], degree: usize, points: usize) -> Result<(), SplineError> {
    let (found, needed) = (knots.len(), points + degree + 1);
    if found != needed {
        return Err(SplineError::KnotCount { found, needed });
    }
    for (index, &found) in knots.iter().enumerate() {
        let ascends = index == 0 || knots[index - 1] <= found;
        // A NaN is not at most anything.
        if !(found.abs() <= LARGEST && ascends) {
            return Err(SplineError::Knot { index, found });
        }
        let apart =
            index == 0 || knots[index - 1] == found || found - knots[index - 1] >= NEAREST_KNOTS;
        // One more than degree knots may be equal at an end, where the curve stops anyway.
        let often = index > degree && knots[index - degree] == found;
        let inside = knots[degree] < found && found < knots[points];
        if !apart || (often && inside) {
            return Err(SplineError::CrowdedKnot { index });
        }
    }
    match knots[degree] < knots[points] {
        true => Ok(()),
        false => Err(SplineError::NoDomain),
    }
}

impl Nurbs {
    /// The same curve with a control point more and a knot more at `u`, inside the curve.
    ///
    /// # Errors
    ///
    /// [`SplineError::Parameter`] outside the curve or at its ends;
    /// [`SplineError::CrowdedKnot`] where the knot is there as often as the degree or
    /// another is nearer than 1e-60.
    pub fn with_knot(&self, u: f64) -> Result<Self, SplineError> {
        let (controls, knots) = self.inserted(u, 1)?;
        check(&knots, self.degree, controls.len())?;
        Ok(Self::of_parts(self.degree, controls, knots))
    }

    /// The curve up to `u` and from there on: the same curve, exactly, over the same
    /// parameters. `u` is inside it.
    ///
    /// # Errors
    ///
    /// [`SplineError::Parameter`] outside the curve or at its ends;
    /// [`SplineError::CrowdedKnot`] where a knot is nearer than 1e-60.
    ///
    /// ```
    /// use pelage_curves::{DVec3, Nurbs};
    /// let points = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE, DVec3::Z];
    /// let curve = Nurbs::clamped(3, &points)?;
    /// let [left, right] = curve.split(0.7)?;
    /// assert_eq!(left.domain(), (0.0, 0.7));
    /// assert!(right.position(1.3).distance(curve.position(1.3)) < 1e-15);
    /// # Ok::<(), pelage_curves::SplineError>(())
    /// ```
    pub fn split(&self, u: f64) -> Result<[Self; 2], SplineError> {
        let there = self.knots.iter().filter(|&&k| k == u).count();
        let (controls, knots) = self.inserted(u, self.degree.saturating_sub(there))?;
        // The last of the knots at u, and the control point that the curve passes there.
        let last = knots.partition_point(|&k| k <= u) - 1;
        let at = last - self.degree;
        let mut left = knots[..=last].to_vec();
        left.push(u);
        let mut right = vec![u];
        right.extend(&knots[last + 1 - self.degree..]);
        let halves = [(&controls[..=at], left), (&controls[at..], right)];
        for (controls, knots) in &halves {
            check(knots, self.degree, controls.len())?;
        }
        Ok(halves.map(|(c, k)| Self::of_parts(self.degree, c.to_vec(), k)))
    }

    /// Controls and knots with `u` inserted `times`, by Boehm's algorithm.
    fn inserted(&self, u: f64, times: usize) -> Result<(Vec<glam::DVec4>, Vec<f64>), SplineError> {
        let (low, high) = self.domain();
        if !(low < u && u < high) {
            let found = u;
            return Err(SplineError::Parameter { found, low, high });
        }
        let (mut controls, mut knots) = (self.controls.clone(), self.knots.clone());
        for _ in 0..times {
            let last = knots.partition_point(|&k| k <= u) - 1;
            let first = last + 1 - self.degree;
            let old: Vec<_> = controls[first - 1..=last.min(controls.len() - 1)].to_vec();
            for (i, pair) in (first..=last).zip(old.windows(2)) {
                let part = (u - knots[i]) / (knots[i + self.degree] - knots[i]);
                // Where it is 0 or 1 the point stays what it was.
                controls[i] = super::pieces::mix(pair[0], pair[1], part);
            }
            if let Some(&end) = old.last() {
                controls.insert(last + 1, end);
            }
            knots.insert(last + 1, u);
        }
        Ok((controls, knots))
    }
}
