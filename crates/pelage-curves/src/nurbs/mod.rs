//! NURBS: rational B-splines of any degree over any knots, f64.
//!
//! Source: L. Piegl and W. Tiller, "The NURBS Book" (definitions); L. Ramshaw, "Blossoming"
//! (the Bézier points of a span). A curve is taken apart once, when it is made, into the
//! homogeneous Bézier pieces between its distinct knots; evaluation then needs no knots, no
//! divisions but one and no memory. Degrees 1 and 2 are raised to 3, which is exact, so
//! that one text serves all.
//!
//! Weights are positive, which keeps the curve in the hull of its control points and its
//! denominator from 0. Curves over unclamped knots, closed ones among them, are read over
//! `knots[degree]..=knots[points]` as they stand.

mod bounds;
mod finder;
mod jet;
mod knots;
mod pieces;

use crate::SplineError;
use crate::spline_error::{LARGEST, check_points};
use glam::{DVec3, DVec4};

/// Largest degree.
const HIGHEST: usize = 255;

/// A rational B-spline curve.
///
/// ```
/// use pelage_curves::{DVec3, Nurbs};
/// // A quarter of the unit circle, exactly.
/// let points = [DVec3::X, DVec3::X + DVec3::Y, DVec3::Y];
/// let weights = [1.0, std::f64::consts::FRAC_1_SQRT_2, 1.0];
/// let arc = Nurbs::new(2, &points, &weights, &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0])?;
/// assert!((arc.position(0.3).length() - 1.0).abs() < 1e-15);
/// # Ok::<(), pelage_curves::SplineError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Nurbs {
    degree: usize,
    /// Points + degree + 1; ascending.
    knots: Vec<f64>,
    /// Weight times point, and weight.
    controls: Vec<DVec4>,
    /// Distinct knots of the domain, one more than pieces.
    breaks: Vec<f64>,
    finder: finder::Finder,
    /// Homogeneous Bézier points of the pieces, which share their ends.
    bezier: Vec<DVec4>,
    rational: bool,
}

impl Nurbs {
    /// The curve of `degree` (1 to 255) over `points`, with one weight each, and
    /// `points + degree + 1` knots. (Formats that leave the first and the last knot out:
    /// put any there, for instance their neighbours again.)
    ///
    /// # Errors
    ///
    /// Whatever of [`SplineError`] applies; the first found.
    pub fn new(
        degree: usize,
        points: &[DVec3],
        weights: &[f64],
        knots: &[f64],
    ) -> Result<Self, SplineError> {
        if !(1..=HIGHEST).contains(&degree) {
            return Err(SplineError::Degree { found: degree });
        }
        if points.len() <= degree {
            return Err(SplineError::Points {
                found: points.len(),
                needs: "a NURBS curve has one more than its degree at least",
            });
        }
        check_points(points)?;
        check_weights(weights, points.len())?;
        knots::check(knots, degree, points.len())?;
        let homogeneous = |(p, &w): (&DVec3, &f64)| (*p * w).extend(w);
        let controls = points.iter().zip(weights).map(homogeneous).collect();
        Ok(Self::of_parts(degree, controls, knots.to_vec()))
    }

    /// The B-spline curve of `degree` that starts and ends in its first and last point,
    /// over evenly spaced knots from 0 to the number of pieces, `points - degree`.
    ///
    /// # Errors
    ///
    /// [`SplineError::Degree`], [`SplineError::Points`], [`SplineError::NotFinite`].
    pub fn clamped(degree: usize, points: &[DVec3]) -> Result<Self, SplineError> {
        let last = points.len().saturating_sub(degree);
        let knot = |i: usize| i.saturating_sub(degree).min(last) as f64;
        let knots: Vec<f64> = (0..points.len() + degree + 1).map(knot).collect();
        Self::new(degree, points, &vec![1.0; points.len()], &knots)
    }

    /// The closed B-spline curve of `degree` over evenly spaced knots, from 0 to the number
    /// of pieces, one for each of `points`.
    ///
    /// # Errors
    ///
    /// [`SplineError::Degree`], [`SplineError::Points`] for none, [`SplineError::NotFinite`].
    pub fn closed(degree: usize, points: &[DVec3]) -> Result<Self, SplineError> {
        if points.is_empty() {
            return Err(SplineError::Points {
                found: 0,
                needs: "a closed curve has one at least",
            });
        }
        let around: Vec<DVec3> = (0..points.len() + degree)
            .map(|i| points[i % points.len()])
            .collect();
        let knot = |i: usize| i as f64 - degree as f64;
        let knots: Vec<f64> = (0..around.len() + degree + 1).map(knot).collect();
        Self::new(degree, &around, &vec![1.0; around.len()], &knots)
    }

    /// The Bézier curve over all of `points`, whose degree is one less than their number;
    /// its parameter goes from 0 to 1.
    ///
    /// # Errors
    ///
    /// [`SplineError::Degree`], [`SplineError::NotFinite`].
    pub fn bezier(points: &[DVec3]) -> Result<Self, SplineError> {
        Self::clamped(points.len().saturating_sub(1), points)
    }

    /// Numbers that are known to make a curve.
    fn of_parts(degree: usize, controls: Vec<DVec4>, knots: Vec<f64>) -> Self {
        let (breaks, bezier) = pieces::bezier(degree, &controls, &knots);
        let rational = controls.iter().any(|c| c.w != controls[0].w);
        Self {
            degree,
            knots,
            controls,
            finder: finder::Finder::new(&breaks),
            breaks,
            bezier,
            rational,
        }
    }

    /// The degree it was made with.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Its knots, ascending.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Its control points.
    pub fn points(&self) -> impl ExactSizeIterator<Item = DVec3> {
        self.controls.iter().map(|c| c.truncate() / c.w)
    }

    /// Their weights.
    pub fn weights(&self) -> impl ExactSizeIterator<Item = f64> {
        self.controls.iter().map(|c| c.w)
    }

    /// First and last parameter.
    pub fn domain(&self) -> (f64, f64) {
        (self.breaks[0], self.breaks[self.breaks.len() - 1])
    }
}

fn check_weights(weights: &[f64], points: usize) -> Result<(), SplineError> {
    let found = weights.len();
    if found != points {
        return Err(SplineError::WeightCount { found, points });
    }
    // A NaN is not above 0.
    let good = |w: f64| w > 0.0 && w <= LARGEST;
    let largest = weights
        .iter()
        .fold(0.0, |a, &b| if good(b) { b.max(a) } else { a });
    let bad = |&w: &f64| !good(w) || w < largest / LARGEST;
    match weights.iter().position(bad) {
        Some(index) => Err(SplineError::Weight {
            index,
            found: weights[index],
        }),
        None => Ok(()),
    }
}

#[cfg(test)]
pub(crate) mod tests;
