//! A Super-Helix of length 1 from the origin: what fits move.

use super::element::{Element, Motion};
use super::target::Samples;
use glam::{DMat3, DVec3};

/// The unknowns of a fit.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    /// Where elements meet, with both ends: one more than elements, from 0 to 1, ascending.
    pub joints: Vec<f64>,
    /// (q0, q1, q2) of each element.
    pub rates: Vec<DVec3>,
    /// The root frame: tangent and two normals.
    pub root: DMat3,
}

/// Errors of a shape at the samples of a target, in units of the length.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Misses {
    pub worst: f64,
    pub mean: f64,
}

impl Shape {
    pub fn elements(&self) -> usize {
        self.rates.len()
    }

    #[inline(always)]
    pub fn length(&self, element: usize) -> f64 {
        self.joints[element + 1] - self.joints[element]
    }

    /// Calls `visit` with the element, its start and frame, and the motion to each sample,
    /// in order; the first sample, the root, is left out.
    #[inline(always)]
    pub fn walk(&self, samples: &Samples, mut visit: impl FnMut(usize, DVec3, &DMat3, &Motion)) {
        let (mut position, mut frame) = (DVec3::ZERO, self.root);
        let mut next = 1;
        for (element, &rate) in self.rates.iter().enumerate() {
            let (start, end) = (self.joints[element], self.joints[element + 1]);
            let last = element + 1 == self.rates.len();
            while next < samples.points.len() && (last || samples.s(next) <= end) {
                let motion = Motion::new(rate, samples.s(next) - start);
                visit(element, position, &frame, &motion);
                next += 1;
            }
            let whole = Motion::new(rate, end - start);
            position += frame * whole.shift();
            frame *= whole.turn();
        }
    }

    /// Distance from each sample, at equal arc length; the first is 0.
    pub fn distances(&self, samples: &Samples) -> Vec<f64> {
        let mut distances = vec![0.0];
        self.walk(samples, |_, start, frame, motion| {
            let point = start + *frame * motion.shift();
            distances.push(point.distance(samples.points[distances.len()]));
        });
        distances
    }

    pub fn misses(&self, samples: &Samples) -> Misses {
        let distances = self.distances(samples);
        Misses {
            worst: distances.iter().copied().fold(0.0, f64::max),
            mean: distances.iter().sum::<f64>() / distances.len() as f64,
        }
    }

    /// Its elements at a length, the sum of theirs whatever the order of summing.
    pub fn scaled(&self, length: f64) -> Vec<Element> {
        // Joints on the grid of the length's last digit: all sums of differences are exact.
        let joint = |&j: &f64| match j >= 1.0 {
            true => length,
            false => (j * length + length) - length,
        };
        let joints: Vec<f64> = self.joints.iter().map(joint).collect();
        let elements = joints.windows(2).zip(&self.rates);
        elements
            .map(|(ends, &rate)| Element::new(ends[1] - ends[0], rate / length))
            .collect()
    }
}
