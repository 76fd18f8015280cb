//! A true upper bound of a fit's error, at equal arc length.
//!
//! On a part of length h with its ends known, a curve of unit speed is within λh of one end
//! and (1-λ)h of the other, so (Stewart's theorem) within √(λ(1-λ)(h²-c²)) ≤ ½√(h²-c²) of
//! the point that divides its chord c alike. So the distance of two curves on a part is at
//! most the larger of that at its ends plus ½√(h²-c²) of each. That needs no derivative: it
//! holds for corners and cusps, and for smooth curves it is about κh²/7. Parts where it is
//! too much are halved. It is as true as the arc length is: to 1e-10 of the length, which
//! leaves the bound some 1e-6 of the length above the error at best.

use super::curve::SuperHelix;
use super::shape::Shape;
use super::target::{Samples, Target};
use crate::frenet::SpaceCurve;
use glam::DVec3;

/// Most halvings of a part between two samples.
const DEEPEST: u32 = 12;

/// Both curves at one arc length, in units of the length.
#[derive(Clone, Copy)]
struct Pair {
    s: f64,
    target: DVec3,
    fit: DVec3,
}

impl Pair {
    fn distance(&self) -> f64 {
        self.target.distance(self.fit)
    }
}

/// No two places at equal arc length of the target and the shape are farther apart than
/// this, in units of the length. Parts are halved until it is known to be at most `enough`,
/// or how it cannot be.
pub(super) fn upper_bound<C: SpaceCurve>(
    target: &Target<C>,
    shape: &Shape,
    samples: &Samples,
    enough: f64,
) -> f64 {
    let curve = SuperHelix::of_parts(DVec3::ZERO, shape.root, shape.scaled(1.0));
    let at = |s: f64| Pair {
        s,
        target: target.at(s)[0],
        fit: curve.at(s).position,
    };
    let sample = |i: usize| Pair {
        s: samples.s(i),
        target: samples.points[i],
        fit: curve.at(samples.s(i)).position,
    };
    let mut before = sample(0);
    let mut worst = 0.0;
    for i in 1..=samples.steps() {
        let after = sample(i);
        worst = f64::max(worst, on_part(&at, before, after, enough, DEEPEST));
        before = after;
    }
    worst
}

fn on_part(at: &impl Fn(f64) -> Pair, a: Pair, b: Pair, enough: f64, depth: u32) -> f64 {
    let h = b.s - a.s;
    let sag = |chord: f64| (h * h - chord * chord).max(0.0).sqrt() / 2.0;
    let ends = a.distance().max(b.distance());
    let sags = sag(a.target.distance(b.target)) + sag(a.fit.distance(b.fit));
    if ends + sags <= enough || ends > enough || depth == 0 {
        return ends + sags;
    }
    let middle = at((a.s + b.s) / 2.0);
    let first = on_part(at, a, middle, enough, depth - 1);
    first.max(on_part(at, middle, b, enough, depth - 1))
}
