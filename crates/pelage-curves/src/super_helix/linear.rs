//! The linear model of a shape: how errors at samples move with its unknowns.
//!
//! An element moves what comes after it like one rigid body, by a screw. So a product with
//! the Jacobian carries one screw from the root to the tip, one with its transpose one
//! force and torque from the tip to the root, and each costs O(elements + samples); the
//! matrix, 3 samples × 4 elements, is never there.
//!
//! The unknowns are blocks of four: first the spin of the root frame (and a 0), then for
//! each element the change of (q0, q1, q2) and of the joint at its end. Moving a joint by δ
//! lengthens one element and shortens the next: all that comes after turns about the joint
//! by δ R (ω - ω'), as both elements have the same tangent there.

use super::element::Motion;
use super::shape::Shape;
use super::target::Samples;
use glam::{DMat3, DVec3};

/// One block of unknowns, or of what belongs to them.
pub(super) type Block = [f64; 4];

/// A force and a torque, or a shift and a spin, about a node.
type Screw = [DVec3; 2];

/// Three residuals.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// How much of the node's shift the row sees: its weight for a position, 0 for a tangent.
    pub mass: f64,
    /// What the node's spin turns: weight times arm.
    pub arm: DVec3,
    /// Derivative with respect to the own element's (q0, q1, q2).
    pub block: DMat3,
    /// Weight times error.
    pub residual: DVec3,
}

/// How an element hands on what comes from before it, and adds its own.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    /// From its start to its end.
    pub chord: DVec3,
    /// Derivative of the end's position with respect to (q0, q1, q2).
    pub shift: DMat3,
    /// Spin of the end per unit of each.
    pub spin: DMat3,
    /// Spin of what comes after per unit that the joint at its end moves.
    pub jump: DVec3,
    /// Index of its first row.
    pub first: usize,
}

/// Which unknowns may move, and what counts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Freedom<'a> {
    pub joints: bool,
    pub root: bool,
    /// Weight of a tangent's error against one of the position, as a length in units of the
    /// target's.
    pub orientation: f64,
    /// One weight a sample; none for 1 everywhere.
    pub weights: Option<&'a [f64]>,
}

#[derive(Clone, Debug)]
pub(super) struct Linear {
    pub links: Vec<Link>,
    pub rows: Vec<Row>,
    /// Whether the root may turn.
    pub root: bool,
}

impl Linear {
    pub fn new(shape: &Shape, samples: &Samples, freedom: &Freedom) -> Self {
        let mut rows = Vec::with_capacity(samples.points.len());
        let mut firsts = vec![0; shape.elements()];
        let mut sample = 0;
        shape.walk(samples, |element, start, frame, motion| {
            sample += 1;
            let weight = freedom.weight(samples, sample);
            let arm = *frame * motion.shift();
            rows.push(Row {
                mass: weight,
                arm: arm * weight,
                block: *frame * motion.shift_by_rate() * weight,
                residual: (start + arm - samples.points[sample]) * weight,
            });
            if freedom.orientation > 0.0 {
                let weight = weight * freedom.orientation;
                let (tangent, spin) = (*frame * motion.tangent(), *frame * motion.spin());
                let turned = |k: usize| spin.col(k).cross(tangent) * weight;
                rows.push(Row {
                    mass: 0.0,
                    arm: tangent * weight,
                    block: DMat3::from_cols(turned(0), turned(1), turned(2)),
                    residual: (tangent - samples.tangents[sample]) * weight,
                });
            }
            firsts[element] = rows.len();
        });
        // From where each element's rows end to where they start; some have none.
        let mut end = 0;
        for first in &mut firsts {
            (*first, end) = (end, end.max(*first));
        }
        Self {
            links: links(shape, freedom.joints, &firsts),
            rows,
            root: freedom.root,
        }
    }

    /// The rows of an element.
    #[inline(always)]
    pub fn rows_of(&self, element: usize) -> &[Row] {
        let end = self.links.get(element + 1).map(|link| link.first);
        &self.rows[self.links[element].first..end.unwrap_or(self.rows.len())]
    }

    /// J · `step`: one vector a row.
    pub fn product(&self, step: &[Block], out: &mut [DVec3]) {
        let mut screw: Screw = [DVec3::ZERO, rate(&step[0])];
        let mut at = 0;
        for (i, link) in self.links.iter().enumerate() {
            let own = rate(&step[i + 1]);
            for row in self.rows_of(i) {
                out[at] = screw[0] * row.mass + screw[1].cross(row.arm) + row.block * own;
                at += 1;
            }
            screw = [
                screw[0] + screw[1].cross(link.chord) + link.shift * own,
                screw[1] + link.spin * own + link.jump * step[i + 1][3],
            ];
        }
    }

    /// Jᵀ · `forces`, one a row.
    pub fn transposed(&self, forces: impl Fn(usize) -> DVec3, out: &mut [Block]) {
        let [mut force, mut torque] = [DVec3::ZERO; 2];
        for (i, link) in self.links.iter().enumerate().rev() {
            let joint = link.jump.dot(torque);
            let mut own = link.shift.transpose() * force + link.spin.transpose() * torque;
            torque += link.chord.cross(force);
            for (k, row) in self.rows_of(i).iter().enumerate() {
                let w = forces(link.first + k);
                own += row.block.transpose() * w;
                force += w * row.mass;
                torque += row.arm.cross(w);
            }
            out[i + 1] = [own.x, own.y, own.z, joint];
        }
        out[0] = match self.root {
            true => [torque.x, torque.y, torque.z, 0.0],
            false => [0.0; 4],
        };
    }
}

impl Freedom<'_> {
    /// Such that the sum of squares is a mean.
    #[inline(always)]
    fn weight(&self, samples: &Samples, sample: usize) -> f64 {
        let own = self.weights.map_or(1.0, |weights| weights[sample]);
        (own / samples.steps() as f64).sqrt()
    }

    /// [`Linear::cost`] without derivatives.
    pub fn cost(&self, shape: &Shape, samples: &Samples) -> f64 {
        let (mut sum, mut sample) = (0.0, 0);
        shape.walk(samples, |_, start, frame, motion| {
            sample += 1;
            let weight = self.weight(samples, sample);
            let miss = start + *frame * motion.shift() - samples.points[sample];
            sum += miss.length_squared() * (weight * weight);
            if self.orientation > 0.0 {
                let miss = *frame * motion.tangent() - samples.tangents[sample];
                sum +=
                    miss.length_squared() * (weight * self.orientation * weight * self.orientation);
            }
        });
        sum / 2.0
    }
}

#[inline(always)]
fn rate(block: &Block) -> DVec3 {
    DVec3::new(block[0], block[1], block[2])
}

fn links(shape: &Shape, joints: bool, firsts: &[usize]) -> Vec<Link> {
    let mut frame = shape.root;
    let rates = shape.rates.iter().enumerate();
    rates
        .map(|(i, &rate)| {
            let motion = Motion::new(rate, shape.length(i));
            let end = frame * motion.turn();
            let jump = match shape.rates.get(i + 1) {
                Some(&next) if joints => end * (rate - next),
                _ => DVec3::ZERO,
            };
            let link = Link {
                chord: frame * motion.shift(),
                shift: frame * motion.shift_by_rate(),
                spin: frame * motion.spin(),
                jump,
                first: firsts[i],
            };
            frame = end;
            link
        })
        .collect()
}

#[cfg(test)]
#[path = "linear_tests.rs"]
mod tests;
