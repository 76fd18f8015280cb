//! Why numbers are no curve.

/// Why a curve cannot be taken apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FrenetError {
    /// There is no vertex or sample.
    #[error("a curve of no points has no curvature")]
    Empty,
    /// A coordinate is not finite, or so large that its square is not.
    #[error("point {index} of the curve is not a finite number")]
    NotFinite {
        /// Index of the first such vertex or sample.
        index: usize,
    },
}
