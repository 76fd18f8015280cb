//! Arc length of any smooth curve, to 1e-10 of it, and its inverse.
//!
//! Source: document 000, equation 38; errata: by Gauss–Legendre quadrature a knot span
//! instead of the Euler steps of equation 42. A span is halved until its halves agree
//! with the whole.

use super::FrenetError;
use super::frame::unit;
use crate::arc_length::NODES;
use glam::DVec3;

/// A curve in pieces, each over a parameter t in 0..=1.
pub trait SpaceCurve {
    /// Number of pieces; at least 1.
    fn pieces(&self) -> usize;

    /// Position, first and second derivative at `t` in 0..=1 of `piece`.
    fn at(&self, piece: usize, t: f64) -> [DVec3; 3];
}

/// Arc length of a curve as a table.
#[derive(Clone, Debug)]
pub struct Measure {
    /// Piece, parameter and arc length of where spans start; the end of all last.
    spans: Vec<(usize, f64, f64)>,
}

/// How well a span's halves have to agree with it, as a part of its length. Halves are
/// much better than they agree.
const ACCURACY: f64 = 1e-11;

/// Most halvings: a cusp needs many, and passes after these.
const DEEPEST: u32 = 24;

impl Measure {
    /// Measures `curve`.
    ///
    /// # Errors
    ///
    /// [`FrenetError::NotFinite`] naming the piece whose length is no number.
    pub fn new(curve: &impl SpaceCurve) -> Result<Self, FrenetError> {
        let mut spans = vec![(0, 0.0, 0.0)];
        let mut total = 0.0;
        for piece in 0..curve.pieces() {
            let velocity = |t: f64| curve.at(piece, t)[1];
            let whole = quadrature(&|t| length(velocity(t)), 0.0, 1.0);
            let least = whole * 1e-14;
            let mut end = |t: f64, part: f64| {
                total += part;
                spans.push((piece, t, total));
            };
            halve(&velocity, [0.0, 1.0], whole, least, DEEPEST, &mut end);
            if !total.is_finite() {
                return Err(FrenetError::NotFinite { index: piece });
            }
        }
        Ok(Self { spans })
    }

    /// Length of the curve.
    pub fn total(&self) -> f64 {
        self.spans.last().map_or(0.0, |span| span.2)
    }

    /// Piece of `curve`, the one measured, and parameter at arc length `s`, clamped to it.
    /// Where two pieces meet it is the second.
    pub fn locate(&self, curve: &impl SpaceCurve, s: f64) -> (usize, f64) {
        let last = self.spans.len() - 1;
        let after = self.spans.partition_point(|&(_, _, c)| c <= s);
        if after > last {
            return (self.spans[last].0, 1.0);
        }
        let ((from, start, before), (piece, end, upto)) =
            (self.spans[after.max(1) - 1], self.spans[after.max(1)]);
        let start = if from == piece { start } else { 0.0 };
        let (target, speed) = (s - before, |t: f64| length(curve.at(piece, t)[1]));
        let mut t = start + (end - start) * (target / (upto - before)).clamp(0.0, 1.0);
        for _ in 0..12 {
            let miss = quadrature(&speed, start, t) - target;
            let here = speed(t);
            if here <= 0.0 || miss.abs() <= 1e-15 * self.total() {
                break;
            }
            t = (t - miss / here).clamp(start, end);
        }
        (piece, t)
    }
}

/// Length of a vector, also of one whose square is out of range.
fn length(vector: DVec3) -> f64 {
    let largest = vector.abs().max_element();
    match largest > 0.0 && largest.is_finite() {
        true => (vector / largest).length() * largest,
        false => largest,
    }
}

/// Tells `end` the parameter and length of the parts of a span that need no halving.
fn halve(
    velocity: &impl Fn(f64) -> DVec3,
    [a, b]: [f64; 2],
    whole: f64,
    least: f64,
    depth: u32,
    end: &mut impl FnMut(f64, f64),
) {
    let speed = |t: f64| length(velocity(t));
    let middle = (a + b) / 2.0;
    let halves = [quadrature(&speed, a, middle), quadrature(&speed, middle, b)];
    let both = halves[0] + halves[1];
    let agree = (both - whole).abs() <= (ACCURACY * both).max(least);
    let done = agree && !turns_back([a, middle, b].map(velocity));
    if done || depth == 0 || !both.is_finite() {
        end(middle, halves[0]);
        end(b, halves[1]);
        return;
    }
    halve(velocity, [a, middle], halves[0], least, depth - 1, end);
    halve(velocity, [middle, b], halves[1], least, depth - 1, end);
}

/// Whether a curve goes back between neighbours of three places: where it does, on a line,
/// its speed has a kink, which halves may miss as the whole does, and agree by chance.
fn turns_back([a, b, c]: [DVec3; 3]) -> bool {
    let back = |v: DVec3, w: DVec3| match (unit(v), unit(w)) {
        (Some(v), Some(w)) => v.dot(w) < 0.0,
        _ => false,
    };
    back(a, b) || back(b, c)
}

/// Integral of `speed` from `a` to `b` by five Gauss–Legendre points.
fn quadrature(speed: &impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    let half = (b - a) / 2.0;
    let parts = NODES.map(|(x, weight)| weight * speed(a + half * (1.0 + x)));
    parts.iter().sum::<f64>() * half
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frenet::CatmullRom;

    /// t², t³ over -1..=1: a cusp, and a length in closed form.
    struct Cusp;

    impl SpaceCurve for Cusp {
        fn pieces(&self) -> usize {
            2
        }

        fn at(&self, piece: usize, t: f64) -> [DVec3; 3] {
            let t = t + piece as f64 - 1.0;
            [
                DVec3::new(t * t, t * t * t, 0.0),
                DVec3::new(2.0 * t, 3.0 * t * t, 0.0),
                DVec3::new(2.0, 6.0 * t, 0.0),
            ]
        }
    }

    #[test]
    fn the_length_of_a_curve_with_a_cusp_is_right_to_1e_10() {
        let half = (13.0 * 13.0f64.sqrt() - 8.0) / 27.0;
        let total = Measure::new(&Cusp).unwrap().total();
        assert!((total / (2.0 * half) - 1.0).abs() < 1e-10, "{total}");
    }

    #[test]
    fn locating_a_length_is_its_inverse() {
        let points: Vec<DVec3> = (0..9)
            .map(|i| i as f64)
            .map(|x| DVec3::new(x * 0.3, libm::sin(x), libm::cos(x * x)))
            .collect();
        let curve = CatmullRom::new(&points).unwrap();
        let measure = Measure::new(&curve).unwrap();
        for i in 0..=200 {
            let s = measure.total() * i as f64 / 200.0;
            let (piece, t) = measure.locate(&curve, s);
            let speed = |t: f64| length(curve.at(piece, t)[1]);
            let start = measure.spans.iter().rev().find(|x| x.0 < piece);
            let parts = (0..64).map(|k| k as f64 / 64.0 * t);
            let inside: f64 = parts.map(|a| quadrature(&speed, a, a + t / 64.0)).sum();
            let found = start.map_or(0.0, |x| x.2) + inside;
            assert!((found - s).abs() < 1e-10, "{s} came back as {found}");
        }
    }
}
