//! Step 2 of document 002: Levenberg–Marquardt on all unknowns at once.
//!
//! Damped by the diagonal of the normal matrix (D. Marquardt), the damping led by how well
//! the linear model foretold the cost (H. B. Nielsen, "Damping parameter in Marquardt's
//! method", 1999).

use super::linear::{Block, Freedom, Linear};
use super::quadratic::Blocks;
use super::shape::Shape;
use super::target::Samples;
use super::{Solver, gradients, sweep};
use glam::{DMat3, DVec3};

/// What of the target is fitted, and how far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relax<'a> {
    pub freedom: Freedom<'a>,
    pub solver: Solver,
    /// Most steps that are tried.
    pub steps: usize,
    /// It is over when a step lowers the cost by less than this part of it.
    pub gain: f64,
    /// What a shape that turns as much as the target costs, as a part of its misses: see
    /// [`Prior`].
    pub calm: f64,
}

/// First damping, as a part of the diagonal.
const DAMPING: f64 = 1e-3;

/// Damping beyond which no step helps.
const MOST_DAMPING: f64 = 1e8;

/// A twist, or a bend, is damped by this part of what damps its element's others at least:
/// that of a straight element has no effect but rounding.
const IDLE: f64 = 1e-6;

/// A joint that moves by the shorter of its elements costs so many times the present cost,
/// times the damping: the linear model knows nothing of elements that end.
const STIFFNESS: f64 = 100.0;

/// An element keeps this part of its length in a step at least.
const KEPT_LENGTH: f64 = 0.3;

impl Relax<'_> {
    /// Moves `shape` until its cost hardly falls; gives the misses' part of it and how many steps were
    /// tried.
    pub fn run(&self, shape: &mut Shape, samples: &Samples) -> (f64, usize) {
        let mut miss = self.freedom.cost(shape, samples);
        let mut prior = self.prior(samples, miss);
        let mut cost = miss + prior.cost(shape);
        let (mut damping, mut growth) = (DAMPING, 2.0);
        let mut tried = 0;
        let mut model = self.model(shape, samples, cost, &prior);
        while tried < self.steps && damping < MOST_DAMPING && cost > f64::MIN_POSITIVE {
            tried += 1;
            let foretold = model.step(self.solver, damping);
            let moved = foretold.as_ref().map(|(step, _)| shape.moved(step));
            let misses = moved.as_ref().map(|to| self.freedom.cost(to, samples));
            let costs = moved.as_ref().map_or(0.0, |to| prior.cost(to));
            match (foretold, moved, misses) {
                (Some((_, fall)), Some(to), Some(now)) if now + costs < cost => {
                    let gain = cost - (now + costs);
                    let off = 2.0 * gain / fall - 1.0;
                    damping *= (1.0 - off * off * off).max(1.0 / 10.0);
                    growth = 2.0;
                    (*shape, miss) = (to, now);
                    let next = now + costs;
                    prior = self.prior(samples, miss);
                    cost = miss + prior.cost(shape);
                    if gain <= self.gain * next {
                        break;
                    }
                    if tried < self.steps {
                        model = self.model(shape, samples, cost, &prior);
                    }
                }
                _ => {
                    damping *= growth;
                    growth *= 2.0;
                }
            }
        }
        (miss, tried)
    }

    fn model(&self, shape: &Shape, samples: &Samples, cost: f64, prior: &Prior) -> Model {
        let linear = Linear::new(shape, samples, &self.freedom);
        let mut blocks = Blocks::new(&linear);
        let mut slope = vec![[0.0; 4]; shape.elements() + 1];
        linear.transposed(|row| linear.rows[row].residual, &mut slope);
        let mut calm = vec![[0.0; 4]; shape.elements() + 1];
        for i in 0..shape.elements() {
            let mut pull = prior.gradient(shape, i);
            if !self.freedom.joints {
                pull[3] = 0.0;
            }
            for k in 0..4 {
                slope[i + 1][k] += pull[k];
                blocks.own[i].gradient[6 + k] += pull[k];
            }
            let stiff = prior.0 * shape.length(i);
            calm[i + 1] = [stiff, stiff, stiff, 0.0];
        }
        let mut stiffness = vec![0.0; shape.elements() + 1];
        for (i, stiffness) in stiffness.iter_mut().enumerate().skip(1) {
            let after = shape
                .joints
                .get(i + 1)
                .map_or(1.0, |end| end - shape.joints[i]);
            let shorter = shape.length(i - 1).min(after);
            *stiffness = STIFFNESS * cost / (shorter * shorter);
        }
        Model {
            linear,
            blocks,
            slope,
            calm,
            stiffness,
        }
    }
}

