//! Position and three derivatives of a rational curve.

use super::Nurbs;
use crate::{Jet, frenet::SpaceCurve};
use fearless_simd::{Level, dispatch};
use glam::{DVec3, DVec4};

impl Nurbs {
    /// Position at `u`, clamped to the curve.
    pub fn position(&self, u: f64) -> DVec3 {
        let (piece, t) = self.locate(u);
        self.jet(piece, t)[0]
    }

    /// Position, first, second and third derivative with respect to `u`, clamped to the
    /// curve. At a knot they are those of the piece after it.
    ///
    /// ```
    /// use pelage_curves::{DVec3, Nurbs};
    /// let parabola = Nurbs::clamped(2, &[DVec3::ZERO, DVec3::X, DVec3::X * 2.0 + DVec3::Y])?;
    /// let [position, first, second, third] = parabola.derivatives(0.5);
    /// assert!(position.distance(DVec3::new(1.0, 0.25, 0.0)) < 1e-15);
    /// assert!(first.distance(DVec3::new(2.0, 1.0, 0.0)) < 1e-14);
    /// assert!(second.distance(DVec3::Y * 2.0) < 1e-14 && third.length() < 1e-13);
    /// # Ok::<(), pelage_curves::SplineError>(())
    /// ```
    #[inline(always)]
    pub fn derivatives(&self, u: f64) -> [DVec3; 4] {
        let (piece, t) = self.locate(u);
        let [position, first, second, third] = self.piece_jet(piece, t);
        let rate = 1.0 / (self.breaks[piece + 1] - self.breaks[piece]);
        [
            position,
            first * rate,
            second * (rate * rate),
            third * (rate * rate * rate),
        ]
    }

    /// [`derivatives`](Self::derivatives) at each of `us`, in any order, to the bit, by the
    /// processor's widest vectors; `jets` has the length of `us`, or the shorter counts.
    ///
    /// ```
    /// use pelage_curves::{DVec3, Nurbs};
    /// let curve = Nurbs::bezier(&[DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z])?;
    /// let mut jets = [[DVec3::ZERO; 4]; 2];
    /// curve.derivatives_at(&[0.25, 0.75], &mut jets);
    /// assert_eq!(jets[1], curve.derivatives(0.75));
    /// # Ok::<(), pelage_curves::SplineError>(())
    /// ```
    pub fn derivatives_at(&self, us: &[f64], jets: &mut [[DVec3; 4]]) {
        dispatch!(Level::new(), simd => {
            let _ = simd;
            for (jet, &u) in jets.iter_mut().zip(us) {
                *jet = self.derivatives(u);
            }
        });
    }

    /// The piece that the curve is in at `u`, and the parameter in 0..=1 inside it; clamped
    /// to the curve, and its start for a NaN.
    #[inline(always)]
    pub fn locate(&self, u: f64) -> (usize, f64) {
        let piece = self.finder.piece(&self.breaks, u);
        let (start, end) = (self.breaks[piece], self.breaks[piece + 1]);
        let t = (u - start) / (end - start);
        // A NaN is not above 0.
        (piece, if t > 0.0 { t.min(1.0) } else { 0.0 })
    }

    /// Homogeneous Bézier points of a piece.
    #[inline(always)]
    pub(super) fn piece(&self, piece: usize) -> &[DVec4] {
        let stride = self.degree.max(3);
        &self.bezier[piece * stride..][..stride + 1]
    }
}

impl SpaceCurve for Nurbs {
    fn pieces(&self) -> usize {
        self.breaks.len() - 1
    }

    fn at(&self, piece: usize, t: f64) -> [DVec3; 3] {
        let [position, first, second, _] = self.jet(piece, t);
        [position, first, second]
    }
}

impl Jet for Nurbs {
    #[inline]
    fn jet(&self, piece: usize, t: f64) -> [DVec3; 4] {
        self.piece_jet(piece, t)
    }
}

impl Nurbs {
    #[inline(always)]
    fn piece_jet(&self, piece: usize, t: f64) -> [DVec3; 4] {
        let points = self.piece(piece);
        let jet = homogeneous(points, t);
        if self.rational {
            return quotient(jet);
        }
        let scale = 1.0 / points[0].w;
        jet.map(|part| part.truncate() * scale)
    }
}

/// Value and three derivatives of the Bézier curve over four `points` at least.
#[inline(always)]
fn homogeneous(points: &[DVec4], t: f64) -> [DVec4; 4] {
    let degree = points.len() - 1;
    let [a, b, c, d] = match points {
        &[a, b, c, d] => [a, b, c, d],
        _ => last_four(points, t),
    };
    let s = 1.0 - t;
    let (ab, bc, cd) = (b - a, c - b, d - c);
    let (abc, bcd) = (bc - ab, cd - bc);
    let first = degree as f64;
    let second = first * (first - 1.0);
    [
        a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t),
        (ab * (s * s) + bc * (2.0 * s * t) + cd * (t * t)) * first,
        (abc * s + bcd * t) * second,
        (bcd - abc) * (second * (first - 2.0)),
    ]
}

/// The four points that de Casteljau's algorithm leaves before its last three rounds, as
/// sums over Bernstein polynomials of degree `points - 4`: no memory, and linear.
fn last_four(points: &[DVec4], t: f64) -> [DVec4; 4] {
    let n = points.len() - 4;
    // From the end that t is nearer to, where the first polynomial cannot vanish.
    let back = t > 0.5;
    let (near, far) = if back { (t, 1.0 - t) } else { (1.0 - t, t) };
    let mut bernstein = (0..n).fold(1.0, |power, _| power * near);
    let mut four = [DVec4::ZERO; 4];
    for k in 0..=n {
        let i = if back { n - k } else { k };
        for (sum, &point) in four.iter_mut().zip(&points[i..]) {
            *sum += point * bernstein;
        }
        bernstein *= (n - k) as f64 / (k + 1) as f64 * (far / near);
    }
    four
}

/// The derivatives of a point divided by its weight, from those of both.
#[inline(always)]
fn quotient([a, b, c, d]: [DVec4; 4]) -> [DVec3; 4] {
    let scale = 1.0 / a.w;
    let (first, second, third) = (b.w * scale, c.w * scale, d.w * scale);
    let position = a.truncate() * scale;
    let velocity = b.truncate() * scale - position * first;
    let change = c.truncate() * scale - velocity * (2.0 * first) - position * second;
    [
        position,
        velocity,
        change,
        d.truncate() * scale
            - change * (3.0 * first)
            - velocity * (3.0 * second)
            - position * third,
    ]
}
