//! Which polynomial joins the control vertices, and how the ends are treated.
//!
//! Names and segment counts are those of OpenUSD's `UsdGeomBasisCurves`.

/// The basis of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Basis {
    /// Straight pieces between neighbouring vertices.
    Linear,
    /// Cubic Bézier: pieces share their end vertex, so vertices come in steps of 3.
    Bezier,
    /// Uniform cubic B-spline; does not pass through its vertices.
    BSpline,
    /// Uniform Catmull-Rom; passes through all vertices but the phantom ends.
    CatmullRom,
}

/// How a curve treats its ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The vertices are all there is.
    Nonperiodic,
    /// The curve closes on itself.
    Periodic,
    /// Phantom vertices are added so that the curve reaches its first and last
    /// vertex: the end vertex once more for Catmull-Rom, twice for B-splines, as
    /// Storm and hdPrman do (the schema text of OpenUSD reflects instead).
    Pinned,
}

impl Basis {
    /// Vertices between the starts of two neighbouring segments.
    pub fn step(self) -> usize {
        match self {
            Basis::Bezier => 3,
            _ => 1,
        }
    }

    /// Segments of a curve of `vertices` control vertices, or `None` where that
    /// count is not allowed for this basis and `wrap`.
    ///
    /// ```
    /// use pelage_curves::{Basis, Wrap};
    /// assert_eq!(Basis::CatmullRom.segments(10, Wrap::Nonperiodic), Some(7));
    /// assert_eq!(Basis::CatmullRom.segments(8, Wrap::Pinned), Some(7));
    /// assert_eq!(Basis::Bezier.segments(6, Wrap::Nonperiodic), None);
    /// ```
    pub fn segments(self, vertices: usize, wrap: Wrap) -> Option<usize> {
        match (self, wrap) {
            (Basis::Linear, Wrap::Periodic) => (vertices >= 3).then_some(vertices),
            (Basis::Linear, _) => (vertices >= 2).then(|| vertices - 1),
            (Basis::Bezier, Wrap::Periodic) => {
                (vertices >= 3 && vertices.is_multiple_of(3)).then_some(vertices / 3)
            }
            (Basis::Bezier, _) => {
                (vertices >= 4 && (vertices - 4).is_multiple_of(3)).then(|| (vertices - 4) / 3 + 1)
            }
            (_, Wrap::Periodic) => (vertices >= 3).then_some(vertices),
            (_, Wrap::Nonperiodic) => (vertices >= 4).then(|| vertices - 3),
            (Basis::CatmullRom, Wrap::Pinned) => (vertices >= 2).then(|| vertices - 1),
            (Basis::BSpline, Wrap::Pinned) => (vertices >= 2).then_some(vertices + 1),
        }
    }
}
