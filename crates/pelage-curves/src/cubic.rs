//! One cubic piece: Bézier points, from and to every other cubic basis.
//!
//! The bases differ by a 4 × 4 matrix of small rational numbers; here each is written out,
//! so that what is exact stays exact. Splitting is de Casteljau's algorithm; extremes are
//! the roots of the derivative's quadratic.

use glam::DVec3;

/// What the four numbers of a cubic piece mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CubicBasis {
    /// Coefficients of 1, t, t², t³.
    Power,
    /// Start, end, derivative at the start, derivative at the end.
    Hermite,
    /// Bézier points.
    Bezier,
    /// Window of a uniform cubic B-spline.
    BSpline,
    /// Window of a uniform Catmull-Rom curve: the piece joins the middle two.
    CatmullRom,
}

impl CubicBasis {
    /// The piece that `[a, b, c, d]` means in this basis.
    pub fn to_cubic(self, [a, b, c, d]: [DVec3; 4]) -> Cubic {
        Cubic(match self {
            Self::Power => [a, a + b / 3.0, a + (b * 2.0 + c) / 3.0, ((a + b) + c) + d],
            Self::Hermite => [a, a + c / 3.0, b - d / 3.0, b],
            Self::Bezier => [a, b, c, d],
            Self::BSpline => [
                (a + b * 4.0 + c) / 6.0,
                (b * 2.0 + c) / 3.0,
                (b + c * 2.0) / 3.0,
                (b + c * 4.0 + d) / 6.0,
            ],
            Self::CatmullRom => [b, b + (c - a) / 6.0, c + (b - d) / 6.0, c],
        })
    }

    /// What `cubic` is in this basis; the inverse of [`to_cubic`](Self::to_cubic).
    ///
    /// ```
    /// use pelage_curves::{CubicBasis, DVec3};
    /// let window = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    /// let piece = CubicBasis::CatmullRom.to_cubic(window);
    /// let b_spline = CubicBasis::BSpline.of_cubic(piece);
    /// assert!(CubicBasis::BSpline.to_cubic(b_spline).position(0.3).distance(piece.position(0.3)) < 1e-15);
    /// ```
    pub fn of_cubic(self, Cubic([a, b, c, d]): Cubic) -> [DVec3; 4] {
        match self {
            Self::Power => [
                a,
                (b - a) * 3.0,
                ((a - b) + (c - b)) * 3.0,
                (d - a) + (b - c) * 3.0,
            ],
            Self::Hermite => [a, d, (b - a) * 3.0, (d - c) * 3.0],
            Self::Bezier => [a, b, c, d],
            Self::BSpline => [
                a * 6.0 - b * 7.0 + c * 2.0,
                b * 2.0 - c,
                c * 2.0 - b,
                b * 2.0 - c * 7.0 + d * 6.0,
            ],
            Self::CatmullRom => [d + (a - b) * 6.0, a, d, a + (d - c) * 6.0],
        }
    }
}

/// A cubic piece by its four Bézier points, f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cubic(pub [DVec3; 4]);

impl Cubic {
    /// Position at `t`; 0 is the first point and 1 the last.
    pub fn position(&self, t: f64) -> DVec3 {
        self.jet(t)[0]
    }

    /// Position and three derivatives at `t`.
    #[inline]
    pub fn jet(&self, t: f64) -> [DVec3; 4] {
        let [a, b, c, d] = self.0;
        let s = 1.0 - t;
        let (ab, bc, cd) = (b - a, c - b, d - c);
        let (abc, bcd) = (bc - ab, cd - bc);
        [
            a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t),
            (ab * (s * s) + bc * (2.0 * s * t) + cd * (t * t)) * 3.0,
            (abc * s + bcd * t) * 6.0,
            (bcd - abc) * 6.0,
        ]
    }

    /// The two halves that meet at `t`, each over 0..=1 again: the same curve, exactly.
    pub fn split(&self, t: f64) -> [Self; 2] {
        let [a, b, c, d] = self.0;
        let mix = |p: DVec3, q: DVec3| p * (1.0 - t) + q * t;
        let (ab, bc, cd) = (mix(a, b), mix(b, c), mix(c, d));
        let (abc, bcd) = (mix(ab, bc), mix(bc, cd));
        let middle = mix(abc, bcd);
        [Self([a, ab, abc, middle]), Self([middle, bcd, cd, d])]
    }

    /// Smallest axis-aligned box `(min, max)` around the piece.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let [a, b, c, d] = self.0;
        let (mut low, mut high) = (a.min(d), a.max(d));
        for axis in 0..3 {
            let inside = |x: f64| low[axis] <= x && x <= high[axis];
            // The curve cannot leave a box that holds all four points.
            if inside(b[axis]) && inside(c[axis]) {
                continue;
            }
            let (ab, bc, cd) = (b[axis] - a[axis], c[axis] - b[axis], d[axis] - c[axis]);
            for t in roots_in_unit(ab - bc * 2.0 + cd, (bc - ab) * 2.0, ab) {
                let x = self.position(t)[axis];
                low[axis] = low[axis].min(x);
                high[axis] = high[axis].max(x);
            }
        }
        (low, high)
    }
}

