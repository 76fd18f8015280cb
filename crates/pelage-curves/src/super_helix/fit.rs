//! A Super-Helix for any curve: local fit, global fit, reduction.
//!
//! For a number of elements the reduction starts from half as many again. For a bound of
//! the error, elements are first added, half as many again at a time from 1, until the
//! bound is kept, and then removed one by one as long as it is: most strands need few, and
//! a reduction from many would take most of its time to get there.

use super::bound::upper_bound;
use super::curve::SuperHelix;
use super::error::FitError;
use super::linear::Freedom;
use super::relax::Relax;
use super::settings::{Fit, Goal, Reached, Settings};
use super::shape::Shape;
use super::target::{Samples, Target};
use crate::frenet::{Frame, SpaceCurve};
use glam::DMat3;

/// Steps of relaxation of a fit on the way, and of the last.
const STEPS: [usize; 2] = [8, 30];

/// Gain of a step at which a fit on the way is left, and the last.
const GAIN: [f64; 2] = [3e-2, 1e-3];

/// What turning as much as the target costs, as a part of the misses.
const CALM: f64 = 0.02;

/// Samples an element at least.
const SAMPLES_PER_ELEMENT: usize = 4;

/// A largest error of so many times the bound may come within it by evening out.
const EVENED: f64 = 2.0;

/// What is left to errors between samples.
const MARGIN: f64 = 0.01;

/// Fits a Super-Helix to `target`.
///
/// A target without length, a point, is fitted by one element without length.
///
/// # Errors
///
/// [`FitError::Target`] where the target is no curve, and what [`Settings`] cannot be. A
/// bound that is not kept by [`Settings::most_elements`] is no error: [`Fit::kept`] tells.
///
/// ```
/// use pelage_curves::{Chain, DVec3};
/// use pelage_curves::super_helix::{Goal, Settings, fit};
/// let wave: Vec<DVec3> = (0..100)
///     .map(|i| i as f64 * 0.1)
///     .map(|x| DVec3::new(x, 0.2 * libm::sin(2.0 * x), 0.0))
///     .collect();
/// let target = Chain::catmull_rom(&wave, 0.5)?;
/// let found = fit(&target, &Settings::new(Goal::RelativeError(0.01)))?;
/// assert!(found.kept && found.worst <= 0.01 * found.curve.length());
/// assert!(found.curve.numbers() * 6 < 3 * wave.len());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn fit(target: &impl SpaceCurve, settings: &Settings) -> Result<Fit, FitError> {
    settings.check()?;
    let target = Target::new(target)?;
    if target.length <= 0.0 {
        return Ok(point(&target));
    }
    let samples = target.samples();
    let search = Search {
        target,
        samples,
        settings: *settings,
        reached: Vec::new(),
        steps: 0,
    };
    Ok(match settings.goal {
        Goal::Elements(elements) => search.down_to(elements),
        Goal::RelativeError(bound) => search.within(bound),
        Goal::Error(bound) => {
            let bound = bound / search.target.length;
            search.within(bound)
        }
    })
}

/// What is fitted to a target without length.
fn point<C: SpaceCurve>(target: &Target<C>) -> Fit {
    let frame = Frame::IDENTITY;
    let root = DMat3::from_cols(frame.tangent, frame.normal, frame.binormal);
    Fit {
        curve: SuperHelix::of_parts(target.start, root, vec![Default::default()]),
        worst: 0.0,
        mean: 0.0,
        reached: vec![Reached {
            elements: 1,
            worst: 0.0,
            mean: 0.0,
        }],
        kept: true,
        steps: 0,
    }
}

/// A fit under way.
struct Search<'a, C> {
    target: Target<'a, C>,
    samples: Samples,
    settings: Settings,
    reached: Vec<Reached>,
    steps: usize,
}

