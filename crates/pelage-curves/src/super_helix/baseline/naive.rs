//! The straightforward way that document 002 shows failing.
//!
//! From the root to the tip, each element is fitted to its part of the target from where
//! the one before ended, and stays. What one misses turns and shifts all after it.

use crate::frenet::SpaceCurve;
use crate::super_helix::error::FitError;
use crate::super_helix::linear::Freedom;
use crate::super_helix::relax::Relax;
use crate::super_helix::settings::Solver;
use crate::super_helix::shape::Shape;
use crate::super_helix::target::{Samples, Target};
use crate::super_helix::{Element, SuperHelix};

/// Samples of an element: enough for the three numbers and to see it bend.
const SAMPLES: usize = 8;

/// `elements` of equal length, one after the other by Gauss–Newton steps on the distance
/// from the target. A target without length gives one element without length.
///
/// # Errors
///
/// [`FitError::Target`], [`FitError::NoElements`].
pub fn root_to_tip(target: &impl SpaceCurve, elements: usize) -> Result<SuperHelix, FitError> {
    let target = Target::new(target)?;
    if elements == 0 {
        return Err(FitError::NoElements);
    }
    let all = target.sampled(elements * SAMPLES);
    let mut shape = Shape::local(&all, elements);
    if target.length <= 0.0 {
        let parts = vec![Element::default()];
        return Ok(SuperHelix::of_parts(target.start, shape.root, parts));
    }
    let relax = Relax {
        freedom: Freedom {
            joints: false,
            root: false,
            orientation: 0.0,
            weights: None,
        },
        solver: Solver::Sweep,
        steps: 20,
        gain: 1e-6,
        calm: 0.0,
    };
    let (mut position, mut frame) = (glam::DVec3::ZERO, shape.root);
    for i in 0..elements {
        let length = shape.length(i);
        // The part of the target, from where the curve has come to.
        let points = &all.points[i * SAMPLES..=(i + 1) * SAMPLES];
        let mut one = Shape {
            joints: vec![0.0, 1.0],
            rates: vec![shape.rates[i] * length],
            root: frame,
        };
        let samples = Samples {
            points: points.iter().map(|&p| (p - position) / length).collect(),
            tangents: all.tangents[i * SAMPLES..=(i + 1) * SAMPLES].to_vec(),
            turning: 0.0,
        };
        relax.run(&mut one, &samples);
        shape.rates[i] = one.rates[0] / length;
        let element = Element::new(length, shape.rates[i]);
        let end = SuperHelix::of_parts(position, frame, vec![element]).at(length);
        position = end.position;
        frame = glam::DMat3::from_cols(end.frame.tangent, end.frame.normal, end.frame.binormal);
    }
    let elements = shape.scaled(target.length);
    Ok(SuperHelix::of_parts(target.start, shape.root, elements))
}
