//! An exact step along a helix.
//!
//! Source: document 000, section 4.1, equations 26–36, with its errata. Where curvature
//! and torsion are constant over a step, the basis turns by a matrix exponential
//! (equation 27; f of equation 33 with τ² in the numerator) and the tangent's integral
//! has a closed form too, which takes the place of equation 37:
//!
//! ∫T = T (ds - κ² σ) + N κ γ + B κ τ σ, with w² = κ² + τ², γ = (1 - cos w ds) / w² and
//! σ = (ds - sin(w ds) / w) / w².
//!
//! All is computed of the angles κ ds and τ ds, so that nothing depends on the unit of
//! length; γ and σ, of small differences, come from series of a quarter of the angle,
//! doubled twice, which takes no difference of near numbers and no branch. So circles and
//! helices are exact to rounding at any step.

use super::{Frame, Segment};
use glam::DVec3;

/// The turn and the shift of one step, as coordinates in the basis it starts from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Rows a, b, c; -b, d, e; c, -e, f of equation 27.
    basis: [DVec3; 3],
    /// ∫T over the step; unit of length.
    shift: DVec3,
}

impl Step {
    /// Squares of the angle of a step below this take no sine: up to 162 degrees.
    pub(super) const SMALL: f64 = 8.0;

    /// The step along `segment`.
    pub fn new(segment: Segment) -> Self {
        let (k, t) = segment.angles();
        Self::with(segment, Series::at(k * k + t * t))
    }

    /// The step along a `segment` whose angle has a square below [`SMALL`](Self::SMALL),
    /// without a branch.
    #[inline(always)]
    pub(super) fn small(segment: Segment) -> Self {
        let (k, t) = segment.angles();
        Self::with(segment, Series::doubled(k * k + t * t))
    }

    #[inline(always)]
    fn with(segment: Segment, Series { sine, versine, lag }: Series) -> Self {
        let (k, t) = segment.angles();
        let length = segment.length;
        let (b, c, e) = (sine * k, versine * k * t, sine * t);
        let d = 1.0 - versine * (k * k + t * t);
        Self {
            basis: [
                DVec3::new(1.0 - versine * k * k, b, c),
                DVec3::new(-b, d, e),
                DVec3::new(c, -e, 1.0 - versine * t * t),
            ],
            shift: DVec3::new(1.0 - lag * k * k, versine * k, lag * k * t) * length,
        }
    }

    /// The basis after the step from `frame`.
    #[inline(always)]
    pub fn frame(&self, frame: &Frame) -> Frame {
        let [tangent, normal, binormal] = self.basis.map(|row| frame.vector(row));
        Frame {
            tangent,
            normal,
            binormal,
        }
    }

    /// How far the curve goes from where its basis is `frame`.
    #[inline(always)]
    pub fn shift(&self, frame: &Frame) -> DVec3 {
        frame.vector(self.shift)
    }

    /// How far a curve of length 1 goes whose basis turns evenly from one to another, the
    /// short way; of a half turn, whose axis is not known, by bending.
    pub(super) fn turning(from: &Frame, to: &Frame) -> DVec3 {
        let rows = |f: &Frame| [f.tangent, f.normal, f.binormal];
        let pairs = || rows(from).into_iter().zip(rows(to));
        let axis: DVec3 = pairs().map(|(a, b)| a.cross(b)).sum();
        let cosines: f64 = pairs().map(|(a, b)| a.dot(b)).sum();
        // Twice the sine and the cosine of the angle.
        let (sine, cosine) = (axis.length(), cosines - 1.0);
        let axis = match (sine > 1e-12, cosine < 0.0) {
            (true, _) => axis * (libm::atan2(sine, cosine) / sine),
            (false, true) => from.binormal * std::f64::consts::PI,
            (false, false) => axis * 0.5,
        };
        let Series { versine, lag, .. } = Series::at(axis.length_squared());
        let across = axis.cross(from.tangent);
        from.tangent + across * versine + axis.cross(across) * lag
    }
}

/// Functions of the angle x of a step that are even, smooth and of order 1.
struct Series {
    /// sin x / x.
    sine: f64,
    /// (1 - cos x) / x².
    versine: f64,
    /// (x - sin x) / x³.
    lag: f64,
}

impl Series {
    /// At the square of x.
    #[inline(always)]
    fn at(square: f64) -> Self {
        match square < Step::SMALL {
            true => Self::doubled(square),
            false => Self::closed(square),
        }
    }

    /// By series of x / 4, where the terms left out are below rounding, and twice
    /// sin 2y = 2 sin y cos y, whose like for the others has no difference either.
    #[inline(always)]
    fn doubled(square: f64) -> Self {
        let mut quarter = square / 16.0;
        let mut part = Self {
            sine: horner(&SINE, quarter),
            versine: horner(&VERSINE, quarter),
            lag: horner(&LAG, quarter),
        };
        for _ in 0..2 {
            let Self { sine, versine, lag } = part;
            part = Self {
                sine: sine * (1.0 - versine * quarter),
                versine: sine * sine * 0.5,
                lag: (lag + sine * versine) * 0.25,
            };
            quarter *= 4.0;
        }
        part
    }