/// Roots of `a t² + b t + c` strictly inside 0..1, without cancellation.
fn roots_in_unit(a: f64, b: f64, c: f64) -> impl Iterator<Item = f64> {
    // Coordinates may be 1e100: squares are taken of numbers of order 1.
    let largest = a.abs().max(b.abs()).max(c.abs()).max(f64::MIN_POSITIVE);
    let (a, b, c) = (a / largest, b / largest, c / largest);
    let discriminant = b * b - 4.0 * a * c;
    let q = -0.5 * (b + discriminant.max(0.0).sqrt().copysign(b));
    let roots = [q / a, c / q].into_iter();
    roots.filter(move |t| discriminant >= 0.0 && *t > 0.0 && *t < 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const BASES: [CubicBasis; 5] = [
        CubicBasis::Power,
        CubicBasis::Hermite,
        CubicBasis::Bezier,
        CubicBasis::BSpline,
        CubicBasis::CatmullRom,
    ];

    fn window() -> impl Strategy<Value = [DVec3; 4]> {
        let point = || prop::array::uniform3(-9.0f64..9.0).prop_map(DVec3::from);
        [point(), point(), point(), point()]
    }

    proptest! {
        #[test]
        fn every_basis_comes_back_from_every_other(window in window()) {
            for from in BASES {
                let piece = from.to_cubic(window);
                for to in BASES {
                    let there = to.to_cubic(to.of_cubic(piece));
                    let back = from.of_cubic(there);
                    for (p, q) in window.iter().zip(back) {
                        prop_assert!(p.distance(q) < 1e-11, "{from:?} {to:?}: {p} {q}");
                    }
                }
            }
        }

        #[test]
        fn the_power_basis_is_the_polynomial(window in window(), t in 0.0f64..1.0) {
            let [a, b, c, d] = window;
            let exact = a + (b + (c + d * t) * t) * t;
            let piece = CubicBasis::Power.to_cubic(window);
            let jet = piece.jet(t);
            prop_assert!(jet[0].distance(exact) < 1e-12);
            prop_assert!(jet[1].distance(b + (c * 2.0 + d * (3.0 * t)) * t) < 1e-12);
            prop_assert!(jet[2].distance(c * 2.0 + d * (6.0 * t)) < 1e-12);
            prop_assert!(jet[3].distance(d * 6.0) < 1e-12);
        }

        #[test]
        fn halves_are_the_whole(window in window(), at in 0.0f64..1.0, t in 0.0f64..1.0) {
            let piece = Cubic(window);
            let [left, right] = piece.split(at);
            prop_assert!(left.position(t).distance(piece.position(at * t)) < 1e-13);
            let along = at + (1.0 - at) * t;
            prop_assert!(right.position(t).distance(piece.position(along)) < 1e-13);
        }

        #[test]
        fn bounds_hold_the_piece_and_touch_it(window in window()) {
            let piece = Cubic(window);
            let (low, high) = piece.bounds();
            let points = (0..=1000).map(|i| piece.position(i as f64 / 1000.0));
            let seen = points.fold((window[0], window[0]), |(l, h), p| (l.min(p), h.max(p)));
            prop_assert!((seen.0 - low).min_element() > -1e-12);
            prop_assert!((high - seen.1).min_element() > -1e-12);
            prop_assert!((seen.0 - low).max_element() < 1e-4);
            prop_assert!((high - seen.1).max_element() < 1e-4);
        }
    }
}
