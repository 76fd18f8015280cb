//! Why there is no fit.

use crate::frenet::FrenetError;

/// Why a curve or a wish cannot be fitted, or numbers are no Super-Helix.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// The target is no curve.
    #[error(transparent)]
    Target(#[from] FrenetError),
    /// A fit of no element was asked for.
    #[error("a fit of 0 elements was asked for, where 1 at least is needed")]
    NoElements,
    /// A bound of the error that no fit can keep, or that is no number.
    #[error("the error bound is {found}, where a positive number is needed")]
    Bound {
        /// The bound.
        found: f64,
    },
    /// A weight of the orientation that is negative or no number.
    #[error("the weight of the orientation is {found}, where 0 or more is allowed")]
    Orientation {
        /// The weight.
        found: f64,
    },
    /// An element with a negative length, or a number that is not finite, or a turn by more
    /// than 1e12 radians, of which no digits would be left.
    #[error(
        "element {index} is none: lengths are 0 or more, and length times curvature 1e12 at most"
    )]
    Element {
        /// Index of the first such element.
        index: usize,
    },
    /// A start that is not finite.
    #[error("the curve starts at a point that is not a finite number")]
    Start,
}
