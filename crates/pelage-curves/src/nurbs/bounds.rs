//! The box around a rational curve.
//!
//! Weights are positive, so a piece lies in the hull of its points. Pieces whose hull
//! leaves the box of the points known to be on the curve are halved until they do by less
//! than rounding; near an extreme the hull's excess falls to a quarter with every halving.

use super::Nurbs;
use super::pieces::mix;
use glam::{DVec3, DVec4};

/// How far the box may reach beyond the curve, as a part of the box of the control points.
const ACCURACY: f64 = 1e-12;

/// Halvings after which a hull is taken as it is; 30 suffice where the hull shrinks at all.
const DEEPEST: u32 = 60;

impl Nurbs {
    /// Axis-aligned box `(min, max)` that holds the curve, and is larger than the smallest
    /// by 1e-12 of the box of the control points at most.
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let (low, high) = hull(&self.bezier);
        let slack = (high - low) * ACCURACY;
        let start = on_curve(self.bezier[0]);
        let stride = self.degree.max(3);
        let ends = self.bezier.iter().step_by(stride).map(|&p| on_curve(p));
        let (mut low, mut high) = ends.fold((start, start), |(l, h), p| (l.min(p), h.max(p)));
        let (mut outer_low, mut outer_high) = (low, high);
        let mut stack = Vec::new();
        for index in 0..self.breaks.len() - 1 {
            stack.push((self.piece(index).to_vec(), 0));
            while let Some((points, depth)) = stack.pop() {
                let (l, h) = hull(&points);
                if depth < DEEPEST && (l.cmplt(low - slack).any() || h.cmpgt(high + slack).any()) {
                    let [left, right] = halves(points);
                    let middle = on_curve(right[0]);
                    (low, high) = (low.min(middle), high.max(middle));
                    stack.extend([(left, depth + 1), (right, depth + 1)]);
                } else {
                    (outer_low, outer_high) = (outer_low.min(l), outer_high.max(h));
                }
            }
        }
        (outer_low.max(low - slack), outer_high.min(high + slack))
    }
}

fn on_curve(point: DVec4) -> DVec3 {
    point.truncate() / point.w
}

fn hull(points: &[DVec4]) -> (DVec3, DVec3) {
    let first = on_curve(points[0]);
    let rest = points.iter().map(|&p| on_curve(p));
    rest.fold((first, first), |(l, h), p| (l.min(p), h.max(p)))
}

/// De Casteljau's algorithm at the middle.
fn halves(mut points: Vec<DVec4>) -> [Vec<DVec4>; 2] {
    let last = points.len() - 1;
    let mut left = vec![points[0]];
    for round in 1..=last {
        for i in 0..=last - round {
            points[i] = mix(points[i], points[i + 1], 0.5);
        }
        left.push(points[0]);
    }
    [left, points]
}
