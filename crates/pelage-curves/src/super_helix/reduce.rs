//! Step 3 of document 002: the element that costs least goes, its length to its neighbours.
//!
//! All elements are candidates in a heap with a cheap estimate; the best few are removed
//! and relaxed for a few steps each, and the one that is missed least is relaxed to the
//! end. The heap is made anew for each removal, as relaxing moves all elements: that costs
//! less than one step of the relaxation.

use super::relax::Relax;
use super::shape::Shape;
use super::target::Samples;
use glam::DVec3;
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// Candidates that are tried.
const TRIED: usize = 3;

/// Steps of relaxation of a candidate that is tried.
const TRIAL_STEPS: usize = 2;

/// An element and what its removal is thought to cost.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Candidate {
    cost: f64,
    element: usize,
}

impl Eq for Candidate {}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        let costs = self.cost.total_cmp(&other.cost);
        costs.then(self.element.cmp(&other.element))
    }
}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Relax<'_> {
    /// `shape`, of two elements at least, with one less, relaxed; and the steps tried.
    pub fn reduced(&self, shape: &Shape, samples: &Samples) -> (Shape, usize) {
        let candidates = (0..shape.elements()).map(|element| {
            let cost = shape.loss(element);
            Reverse(Candidate { cost, element })
        });
        let mut heap: BinaryHeap<_> = candidates.collect();
        let trial = Self {
            steps: TRIAL_STEPS,
            ..*self
        };
        let mut steps = 0;
        let best = (0..TRIED)
            .filter_map(|_| heap.pop())
            .map(|Reverse(candidate)| {
                let mut tried = shape.without(candidate.element);
                let (cost, more) = trial.run(&mut tried, samples);
                steps += more;
                (cost, tried)
            });
        let best = best.min_by(|a, b| a.0.total_cmp(&b.0));
        let mut reduced = best.map_or_else(|| shape.clone(), |(_, shape)| shape);
        steps += self.run(&mut reduced, samples).1;
        (reduced, steps)
    }
}

impl Shape {
    /// The shape without an element: its length is spread over its neighbours, whose rates
    /// become the means, by length, of what they are made of.
    fn without(&self, element: usize) -> Self {
        let mut to = self.clone();
        let (joints, rates) = (&self.joints, &self.rates);
        let last = self.elements() - 1;
        let half = self.length(element) / 2.0;
        match element {
            0 => {
                to.rates[1] = mean(rates[0], 2.0 * half, rates[1], self.length(1));
                to.joints.remove(1);
            }
            e if e == last => {
                to.rates[e - 1] = mean(rates[e - 1], self.length(e - 1), rates[e], 2.0 * half);
                to.joints.remove(e);
            }
            e => {
                to.rates[e - 1] = mean(rates[e - 1], self.length(e - 1), rates[e], half);
                to.rates[e + 1] = mean(rates[e], half, rates[e + 1], self.length(e + 1));
                to.joints[e] = joints[e] + half;
                to.joints.remove(e + 1);
            }
        }
        to.rates.remove(element);
        to
    }

    /// What removing an element costs, by how far rates are from the means that would take
    /// their place.
    fn loss(&self, element: usize) -> f64 {
        let last = self.elements() - 1;
        let length = self.length(element);
        let share = match element == 0 || element == last {
            true => length,
            false => length / 2.0,
        };
        let with = |other: usize| {
            let (a, b) = (self.rates[element], self.rates[other]);
            joined(a, share, b, self.length(other))
        };
        let before = if element > 0 { with(element - 1) } else { 0.0 };
        let after = if element < last {
            with(element + 1)
        } else {
            0.0
        };
        before + after
    }
}

fn mean(a: DVec3, la: f64, b: DVec3, lb: f64) -> DVec3 {
    (a * la + b * lb) / (la + lb)
}

/// How far two elements go astray as one, to leading order in their lengths: bends that
/// differ shift it in the second order, twists, as they turn the bends, in the third.
fn joined(a: DVec3, la: f64, b: DVec3, lb: f64) -> f64 {
    let off = (a - b).abs();
    let bend = |q: DVec3| q.y.abs() + q.z.abs();
    (bend(off) + off.x * (bend(a) + bend(b)) * (la + lb) / 6.0) * la * lb
}
