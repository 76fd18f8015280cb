//! Why numbers are no spline.

/// Largest coordinate, weight ratio and knot that splines take: third derivatives, and
/// products of them, stay finite.
pub(crate) const LARGEST: f64 = 1e100;

/// Nearest that two distinct knots may come: its cube still divides.
pub(crate) const NEAREST_KNOTS: f64 = 1e-60;

/// Why control points, weights and knots make no spline.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SplineError {
    /// Too few or, for Bézier chains, not a number of points that makes whole pieces.
    #[error("{found} control points: {needs}")]
    Points {
        /// Number of points given.
        found: usize,
        /// What is allowed.
        needs: &'static str,
    },
    /// A coordinate that is not finite, or above 1e100.
    #[error("control point {index} is not a finite number of at most 1e100")]
    NotFinite {
        /// Index of the first such point.
        index: usize,
    },
    /// A degree outside 1..=255.
    #[error("degree {found}, where 1 to 255 is allowed")]
    Degree {
        /// Degree asked for.
        found: usize,
    },
    /// An exponent of the distance outside 0..=1.
    #[error("exponent {found}, where 0 (uniform) to 1 (chordal) is allowed")]
    Alpha {
        /// Exponent asked for.
        found: f64,
    },
    /// Not one weight a point.
    #[error("{found} weights for {points} control points")]
    WeightCount {
        /// Number of weights given.
        found: usize,
        /// Number of points.
        points: usize,
    },
    /// A weight that is not positive, or 1e100 times smaller than another.
    #[error("weight {index} is {found}, where a positive number is needed")]
    Weight {
        /// Index of the first such weight.
        index: usize,
        /// The weight.
        found: f64,
    },
    /// Not `points + degree + 1` knots.
    #[error("{found} knots, where points + degree + 1 = {needed} are needed")]
    KnotCount {
        /// Number of knots given.
        found: usize,
        /// Number that points and degree ask for.
        needed: usize,
    },
    /// A knot that is not finite, above 1e100 or below the one before it.
    #[error("knot {index} is {found}: knots are finite, at most 1e100, and ascend")]
    Knot {
        /// Index of the first such knot.
        index: usize,
        /// The knot.
        found: f64,
    },
    /// A knot inside the curve that is there more than degree times, where it would break,
    /// or one that is nearer than 1e-60 to its neighbour.
    #[error("knot {index} is there too often, or too near to the one before it")]
    CrowdedKnot {
        /// Index of the first such knot.
        index: usize,
    },
    /// A curve over no parameter: the knots between its ends are all one.
    #[error("the knots leave the curve no parameter")]
    NoDomain,
    /// A parameter that is not inside the curve.
    #[error("parameter {found} is not inside {low}..{high}")]
    Parameter {
        /// The parameter.
        found: f64,
        /// Where the curve starts.
        low: f64,
        /// Where it ends.
        high: f64,
    },
}

/// The first point that is not finite or too large, as an error.
pub(crate) fn check_points(points: &[glam::DVec3]) -> Result<(), SplineError> {
    let good = |p: &glam::DVec3| p.is_finite() && p.abs().max_element() <= LARGEST;
    match points.iter().position(|p| !good(p)) {
        Some(index) => Err(SplineError::NotFinite { index }),
        None => Ok(()),
    }
}
