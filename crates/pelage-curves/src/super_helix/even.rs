//! From the least mean square to a smaller largest error.
//!
//! The global fit leaves its largest errors in few places. Weights that grow with a power of
//! the error press them down at the cost of the others (iteratively reweighted least squares
//! towards a higher norm, after C. L. Lawson), which often is worth an element.

use super::relax::Relax;
use super::shape::Shape;
use super::target::Samples;

/// Powers of the error that weights are, one a round. Higher ones soon move back and forth.
const POWERS: [f64; 6] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];

/// Steps of relaxation of each round.
const STEPS: usize = 3;

/// No weight is less than this part of the largest.
const LEAST: f64 = 1e-3;

impl Relax<'_> {
    /// Moves `shape` until its largest error at the samples is below `enough`, or to the
    /// smallest on the way; gives how many steps were tried.
    pub fn even_out(&self, shape: &mut Shape, samples: &Samples, enough: f64) -> usize {
        let mut steps = 0;
        let mut distances = shape.distances(samples);
        let mut least = largest(&distances);
        let mut moving = shape.clone();
        for power in POWERS {
            let worst = largest(&distances);
            let weight = |d: &f64| libm::pow(d / worst, power).max(LEAST);
            let weights: Vec<f64> = distances.iter().map(weight).collect();
            let mut weighted = Relax {
                steps: STEPS,
                solver: self.solver,
                ..*self
            };
            weighted.freedom.weights = Some(&weights);
            steps += weighted.run(&mut moving, samples).1;
            distances = moving.distances(samples);
            if largest(&distances) < least {
                least = largest(&distances);
                shape.clone_from(&moving);
            }
            if least <= enough {
                break;
            }
        }
        steps
    }
}

fn largest(distances: &[f64]) -> f64 {
    distances.iter().copied().fold(0.0, f64::max)
}
