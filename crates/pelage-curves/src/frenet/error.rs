//! Why numbers are no curve.

/// Why a curve cannot be taken apart, or curves not be mixed.
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
    /// Guides to be mixed have different numbers of segments.
    #[error(
        "guide {guide} has {found} segments and the first {expected}: take all apart into as many"
    )]
    Unlike {
        /// Index of the first that differs from guide 0.
        guide: usize,
        /// Its segments.
        found: usize,
        /// Those of guide 0.
        expected: usize,
    },
    /// A weight of a guide is negative or no finite number, or all are 0.
    #[error("weights of guides are finite, 0 or more, and not all of them 0")]
    Weights,
}
