//! Why there is no tube.

use crate::frenet::FrenetError;

/// Why a section, or a sweep of it, makes no tube.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TubeError {
    /// Fewer than 3 or more than 4096 points around.
    #[error("a section of {found} points, where 3 to 4096 are allowed")]
    Points {
        /// Number of points given.
        found: usize,
    },
    /// A coordinate of the section that is not finite.
    #[error("point {index} of the section is not a finite number")]
    Section {
        /// Index of the first such point.
        index: usize,
    },
    /// Two edges of the section that touch, cross, or lie on each other; points that
    /// coincide among them.
    #[error("edges {first} and {second} of the section touch")]
    SelfTouching {
        /// Index of the point that the first edge starts from.
        first: usize,
        /// Index of the point that the second edge starts from.
        second: usize,
    },
    /// The curve to sweep along is not finite.
    #[error(transparent)]
    Curve(#[from] FrenetError),
    /// A radius that is negative or not finite.
    #[error("the radius is {found} at {at} of the length, where 0 or more is needed")]
    Radius {
        /// Fraction of the arc length.
        at: f64,
        /// The radius there.
        found: f64,
    },
    /// An angle between rings that is not positive.
    #[error("{found} radians between rings, where a positive angle is needed")]
    Angle {
        /// The angle given.
        found: f64,
    },
    /// A tube that should close along a curve that does not.
    #[error("the curve's ends are {gap} apart, so it does not close")]
    NotClosed {
        /// Distance between the first and the last point.
        gap: f64,
    },
    /// A position beyond the range of `f32`.
    #[error("the tube leaves the range of 32-bit floating-point numbers")]
    TooFar,
    /// More vertices than 32-bit indices count.
    #[error("rings of {around} vertices, {rings} of them, are more than 32-bit indices count")]
    TooMany {
        /// Vertices of a ring.
        around: usize,
        /// Rings.
        rings: usize,
    },
}
