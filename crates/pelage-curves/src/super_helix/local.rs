//! Step 1 of document 002: each element from the Frenet–Serret analysis of its part of the
//! target, refined on end point and orientation.
//!
//! The curvature of the samples' polygon is told in a frame that does not twist. There the
//! torsion is how fast the curvature's direction turns, measured over an element at once as
//! one angle, with a weight of curvature squared: inflections and straight parts, where the
//! Frenet frame jumps, have no say, and any number of turns is seen as long as samples are
//! closer than half of one.

use super::element::Motion;
use super::shape::Shape;
use super::target::Samples;
use crate::framing::turned;
use crate::frenet::{Frame, unit};
use glam::{DMat3, DVec2, DVec3};

/// Steps of the refinement; it has three unknowns and starts near.
const STEPS: usize = 6;

impl Shape {
    /// `elements` of equal length, at most one a step of the samples, each fitted to its
    /// part of them from where that starts.
    pub fn local(samples: &Samples, elements: usize) -> Self {
        let steps = samples.steps();
        let elements = elements.min(steps);
        let joint = |i: usize| i * steps / elements;
        let mut frame = Frame::new(samples.tangents[0], DVec3::ZERO);
        let root = DMat3::from_cols(frame.tangent, frame.normal, frame.binormal);
        let mut rates = Vec::with_capacity(elements);
        for i in 0..elements {
            let (from, to) = (joint(i), joint(i + 1));
            let rate = refined(
                samples,
                from,
                to,
                &frame,
                analysed(samples, from, to, &frame),
            );
            let turn = Motion::new(rate, samples.s(to) - samples.s(from)).turn();
            rates.push(rate);
            // The next one starts with the target's tangent and this one's normal.
            frame = Frame::new(samples.tangents[to], frame.vector(turn.y_axis));
        }
        Self {
            joints: (0..=elements).map(|i| samples.s(joint(i))).collect(),
            rates,
            root,
        }
    }
}

/// Twist and curvatures of the samples `from..=to`, in `frame` at the first of them.
fn analysed(samples: &Samples, from: usize, to: usize, frame: &Frame) -> DVec3 {
    let points = &samples.points;
    let edge = |i: usize| unit(points[i + 1] - points[i]);
    let inner = from.max(1)..(to + 1).min(samples.steps());
    let mut carried = *frame;
    if let Some(tangent) = edge(inner.start - 1) {
        carried = Frame::new(tangent, turned(&carried, tangent));
    }
    let mut bends: Vec<DVec2> = Vec::with_capacity(inner.len());
    for i in inner {
        let Some(tangent) = edge(i) else { continue };
        bends.push(bend(&carried, tangent));
        carried = Frame::new(tangent, turned(&carried, tangent));
    }
    let pairs = bends.windows(2);
    let [sine, cosine] = pairs.fold([0.0, 0.0], |[s, c], b| {
        [s + b[0].perp_dot(b[1]), c + b[0].dot(b[1])]
    });
    let twist = libm::atan2(sine, cosine);
    let back = bends.iter().enumerate().map(|(i, bend)| {
        let angle = -twist * i as f64;
        DVec2::new(libm::cos(angle), libm::sin(angle)).rotate(*bend)
    });
    let mean = back.sum::<DVec2>() / bends.len().max(1) as f64;
    DVec3::new(twist, -mean.y, mean.x) * samples.steps() as f64
}

/// The angle to a new tangent, as a vector of the normal and the binormal.
fn bend(frame: &Frame, to: DVec3) -> DVec2 {
    let across = to - frame.tangent * to.dot(frame.tangent);
    let angle = libm::atan2(across.length(), to.dot(frame.tangent));
    let towards = unit(across).unwrap_or(frame.normal);
    DVec2::new(towards.dot(frame.normal), towards.dot(frame.binormal)) * angle
}

/// The rate that best brings `frame` at sample `from` to the position and the tangent at
/// `to`, found from `rate` by damped Gauss–Newton steps; a radian of the tangent counts as
/// much as a miss by the element's length.
fn refined(samples: &Samples, from: usize, to: usize, frame: &Frame, rate: DVec3) -> DVec3 {
    let length = samples.s(to) - samples.s(from);
    let base = DMat3::from_cols(frame.tangent, frame.normal, frame.binormal);
    let chord = base.transpose() * (samples.points[to] - samples.points[from]);
    let tangent = base.transpose() * samples.tangents[to];
    let misses = |motion: &Motion| {
        [
            motion.shift() - chord,
            (motion.tangent() - tangent) * length,
        ]
    };
    let cost = |[p, t]: [DVec3; 2]| p.length_squared() + t.length_squared();
    let mut motion = Motion::new(rate, length);
    let mut best = (rate, cost(misses(&motion)));
    let mut damping = 1e-6;
    for _ in 0..STEPS {
        let [miss, turn] = misses(&motion);
        let by_shift = motion.shift_by_rate();
        let (spin, end) = (motion.spin(), motion.tangent());
        let column = |k: usize| spin.col(k).cross(end) * length;
        let by_turn = DMat3::from_cols(column(0), column(1), column(2));
        let square = by_shift.transpose() * by_shift + by_turn.transpose() * by_turn;
        let slope = by_shift.transpose() * miss + by_turn.transpose() * turn;
        // The twist of a straight element has no effect: it keeps what it has.
        let floor = DVec3::splat(1e-12 * length * length * length * length);
        let diagonal = DVec3::new(square.x_axis.x, square.y_axis.y, square.z_axis.z);
        let damped = square + DMat3::from_diagonal(diagonal * damping + floor);
        let moved = best.0 - damped.inverse() * slope;
        let next = Motion::new(moved, length);
        let now = cost(misses(&next));
        if now < best.1 {
            (best, motion, damping) = ((moved, now), next, damping * 0.1);
        } else {
            damping = (damping * 100.0).max(1e-3);
        }
    }
    best.0
}
