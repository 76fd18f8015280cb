//! The damped normal equations by preconditioned conjugate gradients (document 002).
//!
//! Only products with the Jacobian and its transpose are taken, and the preconditioner is
//! the blocks of four on the diagonal of the normal matrix: time O(elements + samples) an
//! iteration, memory linear.

use super::linear::{Block, Linear};
use super::quadratic::{Blocks, Cholesky};
use glam::DVec3;

/// Residual, in the norm of the preconditioner and against the first, at which it is solved.
const ACCURACY: f64 = 1e-10;

/// As [`sweep::solve`](super::sweep::solve), for a gradient `slope`, to [`ACCURACY`], or to what twice as many
/// iterations as there are unknowns (in exact arithmetic: more than all) have reached.
pub(super) fn solve(
    linear: &Linear,
    blocks: &Blocks,
    damping: &[Block],
    slope: &[Block],
) -> Option<Vec<Block>> {
    let roots = preconditioner(blocks, damping)?;
    let precondition = |r: &[Block]| -> Vec<Block> {
        roots
            .iter()
            .zip(r)
            .map(|(root, r)| root.solve(*r))
            .collect()
    };
    let mut residual: Vec<Block> = slope.iter().map(|block| block.map(|x| -x)).collect();
    let mut step = vec![[0.0; 4]; damping.len()];
    let mut direction = precondition(&residual);
    let mut size = dot(&residual, &direction);
    let enough = size * (ACCURACY * ACCURACY);
    let mut products = vec![DVec3::ZERO; linear.rows.len()];
    let mut curved = vec![[0.0; 4]; damping.len()];
    for _ in 0..8 * damping.len() {
        if size <= enough {
            break;
        }
        linear.product(&direction, &mut products);
        linear.transposed(|row| products[row], &mut curved);
        for ((c, d), p) in curved.iter_mut().zip(damping).zip(&direction) {
            (0..4).for_each(|k| c[k] += d[k] * p[k]);
        }
        let along = size / dot(&direction, &curved);
        if !along.is_finite() {
            return None;
        }
        add(&mut step, along, &direction);
        add(&mut residual, -along, &curved);
        let next = precondition(&residual);
        let before = std::mem::replace(&mut size, dot(&residual, &next));
        let keep = size / before;
        for (d, n) in direction.iter_mut().zip(&next) {
            (0..4).for_each(|k| d[k] = n[k] + keep * d[k]);
        }
    }
    Some(step)
}

fn preconditioner(blocks: &Blocks, damping: &[Block]) -> Option<Vec<Cholesky>> {
    let pairs = blocks.diagonal.iter().zip(damping);
    pairs
        .map(|(block, damping)| {
            let mut block = *block;
            (0..4).for_each(|k| block[k][k] += damping[k]);
            Cholesky::new(&block)
        })
        .collect()
}

fn dot(a: &[Block], b: &[Block]) -> f64 {
    let block = |(a, b): (&Block, &Block)| (0..4).map(|k| a[k] * b[k]).sum::<f64>();
    a.iter().zip(b).map(block).sum()
}

fn add(to: &mut [Block], times: f64, what: &[Block]) {
    for (t, w) in to.iter_mut().zip(what) {
        (0..4).for_each(|k| t[k] += times * w[k]);
    }
}