impl<C: SpaceCurve> Search<'_, C> {
    fn relax(&self, last: bool) -> Relax<'static> {
        let Settings {
            orientation,
            turn_root,
            move_joints,
            solver,
            ..
        } = self.settings;
        let stage = usize::from(last);
        Relax {
            freedom: Freedom {
                joints: move_joints,
                root: turn_root,
                orientation,
                weights: None,
            },
            solver,
            steps: STEPS[stage],
            gain: GAIN[stage],
            calm: CALM,
        }
    }

    /// The local fit of some elements, relaxed.
    fn grown(&mut self, elements: usize) -> Shape {
        if self.samples.steps() < SAMPLES_PER_ELEMENT * elements {
            self.samples = self.target.sampled(SAMPLES_PER_ELEMENT * elements);
        }
        let mut shape = Shape::local(&self.samples, elements);
        self.steps += self.relax(false).run(&mut shape, &self.samples).1;
        self.note(&shape);
        shape
    }

    /// One element less.
    fn reduced(&mut self, shape: &Shape) -> Shape {
        let (reduced, steps) = self.relax(false).reduced(shape, &self.samples);
        self.steps += steps;
        self.note(&reduced);
        reduced
    }

    /// Lowers the largest error of a shape to `bound` if it can; gives an upper bound of it.
    fn evened(&mut self, shape: &mut Shape, bound: f64) -> f64 {
        let relax = self.relax(false);
        self.steps += relax.even_out(shape, &self.samples, bound * (1.0 - MARGIN));
        self.note(shape);
        self.worst(shape, bound)
    }

    /// Keeps the error of a shape.
    fn note(&mut self, shape: &Shape) {
        let misses = shape.misses(&self.samples);
        self.reached.push(Reached {
            elements: shape.elements(),
            worst: misses.worst * self.target.length,
            mean: misses.mean * self.target.length,
        });
    }

    fn down_to(mut self, elements: usize) -> Fit {
        let start = self
            .settings
            .start
            .unwrap_or(elements + elements.div_ceil(2));
        let mut shape = self.grown(start.max(elements));
        while shape.elements() > elements {
            shape = self.reduced(&shape);
        }
        self.finish(&mut shape);
        let worst = shape.misses(&self.samples).worst;
        let worst = upper_bound(&self.target, &shape, &self.samples, worst * 1.02);
        self.told(shape, worst, true)
    }

    fn within(mut self, bound: f64) -> Fit {
        let mut elements = 1;
        let (mut shape, mut worst) = loop {
            let shape = self.grown(elements);
            let worst = self.worst(&shape, bound);
            if worst <= bound || elements >= self.settings.most_elements {
                break (shape, worst);
            }
            elements = (elements + elements.div_ceil(2)).min(self.settings.most_elements);
        };
        while worst <= bound && shape.elements() > 1 {
            let mut less = self.reduced(&shape);
            let mut now = self.worst(&less, bound);
            if now > bound && now <= EVENED * bound {
                now = self.evened(&mut less, bound);
            }
            if now > bound {
                break;
            }
            (shape, worst) = (less, now);
        }
        self.told(shape, worst, worst <= bound)
    }

    /// An upper bound of the error, as near as tells whether it is within `bound`.
    fn worst(&self, shape: &Shape, bound: f64) -> f64 {
        let seen = shape.misses(&self.samples).worst;
        match seen > bound {
            true => seen,
            false => upper_bound(&self.target, shape, &self.samples, bound),
        }
    }

    fn finish(&mut self, shape: &mut Shape) {
        self.steps += self.relax(true).run(shape, &self.samples).1;
        self.note(shape);
    }

    fn told(mut self, shape: Shape, worst: f64, kept: bool) -> Fit {
        let length = self.target.length;
        let elements = shape.scaled(length);
        self.reached.sort_by(|a, b| {
            let same = a.elements.cmp(&b.elements);
            same.then(a.worst.total_cmp(&b.worst))
        });
        self.reached.dedup_by_key(|reached| reached.elements);
        for i in 1..self.reached.len() {
            let fewer = self.reached[i - 1];
            if fewer.worst < self.reached[i].worst {
                self.reached[i].worst = fewer.worst;
                self.reached[i].mean = fewer.mean;
            }
        }
        Fit {
            worst: worst * length,
            mean: shape.misses(&self.samples).mean * length,
            curve: SuperHelix::of_parts(self.target.start, shape.root, elements),
            reached: self.reached,
            kept,
            steps: self.steps,
        }
    }
}

#[cfg(test)]
#[path = "fit_tests.rs"]
mod tests;

#[cfg(test)]
#[path = "odd_tests.rs"]
mod odd_tests;