    /// Where the differences lose less than two digits.
    fn closed(square: f64) -> Self {
        let x = square.sqrt();
        let (sine, half) = (libm::sin(x), libm::sin(x / 2.0));
        Self {
            sine: sine / x,
            versine: 2.0 * half * half / square,
            lag: (x - sine) / (square * x),
        }
    }
}

/// Terms of a series: enough for a square of ½.
type Terms = [f64; 9];

const SINE: Terms = terms(1);
const VERSINE: Terms = terms(2);
const LAG: Terms = terms(3);

/// (-1)^n / (2n + first)! for n from 0.
const fn terms(first: usize) -> Terms {
    let mut terms = [0.0; 9];
    let (mut factorial, mut k, mut n) = (1.0, 1, 0);
    while n < terms.len() {
        while k <= 2 * n + first {
            factorial *= k as f64;
            k += 1;
        }
        terms[n] = if n % 2 == 0 { 1.0 } else { -1.0 } / factorial;
        n += 1;
    }
    terms
}

#[inline(always)]
fn horner(terms: &Terms, x: f64) -> f64 {
    let mut sum = terms[8];
    for n in (0..8).rev() {
        sum = sum * x + terms[n];
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frenet::Apparatus;
    use glam::DMat3;
    use proptest::prelude::*;

    /// exp(Q ds) by its Taylor series of a small part, squared.
    fn exponential(k: f64, t: f64) -> DMat3 {
        let q = DMat3::from_cols_array_2d(&[[0.0, -k, 0.0], [k, 0.0, -t], [0.0, t, 0.0]]);
        let small = q * (1.0 / 1024.0);
        let mut sum = DMat3::IDENTITY;
        for n in (1..=12).rev() {
            sum = DMat3::IDENTITY + small * sum * (1.0 / n as f64);
        }
        (0..10).fold(sum, |power, _| power * power)
    }

    fn rows(step: &Step) -> [[f64; 3]; 3] {
        step.basis.map(|row| row.to_array())
    }

    proptest! {
        #[test]
        fn the_basis_turns_by_the_matrix_exponential(k in -9.0f64..9.0, t in -9.0f64..9.0) {
            let step = Step::new(Segment { length: 1.0, curvature: k, torsion: t });
            let exact = exponential(k, t).transpose().to_cols_array_2d();
            for (row, expected) in rows(&step).iter().zip(exact) {
                for (x, y) in row.iter().zip(expected) {
                    prop_assert!((x - y).abs() < 1e-12, "{} {}", x, y);
                }
            }
        }

        #[test]
        fn two_halves_are_a_whole_at_any_size_and_in_any_unit(
            k in -9.0f64..9.0, t in -9.0f64..9.0, exponent in -9.0f64..0.0, unit in -30.0f64..30.0,
        ) {
            let (small, unit) = (libm::pow(10.0, exponent), libm::exp(unit));
            let (curvature, torsion) = (k * small / unit, t * small / unit);
            let step = |length| Step::new(Segment { length, curvature, torsion });
            let (whole, half) = (step(unit), step(unit / 2.0));
            let (first, all) = (half.frame(&Frame::IDENTITY), whole.frame(&Frame::IDENTITY));
            let twice = half.frame(&first);
            prop_assert!(twice.tangent.distance(all.tangent) < 1e-14);
            prop_assert!(twice.binormal.distance(all.binormal) < 1e-14);
            let shift = half.shift(&Frame::IDENTITY) + half.shift(&first);
            prop_assert!(shift.distance(whole.shift(&Frame::IDENTITY)) < 1e-14 * unit);
        }
    }

    /// Radius 1, rise 2πp a turn, from angle 0, where the basis looks inwards.
    fn helix(pitch: f64, angle: f64) -> DVec3 {
        DVec3::new(libm::cos(angle), libm::sin(angle), pitch * angle)
    }

    #[test]
    fn circles_and_helices_are_exact_to_rounding_at_any_step() {
        for pitch in [0.0f64, 0.3, -2.0] {
            for per_step in [1e-4, 0.1, 1.0, 2.0, 5.0] {
                let speed = (1.0 + pitch * pitch).sqrt();
                let segment = Segment {
                    length: per_step * speed,
                    curvature: 1.0 / (speed * speed),
                    torsion: pitch / (speed * speed),
                };
                let apparatus = Apparatus {
                    start: helix(pitch, 0.0),
                    frame: Frame::new(DVec3::new(0.0, 1.0, pitch), -DVec3::X),
                    segments: vec![segment; 100],
                };
                for (i, point) in apparatus.points().iter().enumerate() {
                    let miss = point.distance(helix(pitch, per_step * i as f64));
                    let size = 1.0 + per_step * i as f64 * speed;
                    assert!(miss < 1e-13 * size, "{pitch} {per_step}: {miss}");
                }
            }
        }
    }
}
