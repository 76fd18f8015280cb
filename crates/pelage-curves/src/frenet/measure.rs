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

    /// The first derivative alone, where that is less work.
    fn velocity(&self, piece: usize, t: f64) -> DVec3 {
        self.at(piece, t)[1]
    }
}

/// Arc length of a curve as a table.
#[derive(Clone, Debug)]
pub struct Measure {
    spans: Vec<Span>,
}

/// A part of a piece that one quadrature measures. It starts where the one before it ends,
/// or with its piece.
#[derive(Clone, Copy, Debug)]
struct Span {
    piece: usize,
    /// Parameter at its end.
    end: f64,
    /// Arc length from the start of the curve to its end.
    upto: f64,
    /// At both ends. They only lead to a guess.
    speeds: [f32; 2],
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
        let mut spans = Vec::with_capacity(2 * curve.pieces());
        let mut total = 0.0;
        for piece in 0..curve.pieces() {
            let velocity = |t: f64| curve.velocity(piece, t);
            let whole = quadrature(&|t| length(velocity(t)), 0.0, 1.0);
            let least = whole * 1e-14;
            let mut add = |end: f64, part: f64, speeds: [f64; 2]| {
                total += part;
                spans.push(Span {
                    piece,
                    end,
                    upto: total,
                    speeds: speeds.map(|speed| speed as f32),
                });
            };
            let ends = [0.0, 1.0].map(|t| (t, velocity(t)));
            halve(&velocity, ends, whole, least, DEEPEST, &mut add);
            if !total.is_finite() {
                return Err(FrenetError::NotFinite { index: piece });
            }
        }
        Ok(Self { spans })
    }

    /// Length of the curve.
    pub fn total(&self) -> f64 {
        self.spans.last().map_or(0.0, |span| span.upto)
    }

    /// Piece of `curve`, the one measured, and parameter at arc length `s`, clamped to it.
    /// Where two pieces meet it is the second.
    pub fn locate(&self, curve: &impl SpaceCurve, s: f64) -> (usize, f64) {
        let number = self.spans.partition_point(|span| span.upto <= s);
        self.locate_in(curve, s, number)
    }

    /// [`locate`](Self::locate) for arc lengths that ascend: `before` is the span of the last
    /// one, 0 at first, and becomes that of this one.
    pub(super) fn locate_next(
        &self,
        curve: &impl SpaceCurve,
        s: f64,
        before: &mut usize,
    ) -> (usize, f64) {
        let later = self.spans[*before..].iter();
        *before += later.take_while(|span| span.upto <= s).count();
        self.locate_in(curve, s, *before)
    }

    /// Where `s` is in span `number`, the end of the curve if there is none.
    fn locate_in(&self, curve: &impl SpaceCurve, s: f64, number: usize) -> (usize, f64) {
        let Some(span) = self.spans.get(number) else {
            return (self.spans[self.spans.len() - 1].piece, 1.0);
        };
        let (piece, end) = (span.piece, span.end);
        let last = number.checked_sub(1).map(|before| self.spans[before]);
        let before = last.map_or(0.0, |last| last.upto);
        let start = last
            .filter(|last| last.piece == piece)
            .map_or(0.0, |last| last.end);
        let target = (s - before).max(0.0);
        let speed = |t: f64| length(curve.velocity(piece, t));
        let mut t = span.guess(start, target, span.upto - before);
        for _ in 0..12 {
            let miss = quadrature(&speed, start, t) - target;
            let [_, first, second] = curve.at(piece, t);
            let here = length(first);
            if here <= 0.0 || miss.abs() <= 1e-15 * self.total() {
                break;
            }
            let step = miss / here;
            // By how much the speed differs over the step, as a part of it.
            let change = (first / here).dot(second / here) * step;
            let small = change.abs() <= NEAR;
            // Where it differs little, a step that knows of it ends a cube of it off.
            let step = if small {
                step * (1.0 + change / 2.0)
            } else {
                step
            };
            t = (t - step).clamp(start, end);
            if small && step.abs() <= NEAR * (end - start) {
                break;
            }
        }
        (piece, t)
    }
}

/// Steps shorter than this part of a span need no other after them: their cube is far below
/// what arc length is known to.
const NEAR: f64 = 1e-4;

impl Span {
    /// Where the arc length `target` of `length` from `start` of the span is about: by the
    /// cubic that has the speeds at both ends.
    fn guess(&self, start: f64, target: f64, length: f64) -> f64 {
        let (x, whole) = ((target / length).clamp(0.0, 1.0), self.end - start);
        // Slopes up to 3 leave a cubic ascending; a NaN is none.
        let slope = |speed: f32| (length / (f64::from(speed) * whole)).min(3.0);
        let [m, n] = self.speeds.map(|speed| slope(speed) - 1.0);
        start + whole * (x + x * (1.0 - x) * (m * (1.0 - x) - n * x))
    }
}

/// Length of a vector, also of one whose square is out of range.
#[inline]
fn length(vector: DVec3) -> f64 {
    let square = vector.length_squared();
    if (1e-200..1e200).contains(&square) {
        return square.sqrt();
    }
    let largest = vector.abs().max_element();
    match largest > 0.0 && largest.is_finite() {
        true => (vector / largest).length() * largest,
        false => largest,
    }
}

/// Tells `add` the end, the length and the speeds at both ends of the parts of a span that
/// need no halving; `a` and `b` are its ends with their velocities.
fn halve(
    velocity: &impl Fn(f64) -> DVec3,
    [a, b]: [(f64, DVec3); 2],
    whole: f64,
    least: f64,
    depth: u32,
    add: &mut impl FnMut(f64, f64, [f64; 2]),
) {
    let speed = |t: f64| length(velocity(t));
    let middle = (a.0 + b.0) / 2.0;
    let middle = (middle, velocity(middle));
    let parts = [[a, middle], [middle, b]];
    let halves = parts.map(|[a, b]| quadrature(&speed, a.0, b.0));
    let both = halves[0] + halves[1];
    let agree = (both - whole).abs() <= (ACCURACY * both).max(least);
    let done = agree && !turns_back([a.1, middle.1, b.1]);
    for (part, half) in parts.into_iter().zip(halves) {
        if done || depth == 0 || !both.is_finite() {
            add(part[1].0, half, part.map(|(_, v)| length(v)));
        } else {
            halve(velocity, part, half, least, depth - 1, add);
        }
    }
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
            let start = measure.spans.iter().rev().find(|x| x.piece < piece);
            let parts = (0..64).map(|k| k as f64 / 64.0 * t);
            let inside: f64 = parts.map(|a| quadrature(&speed, a, a + t / 64.0)).sum();
            let found = start.map_or(0.0, |x| x.upto) + inside;
            assert!((found - s).abs() < 1e-10, "{s} came back as {found}");
        }
    }
}