/// The linear model at one shape, for any damping.
struct Model {
    linear: Linear,
    blocks: Blocks,
    /// The gradient of the cost.
    slope: Vec<Block>,
    /// The diagonal Hessian of the prior.
    calm: Vec<Block>,
    /// What joints are damped by beside their diagonal.
    stiffness: Vec<f64>,
}

impl Model {
    /// The step, and by how much the model foretells that it lowers the cost.
    fn step(&self, solver: Solver, damping: f64) -> Option<(Vec<Block>, f64)> {
        let diagonal = self.blocks.diagonal.iter().zip(&self.stiffness);
        let diagonal: Vec<Block> = diagonal
            .map(|(block, stiffness)| {
                let [x, y, z, joint] = std::array::from_fn(|k| block[k][k]);
                let least = IDLE * x.max(y).max(z);
                let all = [x.max(least), y.max(least), z.max(least), joint + stiffness];
                all.map(|d| damping * d + f64::MIN_POSITIVE)
            })
            .collect();
        let (linear, blocks) = (&self.linear, &self.blocks);
        let all = self.calm.iter().zip(&diagonal);
        let all: Vec<Block> = all
            .map(|(calm, d)| std::array::from_fn(|k| calm[k] + d[k]))
            .collect();
        let step = match solver {
            Solver::Sweep => sweep::solve(linear, blocks, &all),
            Solver::ConjugateGradients => gradients::solve(linear, blocks, &all, &self.slope),
        }?;
        let mut fall = 0.0;
        for ((x, d), g) in step.iter().zip(&diagonal).zip(&self.slope) {
            fall += (0..4).map(|k| x[k] * (d[k] * x[k] - g[k])).sum::<f64>() / 2.0;
        }
        (fall > 0.0 && fall.is_finite()).then_some((step, fall))
    }
}

/// What turning costs: an element whose twist nothing tells would turn at will, and one
/// that follows no wave would cross it in a fine coil (the poster's "visually appalling"
/// minima). The factor of half the integral of |ω|².
///
/// It is a part of the misses as they stand, so that a perfect fit has none.
#[derive(Clone, Copy, Debug)]
struct Prior(f64);

impl Relax<'_> {
    fn prior(&self, samples: &Samples, miss: f64) -> Prior {
        let pace = 1.0 + samples.turning;
        Prior(2.0 * self.calm * miss / (pace * pace))
    }
}

impl Prior {
    fn cost(&self, shape: &Shape) -> f64 {
        let square = |i: usize| shape.rates[i].length_squared() * shape.length(i);
        self.0 / 2.0 * (0..shape.elements()).map(square).sum::<f64>()
    }

    /// With respect to an element's four.
    fn gradient(&self, shape: &Shape, element: usize) -> Block {
        let rate = shape.rates[element];
        let pull = rate * (self.0 * shape.length(element));
        let square = |rate: &DVec3| rate.length_squared();
        let joint = match shape.rates.get(element + 1) {
            Some(next) => self.0 / 2.0 * (square(&rate) - square(next)),
            None => 0.0,
        };
        [pull.x, pull.y, pull.z, joint]
    }
}

impl Shape {
    /// The shape after a step of its unknowns, or after the part of it that leaves each
    /// element [`KEPT_LENGTH`].
    pub fn moved(&self, step: &[Block]) -> Self {
        let mut to = self.clone();
        let joint = |i: usize| {
            if i == 0 || i == self.elements() {
                0.0
            } else {
                step[i][3]
            }
        };
        let part = (0..self.elements()).fold(1.0, |part: f64, i| {
            let shrinks = joint(i) - joint(i + 1);
            match shrinks > 0.0 {
                true => part.min((1.0 - KEPT_LENGTH) * self.length(i) / shrinks),
                false => part,
            }
        });
        to.root = turned(self.root, DVec3::from_slice(&step[0][..3]) * part);
        for i in 0..self.elements() {
            to.rates[i] += DVec3::from_slice(&step[i + 1][..3]) * part;
            to.joints[i] += part * joint(i);
        }
        to
    }
}

/// A frame after a spin in space, orthonormal to rounding.
fn turned(frame: DMat3, spin: DVec3) -> DMat3 {
    if spin == DVec3::ZERO {
        return frame;
    }
    let turned = super::element::Motion::new(spin, 1.0).turn() * frame;
    let tangent = turned.x_axis.normalize();
    let normal = (turned.y_axis - tangent * turned.y_axis.dot(tangent)).normalize();
    DMat3::from_cols(tangent, normal, tangent.cross(normal))
}
